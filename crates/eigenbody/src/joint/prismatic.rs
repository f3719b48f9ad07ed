//! Translation along z. S = [0; z].

use crate::scalar::Scalar;
use crate::spatial::{Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    S[0] = Motion::new(Vec3::ZERO, Vec3::Z);
    Transform::translation(Vec3::Z * q[0])
}

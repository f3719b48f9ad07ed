//! Rotation about z. S = [z; 0].

use crate::scalar::Scalar;
use crate::spatial::{Mat3, Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    S[0] = Motion::new(Vec3::Z, Vec3::ZERO);
    Transform::new(Mat3::rotation_z(q[0].sin_cos()), Vec3::ZERO)
}

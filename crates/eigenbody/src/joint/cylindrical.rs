//! Rotation about z and translation along z. S = [z 0; 0 z].

use crate::scalar::Scalar;
use crate::spatial::{Mat3, Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    S[0] = Motion::new(Vec3::Z, Vec3::ZERO);
    S[1] = Motion::new(Vec3::ZERO, Vec3::Z);
    Transform::new(Mat3::rotation_z(q[0].sin_cos()), Vec3::Z * q[1])
}

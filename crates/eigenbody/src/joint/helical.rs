//! A screw about z. S = [z; pitch z].

use crate::scalar::Scalar;
use crate::spatial::{Mat3, Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(pitch: T, q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    S[0] = Motion::new(Vec3::Z, Vec3::Z * pitch);
    Transform::new(Mat3::rotation_z(q[0].sin_cos()), Vec3::Z * (pitch * q[0]))
}

//! Any rotation. q = unit quaternion w, x, y, z; v = angular velocity in the body's frame; S = [1; 0].

use super::manifold::{quaternion_exp, quaternion_log, quaternion_product};
use crate::scalar::{Real, Scalar};
use crate::spatial::{Mat3, Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    S[0] = Motion::new(Vec3::X, Vec3::ZERO);
    S[1] = Motion::new(Vec3::Y, Vec3::ZERO);
    S[2] = Motion::new(Vec3::Z, Vec3::ZERO);
    Transform::new(Mat3::rotation_quaternion(q[0], Vec3::new(q[1], q[2], q[3])), Vec3::ZERO)
}

/// q ⊗ exp(ω/2).
pub(super) fn integrate<T: Real>(q: &[T], v: &[T], out: &mut [T]) {
    let turned = quaternion_product([q[0], q[1], q[2], q[3]], quaternion_exp(Vec3::new(v[0], v[1], v[2])));
    out.copy_from_slice(&turned);
}

pub(super) fn difference<T: Real>(from: &[T], to: &[T], out: &mut [T]) {
    let turn = quaternion_log([from[0], from[1], from[2], from[3]], [to[0], to[1], to[2], to[3]]);
    out.copy_from_slice(&turn.to_array());
}

//! Any motion. q = x, y, z, then w, x, y, z; v = [angular; linear] in the body's frame; S = 1.

use super::manifold::{quaternion_exp, quaternion_log, quaternion_product, twist_translation};
use super::tangent::dexp_inverse;
use crate::scalar::{Real, Scalar};
use crate::spatial::{Mat3, Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    S[0] = Motion::new(Vec3::X, Vec3::ZERO);
    S[1] = Motion::new(Vec3::Y, Vec3::ZERO);
    S[2] = Motion::new(Vec3::Z, Vec3::ZERO);
    S[3] = Motion::new(Vec3::ZERO, Vec3::X);
    S[4] = Motion::new(Vec3::ZERO, Vec3::Y);
    S[5] = Motion::new(Vec3::ZERO, Vec3::Z);
    Transform::new(Mat3::rotation_quaternion(q[3], Vec3::new(q[4], q[5], q[6])), Vec3::new(q[0], q[1], q[2]))
}

/// The frame carried along a constant body twist for unit time.
pub(super) fn integrate<T: Real>(q: &[T], v: &[T], out: &mut [T]) {
    let (w, u) = (Vec3::new(v[0], v[1], v[2]), Vec3::new(v[3], v[4], v[5]));
    let E = Mat3::rotation_quaternion(q[3], Vec3::new(q[4], q[5], q[6]));
    let p = Vec3::new(q[0], q[1], q[2]) + E.transpose_times(twist_translation(w, u));
    out[..3].copy_from_slice(&p.to_array());
    out[3..].copy_from_slice(&quaternion_product([q[3], q[4], q[5], q[6]], quaternion_exp(w)));
}

/// The turn, and the linear velocity u with twist_translation(w, u) = the way in the frame before: u = dexp_w⁻¹ of it.
pub(super) fn difference<T: Real>(from: &[T], to: &[T], out: &mut [T]) {
    let w = quaternion_log([from[3], from[4], from[5], from[6]], [to[3], to[4], to[5], to[6]]);
    let E = Mat3::rotation_quaternion(from[3], Vec3::new(from[4], from[5], from[6]));
    let way = E * (Vec3::new(to[0], to[1], to[2]) - Vec3::new(from[0], from[1], from[2]));
    let u = dexp_inverse(Motion::new(w, Vec3::ZERO), Motion::new(Vec3::ZERO, way)).lin;
    out[..3].copy_from_slice(&w.to_array());
    out[3..].copy_from_slice(&u.to_array());
}

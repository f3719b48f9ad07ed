//! Rotation about an axis of the parent, then about z of the body.
//!
//! ```text
//! E = Rz(q₂) R_a(q₁)      S = [ Rz(q₂) a   z ]      S° v = −q̇₁ q̇₂ z × S₁
//!                             [    0       0 ]
//! ```
//! a = the first axis. S° is the change of S in the body's coordinates: z stays, Rz(q₂) a turns with −q̇₂ z.

use crate::scalar::Scalar;
use crate::spatial::{Mat3, Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(first: Vec3<T>, q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    let second = Mat3::rotation_z(q[1].sin_cos());
    S[0] = Motion::new(second * first, Vec3::ZERO);
    S[1] = Motion::new(Vec3::Z, Vec3::ZERO);
    Transform::new(second * Mat3::rotation_about(first, q[0].sin_cos()), Vec3::ZERO)
}

#[inline(always)]
pub(super) fn bias<T: Scalar>(S: &[Motion<T>], v: &[T]) -> Motion<T> {
    Motion::new(Vec3::Z.cross(S[0].ang) * -(v[0] * v[1]), Vec3::ZERO)
}

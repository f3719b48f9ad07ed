//! Motion in the x-y plane. q = x, y, θ; v = vx, vy, ωz in the body's frame; S = [0 0 z; x y 0].

use super::manifold::sinc;
use crate::scalar::{Real, Scalar};
use crate::spatial::{Mat3, Motion, Transform, Vec3};

#[inline(always)]
pub(super) fn kinematics<T: Scalar>(q: &[T], S: &mut [Motion<T>]) -> Transform<T> {
    S[0] = Motion::new(Vec3::ZERO, Vec3::X);
    S[1] = Motion::new(Vec3::ZERO, Vec3::Y);
    S[2] = Motion::new(Vec3::Z, Vec3::ZERO);
    Transform::new(Mat3::rotation_z(q[2].sin_cos()), Vec3::new(q[0], q[1], T::ZERO))
}

/// A constant body velocity moves the origin along an arc: the chord has length |v| sinc(ω/2) and direction θ + ω/2.
pub(super) fn integrate<T: Real>(q: &[T], v: &[T], out: &mut [T]) {
    let half = v[2] * T::from_f64(0.5);
    let chord = sinc(half);
    let (s, c) = (q[2] + half).sin_cos();
    out[0] = q[0] + (c * v[0] - s * v[1]) * chord;
    out[1] = q[1] + (s * v[0] + c * v[1]) * chord;
    out[2] = q[2] + v[2];
}

/// The chord turned back by θ + ω/2 and divided by sinc(ω/2). The turn is what the angles say, whole turns included.
pub(super) fn difference<T: Real>(from: &[T], to: &[T], out: &mut [T]) {
    let turn = to[2] - from[2];
    let half = turn * T::from_f64(0.5);
    let chord = sinc(half);
    let (s, c) = (from[2] + half).sin_cos();
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    out[0] = (c * x + s * y) / chord;
    out[1] = (c * y - s * x) / chord;
    out[2] = turn;
}

//! Internal frames: the axis of a joint becomes z.

use crate::scalar::Real;
use crate::spatial::{Mat3, Sym3, Vec3};

/// The coordinate rotation Q with Q a = z for the unit vector a, the smallest one; exact for ±x, ±y, ±z.
///
/// ```text
/// a_z ≥ 0:  Q = 1 + [v]× + [v]×²/(1 + a_z),  v = a × z          a_z < 0:  turn by π about x first
/// ```
pub(super) fn z_from_axis<T: Real>(a: Vec3<T>) -> Mat3<T> {
    if a.z < T::ZERO {
        let flip = Sym3::diagonal(T::ONE, -T::ONE, -T::ONE).full();
        return z_from_axis(flip * a) * flip;
    }
    let K = Mat3::cross(a.cross(Vec3::Z));
    Mat3::IDENTITY + K + K * K * (T::ONE / (T::ONE + a.z))
}

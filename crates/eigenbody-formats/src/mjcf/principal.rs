//! Principal axes of an inertia, by Jacobi rotations kept as a quaternion.
//!
//! Of a mesh, MuJoCo drops what is beside the diagonal once it is below 1e-7 of the largest entry (found by experiment with
//! version 4.0). That shows in the seventh digit of H, so a mesh is read with the same [`Care`].

use eigenbody::spatial::{Mat3, Sym3, Vec3};

/// Moments that differ by less, against the largest, are not sorted.
const SAME: f64 = 1e-12;

/// How far to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Care {
    /// To the last digit.
    Full,
    /// To MuJoCo's limits for a mesh.
    Mesh,
}

/// Principal moments in descending order, and the rotation of coordinates to their axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Principal {
    pub moments: [f64; 3],
    pub E: Mat3<f64>,
}

/// The principal axes of A.
pub(super) fn principal(A: Sym3<f64>, care: Care) -> Principal {
    let mut q = [1.0, 0.0, 0.0, 0.0];
    let mut moments = [A.xx, A.yy, A.zz];
    let largest_entry = [A.xx, A.yy, A.zz, A.xy, A.xz, A.yz].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let smallest = largest_entry * if care == Care::Full { 0.5 * f64::EPSILON } else { 1e-7 };
    for _ in 0..100 {
        // congruence gives Eᵀ A E; E = R here.
        let D = A.congruence(rotation(q).transpose());
        moments = [D.xx, D.yy, D.zz];
        let (entry, row, column, axis) = match (D.xy.abs(), D.xz.abs(), D.yz.abs()) {
            (xy, xz, yz) if xy > xz && xy > yz => (D.xy, 0, 1, 2),
            (_, xz, yz) if xz > yz => (D.xz, 0, 2, 1),
            _ => (D.yz, 1, 2, 0),
        };
        if entry.abs() <= smallest {
            break;
        }
        let tau = (moments[column] - moments[row]) / (2.0 * entry);
        let t = if tau >= 0.0 { 1.0 } else { -1.0 } / (tau.abs() + (1.0 + tau * tau).sqrt());
        let c = 1.0 / (1.0 + t * t).sqrt();
        // The sine of half the angle.
        let half = t.abs() * c / (2.0 * (1.0 + c)).sqrt();
        let sign = if (tau >= 0.0) == (axis == 1) { 1.0 } else { -1.0 };
        let mut turn = [(1.0 - half * half).sqrt(), 0.0, 0.0, 0.0];
        turn[axis + 1] = sign * half;
        q = product(q, turn);
    }
    let same = SAME * largest_entry;
    for first in [0, 1, 0] {
        if moments[first] + same < moments[first + 1] {
            moments.swap(first, first + 1);
            let mut turn = [std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, 0.0];
            turn[(first + 2) % 3 + 1] = std::f64::consts::FRAC_1_SQRT_2;
            q = product(q, turn);
        }
    }
    Principal { moments, E: rotation(q) }
}

/// The inertia that a body with these principal axes has.
pub(super) fn inertia(principal: &Principal) -> Sym3<f64> {
    let [a, b, c] = principal.moments;
    Sym3::diagonal(a, b, c).congruence(principal.E)
}

fn rotation([w, x, y, z]: [f64; 4]) -> Mat3<f64> {
    Mat3::rotation_quaternion(w, Vec3::new(x, y, z))
}

/// The Hamilton product, normalised.
fn product(p: [f64; 4], q: [f64; 4]) -> [f64; 4] {
    let (a, b) = (Vec3::new(p[1], p[2], p[3]), Vec3::new(q[1], q[2], q[3]));
    let w = p[0] * q[0] - a.dot(b);
    let v = b * p[0] + a * q[0] + a.cross(b);
    let norm = (w * w + v.dot(v)).sqrt();
    [w / norm, v.x / norm, v.y / norm, v.z / norm]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_axes_rebuild_the_inertia() {
        for size in [1.0, 1e-9] {
            let A = Sym3 { xx: 1.0, yy: 1.2, zz: 1.4, xy: 0.1, xz: 0.2, yz: 0.3 } * size;
            let found = principal(A, Care::Full);
            // Computed by MuJoCo 4.0 for the same fullinertia.
            for (found, expected) in found.moments.iter().zip([1.687298334620745, 1.0, 0.9127016653792603]) {
                // 20 ε of the largest entry, 1.4
                assert!((found / size - expected).abs() < 20.0 * f64::EPSILON * 1.4, "{found} {expected}");
            }
            let B = inertia(&found) - A;
            for x in [B.xx, B.yy, B.zz, B.xy, B.xz, B.yz] {
                // 20 ε of the largest entry
                assert!(x.abs() < 20.0 * f64::EPSILON * 1.4 * size, "{x}");
            }
        }
    }

    #[test]
    fn what_is_small_beside_the_diagonal_is_dropped_of_a_mesh() {
        let A = Sym3 { xy: 1e-7, ..Sym3::diagonal(3.0, 2.0, 1.0) };
        assert_eq!(inertia(&principal(A, Care::Mesh)).xy, 0.0);
        assert!((inertia(&principal(A, Care::Full)).xy - 1e-7).abs() < 1e-15);
    }
}

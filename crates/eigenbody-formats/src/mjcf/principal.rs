//! Principal axes of an inertia, as MuJoCo takes them.
//!
//! ```text
//! Jacobi rotations, kept as a quaternion q, until the largest off-diagonal entry of RᵀAR is below 1e-12
//! ```
//! MuJoCo keeps the diagonal and R and drops what is left beside the diagonal. For a small part, 1e-12 is not nothing:
//! an inertia read with all its digits would differ from MuJoCo's. So the same entries are dropped here.

use eigenbody::spatial::{Mat3, Sym3, Vec3};

/// Off-diagonal entries below this are dropped; eigenvalues that differ by less are not sorted.
const SMALL: f64 = 1e-12;

/// Principal moments in descending order, and the rotation of coordinates to their axes.
#[derive(Debug)]
pub(super) struct Principal {
    pub moments: [f64; 3],
    pub E: Mat3<f64>,
}

/// The principal axes of A.
pub(super) fn principal(A: Sym3<f64>) -> Principal {
    let mut q = [1.0, 0.0, 0.0, 0.0];
    let mut moments = [A.xx, A.yy, A.zz];
    for _ in 0..500 {
        let R = rotation(q).transpose();
        // congruence gives Eᵀ A E; E = R here.
        let D = A.congruence(R);
        moments = [D.xx, D.yy, D.zz];
        let (entry, row, column, axis) = match (D.xy.abs(), D.xz.abs(), D.yz.abs()) {
            (xy, xz, yz) if xy > xz && xy > yz => (D.xy, 0, 1, 2),
            (_, xz, yz) if xz > yz => (D.xz, 0, 2, 1),
            _ => (D.yz, 1, 2, 0),
        };
        if entry.abs() < SMALL {
            break;
        }
        let tau = (moments[column] - moments[row]) / (2.0 * entry);
        let t = tau.signum() / (tau.abs() + tau.hypot(1.0));
        let c = 1.0 / t.hypot(1.0);
        if c > 1.0 - SMALL {
            break;
        }
        let half = (0.5 - 0.5 * c).sqrt();
        let sign = if (tau >= 0.0) == (axis == 1) { 1.0 } else { -1.0 };
        let mut turn = [(1.0 - half * half).sqrt(), 0.0, 0.0, 0.0];
        turn[axis + 1] = sign * half;
        q = product(q, turn);
    }
    for first in [0, 1, 0] {
        if moments[first] + SMALL < moments[first + 1] {
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
        let A = Sym3 { xx: 1.0, yy: 1.2, zz: 1.4, xy: 0.1, xz: 0.2, yz: 0.3 };
        let found = principal(A);
        // Computed by MuJoCo 4.0 for the same fullinertia.
        for (found, expected) in found.moments.iter().zip([1.687298334620745, 1.0, 0.9127016653792603]) {
            // 20 ε of the largest entry, 1.4
            assert!((found - expected).abs() < 20.0 * f64::EPSILON * 1.4, "{found} {expected}");
        }
        let B = inertia(&found) - A;
        for x in [B.xx, B.yy, B.zz, B.xy, B.xz, B.yz] {
            // what is dropped, 1e-12, and 20 ε of the largest entry
            assert!(x.abs() < 1e-12 + 20.0 * f64::EPSILON * 1.4, "{x}");
        }
    }

    #[test]
    fn what_is_below_1e_12_is_dropped() {
        let A = Sym3 { xx: 3e-12, yy: 2e-12, zz: 1e-12, xy: 5e-13, xz: 0.0, yz: 0.0 };
        assert_eq!(principal(A).moments, [3e-12, 2e-12, 1e-12]);
    }
}

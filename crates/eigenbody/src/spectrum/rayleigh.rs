//! Eigenvectors by inverse iteration, and one Rayleigh quotient of the kinetic energy in double-double.
//!
//! ```text
//! x ← (H − σB)⁻¹ B x / |·|_B                λ = 2T(x)/xᵀBx,   T = ½ Σ v_iᵀ I_i v_i + ½ Σ armature_d x_d²
//! ```
//! The quotient's error is the square of the vector's, and the kinetic energy is a sum of squares: what is lost to cancellation
//! in the factors comes back. Forward kinematics only, no factorisation.

use super::sturm::{Factors, Pencil};
use crate::joint::Joint;
use crate::model::{Body, Model, Random};
use crate::scalar::{Dd, Real, Scalar};
use crate::spatial::{Motion, Transform};

/// Most rounds of inverse iteration; two suffice unless the start is nearly orthogonal to the mode.
const ROUNDS: usize = 6;

/// The mode of an eigenvalue, xᵀBx = 1 over the DoFs that take part, the largest entry (weighed by B) positive.
///
/// `factors` holds those of H − shift·B afterwards, with the bodies' motions under x.
pub(super) fn mode(pencil: &Pencil<f64>, shift: f64, factors: &mut Factors<f64>) -> Vec<f64> {
    let B = pencil.metric();
    let mut random = Random::new(0x5eed);
    let mut x: Vec<f64> =
        B.iter().map(|&b| if b > 0.0 { random.between(0.5, 1.5) / b.sqrt() } else { 0.0 }).collect();
    for (d, x) in x.iter_mut().enumerate() {
        if d % 2 == 1 && random.uniform() < 0.5 {
            *x = -*x;
        }
    }
    normalise(&mut x, B);
    factors.factor(pencil, shift);
    let mut growth = 0.0;
    for _ in 0..ROUNDS {
        for (x, &b) in x.iter_mut().zip(B) {
            *x *= b;
        }
        factors.solve(pencil, &mut x);
        let grown = normalise(&mut x, B);
        factors.scale_motions(1.0 / grown);
        // Growth is 1/|λ − σ| once the other modes have died out: it settles, or the residual 1/growth is all rounding.
        if growth > 0.0 && (grown <= 1.5 * growth || grown * shift > 1e12) {
            break;
        }
        growth = grown;
    }
    let largest = x.iter().zip(B).fold((0.0, 1.0), |best, (&x, &b)| {
        if x.abs() * b.sqrt() > best.0 { (x.abs() * b.sqrt(), x) } else { best }
    });
    if largest.1 < 0.0 {
        x.iter_mut().for_each(|x| *x = -*x);
        factors.scale_motions(-1.0);
    }
    x
}

/// x / |x|_B; returns the norm. Scaled first: inverse iteration at an eigenvalue makes huge vectors.
pub(super) fn normalise(x: &mut [f64], B: &[f64]) -> f64 {
    let scale = x.iter().zip(B).fold(0.0f64, |m, (x, b)| m.max(x.abs() * b.sqrt()));
    if !(scale > 0.0 && scale.is_finite()) {
        return scale;
    }
    let sum: f64 = x.iter().zip(B).map(|(x, b)| (x / scale).powi(2) * b).sum();
    let norm = scale * sum.sqrt();
    x.iter_mut().for_each(|x| *x /= norm);
    norm
}

/// 2T(x)/xᵀBx in double-double, `x` over all DoFs of the model and `B` zero for those that take no part.
pub(super) fn quotient(model: &Model<f64>, q: &[f64], x: &[f64], B: &[f64]) -> f64 {
    let wide = Dd::from_f64;
    let mut v: Vec<Motion<Dd>> = Vec::with_capacity(model.bodies().len());
    let mut twice = Dd::ZERO;
    for body in model.bodies() {
        let (X_up, S) = posed(body, q);
        let mut v_i = body.parent().map_or(Motion::ZERO, |p| X_up.motion(v[p]));
        for (S, d) in S.into_iter().zip(body.dofs()) {
            v_i += S * wide(x[d]);
        }
        twice += v_i.dot(body.inertia().map(wide).times(v_i));
        v.push(v_i);
    }
    let mut norm = Dd::ZERO;
    for (d, &x) in x.iter().enumerate() {
        let square = Dd::from_product(x, x);
        twice += square * wide(model.armature()[d]);
        norm += square * wide(B[d]);
    }
    (twice / norm).to_f64()
}

/// X_up and S of a body in double-double.
fn posed(body: &Body<f64>, q: &[f64]) -> (Transform<Dd>, [Motion<Dd>; 6]) {
    let wide = Dd::from_f64;
    let joint: Joint<Dd> = body.joint().map(wide);
    let mut coordinates = [Dd::ZERO; 7];
    for (wide_q, &q) in coordinates.iter_mut().zip(&q[body.coordinates()]) {
        *wide_q = wide(q);
    }
    let mut S = [Motion::ZERO; 6];
    let X_J = joint.kinematics(&coordinates, &mut S);
    (X_J * body.tree_transform().map(wide), S)
}

//! Eigenvectors by inverse iteration, and one Rayleigh quotient of the kinetic energy in double-double.
//!
//! ```text
//! x ← (H − σB)⁻¹ B x / |·|_B                λ = 2T(x)/xᵀBx,   T = ½ Σ v_iᵀ I_i v_i + ½ Σ armature_d x_d²
//! ```
//! The quotient's error is the square of the vector's, and the kinetic energy is a sum of squares: what is lost to cancellation
//! in the factors comes back. Forward kinematics only, no factorisation.

use super::sturm::{Factors, Pencil};
use crate::joint::Joint;
use crate::model::{Body, Random};
use crate::scalar::{Array, Dd, Real, Scalar};
use crate::spatial::{Motion, Transform};

/// Most rounds of inverse iteration; two suffice unless the start is nearly orthogonal to the mode.
const ROUNDS: usize = 6;

/// The modes of eigenvalues side by side, xᵀBx = 1 over the DoFs that take part, the largest entry (weighed by B) positive.
///
/// `factors` holds those of H − shift·B afterwards, with the bodies' motions under x.
pub(super) fn modes(pencil: &Pencil<'_, f64>, shifts: [f64; 2], factors: &mut Factors) -> Vec<Array<2>> {
    let B = pencil.metric();
    let mut x: Vec<_> = start(B).into_iter().map(|x| Array([x; 2])).collect();
    normalise(&mut x, B);
    factors.factor(pencil, Array(shifts));
    // Of each mode, until it has settled.
    let (mut growth, mut settled) = ([0.0; 2], [false; 2]);
    for _ in 0..ROUNDS {
        for (x, &b) in x.iter_mut().zip(B) {
            *x *= Array([b; 2]);
        }
        factors.solve(pencil, &mut x);
        let grown = normalise(&mut x, B);
        factors.scale_motions(Array::ONE / Array(grown));
        for k in 0..2 {
            // Growth is 1/|λ − σ| once the other modes have died out: it settles, or the residual 1/growth is all rounding.
            settled[k] |= growth[k] > 0.0 && (grown[k] <= 1.5 * growth[k] || grown[k] * shifts[k] > 1e12);
        }
        if settled.iter().all(|&settled| settled) {
            break;
        }
        growth = grown;
    }
    let signs = Array([0, 1].map(|k| {
        let weighed = x.iter().zip(B).map(|(x, b)| x.0[k] * b.sqrt());
        let largest = weighed.fold(0.0, |best: f64, x| if x.abs() > best.abs() { x } else { best });
        if largest < 0.0 { -1.0 } else { 1.0 }
    }));
    x.iter_mut().for_each(|x| *x *= signs);
    factors.scale_motions(signs);
    x
}

/// A vector that is orthogonal to no mode.
pub(super) fn start(B: &[f64]) -> Vec<f64> {
    let mut random = Random::new(0x5eed);
    let mut x: Vec<f64> =
        B.iter().map(|&b| if b > 0.0 { random.between(0.5, 1.5) / b.sqrt() } else { 0.0 }).collect();
    for (d, x) in x.iter_mut().enumerate() {
        if d % 2 == 1 && random.uniform() < 0.5 {
            *x = -*x;
        }
    }
    x
}

/// x / |x|_B in every lane; returns the norms. Scaled first: inverse iteration at an eigenvalue makes huge vectors. What is zero or
/// not finite stays as it is.
pub(super) fn normalise<const N: usize>(x: &mut [Array<N>], B: &[f64]) -> [f64; N] {
    let scale = x.iter().zip(B).fold(Array::ZERO, |m, (&x, &b)| (x.abs() * Array([b.sqrt(); N])).max(m));
    let usable = scale.0.map(|scale| scale > 0.0 && scale.is_finite());
    let unit = Array(std::array::from_fn(|k| if usable[k] { scale.0[k] } else { 1.0 }));
    let square = |x: Array<N>| (x / unit) * (x / unit);
    let sum = x.iter().zip(B).fold(Array::ZERO, |sum, (&x, &b)| sum + square(x) * Array([b; N]));
    let norm = std::array::from_fn(|k| if usable[k] { scale.0[k] * sum.0[k].sqrt() } else { scale.0[k] });
    let divisor = Array(std::array::from_fn(|k| if usable[k] { norm[k] } else { 1.0 }));
    x.iter_mut().for_each(|x| *x = *x / divisor);
    norm
}

/// 2T(x)/xᵀBx in double-double, of those `lanes` of `x`, over all DoFs of the model; B is zero for those that take no part.
pub(super) fn quotients<const N: usize>(
    pencil: &Pencil<'_, f64>,
    x: &[Array<N>],
    lanes: &[usize],
) -> Vec<f64> {
    if lanes.is_empty() {
        return Vec::new();
    }
    let wide = Dd::from_f64;
    let (model, q, B) = (pencil.model, &pencil.q, pencil.metric());
    let (bodies, armature) = (model.bodies(), model.armature());
    // Bodies' velocities, one a lane.
    let mut v: Vec<Motion<Dd>> = Vec::with_capacity(bodies.len() * lanes.len());
    let mut twice = vec![Dd::ZERO; lanes.len()];
    let mut norm = twice.clone();
    for body in bodies {
        let (X_up, S) = posed(body, q);
        let I = body.inertia().map(wide);
        for (place, &k) in lanes.iter().enumerate() {
            let carrier = |p: usize| X_up.motion(v[p * lanes.len() + place]);
            let mut v_i = body.parent().map_or(Motion::ZERO, carrier);
            for (S, d) in S.into_iter().zip(body.dofs()) {
                let x_d = x[d].0[k];
                v_i += S * wide(x_d);
                let square = Dd::from_product(x_d, x_d);
                twice[place] += square * wide(armature[d]);
                norm[place] += square * wide(B[d]);
            }
            twice[place] += v_i.dot(I.times(v_i));
            v.push(v_i);
        }
    }
    twice.into_iter().zip(norm).map(|(twice, norm)| (twice / norm).to_f64()).collect()
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

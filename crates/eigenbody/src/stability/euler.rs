//! The Euler family: h²K + 2hΔ ≺ 4H, Δ = D_e − D_i.
//!
//! ```text
//! hi ← min over DoFs of root(e_d)           root(x): h² xᵀKx + 2h xᵀΔx = 4 xᵀHx, from above for every x
//! lo ← hi, halved until C(lo) = 4H − 2hΔ − h²K has a Cholesky factor
//! until hi − lo is rounding:
//!     x ← C(lo)⁻¹ H x, a few times           the motion nearest to instability
//!     hi ← min(hi, root(x));  lo ← just below hi if C has a factor there, else the middle, if it has one there; else hi ← it
//! ```

use super::{Impedance, StepLimit};
use crate::error::Error;
use crate::factor::Cholesky;
use crate::matrix::{Matrix, dot};

/// Relative distance of the step from the true bound.
const SETTLED: f64 = 1e-11;
/// Halvings to a first stable step; bisections after.
const HALVINGS: usize = 400;
const ROUNDS: usize = 200;
/// Inverse iterations a round.
const ITERATIONS: usize = 3;

pub(super) fn is_stable(H: &Matrix<f64>, impedance: &Impedance, implicit: &Matrix<f64>, step: f64) -> bool {
    let mut factor = Cholesky::new(H.rows());
    factor.factor(&Bound { H, impedance, implicit }.at(step)).is_ok()
}

pub(super) fn largest_step(
    H: &Matrix<f64>,
    impedance: &Impedance,
    implicit: &Matrix<f64>,
) -> Result<StepLimit, Error> {
    let n = H.rows();
    let mut factor = Cholesky::new(n);
    factor.factor(H)?;
    let bound = Bound { H, impedance, implicit };
    let unit = |d: usize| -> Vec<f64> { (0..n).map(|e| if e == d { 1.0 } else { 0.0 }).collect() };
    let axes = (0..n).map(|d| (bound.root(&unit(d)), d));
    let Some((mut hi, first)) = axes.min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Ok(StepLimit { step: f64::INFINITY, mode: Vec::new() });
    };
    let mut x = unit(first);
    if hi.is_infinite() {
        // What is off the diagonal may bind where the diagonal does not: a tendon whose damping is implicit only in part.
        hi = 1e6;
        if factor.factor(&bound.at(hi)).is_ok() {
            return Ok(StepLimit { step: f64::INFINITY, mode: vec![0.0; n] });
        }
    }
    let mut lo = hi;
    let mut halvings = 0;
    loop {
        lo *= 0.5;
        halvings += 1;
        match factor.factor(&bound.at(lo)) {
            Ok(_) => break,
            Err(error) if halvings == HALVINGS => return Err(error),
            Err(_) => hi = lo,
        }
    }
    for _ in 0..ROUNDS {
        for _ in 0..ITERATIONS {
            let mut next = H.times(&x);
            factor.solve(&mut next)?;
            let size = next.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            x = next.into_iter().map(|x| x / size).collect();
        }
        hi = hi.min(bound.root(&x)).max(lo);
        if hi - lo <= SETTLED * hi {
            break;
        }
        let near = hi * (1.0 - 0.5 * SETTLED);
        if factor.factor(&bound.at(near)).is_ok() {
            lo = near;
            continue;
        }
        let middle = (lo * hi).sqrt();
        if factor.factor(&bound.at(middle)).is_ok() {
            lo = middle;
        } else {
            hi = middle;
            factor.factor(&bound.at(lo))?;
        }
    }
    Ok(StepLimit { step: lo, mode: oriented(x) })
}

/// C(h) = 4H − 2hΔ − h²K.
struct Bound<'a> {
    H: &'a Matrix<f64>,
    impedance: &'a Impedance,
    implicit: &'a Matrix<f64>,
}

impl Bound<'_> {
    fn at(&self, h: f64) -> Matrix<f64> {
        let Self { H, impedance: Impedance { stiffness: K, damping: D, .. }, implicit } = self;
        Matrix::from_fn(H.rows(), H.rows(), |i, j| {
            4.0 * H[(i, j)] - 2.0 * h * (D[(i, j)] - 2.0 * implicit[(i, j)]) - h * h * K[(i, j)]
        })
    }

    /// The step at which xᵀ C(h) x = 0.
    fn root(&self, x: &[f64]) -> f64 {
        let along = |A: &Matrix<f64>| dot(x, &A.times(x));
        let inertia = along(self.H);
        let k = along(&self.impedance.stiffness).max(0.0) / inertia;
        let delta = (along(&self.impedance.damping) - 2.0 * along(self.implicit)) / inertia;
        let size = delta.mul_add(delta, 4.0 * k).sqrt();
        // The positive root of k h² + 2δ h − 4, without cancellation.
        if delta < 0.0 { (size - delta) / k } else { 4.0 / (delta + size) }
    }
}

/// The sign that makes the largest entry positive.
pub(super) fn oriented(mut x: Vec<f64>) -> Vec<f64> {
    let largest = x.iter().fold(0.0f64, |m, &x| if x.abs() > m.abs() { x } else { m });
    if largest < 0.0 {
        x.iter_mut().for_each(|x| *x = -*x);
    }
    x
}

//! Descent by exact gradients: BFGS with a backtracking line search (Nocedal & Wright 2006, §6.1 and §3.1).
//!
//! ```text
//! p = −W g      α: f(x ⊕ αp) ≤ f + 10⁻⁴ α gᵀp      s = αp,  y = g⁺ − g
//! W ← (1 − s yᵀ/sᵀy) W (1 − y sᵀ/sᵀy) + s sᵀ/sᵀy        if sᵀy > 0
//! ```
//! Eigenvalues that cross make kinks; a minimum of λmin lies on one as seldom as water gathers on a ridge.

use crate::matrix::Matrix;

/// Decrease, relative to the value, below which descent stops.
const SETTLED: f64 = 1e-9;
/// Longest step of a DoF (rad, m).
const LONGEST: f64 = 1.0;

/// A function on points that can be moved along a step.
pub trait Landscape {
    /// Where to look.
    type Point: Clone;
    /// Value, not below zero, and gradient; none where they do not exist.
    fn look(&mut self, at: &Self::Point) -> Option<(f64, Vec<f64>)>;
    /// The point moved along a step.
    fn moved(&self, from: &Self::Point, step: &[f64]) -> Self::Point;
}

/// The lowest point found from `start` in at most `looks` evaluations, and its value; none if there is no value at `start`.
///
/// Method: BFGS (Nocedal & Wright 2006, §6.1) with a backtracking line search, until the value settles to 1e-9 or is zero.
pub fn descend<L: Landscape>(land: &mut L, start: &L::Point, looks: usize) -> Option<(L::Point, f64)> {
    let (mut x, (mut f, mut g)) = (start.clone(), land.look(start)?);
    let n = g.len();
    let mut W = None;
    let mut looks = looks.saturating_sub(1);
    while looks > 0 && f > 0.0 {
        let mut p = direction(W.as_ref(), &g);
        let mut slope = dot(&g, &p);
        if slope >= 0.0 {
            (W, p) = (None, direction(None, &g));
            slope = dot(&g, &p);
        }
        let largest = p.iter().fold(0.0f64, |m, p| m.max(p.abs()));
        if !(slope < 0.0 && largest.is_finite()) {
            break;
        }
        // Without curvature, the step on which a quadratic with its minimum at zero would vanish.
        let first = if W.is_none() { 2.0 * f / -slope } else { 1.0 };
        let mut alpha = first.min(LONGEST / largest);
        let accepted = loop {
            if looks == 0 {
                break None;
            }
            looks -= 1;
            let step: Vec<f64> = p.iter().map(|p| alpha * p).collect();
            let next = land.moved(&x, &step);
            if let Some((value, gradient)) = land.look(&next)
                && value <= f + 1e-4 * alpha * slope
            {
                break Some((next, step, value, gradient));
            }
            alpha *= 0.3;
            if alpha * largest < 1e-12 {
                break None;
            }
        };
        let Some((next, s, value, gradient)) = accepted else { break };
        let y: Vec<f64> = gradient.iter().zip(&g).map(|(a, b)| a - b).collect();
        let settled = f - value <= SETTLED * f;
        W = Some(updated(W.take(), n, &s, &y));
        (x, f, g) = (next, value, gradient);
        if settled {
            break;
        }
    }
    Some((x, f))
}

fn direction(W: Option<&Matrix<f64>>, g: &[f64]) -> Vec<f64> {
    match W {
        Some(W) => W.times(g).into_iter().map(|x| -x).collect(),
        None => g.iter().map(|g| -g).collect(),
    }
}

/// The inverse Hessian after a step; scaled to the first step's curvature where there was none.
fn updated(W: Option<Matrix<f64>>, n: usize, s: &[f64], y: &[f64]) -> Matrix<f64> {
    let (sy, yy) = (dot(s, y), dot(y, y));
    let scale = if sy > 0.0 && yy > 0.0 { sy / yy } else { 1.0 };
    let mut W = W.unwrap_or_else(|| {
        let mut W = Matrix::zeros(n, n);
        (0..n).for_each(|d| W[(d, d)] = scale);
        W
    });
    if sy <= 1e-12 * dot(s, s).sqrt() * yy.sqrt() {
        return W;
    }
    let Wy = W.times(y);
    let factor = (1.0 + dot(y, &Wy) / sy) / sy;
    for d in 0..n {
        for e in 0..n {
            W[(d, e)] += factor * s[d] * s[e] - (s[d] * Wy[e] + Wy[d] * s[e]) / sy;
        }
    }
    W
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::{Landscape, descend};

    /// Rosenbrock's valley.
    struct Valley;

    impl Landscape for Valley {
        type Point = [f64; 2];
        fn look(&mut self, &[x, y]: &[f64; 2]) -> Option<(f64, Vec<f64>)> {
            let (a, b) = (1.0 - x, y - x * x);
            Some((a * a + 100.0 * b * b, vec![-2.0 * a - 400.0 * x * b, 200.0 * b]))
        }
        fn moved(&self, &[x, y]: &[f64; 2], step: &[f64]) -> [f64; 2] {
            [x + step[0], y + step[1]]
        }
    }

    #[test]
    fn reaches_the_end_of_a_curved_valley() {
        let ([x, y], f) = descend(&mut Valley, &[-1.2, 1.0], 200).unwrap();
        assert!(f < 1e-12 && (x - 1.0).abs() < 1e-6 && (y - 1.0).abs() < 1e-6, "{x} {y} {f}");
    }
}

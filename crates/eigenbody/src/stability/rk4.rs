//! Runge-Kutta 4: |R(hμ)| ≤ 1 for every μ with (μ²H + μD + K) x = 0.
//!
//! ```text
//! H = L Lᵀ,  L⁻¹KL⁻ᵀ = Q Ω² Qᵀ,  D̂ = Qᵀ L⁻¹DL⁻ᵀ Q        μ: eigenvalues of [0 Ω; −Ω −D̂]
//! ```
//! In these coordinates energy is the sum of squares: without damping the matrix is skew, and however large the spread of
//! frequencies, the largest μ, which set the step, are good to a few ε. Where the ray of hμ leaves the region of R is found once per μ.

use super::euler::oriented;
use super::hqr::eigenvalues;
use super::{Impedance, StepLimit};
use crate::error::Error;
use crate::factor::Cholesky;
use crate::matrix::Matrix;
use crate::spectrum::eigen;

/// Stable for hω up to 2√2 without damping.
pub const IMAGINARY_LIMIT: f64 = 2.0 * std::f64::consts::SQRT_2;

/// Stable for hd up to this without stiffness, and at great damping.
pub const REAL_LIMIT: f64 = 2.785_293_563_405_281;

pub(super) fn largest_step(H: &Matrix<f64>, impedance: &Impedance) -> Result<StepLimit, Error> {
    let n = H.rows();
    let mut factor = Cholesky::new(n);
    factor.factor(H)?;
    let K = congruence(factor.l(), &impedance.stiffness);
    let modes = eigen(&K, &vec![1.0; n])?;
    let omega: Vec<f64> = modes.values.iter().map(|square| square.max(0.0).sqrt()).collect();
    let D = congruence(factor.l(), &impedance.damping);
    // Rows of the vectors are modes: D̂ = V D Vᵀ.
    let DV: Vec<Vec<f64>> = (0..n).map(|k| D.times(modes.vectors.row(k))).collect();
    let D = Matrix::from_fn(n, n, |i, j| crate::matrix::dot(modes.vectors.row(i), &DV[j]));
    let A = Matrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => 0.0,
        (true, false) => {
            if i + n == j {
                omega[i]
            } else {
                0.0
            }
        }
        (false, true) => {
            if j + n == i {
                -omega[j]
            } else {
                0.0
            }
        }
        (false, false) => -D[(i - n, j - n)],
    });
    let roots = eigenvalues(A)?;
    let largest = roots.iter().fold(0.0f64, |m, (re, im)| re.hypot(*im).max(m));
    let mut worst = (f64::INFINITY, (0.0, 0.0));
    // The region's edge is 2.59 to 3.3 from the origin: roots of half the size cannot set the step. None has a real part above zero
    // but by rounding.
    for (re, im) in roots.into_iter().filter(|(re, im)| re.hypot(*im) > 0.5 * largest) {
        let h = reach(re.min(0.0), im);
        if h < worst.0 {
            worst = (h, (re, im));
        }
    }
    let (step, mu) = worst;
    let mode = if step.is_finite() { mode(H, impedance, mu) } else { vec![0.0; n] };
    Ok(StepLimit { step, mode })
}

/// L⁻¹ A L⁻ᵀ.
fn congruence(L: &Matrix<f64>, A: &Matrix<f64>) -> Matrix<f64> {
    let n = L.rows();
    // Columns of L⁻¹A, then rows of the result.
    let forward = |b: &mut [f64]| {
        for k in 0..n {
            b[k] = (0..k).fold(b[k], |sum, m| sum - L[(k, m)] * b[m]) / L[(k, k)];
        }
    };
    let mut half = A.clone();
    (0..n).for_each(|i| forward(half.row_mut(i)));
    let mut whole = Matrix::from_fn(n, n, |i, j| half[(j, i)]);
    (0..n).for_each(|i| forward(whole.row_mut(i)));
    Matrix::from_fn(n, n, |i, j| 0.5 * (whole[(i, j)] + whole[(j, i)]))
}

/// The first h at which |R(hμ)| exceeds 1, for Re μ ≤ 0.
fn reach(re: f64, im: f64) -> f64 {
    let size = re.hypot(im);
    if size == 0.0 {
        return f64::INFINITY;
    }
    // A real part of rounding size is none.
    let (c, s) = (re / size, im / size);
    let (c, s) = if c.abs() < 1e-9 { (0.0, 1.0) } else { (c, s) };
    let beyond = |r: f64| amplification(r * c, r * s) > 1.0 + 1e-12;
    let (mut lo, mut hi) = (0.0, 0.0);
    while !beyond(hi) {
        lo = hi;
        hi += 0.02;
    }
    for _ in 0..60 {
        let middle = 0.5 * (lo + hi);
        if beyond(middle) { hi = middle } else { lo = middle }
    }
    lo / size
}

/// |R(z)| by Horner's rule.
fn amplification(x: f64, y: f64) -> f64 {
    let (mut re, mut im) = (1.0, 0.0);
    for k in [4.0, 3.0, 2.0, 1.0] {
        let (a, b) = (x * re - y * im, x * im + y * re);
        (re, im) = (1.0 + a / k, b / k);
    }
    re.hypot(im)
}

/// Amplitudes of the motion that belongs to μ, by inverse iteration on [Re P −Im P; Im P Re P], P = μ²H + μD + K.
fn mode(H: &Matrix<f64>, impedance: &Impedance, (re, im): (f64, f64)) -> Vec<f64> {
    let n = H.rows();
    // A little off, so that the system can be solved.
    let (re, im) = (re * (1.0 + 1e-9), im * (1.0 + 1e-9));
    let (re2, im2) = (re * re - im * im, 2.0 * re * im);
    let (K, D) = (&impedance.stiffness, &impedance.damping);
    let P = Matrix::from_fn(2 * n, 2 * n, |i, j| {
        let (a, b) = (i % n, j % n);
        let real = re2 * H[(a, b)] + re * D[(a, b)] + K[(a, b)];
        let imaginary = im2 * H[(a, b)] + im * D[(a, b)];
        match (i < n, j < n) {
            (true, false) => -imaginary,
            (false, true) => imaginary,
            _ => real,
        }
    });
    let mut x: Vec<f64> = (0..2 * n).map(|i| 1.0 + 0.1 * (i % 7) as f64).collect();
    for _ in 0..3 {
        // Momentum of the last guess as the right-hand side: in its units every joint counts alike.
        let (head, tail) = x.split_at(n);
        let right = [H.times(head), H.times(tail)].concat();
        x = solve(P.clone(), right);
        let size = x.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        x.iter_mut().for_each(|x| *x /= size);
    }
    if im == 0.0 {
        return oriented(x[..n].to_vec());
    }
    let amplitudes: Vec<f64> = (0..n).map(|d| x[d].hypot(x[d + n])).collect();
    let largest = (0..n).fold(0, |best, d| if amplitudes[d] > amplitudes[best] { d } else { best });
    // In step with the largest where the motion is nearly that of one phase.
    let (c, s) = (x[largest] / amplitudes[largest], x[largest + n] / amplitudes[largest]);
    (0..n).map(|d| amplitudes[d].copysign(c * x[d] + s * x[d + n])).collect()
}

/// A⁻¹ b by elimination with row exchanges; a pivot of zero counts as a very small one, as inverse iteration wants it.
fn solve(mut A: Matrix<f64>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    let tiny = f64::EPSILON * A.max_abs().max(f64::MIN_POSITIVE);
    for k in 0..n {
        let pivot = (k..n).fold(k, |best, i| if A[(i, k)].abs() > A[(best, k)].abs() { i } else { best });
        if pivot != k {
            for j in k..n {
                let held = A[(k, j)];
                A[(k, j)] = A[(pivot, j)];
                A[(pivot, j)] = held;
            }
            b.swap(k, pivot);
        }
        if A[(k, k)].abs() < tiny {
            A[(k, k)] = tiny;
        }
        for i in k + 1..n {
            let ratio = A[(i, k)] / A[(k, k)];
            if ratio != 0.0 {
                for j in k + 1..n {
                    A[(i, j)] -= ratio * A[(k, j)];
                }
                b[i] -= ratio * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| A[(k, j)] * b[j]).sum();
        b[k] = (b[k] - known) / A[(k, k)];
    }
    b
}

#[cfg(test)]
mod tests {
    use super::{IMAGINARY_LIMIT, REAL_LIMIT, reach};

    /// Hairer & Wanner, *Solving Ordinary Differential Equations II* (1996), §IV.2.
    #[test]
    fn ends_of_the_region() {
        assert!((reach(-1.0, 0.0) - REAL_LIMIT).abs() < 1e-9, "{}", reach(-1.0, 0.0));
        assert!((reach(0.0, 1.0) - IMAGINARY_LIMIT).abs() < 1e-9, "{}", reach(0.0, 1.0));
        assert_eq!(reach(0.0, 0.0), f64::INFINITY);
        // No point of the edge in the left half-plane is nearer or farther than the filter above takes for granted.
        for k in 0..=1000 {
            let angle = std::f64::consts::FRAC_PI_2 * (1.0 + f64::from(k) / 1000.0);
            let edge = reach(angle.cos(), angle.sin());
            assert!((2.59..=3.3).contains(&edge), "{angle} {edge}");
        }
    }
}

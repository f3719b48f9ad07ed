//! How well-conditioned: κ, κ′, the diagonal ratio, the bracket, the softest and the stiffest mode.

mod at;
mod closed;
mod measure;

pub use at::{Question, conditioning_at, count_below};
pub use closed::{Allowed, ClosedAt, RANK_TOLERANCE, allowed_motions, close_loops, conditioning_closed};
pub use measure::{Measure, Values};

use crate::error::Error;
use crate::matrix::Matrix;
use crate::scalar::Real;
use crate::spectrum::{SymmetricEigen, eigen, eigenvalues};
use std::cmp::Ordering;

/// How eigenvalues are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Dense for up to 32 degrees of freedom where that keeps 13 digits, and where mimic joints break the tree; else Sturm.
    #[default]
    Auto,
    /// From the matrix: Householder and QL, O(n³).
    Dense,
    /// From the tree: counts of articulated-body pivots, O(n).
    Sturm,
}

/// Verdict on a mass matrix in a metric. A number that cannot be had is `None`, and `notes` says why.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditioning<T> {
    /// Smallest eigenvalue of H x = λ B x.
    pub lambda_min: Option<T>,
    /// Largest eigenvalue.
    pub lambda_max: Option<T>,
    /// κ = λmax/λmin: governs gains, explicit time steps, gradients.
    pub kappa: Option<T>,
    /// κ′: κ with every DoF in units of its own inertia; governs the accuracy of Cholesky-type solves.
    pub kappa_weighted: Option<T>,
    /// r = max H_dd/B_dd over min H_dd/B_dd.
    pub diagonal_ratio: Option<T>,
    /// [r, r κ′]: κ lies within.
    pub bracket: Option<(T, T)>,
    /// Estimated relative errors of λmin and λmax.
    pub error_estimate: [Option<f64>; 2],
    /// All eigenvalues, ascending, where they were computed.
    pub eigenvalues: Option<Vec<T>>,
    /// The mode with the least inertia, xᵀBx = 1: what moves when little force is applied.
    pub softest: Option<Vec<T>>,
    /// The mode with the most inertia.
    pub stiffest: Option<Vec<T>>,
    /// Diagonal of B.
    pub weights: Vec<T>,
    /// How it was computed: never [`Method::Auto`].
    pub method: Method,
    /// Sweeps of eight counts that κ took.
    pub passes: Option<usize>,
    /// Why something is `None`.
    pub notes: Vec<String>,
}

/// κ, κ′, bracket and modes of the mass matrix H in the diagonal metric `weights`.
///
/// ```text
/// H x = λ B x      κ = λmax/λmin      κ′ = κ(D H D), d = H_dd^-½      r ≤ κ ≤ r κ′
/// ```
/// | name | shape | unit |
/// |------|-------|------|
/// | `H` | n × n, symmetric | kg m², kg m, kg |
/// | `weights` | n, the diagonal of B | see [`Metric`](crate::Metric) |
///
/// Method: dense eigenproblem, O(n³); allocates. Numerics: λmin is good to a few ε·λmax, so κ to a relative few ε·κ. An
/// eigenvalue below n·ε·λmax is rounding, not a result: λmin and κ are then `None`.
///
/// Errors: as [`eigen`].
///
/// ```
/// use eigenbody::{Family, Metric, conditioning, mass_matrix};
/// let robot = Family::hydra(2, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let H = mass_matrix(&robot, &[0.0, 0.0])?;
/// let report = conditioning(&H, &Metric::Euclidean.weights(&robot, &H)?)?;
/// assert!((report.kappa.unwrap() - 43.886461117396).abs() < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn conditioning<T: Real>(H: &Matrix<T>, weights: &[T]) -> Result<Conditioning<T>, Error> {
    let SymmetricEigen { values, vectors } = eigen(H, weights)?;
    let n = values.len();
    let mut notes = Vec::new();
    let (lambda_min, lambda_max) = extremes("λmin", &values, &mut notes);
    let error = lambda_max.map(|max| n as f64 * T::EPSILON * max.to_f64());
    let relative = |lambda: Option<T>| Some(error? / lambda?.to_f64());
    let diagonal: Vec<T> = (0..n).map(|d| H[(d, d)]).collect();
    let (diagonal_ratio, has_zero) = diagonal_ratio(&diagonal, weights, &mut notes);
    let kappa_weighted = if has_zero {
        None
    } else {
        let (min, max) = extremes("λ′min", &eigenvalues(H, &diagonal)?, &mut notes);
        ratio(max, min)
    };
    Ok(Conditioning {
        lambda_min,
        lambda_max,
        kappa: in_range("κ", ratio(lambda_max, lambda_min), &mut notes),
        kappa_weighted,
        diagonal_ratio,
        bracket: bracket(diagonal_ratio, kappa_weighted, &mut notes),
        error_estimate: [relative(lambda_min), relative(lambda_max)],
        softest: (n > 0).then(|| vectors.row(0).to_vec()),
        stiffest: n.checked_sub(1).map(|last| vectors.row(last).to_vec()),
        eigenvalues: Some(values),
        weights: weights.to_vec(),
        method: Method::Dense,
        passes: None,
        notes,
    })
}

/// r, and whether a DoF has no inertia at all.
fn diagonal_ratio<T: Real>(diagonal: &[T], weights: &[T], notes: &mut Vec<String>) -> (Option<T>, bool) {
    let scaled: Vec<T> = diagonal.iter().zip(weights).map(|(&h, &b)| h / b).collect();
    let smallest = scaled.iter().copied().reduce(T::min);
    let largest = scaled.iter().copied().reduce(T::max);
    if let Some(d) = scaled.iter().position(|&x| x.partial_cmp(&T::ZERO) != Some(Ordering::Greater)) {
        notes.push(format!(
            "DoF {d} has no inertia (H_dd = {:e}): κ′ and r do not exist",
            diagonal[d].to_f64()
        ));
        return (None, true);
    }
    (in_range("r", ratio(largest, smallest), notes), scaled.is_empty())
}

fn bracket<T: Real>(
    diagonal_ratio: Option<T>,
    kappa_weighted: Option<T>,
    notes: &mut Vec<String>,
) -> Option<(T, T)> {
    let (r, weighted) = diagonal_ratio.zip(kappa_weighted)?;
    Some((r, in_range("r κ′", Some(r * weighted), notes)?))
}

/// A quotient of finite numbers, unless it is beyond the range of T itself.
fn in_range<T: Real>(name: &str, value: Option<T>, notes: &mut Vec<String>) -> Option<T> {
    let value = value?;
    if !value.is_finite() {
        notes.push(format!("{name} is beyond the range of floating-point numbers"));
        return None;
    }
    Some(value)
}

/// First and last of ascending eigenvalues; the first only if it stands clear of rounding.
fn extremes<T: Real>(name: &str, ascending: &[T], notes: &mut Vec<String>) -> (Option<T>, Option<T>) {
    let (Some(&min), Some(&max)) = (ascending.first(), ascending.last()) else {
        notes.push("no degrees of freedom: no eigenvalues".into());
        return (None, None);
    };
    let resolution = ascending.len() as f64 * T::EPSILON * max.to_f64();
    if min.to_f64() > resolution {
        return (Some(min), Some(max));
    }
    notes.push(format!("{name} is not resolved: it lies below n·ε·λmax = {resolution:.1e}; H is singular to working precision"));
    (None, Some(max))
}

fn ratio<T: Real>(a: Option<T>, b: Option<T>) -> Option<T> {
    a.zip(b).map(|(a, b)| a / b)
}

//! How well-conditioned: κ, κ′, the diagonal ratio, the bracket, the softest and the stiffest mode.

use crate::error::Error;
use crate::matrix::Matrix;
use crate::scalar::Real;
use crate::spectrum::{SymmetricEigen, eigen, eigenvalues};

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
    /// All eigenvalues, ascending, and their vectors.
    pub spectrum: SymmetricEigen<T>,
    /// Why something is `None`.
    pub notes: Vec<String>,
}

impl<T: Real> Conditioning<T> {
    /// The mode with the least inertia: what moves when little force is applied.
    pub fn softest(&self) -> Option<&[T]> {
        (self.spectrum.vectors.rows() > 0).then(|| self.spectrum.vectors.row(0))
    }

    /// The mode with the most inertia.
    pub fn stiffest(&self) -> Option<&[T]> {
        self.spectrum.vectors.rows().checked_sub(1).map(|last| self.spectrum.vectors.row(last))
    }
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
    let spectrum = eigen(H, weights)?;
    let mut notes = Vec::new();
    let (lambda_min, lambda_max) = extremes("λmin", &spectrum.values, &mut notes);
    let kappa = ratio(lambda_max, lambda_min);

    let diagonal: Vec<T> = weights.iter().enumerate().map(|(d, &b)| H[(d, d)] / b).collect();
    let smallest = diagonal.iter().copied().reduce(T::min);
    let largest = diagonal.iter().copied().reduce(T::max);
    let has_zero = smallest.is_none_or(|least| least <= T::ZERO);
    let (diagonal_ratio, kappa_weighted) = if has_zero {
        if let Some(d) = diagonal.iter().position(|&x| x <= T::ZERO) {
            notes.push(format!(
                "DoF {d} has no inertia (H_dd = {:e}): κ′ and r do not exist",
                diagonal[d].to_f64()
            ));
        }
        (None, None)
    } else {
        let own: Vec<T> = (0..H.rows()).map(|d| H[(d, d)]).collect();
        let (min, max) = extremes("λ′min", &eigenvalues(H, &own)?, &mut notes);
        (ratio(largest, smallest), ratio(max, min))
    };
    let bracket = diagonal_ratio.zip(kappa_weighted).map(|(r, weighted)| (r, r * weighted));
    Ok(Conditioning {
        lambda_min,
        lambda_max,
        kappa,
        kappa_weighted,
        diagonal_ratio,
        bracket,
        spectrum,
        notes,
    })
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

//! Both ends of the spectrum of H at one configuration after the other, where nothing else of H is asked for.
//!
//! ```text
//! H(q) by composite rigid bodies, straight to where it is reduced;   H ← W H W, W = B^-½;   λmin and λmax of H
//! ```

use super::Metric;
use super::ends::{EndsWorkspace, reduced_ends};
use crate::dynamics::{Crba, CrbaWorkspace};
use crate::error::InputError;
use crate::matrix::Rows;
use crate::model::Model;
use crate::scalar::{Real, dispatch_one};

/// Room for [`extreme_eigenvalues_at`], for one model and metric.
#[derive(Debug, Clone)]
pub struct EndsAtWorkspace<T> {
    crba: CrbaWorkspace<T>,
    ends: EndsWorkspace<T>,
    /// B^-½, where it stays the same and is not 1.
    units: Option<Vec<T>>,
    /// B = diag(H).
    unit_diagonal: bool,
}

impl<T: Real> EndsAtWorkspace<T> {
    /// Room for a model, in a metric.
    ///
    /// Errors: [`InputError::NotPositive`] for a weight of the metric; [`InputError::Length`]; if nv exceeds
    /// [`DENSE_LIMIT`](crate::model::DENSE_LIMIT).
    pub fn new(model: &Model<T>, metric: &Metric<T>) -> Result<Self, InputError> {
        model.check_dense()?;
        let weights = metric.weights_for(&vec![T::ONE; model.nv()], |d| model.is_translation(d))?;
        let unit_diagonal = *metric == Metric::UnitDiagonal;
        let plain = !unit_diagonal && weights.iter().all(|&b| b == T::ONE);
        Ok(Self {
            crba: CrbaWorkspace::new(model),
            ends: EndsWorkspace::new(model.nv()),
            units: (!plain).then(|| weights.iter().map(|&b| T::ONE / b.sqrt()).collect()),
            unit_diagonal,
        })
    }
}

/// λmin and λmax of H(q) x = λ B x, without the other eigenvalues and without H; allocates nothing.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternions |
/// | returned | λmin, λmax | unit of H_dd/B_dd |
///
/// The metric is the workspace's. All degrees of freedom take part: mimic joints move freely, a floating base is kept.
///
/// Method, cost, numerics: as [`mass_matrix_into`](crate::dynamics::mass_matrix_into) and [`extreme_eigenvalues`](super::extreme_eigenvalues).
///
/// Errors: [`InputError`] if q does not fit the model, [`InputError::OtherModel`] for the workspace;
/// [`InputError::NotFinite`] if H is too large a number; [`InputError::NotPositive`] in the unit-diagonal metric, if a degree of freedom has no inertia.
///
/// ```
/// use eigenbody::spectrum::{EndsAtWorkspace, Metric, extreme_eigenvalues_at};
/// use eigenbody::{Family, Model};
/// let arm: Model<f64> = Family::hydra(6, 1.0, 0.4, 1.0)?.model()?;
/// let mut room = EndsAtWorkspace::new(&arm, &Metric::Euclidean)?;
/// let [min, max] = extreme_eigenvalues_at(&arm, &[0.1; 6], &mut room)?;
/// assert!(max / min > 1e3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn extreme_eigenvalues_at<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut EndsAtWorkspace<T>,
) -> Result<[T; 2], InputError> {
    let EndsAtWorkspace { crba, ends, units, unit_diagonal } = workspace;
    let (n, stride) = (ends.n, ends.stride);
    model.check_shape("workspace", crba.shape)?;
    model.check_q(q)?;
    if n == 0 {
        return Ok([T::ZERO; 2]);
    }
    dispatch_one(Crba { model, q, workspace: crba, H: Rows { numbers: &mut ends.A, stride }, both: true });
    if let Some(units) = units {
        if *unit_diagonal {
            for (d, unit) in units.iter_mut().enumerate() {
                let value = ends.A[d * stride + d];
                if !(value > T::ZERO && value.is_finite()) {
                    return Err(InputError::NotPositive {
                        what: "diagonal of H",
                        index: d,
                        value: value.to_f64(),
                    });
                }
                *unit = T::ONE / value.sqrt();
            }
        }
        for (row, &unit) in ends.A.chunks_exact_mut(stride).zip(&*units) {
            for (x, &other) in row.iter_mut().zip(&*units) {
                *x = unit * *x * other;
            }
        }
    }
    // No entry is larger than the largest on the diagonal.
    let mut diagonal = (0..n).map(|d| ends.A[d * stride + d]);
    let found = match diagonal.position(|value| !value.is_finite()) {
        Some(index) => Err(index),
        None => Ok(reduced_ends(ends)),
    };
    match found {
        Ok([min, max]) if (min + max).is_finite() => Ok([min, max]),
        _ => {
            ends.A.fill(T::ZERO);
            Err(InputError::NotFinite { what: "H", index: found.err().unwrap_or(0) })
        }
    }
}

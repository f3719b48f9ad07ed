//! The verdict on a robot in a configuration, by whichever method suits it.

use super::{Conditioning, Method, bracket, conditioning, diagonal_ratio, in_range, ratio};
use crate::dynamics::Reduction;
use crate::error::{Error, InputError};
use crate::model::Model;
use crate::scalar::LANES;
use crate::spectrum::sturm::{Pencil, counts};
use crate::spectrum::{Extremes, Metric, Precision, check_range, extreme_values, extremes_from, slice};

/// Up to so many degrees of freedom the dense method is the faster one.
const CROSSOVER: usize = 32;
/// Relative error up to which [`Method::Auto`] keeps a dense result.
const GOOD: f64 = 1e-13;

/// What is asked of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// What counts as a unit of motion.
    pub metric: Metric<f64>,
    /// Which degrees of freedom.
    pub reduction: Reduction,
    /// How to compute.
    pub method: Method,
    /// When to use double-double.
    pub precision: Precision,
    /// All eigenvalues, not only the two extremes.
    pub all: bool,
}

impl Default for Question {
    fn default() -> Self {
        Self {
            metric: Metric::Euclidean,
            reduction: Reduction::default(),
            method: Method::Auto,
            precision: Precision::Auto,
            all: false,
        }
    }
}

/// κ, κ′, bracket and modes of a robot at q.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq`, all coordinates | rad, m, unit quaternion |
///
/// Method: see [`Method`]; both give the same numbers, the Sturm engine without the matrix and with full relative accuracy of λmin.
/// Numerics: `error_estimate` of the result.
///
/// Errors: [`InputError`] if q or the metric does not fit, a floating base is missing, or the method does not suit the robot;
/// [`InputError::Overflow`] if H or λmax is beyond the range of f64; otherwise as [`conditioning`].
///
/// ```
/// use eigenbody::{Family, Question, conditioning_at};
/// let robot = Family::hydra(220, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let verdict = conditioning_at(&robot, &[0.0; 220], &Question::default())?;
/// assert!((verdict.kappa.unwrap() / 9041021539.973643 - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn conditioning_at(
    model: &Model<f64>,
    q: &[f64],
    question: &Question,
) -> Result<Conditioning<f64>, Error> {
    let is_coupled = question.reduction.mimic && model.coupling().is_some();
    match question.method {
        Method::Dense => dense(model, q, question),
        Method::Auto if is_coupled => dense(model, q, question),
        Method::Auto if question.reduction.dofs(model).len() <= CROSSOVER => {
            // A dense result is kept where it has the digits; what it cannot resolve the engine may.
            match dense(model, q, question) {
                Ok(result) if result.error_estimate[0].is_some_and(|error| error <= GOOD) => Ok(result),
                Ok(result) if result.weights.is_empty() => Ok(result),
                Err(error @ Error::Input(_)) => Err(error),
                _ => sturm(model, q, question),
            }
        }
        // A robot that cannot move has an empty matrix: nothing to sweep.
        Method::Sturm if question.reduction.dofs(model).is_empty() => dense(model, q, question),
        Method::Sturm | Method::Auto => sturm(model, q, question),
    }
}

fn dense(model: &Model<f64>, q: &[f64], question: &Question) -> Result<Conditioning<f64>, Error> {
    let H = question.reduction.mass_matrix(model, q)?;
    let dofs = question.reduction.dofs(model);
    let weights = question.metric.weights_of(&H, |row| model.is_translation(dofs[row]))?;
    let result = conditioning(&H, &weights)?;
    let eigenvalues = result.eigenvalues.filter(|_| question.all);
    Ok(Conditioning { eigenvalues, ..result })
}

fn sturm(model: &Model<f64>, q: &[f64], question: &Question) -> Result<Conditioning<f64>, Error> {
    let Tree { pencil, dofs, weights, own } = tree(model, q, question)?;
    let pick = |all: &[f64]| -> Vec<f64> { dofs.iter().map(|&d| all[d]).collect() };
    let diagonal = pick(&own);
    let mut notes = Vec::new();
    let Extremes { min, max, passes } = extremes_from(&pencil, &own, question.precision)?;
    let eigenvalues = if question.all { Some(slice(&pencil)) } else { None };
    let (diagonal_ratio, has_zero) = diagonal_ratio(&diagonal, &weights, &mut notes);
    let kappa_weighted = if has_zero {
        None
    } else if question.metric == Metric::UnitDiagonal {
        ratio(Some(max.value), min.as_ref().ok().map(|min| min.value))
    } else {
        let weighted = pencil.with_metric(own.clone())?;
        if min.as_ref().is_ok_and(|min| min.counted_error <= GOOD) {
            let (min, max) = extreme_values(&weighted, &own);
            ratio(Some(max), min)
        } else {
            let ends = extremes_from(&weighted, &own, question.precision)?;
            if let Err(unresolved) = &ends.min {
                notes.push(format!("λ′min is not resolved: it lies below {:.1e}", unresolved.below));
            }
            ratio(Some(ends.max.value), ends.min.ok().map(|min| min.value))
        }
    };
    if let Err(unresolved) = &min {
        notes.push(match unresolved.below {
            0.0 => "λmin is zero: a motion moves no mass; H is singular".into(),
            below => {
                format!("λmin is not resolved: it lies below {below:.1e}; H is singular to working precision")
            }
        });
    }
    let min = min.ok();
    let lambda_min = min.as_ref().map(|min| min.value);
    Ok(Conditioning {
        lambda_min,
        lambda_max: Some(max.value),
        kappa: in_range("κ", ratio(Some(max.value), lambda_min), &mut notes),
        kappa_weighted,
        diagonal_ratio,
        bracket: bracket(diagonal_ratio, kappa_weighted, &mut notes),
        error_estimate: [min.as_ref().map(|min| min.error_estimate), Some(max.error_estimate)],
        softest: min.map(|min| pick(&min.vector)),
        stiffest: Some(pick(&max.vector)),
        eigenvalues,
        weights,
        method: Method::Sturm,
        passes: Some(passes),
        notes,
    })
}

/// The pencil that a question is about.
struct Tree<'m> {
    pencil: Pencil<'m, f64>,
    /// The model's DoFs that take part, and their weights in B.
    dofs: Vec<usize>,
    weights: Vec<f64>,
    /// Diagonal of the matrix, over all DoFs.
    own: Vec<f64>,
}

fn tree<'m>(model: &'m Model<f64>, q: &[f64], question: &Question) -> Result<Tree<'m>, InputError> {
    if question.reduction.mimic && model.coupling().is_some() {
        return Err(InputError::NotATree);
    }
    let pencil = Pencil::euclidean(model, q, question.reduction.base)?;
    let own = pencil.diagonal();
    check_range(&own)?;
    let B = pencil.weights(&question.metric, &own)?;
    let weights = B[pencil.removed()..].to_vec();
    Ok(Tree { pencil: pencil.with_metric(B)?, dofs: question.reduction.dofs(model), weights, own })
}

/// Number of eigenvalues below σ, in O(N), without the matrix.
///
/// Method, metric and reduction as in [`conditioning_at`]; always by the Sturm engine.
///
/// Errors: [`InputError`] if q or the metric does not fit, σ is not finite in the metric, mimic joints break the tree, or H is
/// beyond the range of f64.
///
/// ```
/// use eigenbody::{Family, Question, count_below};
/// let ring = Family::onion(5, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// // Eigenvalues 1/(4 sin²((2k−1)π/22)): 0.27, 0.35, 0.58, 1.45, 12.3.
/// assert_eq!(count_below(&ring, &[0.0; 5], &Question::default(), 1.0)?, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn count_below(model: &Model<f64>, q: &[f64], question: &Question, sigma: f64) -> Result<usize, Error> {
    let Tree { pencil, .. } = tree(model, q, question)?;
    if !pencil.metric().iter().all(|b| (b * sigma).is_finite()) {
        return Err(InputError::NotFinite { what: "sigma", index: 0 }.into());
    }
    Ok(counts(&pencil, [sigma; LANES])[0].below)
}

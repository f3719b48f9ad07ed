//! Where a quantity of the spectrum crosses a level.

use super::{State, Watch};
use eigenbody::spectrum::Tracker;
use eigenbody::{InputError, Metric, Model, Reduction};
use thiserror::Error;

/// Why a text names no crossing.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LevelError {
    /// No sign of equality.
    #[error("expected QUANTITY=X")]
    Form,
    /// The level is no number.
    #[error("expected a number")]
    Number,
    /// Another quantity.
    #[error("known: kappa, kappa_weighted, lambda_min, lambda_max")]
    Quantity,
    /// Mimic joints follow: there is no tree to track.
    #[error("not where mimic joints follow; see --mimic off")]
    Coupled,
    /// The start has no value.
    #[error(transparent)]
    Start(#[from] InputError),
}

/// Watches for a crossing that a text names, as `kappa=1e5`: of `kappa`, `kappa_weighted`, `lambda_min` or `lambda_max`, from q on.
///
/// Method: a [`Tracker`] of its own, about one factorisation a look. Errors: [`LevelError`].
///
/// ```
/// use eigenbody::{Family, Reduction};
/// use eigenbody_study::simulate::level;
/// let arm = Family::hydra(3, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let watch = level("kappa=100", &arm, Reduction::default(), &[0.0; 3])?;
/// assert_eq!((watch.rises, watch.is_above), ("kappa rises above 100".into(), "kappa is above 100".into()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn level<'a>(
    text: &str,
    model: &'a Model<f64>,
    reduction: Reduction,
    q: &[f64],
) -> Result<Watch<'a>, LevelError> {
    let (name, level) = text.split_once('=').ok_or(LevelError::Form)?;
    let level: f64 = level.trim().parse().map_err(|_| LevelError::Number)?;
    let (metric, value): (_, fn([f64; 2]) -> f64) = match name.trim() {
        "kappa" => (Metric::Euclidean, |[min, max]| max / min),
        "kappa_weighted" => (Metric::UnitDiagonal, |[min, max]| max / min),
        "lambda_min" => (Metric::Euclidean, |[min, _]| min),
        "lambda_max" => (Metric::Euclidean, |[_, max]| max),
        _ => return Err(LevelError::Quantity),
    };
    if reduction.mimic && model.coupling().is_some() {
        return Err(LevelError::Coupled);
    }
    let name = name.trim().to_owned();
    let mut tracker = Tracker::new(model, q, &metric, reduction.base)?;
    let words = |verb: &str| format!("{name} {verb} {level}");
    let [rises, falls, is_above] = ["rises above", "falls below", "is above"].map(words);
    Ok(Watch::new(rises, falls, is_above, move |state: &State| {
        // A state that does not fit has no value, and the motion ends for a better reason.
        tracker.update(&state.q).map_or(f64::NAN, |ends| value(ends.map(|end| end.value)) - level)
    }))
}

//! A motion to and fro along a mode.

use super::stance::stance;
use crate::StudyError;
use eigenbody::search::Evaluator;
use eigenbody::spatial::Transform;
use eigenbody::{InputError, Metric, Model, Reduction};

/// A robot in equal steps along a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Swing {
    /// From the world's frame to each moving body's link, a frame after the other.
    pub frames: Vec<Vec<Transform<f64>>>,
}

/// The robot at q ⊕ s x for s from −`amplitude` to `amplitude` in `count` equal steps.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `rates` | a number a DoF of `reduction` | any; scaled so that the largest is 1 |
///
/// Followers follow, and a removed base floats along as momentum wants it at q. Cost O(N) a frame, and O(N²) once where a base is
/// removed. Errors: [`StudyError`] if q or the rates do not fit.
pub fn swing(
    model: &Model<f64>,
    reduction: Reduction,
    q: &[f64],
    rates: &[f64],
    amplitude: f64,
    count: usize,
) -> Result<Swing, StudyError> {
    if let Some(index) = rates.iter().position(|rate| !rate.is_finite()) {
        return Err(InputError::NotFinite { what: "rates", index }.into());
    }
    if !amplitude.is_finite() {
        return Err(InputError::NotFinite { what: "amplitude", index: 0 }.into());
    }
    let evaluator = Evaluator::new(model, reduction, Metric::Euclidean)?;
    let v = evaluator.motion(q, rates)?;
    let largest = rates.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let scale = if largest > 0.0 { amplitude / largest } else { 0.0 };
    let frame = |k: usize| -> Result<Vec<Transform<f64>>, StudyError> {
        let s = if count > 1 { 2.0 * k as f64 / (count - 1) as f64 - 1.0 } else { 0.0 };
        let moved: Vec<f64> = v.iter().map(|v| s * scale * v).collect();
        Ok(stance(model, &model.integrate(q, &moved)?)?.links)
    };
    Ok(Swing { frames: (0..count).map(frame).collect::<Result<_, _>>()? })
}

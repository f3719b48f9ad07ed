//! κ along a line between two configurations, and over the plane of two joints.

use super::stance::settled;
use crate::StudyError;
use eigenbody::conditioning::Values;
use eigenbody::search::Evaluator;
use eigenbody::{InputError, Metric, Model, Reduction};
use rayon::prelude::*;

/// Measures along a line.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// How far, 0 to 1.
    pub t: Vec<f64>,
    /// κ, κ′, λmin, λmax there.
    pub values: Vec<Values>,
}

/// Measures over a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Values of the first joint's coordinate, ascending (rad, m).
    pub x: Vec<f64>,
    /// Of the second's.
    pub y: Vec<f64>,
    /// Row-major, a row an y.
    pub values: Vec<Values>,
}

/// The measures at `from` ⊕ t (`to` ⊖ `from`), t = 0 to 1 in `count` equal steps: rotations go the shorter way round.
///
/// Method: [`Evaluator::values`], O(N) a point, on all cores. Errors: [`StudyError`] if a configuration or the metric does not fit.
pub fn line(
    model: &Model<f64>,
    reduction: Reduction,
    metric: &Metric<f64>,
    [from, to]: [&[f64]; 2],
    count: usize,
) -> Result<Line, StudyError> {
    let [from, to] = [settled(model, reduction, from)?, settled(model, reduction, to)?];
    let v = model.difference(&from, &to)?;
    let t = steps(0.0, 1.0, count);
    let at = |k: usize| {
        let moved: Vec<f64> = v.iter().map(|v| t[k] * v).collect();
        Ok(settled(model, reduction, &model.integrate(&from, &moved)?)?)
    };
    let values = measured(model, reduction, metric, count, at)?;
    Ok(Line { t, values })
}

/// The measures over the ranges of two coordinates, the others as in q; `coordinates` are their places in q.
///
/// Method and errors: as [`line()`].
pub fn plane(
    model: &Model<f64>,
    reduction: Reduction,
    metric: &Metric<f64>,
    q: &[f64],
    coordinates: [(usize, [f64; 2]); 2],
    count: usize,
) -> Result<Plane, StudyError> {
    model.check_q(q)?;
    let [(a, [lo_x, hi_x]), (b, [lo_y, hi_y])] = coordinates;
    if let Some(found) = [a, b].into_iter().find(|&k| k >= model.nq()) {
        return Err(InputError::Length { what: "q", expected: model.nq(), found }.into());
    }
    let (x, y) = (steps(lo_x, hi_x, count), steps(lo_y, hi_y, count));
    let at = |k: usize| {
        let mut q = q.to_vec();
        (q[a], q[b]) = (x[k % count], y[k / count]);
        Ok(settled(model, reduction, &q)?)
    };
    let values = measured(model, reduction, metric, count * count, at)?;
    Ok(Plane { x, y, values })
}

/// `count` numbers from `lo` to `hi`, both included.
fn steps(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    let part = |k: usize| if count > 1 { k as f64 / (count - 1) as f64 } else { 0.0 };
    (0..count).map(|k| lo * (1.0 - part(k)) + hi * part(k)).collect()
}

/// The measures of `count` configurations, side by side.
fn measured(
    model: &Model<f64>,
    reduction: Reduction,
    metric: &Metric<f64>,
    count: usize,
    at: impl Fn(usize) -> Result<Vec<f64>, StudyError> + Sync,
) -> Result<Vec<Values>, StudyError> {
    let evaluator = Evaluator::new(model, reduction, metric.clone())?;
    (0..count)
        .into_par_iter()
        .map_init(|| evaluator.clone(), |evaluator, k| Ok(evaluator.values(&at(k)?)?))
        .collect()
}

//! Both ends of the spectrum in O(N), without the matrix.
//!
//! ```text
//! bracket λmin in (0, min H_dd/B_d], λmax in [max H_dd/B_d, Σ H_dd/B_d]
//! passes of eight shifts, four to each end, until both brackets are as narrow as the numbers allow
//! mode of each by inverse iteration; error estimate; where it asks, one Rayleigh quotient in double-double
//! ```

use super::bisect::Search;
use super::rayleigh::{modes, quotients};
use super::sturm::{Errors, Factors, Pencil, absolute_errors, counts};
use crate::error::InputError;
use crate::scalar::{Array, LANES, Unit};

/// Relative error estimate above which the double-double quotient is taken.
const WELL_KNOWN: f64 = 1e-14;
/// Relative error estimate above which every digit is worth it.
const BADLY_KNOWN: f64 = 1e-9;
/// More passes than any spectrum has needed; a guard, not a budget.
const MAX_PASSES: usize = 200;

/// One end of the spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct Extreme {
    /// The eigenvalue.
    pub value: f64,
    /// Its mode, one number a DoF of the model, xᵀBx = 1; a removed base moves along.
    pub vector: Vec<f64>,
    /// Estimated relative error of the value.
    pub error_estimate: f64,
    /// Estimated relative error of the value that counts alone give.
    pub counted_error: f64,
}

/// The smallest eigenvalue lies below what rounding lets be seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unresolved {
    /// Nothing is known of λmin but that it lies below this.
    pub below: f64,
}

/// Both ends of the spectrum of (H, B).
#[derive(Debug, Clone, PartialEq)]
pub struct Extremes {
    /// The smallest eigenvalue.
    pub min: Result<Extreme, Unresolved>,
    /// The largest.
    pub max: Extreme,
    /// Sweeps of eight counts spent.
    pub passes: usize,
}

/// Whether a Rayleigh quotient in double-double improves on the counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// Never.
    F64,
    /// Where the error estimate exceeds 1e-14 and would fall to a fourth, or where it exceeds 1e-9.
    #[default]
    Auto,
    /// Always.
    Dd,
}

/// λmin and λmax of H(q) x = λ B x with their modes and error estimates, in O(N).
///
/// Method: Sturm counts from articulated-body pivots, bisection with interpolated shifts, inverse iteration. Typically 12 to 16
/// passes of about 70 ns a body; allocates. Numerics: the relative error is that of [`Extreme::error_estimate`], usually a few ε
/// whatever κ; see `docs/numerics.md`.
///
/// Errors: [`InputError::NotPositive`] if B is zero throughout; [`InputError::Overflow`] if H, λmax, or a number on the way to a mode or its
/// error is beyond the range of f64.
///
/// ```
/// use eigenbody::Family;
/// use eigenbody::spectrum::{Precision, extremes, sturm::Pencil};
/// let (robot, q) = (Family::hydra(1000, 1.0, 0.0, 1.0)?.model::<f64>()?, vec![0.0; 1000]);
/// let pencil = Pencil::new(&robot, &q, vec![1.0; 1000])?;
/// let ends = extremes(&pencil, Precision::Auto)?;
/// assert!((ends.min.unwrap().value / 0.02114603916771028 - 1.0).abs() < 5e-15);
/// assert!((ends.max.value / 81052547734.42397 - 1.0).abs() < 5e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn extremes(pencil: &Pencil<'_, f64>, precision: Precision) -> Result<Extremes, InputError> {
    extremes_from(pencil, &pencil.diagonal(), precision)
}

/// [`extremes`] where the diagonal of the matrix is known.
pub(crate) fn extremes_from(
    pencil: &Pencil<'_, f64>,
    diagonal: &[f64],
    precision: Precision,
) -> Result<Extremes, InputError> {
    if pencil.is_empty() {
        return Err(InputError::NotPositive { what: "B", index: 0, value: 0.0 });
    }
    check_range(diagonal)?;
    let (low, high, passes) = search(pencil, diagonal);
    let largest = known_largest(&high, pencil, diagonal);
    if !largest.is_finite() {
        return Err(InputError::Overflow { what: "λmax" });
    }
    let gaps = [low.value().map_or(0.0, |value| low.gap(value)), high.gap(largest)];
    let ending = Ending { pencil, precision, largest };
    // Without a λmin, the mode of zero tells how far rounding reaches.
    let ([min, max], errors) = ending.finish([low.value().unwrap_or(0.0), largest], gaps);
    let min = if low.value().is_some() && min.error_estimate < 0.5 {
        Ok(min)
    } else {
        let reach =
            if low.value().is_some() { min.value * (1.0 + min.error_estimate) } else { errors[0].counted };
        Err(Unresolved { below: known_bound(reach, pencil, diagonal) })
    };
    let known = |end: &Extreme| {
        end.error_estimate.is_finite() && end.value.is_finite() && end.vector.iter().all(|x| x.is_finite())
    };
    match known(&max) && min.as_ref().map_or(true, known) {
        true => Ok(Extremes { min, max, passes }),
        false => Err(InputError::Overflow { what: "a mode" }),
    }
}

/// Refuses a matrix with this diagonal that is beyond the range of f64.
pub(crate) fn check_range(diagonal: &[f64]) -> Result<(), InputError> {
    match diagonal.iter().all(|h| h.is_finite()) {
        true => Ok(()),
        false => Err(InputError::Overflow { what: "H" }),
    }
}

/// λmax: counts find none where there is no inertia at all.
fn known_largest(high: &Search, pencil: &Pencil<'_, f64>, diagonal: &[f64]) -> f64 {
    let [_, most, _] = pencil.ratios(diagonal);
    high.value().unwrap_or(if most > 0.0 { f64::INFINITY } else { 0.0 })
}

/// A bound on λmin that holds whatever was lost: the smallest H_dd/B_d, where the estimate is larger or not a number.
fn known_bound(estimate: f64, pencil: &Pencil<'_, f64>, diagonal: &[f64]) -> f64 {
    let [bound, ..] = pencil.ratios(diagonal);
    if estimate < bound { estimate } else { bound.min(f64::MAX) }
}

/// Both ends by counts alone: the values without modes, error estimates or double-double.
///
/// For pencils whose extremes are known to be well determined: a third of the cost of [`extremes`]. λmin is none if it cannot be told
/// from zero.
pub(crate) fn extreme_values(pencil: &Pencil<'_, f64>, diagonal: &[f64]) -> (Option<f64>, f64) {
    let (low, high, _) = search(pencil, diagonal);
    (low.value(), known_largest(&high, pencil, diagonal))
}

/// Brackets of both ends, and the passes they took: four shifts to each end, eight to one that is left over.
fn search(pencil: &Pencil<'_, f64>, diagonal: &[f64]) -> (Search, Search, usize) {
    let (mut low, mut high) = (Search::new(0), Search::new(pencil.len() - 1));
    let mut passes = 0;
    let mut shifts = first_shifts(pencil, diagonal);
    while passes < MAX_PASSES {
        let found = counts(pencil, shifts);
        passes += 1;
        low.learn(&found);
        high.learn(&found);
        match (low.is_settled(), high.is_settled()) {
            (true, true) => break,
            (true, false) => high.offer(&mut shifts),
            (false, true) => low.offer(&mut shifts),
            (false, false) => {
                let (first, second) = shifts.split_at_mut(LANES / 2);
                low.offer(first);
                high.offer(second);
            }
        }
    }
    (low, high, passes)
}

/// Bounds of both ends, and shifts between them.
fn first_shifts(pencil: &Pencil<'_, f64>, diagonal: &[f64]) -> [f64; LANES] {
    let [min, max, sum] = pencil.ratios(diagonal);
    // A little outside, so that rounding in the diagonal does not matter.
    let (inside, outside) = (max * (1.0 - 1e-9), sum * (1.0 + 1e-9));
    let step = |part: f64| inside * (outside / inside).powf(part);
    [0.0, 0.01 * min, 0.3 * min, min * (1.0 + 1e-9), inside, step(1.0 / 3.0), step(2.0 / 3.0), outside]
}

/// What is left to do when both eigenvalues are known.
struct Ending<'a> {
    pencil: &'a Pencil<'a, f64>,
    precision: Precision,
    largest: f64,
}

impl Ending<'_> {
    /// Modes, error estimates and, where those ask, double-double quotients; both ends side by side.
    fn finish(&self, values: [f64; 2], gaps: [f64; 2]) -> ([Extreme; 2], [Errors; 2]) {
        let Self { pencil, .. } = self;
        // As the estimate, which in fused arithmetic is less sure of what counts hardly know.
        let mut factors = Factors::new(pencil, Unit::Plain);
        let mut x = modes(pencil, values, &mut factors);
        let errors = absolute_errors(pencil, values, factors.motions(), &x);
        pencil.fill_base(factors.motions(), &mut x);
        drop(factors);
        let estimate = |k: usize| match values[k] {
            0.0 => 0.0,
            value => (f64::EPSILON * value + errors[k].counted) / value,
        };
        let extreme = |k: usize| Extreme {
            value: values[k],
            vector: x.iter().map(|x: &Array<2>| x.0[k]).collect(),
            error_estimate: estimate(k),
            counted_error: estimate(k),
        };
        let mut ends = [0, 1].map(extreme);
        let refined = [0, 1].map(|k| self.quotient_error(&ends[k], errors[k], gaps[k]));
        let asked: Vec<usize> = (0..2).filter(|&k| self.asks(ends[k].counted_error, refined[k])).collect();
        for (&k, quotient) in asked.iter().zip(quotients(pencil, &x, &asked)) {
            // Taken if it lies within the error of the counts and is better known.
            let end = &mut ends[k];
            let agrees = (quotient - end.value).abs() <= end.counted_error * end.value;
            if agrees && refined[k] < end.error_estimate {
                (end.value, end.error_estimate) = (quotient, refined[k]);
            }
        }
        (ends, errors)
    }

    /// Whether a quotient is worth its cost: where digits are few, or where it promises a fourth of the error.
    fn asks(&self, counted: f64, refined: f64) -> bool {
        match self.precision {
            Precision::F64 => false,
            Precision::Auto => counted > WELL_KNOWN && (counted > BADLY_KNOWN || refined <= 0.25 * counted),
            Precision::Dd => true,
        }
    }

    /// Relative error of the quotient: the square of the mode's error, which is that of the pencil over the gap to the next
    /// eigenvalue, and of the last digit of every x_d, which the largest eigenvalue amplifies. The mechanism's own numbers are no
    /// better for it.
    fn quotient_error(&self, end: &Extreme, errors: Errors, gap: f64) -> f64 {
        let error = end.counted_error * end.value;
        let digits = (0.5 * f64::EPSILON).powi(2) * self.largest;
        ((errors.given + error * (error / gap) + digits) / end.value).max(4.0 * f64::EPSILON)
    }
}

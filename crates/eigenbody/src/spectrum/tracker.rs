//! Both ends of the spectrum along a motion, side by side, at about one factorisation and one solve a step.
//!
//! ```text
//! σ ← λ extrapolated,  x ← mode extrapolated
//! repeat:   y = (H − σB)⁻¹ B x      c = ŷᵀBx,  ŷ = y/|y|_B
//!           λ = σ + c/|y|           residual |(H − λB)ŷ| = √(1 − c²)/|y|
//!           x ← ŷ,  σ ← λ           until residual ≤ 1e-8 λ
//! ```
//! Rayleigh-quotient iteration converges to an eigenvalue, not to a given one. Which one it is, the same factorisation tells at no
//! cost: with k eigenvalues sought below λ, count(σ) is k for λ ≥ σ and k + 1 for λ < σ. Where the count says otherwise, as after
//! a crossing, the end is found again by bisection and the reading says so.

use super::extremes::cold;
use super::metric::Metric;
use super::rayleigh::{modes, normalise};
use super::sturm::{Diagonal, Factors, Pencil};
use crate::error::InputError;
use crate::model::Model;
use crate::scalar::{Array, Scalar};

/// Residual, against the eigenvalue, at which iteration stops: the value's error is its square over the gap.
const RESIDUAL: f64 = 1e-8;
/// Rounds before an end is given up and found again.
const ROUNDS: usize = 6;

/// One end of the spectrum at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// The eigenvalue; zero if it cannot be told from zero.
    pub value: f64,
    /// |(H − λB)x| of the mode, xᵀBx = 1, in the norm of B⁻¹.
    pub residual: f64,
    /// Factorisations spent.
    pub factorisations: usize,
    /// The end was lost and found again by bisection.
    pub restarted: bool,
}

/// λmin and λmax along a motion.
///
/// Starts cold; each [`update`](Self::update) costs about one factorisation and one solve of two lanes, O(N), and allocates nothing
/// unless an end is lost. Any pace: the coarser the steps, the more rounds or restarts.
///
/// ```
/// use eigenbody::spectrum::{Metric, Tracker};
/// use eigenbody::Family;
/// let robot = Family::hydra(20, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let mut tracker = Tracker::new(&robot, &[0.0; 20], &Metric::Euclidean, false)?;
/// for step in 1..100 {
///     let q = [0.001 * f64::from(step); 20];
///     let [softest, stiffest] = tracker.update(&q)?;
///     assert!(stiffest.value / softest.value > 1e4);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Tracker<'m> {
    model: &'m Model<f64>,
    pencil: Pencil<f64>,
    /// The unit-diagonal metric follows q.
    own: Option<Diagonal<f64>>,
    factors: Factors<Array<2>>,
    /// Both modes: the last ones, the ones before, and those that are being iterated.
    x: Vec<Array<2>>,
    before: Vec<Array<2>>,
    y: Vec<Array<2>>,
    ends: [End; 2],
}

/// What is remembered of one end.
#[derive(Debug, Clone)]
struct End {
    /// Its place in the spectrum.
    index: usize,
    /// The last values, the latest first; as many as `known` count.
    values: [f64; 3],
    known: usize,
}

impl<'m> Tracker<'m> {
    /// Starts at q. `free_floating` removes a floating base: H*.
    ///
    /// Errors: [`InputError`] if q or the metric does not fit, or there is no floating base to remove.
    pub fn new(
        model: &'m Model<f64>,
        q: &[f64],
        metric: &Metric<f64>,
        free_floating: bool,
    ) -> Result<Self, InputError> {
        let nv = model.nv();
        let (unit, removed) = (vec![1.0; nv], if free_floating { 6 } else { 0 });
        let pencil = match free_floating {
            true => Pencil::free_floating(model, q, unit)?,
            false => Pencil::new(model, q, unit)?,
        };
        let mut diagonal = Diagonal::new(&pencil);
        let weights = metric
            .weights_for(&diagonal.update(&pencil)[removed..], |row| model.is_translation(row + removed))?;
        let mut B = vec![0.0; nv];
        B[removed..].copy_from_slice(&weights);
        let pencil = pencil.with_metric(B)?;
        let Some(last) = pencil.len().checked_sub(1) else {
            return Err(InputError::NotPositive { what: "B", index: 0, value: 0.0 });
        };
        let end = |index| End { index, values: [0.0; 3], known: 0 };
        let own = matches!(metric, Metric::UnitDiagonal).then_some(diagonal);
        let factors = Factors::new(&pencil);
        let [x, before, y] = [(); 3].map(|()| vec![Array::ZERO; nv]);
        let mut tracker = Self { model, pencil, own, factors, x, before, y, ends: [end(0), end(last)] };
        for which in 0..2 {
            tracker.restart(which);
        }
        Ok(tracker)
    }

    /// λmin and λmax at the next q.
    ///
    /// Errors: [`InputError`] if q does not fit; the tracker then stays where it was.
    pub fn update(&mut self, q: &[f64]) -> Result<[Reading; 2], InputError> {
        self.pencil.update(self.model, q)?;
        if let Some(own) = &mut self.own {
            let diagonal = own.update(&self.pencil);
            self.pencil.set_metric(diagonal);
        }
        Ok(self.follow())
    }

    /// The latest mode of λmin (0) or λmax (1): one number a DoF, xᵀBx = 1. A removed base has zeros.
    pub fn mode(&self, which: usize) -> impl ExactSizeIterator<Item = f64> {
        self.x.iter().map(move |x| x.0[which.min(1)])
    }

    fn follow(&mut self) -> [Reading; 2] {
        let mut shifts = self.predict();
        let Self { pencil, factors, x, y, ends, .. } = self;
        let B = pencil.metric();
        let mut found: [Option<Reading>; 2] = [None; 2];
        let mut lost = [false; 2];
        normalise(y, B);
        for round in 1..=ROUNDS {
            x.copy_from_slice(y);
            factors.factor(pencil, Array(shifts));
            for ((y, &x), &b) in y.iter_mut().zip(&*x).zip(B) {
                *y = Array([b; 2]) * x;
            }
            factors.solve(pencil, y);
            let growth = normalise(y, B);
            let c = y.iter().zip(&*x).zip(B).fold(Array::ZERO, |c, ((&y, &x), &b)| c + y * x * Array([b; 2]));
            let sign = Array(c.0.map(f64::signum));
            y.iter_mut().for_each(|y| *y *= sign);
            for (k, end) in ends.iter().enumerate() {
                // An end that is found stays at its shift while the other goes on: its mode only gets better.
                if found[k].is_some() || lost[k] {
                    continue;
                }
                let value = shifts[k] + c.0[k] / growth[k];
                let residual = (1.0 - c.0[k] * c.0[k]).max(0.0).sqrt() / growth[k];
                if residual <= RESIDUAL * value.abs() {
                    let expected = end.index + usize::from(value < shifts[k]);
                    lost[k] = factors.below.0[k] as usize != expected;
                    found[k] = Some(Reading { value, residual, factorisations: round, restarted: false });
                } else if value.is_finite() {
                    shifts[k] = value;
                } else {
                    lost[k] = true;
                }
            }
            if (0..2).all(|k| found[k].is_some() || lost[k]) {
                break;
            }
        }
        x.copy_from_slice(y);
        [0, 1].map(|k| match found[k].filter(|_| !lost[k]) {
            Some(reading) => {
                self.ends[k].settle(reading.value);
                reading
            }
            None => self.restart(k),
        })
    }

    /// The next values by extrapolation through up to three, and the next modes, into `y`, through two; the last modes are kept.
    fn predict(&mut self) -> [f64; 2] {
        let Self { x, before, y, ends, .. } = self;
        // x + forward (x − before)
        let forward = Array([0, 1].map(|k| if ends[k].known > 1 { 1.0 } else { 0.0 }));
        for ((y, &x), before) in y.iter_mut().zip(&*x).zip(before) {
            *y = x + forward * (x - *before);
            *before = x;
        }
        [0, 1].map(|k| ends[k].predict())
    }

    /// Finds an end by bisection, without what was known.
    fn restart(&mut self, which: usize) -> Reading {
        let Self { pencil, x, before, ends, .. } = self;
        let end = &mut ends[which];
        let value = cold(pencil, end.index).unwrap_or(0.0);
        end.known = 0;
        end.settle(value);
        let mode = modes(pencil, [value], &mut Factors::new(pencil));
        for ((x, before), Array([mode])) in x.iter_mut().zip(before).zip(mode) {
            (x.0[which], before.0[which]) = (mode, mode);
        }
        Reading { value, residual: f64::EPSILON * value, factorisations: ROUNDS, restarted: true }
    }
}

impl End {
    fn predict(&self) -> f64 {
        let [a, b, c] = self.values;
        match self.known {
            0 | 1 => a,
            2 => 2.0 * a - b,
            _ => 3.0 * (a - b) + c,
        }
    }

    fn settle(&mut self, value: f64) {
        self.values = [value, self.values[0], self.values[1]];
        self.known = (self.known + 1).min(3);
    }
}

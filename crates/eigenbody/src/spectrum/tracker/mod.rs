//! Both ends of the spectrum along a motion, side by side, at about one factorisation and one solve a step.
//!
//! ```text
//! x ← mode extrapolated,  σ ← λ extrapolated or xᵀHx, the one nearer to its end: xᵀHx lies inside of the spectrum
//! repeat:   y = (H − σB)⁻¹ B x      c = ŷᵀBx,  ŷ = y/|y|_B
//!           λ = ŷᵀHŷ, twice the kinetic energy     residual |(H − λB)ŷ| = √(1 − c²)/|y|
//!           x ← ŷ,  σ ← λ           until the residual is small
//! ```
//! Rayleigh-quotient iteration converges to an eigenvalue, not to a given one. Which one it is, the same factorisation tells at no
//! cost, if σ stands a little inside of λ: one eigenvalue below σ and λ < σ, and λ is λmin; all but one below σ and λ ≥ σ, and λ is λmax.
//! Where σ fell outside, one more count just outside of λ tells; where that says otherwise, as after a crossing, the end is found again and
//! the reading says so:
//!
//! ```text
//! inverse iteration beside λ, without its mode; a count just outside of what is found says whether it is the end. If not:
//! bracket of eigenvalue k by two counts a sweep, from its last value outwards, until it is alone in there and the bracket is short
//! inverse iteration from its middle; what converges inside the bracket is eigenvalue k; else the bracket is shortened further
//! ```

mod end;
mod lost;

use super::metric::Metric;
use super::rayleigh::{normalise, start};
use super::sturm::{Diagonal, Factors, Pencil};
use crate::error::InputError;
use crate::model::Model;
use crate::scalar::{Array, Scalar, Unit};
use end::{CERTIFIED, End, MARGIN, inwards, outwards};

/// Error of the value, against itself, at which iteration stops.
///
/// Where σ stands between the end and all other eigenvalues, a round turns every other mode's part m_j of x about: to −m_j (λ − σ)/(σ − λ_j). So
/// what is left of them is less than what x turned by, sin θ = √(1 − c²), and the value's error Σ m_j²|λ_j − λ| at most sin θ times the residual.
const ERROR: f64 = 3e-13;
/// Rounds before an end is given up and found again.
const ROUNDS: usize = 6;

/// One end of the spectrum at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// The eigenvalue; zero if it cannot be told from zero.
    pub value: f64,
    /// |(H − λB)x| of the mode, xᵀBx = 1, in the norm of B⁻¹.
    pub residual: f64,
    /// Factorisations spent on this end; where both share a sweep, one each.
    pub factorisations: usize,
    /// The end was lost and found again.
    pub restarted: bool,
}

/// Refuses an eigenvalue that is no number.
fn within_range(reading: Reading) -> Result<Reading, InputError> {
    match reading.value.is_finite() {
        true => Ok(reading),
        false => Err(InputError::Overflow { what: "an eigenvalue" }),
    }
}

/// λmin and λmax along a motion.
///
/// Each [`update`](Self::update) costs about one factorisation and one solve of two lanes, O(N), and allocates nothing. Any pace: the
/// coarser the steps, the more rounds or restarts. Bounded: at most 6 rounds, and for each end that is lost at most 90 more.
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
    pencil: Pencil<'m, f64>,
    diagonal: Diagonal<f64>,
    /// The unit-diagonal metric follows q.
    follows: bool,
    /// What inverse iteration starts from where nothing is known.
    start: Vec<f64>,
    factors: Factors,
    /// Both modes: the last ones, the two before, and those that are being iterated.
    x: Vec<Array<2>>,
    before: Vec<[Array<2>; 2]>,
    y: Vec<Array<2>>,
    /// One mode, while an end is found again.
    x_lane: Vec<f64>,
    ends: [End; 2],
}

impl<'m> Tracker<'m> {
    /// Starts at q. `free_floating` removes a floating base: H*.
    ///
    /// Errors: [`InputError`] if q or the metric does not fit, there is no floating base to remove, or an eigenvalue is beyond the
    /// range of f64.
    pub fn new(
        model: &'m Model<f64>,
        q: &[f64],
        metric: &Metric<f64>,
        free_floating: bool,
    ) -> Result<Self, InputError> {
        let nv = model.nv();
        let pencil = Pencil::euclidean(model, q, free_floating)?;
        let mut diagonal = Diagonal::new(&pencil);
        let B = pencil.weights(metric, diagonal.update(&pencil))?;
        let pencil = pencil.with_metric(B)?;
        let Some(last) = pencil.len().checked_sub(1) else {
            return Err(InputError::NotPositive { what: "B", index: 0, value: 0.0 });
        };
        let end = |index| End { index, values: [0.0; 4], known: 0, missed: MARGIN.1 };
        let follows = matches!(metric, Metric::UnitDiagonal);
        let (factors, start) = (Factors::new(&pencil, Unit::widest()), start(pencil.metric()));
        let [x, y] = [(); 2].map(|()| vec![Array::ZERO; nv]);
        let before = vec![[Array::ZERO; 2]; nv];
        let ends = [end(0), end(last)];
        let mut tracker =
            Self { pencil, diagonal, follows, start, factors, x, before, y, x_lane: vec![0.0; nv], ends };
        for which in 0..2 {
            within_range(tracker.find_again(which, None))?;
        }
        Ok(tracker)
    }

    /// λmin and λmax at the next q.
    ///
    /// Errors: [`InputError::Overflow`] if an eigenvalue is beyond the range of f64, after which nothing is known of the modes;
    /// [`InputError`] if q does not fit, or a degree of freedom has no inertia there and the metric is the unit-diagonal one; the
    /// modes are then those of the last q that was followed.
    pub fn update(&mut self, q: &[f64]) -> Result<[Reading; 2], InputError> {
        self.pencil.update(q)?;
        if self.follows {
            let diagonal = self.diagonal.update(&self.pencil);
            self.pencil.set_metric(diagonal)?;
        }
        let [softest, stiffest] = self.follow();
        Ok([within_range(softest)?, within_range(stiffest)?])
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
        factors.set_moving(pencil, y);
        let inside = factors.energy(pencil, y).0;
        shifts[0] = shifts[0].min(inside[0] * inwards(0, MARGIN.0));
        shifts[1] = shifts[1].max(inside[1] * inwards(1, MARGIN.0));
        for round in 1..=ROUNDS {
            x.copy_from_slice(y);
            factors.factor(pencil, Array(shifts));
            for ((y, &x), &b) in y.iter_mut().zip(&*x).zip(B) {
                *y = Array([b; 2]) * x;
            }
            factors.solve(pencil, y);
            let energy = factors.energy(pencil, y);
            let growth = normalise(y, B);
            let quotient = energy / (Array(growth) * Array(growth));
            let c = y.iter().zip(&*x).zip(B).fold(Array::ZERO, |c, ((&y, &x), &b)| c + y * x * Array([b; 2]));
            let sign = Array(c.0.map(f64::signum));
            y.iter_mut().for_each(|y| *y *= sign);
            for (k, end) in ends.iter().enumerate() {
                // An end that is found stays at its shift while the other goes on: its mode only gets better.
                if found[k].is_some() || lost[k] {
                    continue;
                }
                let value = quotient.0[k];
                let turned = (1.0 - c.0[k] * c.0[k]).max(0.0);
                let residual = turned.sqrt() / growth[k];
                if turned / growth[k] <= ERROR * value.abs() {
                    lost[k] = !end.is_certain(k, value, shifts[k], factors.below.0[k] as usize);
                    found[k] = Some(Reading { value, residual, factorisations: round, restarted: false });
                } else if value.is_finite() {
                    shifts[k] = value * inwards(k, MARGIN.0);
                } else {
                    lost[k] = true;
                }
            }
            if (0..2).all(|k| found[k].is_some() || lost[k]) {
                break;
            }
        }
        x.copy_from_slice(y);
        let certified = self.certify(&found, &lost);
        [0, 1].map(|k| {
            let certificate = usize::from(lost[k] && found[k].is_some());
            let spent = certificate + found[k].map_or(ROUNDS, |reading| reading.factorisations);
            let reading = match found[k] {
                Some(reading) if !lost[k] || certified[k] => {
                    self.ends[k].settle(reading.value);
                    Reading { factorisations: 0, ..reading }
                }
                followed => self.find_again(k, followed.map(|reading| reading.value)),
            };
            Reading { factorisations: spent + reading.factorisations, ..reading }
        })
    }

    /// Where two eigenvalues lie so close together that the count speaks of both: whether none lies beyond the one that was found, by one
    /// more count just outside of it.
    fn certify(&mut self, found: &[Option<Reading>; 2], lost: &[bool; 2]) -> [bool; 2] {
        let asked = [0, 1].map(|k| found[k].filter(|_| lost[k]));
        if asked.iter().all(Option::is_none) {
            return [false; 2];
        }
        let shifts = [0, 1].map(|k| asked[k].map_or(0.0, |reading| reading.value * outwards(k, CERTIFIED)));
        self.factors.factor(&self.pencil, Array(shifts));
        let below = self.factors.below.0;
        [0, 1].map(|k| asked[k].is_some() && below[k] as usize == self.ends[k].index + k)
    }

    /// The next values and, into `y`, the next modes by extrapolation through as many of the last as are known; the last modes are kept.
    fn predict(&mut self) -> [f64; 2] {
        let Self { x, before, y, ends, .. } = self;
        // x + first (x − b₁) + second (x − 2 b₁ + b₂)
        let [first, second] =
            [1, 2].map(|known| Array([0, 1].map(|k| f64::from(u8::from(ends[k].known > known)))));
        for ((y, &x), before) in y.iter_mut().zip(&*x).zip(before) {
            let step = x - before[0];
            *y = x + first * step + second * (step - (before[0] - before[1]));
            *before = [x, before[0]];
        }
        [0, 1].map(|k| ends[k].shift(k))
    }
}

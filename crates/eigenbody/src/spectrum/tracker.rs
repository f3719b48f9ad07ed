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
//! bracket of eigenvalue k by two counts a sweep, from its last value outwards, until it is alone in there and the bracket is short
//! inverse iteration from its middle; what converges inside the bracket is eigenvalue k; else the bracket is shortened further
//! ```

use super::metric::Metric;
use super::rayleigh::{normalise, start};
use super::sturm::{Diagonal, Factors, Pencil};
use crate::error::InputError;
use crate::model::Model;
use crate::scalar::{Array, Scalar};

/// Error of the value, against itself, at which iteration stops.
///
/// Where σ stands between the end and all other eigenvalues, a round turns every other mode's part m_j of x about: to −m_j (λ − σ)/(σ − λ_j). So
/// what is left of them is less than what x turned by, sin θ = √(1 − c²), and the value's error Σ m_j²|λ_j − λ| at most sin θ times the residual.
const ERROR: f64 = 3e-13;
/// Residual, against the eigenvalue, at which iteration stops where nothing is known of σ's place.
const RESIDUAL: f64 = 1e-12;
/// Rounds before an end is given up and found again.
const ROUNDS: usize = 6;
/// How close to its end of the spectrum a value is certified to be, where eigenvalues lie together.
const CERTIFIED: f64 = 1e-13;
/// How far, at least and at most, a shift stands inside of the value that it is meant for.
const MARGIN: (f64, f64) = (1e-9, 1e-3);
/// Sweeps after which a bracket is as short as numbers allow, whatever it was: 280 decades, then 53 bits, by thirds.
const SWEEPS: usize = 60;
/// Relative width of a bracket at which inverse iteration is tried, and to which it is shortened where that fails.
const SHORT: f64 = 0.1;
/// Relative width at which a bracket is as good as the numbers in it.
const WIDTH: f64 = 2.0 * f64::EPSILON;
/// How far from the edges of a bracket, relative to its size, a value lies inside of it for certain.
const EDGE: f64 = 1e-12;
/// Eigenvalues below this are not told from zero.
const SMALLEST: f64 = 1e-280;

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
    model: &'m Model<f64>,
    pencil: Pencil<f64>,
    diagonal: Diagonal<f64>,
    /// The unit-diagonal metric follows q.
    follows: bool,
    /// What inverse iteration starts from where nothing is known.
    start: Vec<f64>,
    factors: Factors<Array<2>>,
    /// Both modes: the last ones, the two before, and those that are being iterated.
    x: Vec<Array<2>>,
    before: Vec<[Array<2>; 2]>,
    y: Vec<Array<2>>,
    /// One mode, while an end is found again.
    x_lane: Vec<f64>,
    ends: [End; 2],
}

/// What is remembered of one end.
#[derive(Debug, Clone)]
struct End {
    /// Its place in the spectrum.
    index: usize,
    /// The last values, the latest first; as many as `known` count.
    values: [f64; 4],
    known: usize,
    /// By how much, relative to the value, the last prediction missed it.
    missed: f64,
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
        let end = |index| End { index, values: [0.0; 4], known: 0, missed: MARGIN.1 };
        let follows = matches!(metric, Metric::UnitDiagonal);
        let (factors, start) = (Factors::new(&pencil), start(pencil.metric()));
        let [x, y] = [(); 2].map(|()| vec![Array::ZERO; nv]);
        let before = vec![[Array::ZERO; 2]; nv];
        let ends = [end(0), end(last)];
        let mut tracker = Self {
            model,
            pencil,
            diagonal,
            follows,
            start,
            factors,
            x,
            before,
            y,
            x_lane: vec![0.0; nv],
            ends,
        };
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
        if self.follows {
            let diagonal = self.diagonal.update(&self.pencil);
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
        [0, 1].map(|k| match found[k] {
            Some(reading) if !lost[k] || certified[k] => {
                self.ends[k].settle(reading.value);
                let certificate = usize::from(lost[k]);
                Reading { factorisations: reading.factorisations + certificate, ..reading }
            }
            _ => self.restart(k),
        })
    }

    /// Where two eigenvalues lie so close together that the count speaks of both: whether none lies beyond the one that was found, by one
    /// more count just outside of it.
    fn certify(&mut self, found: &[Option<Reading>; 2], lost: &[bool; 2]) -> [bool; 2] {
        let asked = [0, 1].map(|k| found[k].filter(|_| lost[k]));
        if asked.iter().all(Option::is_none) {
            return [false; 2];
        }
        let outside = [1.0 - CERTIFIED, 1.0 + CERTIFIED];
        let shifts = [0, 1].map(|k| asked[k].map_or(0.0, |reading| outside[k] * reading.value));
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

    /// Finds an end by bisection and inverse iteration, its last value the first guess.
    fn restart(&mut self, which: usize) -> Reading {
        let (index, guess) = (self.ends[which].index, self.ends[which].values[0]);
        let mut bracket = self.bounds(which);
        let mut sweeps = 0;
        let mut width = SHORT;
        let found = loop {
            if !self.shorten(&mut bracket, index, guess, width, &mut sweeps) {
                break None;
            }
            let rounds = self.settle_inside(which, &bracket);
            sweeps += rounds.1;
            let is_point = bracket.width() <= WIDTH || sweeps >= SWEEPS;
            match rounds.0 {
                Some(found) => break Some(found),
                None if is_point => break Some((bracket.middle(), bracket.width() * bracket.middle())),
                None => width = (width * 1e-3).max(WIDTH),
            }
        };
        let (value, residual) = found.unwrap_or((0.0, 0.0));
        let Self { y, x, before, ends, .. } = self;
        for ((x, before), y) in x.iter_mut().zip(before).zip(&*y) {
            (x.0[which], before[0].0[which]) = (y.0[which], y.0[which]);
        }
        ends[which].known = 0;
        ends[which].settle(value);
        Reading { value, residual, factorisations: 2 * sweeps, restarted: true }
    }

    /// A bracket that holds for certain: λmin in (0, min H_dd/B_d], λmax in [max H_dd/B_d, Σ H_dd/B_d].
    fn bounds(&mut self, which: usize) -> Bracket {
        let diagonal = self.diagonal.update(&self.pencil);
        let ratios = diagonal.iter().zip(self.pencil.metric()).filter(|(_, b)| **b > 0.0).map(|(h, b)| h / b);
        let (min, max, sum) =
            ratios.fold((f64::INFINITY, 0.0f64, 0.0), |(min, max, sum), r| (r.min(min), r.max(max), sum + r));
        // A little outside, so that rounding in the diagonal does not matter; what is below `lo` and `hi` is known of these two alone.
        let n = self.pencil.len();
        match which {
            0 => Bracket { lo: 0.0, hi: min * (1.0 + 1e-9), below: (0, n) },
            _ => Bracket { lo: max * (1.0 - 1e-9), hi: sum * (1.0 + 1e-9), below: (0, n) },
        }
    }

    /// Shortens the bracket of an eigenvalue, two counts a sweep, until it is alone in there and the bracket's relative width is at most
    /// `width`, or until numbers go no further. False if the eigenvalue cannot be told from zero.
    fn shorten(
        &mut self,
        bracket: &mut Bracket,
        index: usize,
        guess: f64,
        width: f64,
        sweeps: &mut usize,
    ) -> bool {
        while !(bracket.is_alone(index) && bracket.width() <= width)
            && bracket.width() > WIDTH
            && *sweeps < SWEEPS
        {
            let shifts = match *sweeps {
                0 if bracket.lo == 0.0 => [0.0, guess],
                0 => [guess, bracket.thirds()[1]],
                1 => [guess * (1.0 - 0.4 * SHORT), guess * (1.0 + 0.4 * SHORT)],
                _ => bracket.thirds(),
            };
            self.factors.factor(&self.pencil, Array(shifts));
            *sweeps += 1;
            for (&shift, below) in shifts.iter().zip(self.factors.below.0) {
                let below = below as usize;
                if shift == 0.0 && below > index {
                    return false;
                }
                bracket.learn(shift, below, index);
            }
            if bracket.hi < SMALLEST {
                return false;
            }
        }
        true
    }

    /// Inverse iteration from the middle of a bracket: eigenvalue and residual if it settles inside, and the rounds it took.
    fn settle_inside(&mut self, which: usize, bracket: &Bracket) -> (Option<(f64, f64)>, usize) {
        let Self { pencil, factors, y, start, x_lane, .. } = self;
        let B = pencil.metric();
        y.iter_mut().zip(&*start).for_each(|(y, &x)| *y = Array([x; 2]));
        let mut shift = bracket.middle();
        let mut found = None;
        let mut round = 0;
        normalise(y, B);
        while round < ROUNDS + 3 {
            // Three rounds at the middle make the nearest mode stand out; from then on the shift follows.
            if round == 0 || round >= 3 {
                factors.factor(pencil, Array([shift; 2]));
            }
            round += 1;
            // c = ŷᵀBx needs x: B x and its image are weighed in one pass.
            let before: f64 = sum(y.iter().zip(B), |(y, b)| y.0[which] * y.0[which] * b);
            x_lane.iter_mut().zip(&*y).for_each(|(x, y)| *x = y.0[which]);
            y.iter_mut().zip(B).for_each(|(y, &b)| *y *= Array([b; 2]));
            factors.solve(pencil, y);
            let energy = factors.energy(pencil, y).0[which];
            let growth = normalise(y, B)[which];
            let c: f64 = sum(y.iter().zip(&*x_lane).zip(B), |((y, x), b)| y.0[which] * x * b) / before.sqrt();
            let value = energy / (growth * growth);
            let residual = (1.0 - c * c).max(0.0).sqrt() / growth;
            if !value.is_finite() {
                break;
            }
            if round > 1 && residual <= RESIDUAL * value.abs() {
                // An edge may be an eigenvalue itself, and then not the one that is meant: one that stays the same in every
                // configuration is the first guess again.
                let edge = residual + EDGE * value.abs();
                let is_inside = value > bracket.lo + edge && value < bracket.hi - edge;
                found = is_inside.then_some((value, residual));
                break;
            }
            if round >= 3 {
                shift = value;
            }
        }
        (found, round)
    }
}

fn sum<T>(terms: impl Iterator<Item = T>, f: impl Fn(T) -> f64) -> f64 {
    terms.fold(0.0, |sum, term| sum + f(term))
}

/// Where an eigenvalue lies: count(lo) ≤ index < count(hi).
#[derive(Debug, Clone, Copy)]
struct Bracket {
    lo: f64,
    hi: f64,
    /// Eigenvalues below lo and below hi.
    below: (usize, usize),
}

impl Bracket {
    /// Against its upper end.
    fn width(&self) -> f64 {
        (self.hi - self.lo) / self.hi
    }

    fn middle(&self) -> f64 {
        self.lo + 0.5 * (self.hi - self.lo)
    }

    fn is_alone(&self, index: usize) -> bool {
        self.below == (index, index + 1)
    }

    /// Two shifts in between, of equal steps of log σ where hi/lo > 2; far down where there is no lower bound yet.
    fn thirds(&self) -> [f64; 2] {
        let Self { lo, hi, .. } = *self;
        if lo == 0.0 {
            [hi * 1e-6, hi * 0.1]
        } else if hi > 2.0 * lo {
            let ratio = (hi / lo).cbrt();
            [lo * ratio, lo * ratio * ratio]
        } else {
            [lo + (hi - lo) / 3.0, lo + (hi - lo) / 1.5]
        }
    }

    /// Takes note of a count, if the shift is strictly inside.
    fn learn(&mut self, shift: f64, below: usize, index: usize) {
        if !(shift >= self.lo && shift <= self.hi) {
            return;
        }
        if below > index {
            (self.hi, self.below.1) = (shift, below);
        } else {
            (self.lo, self.below.0) = (shift, below);
        }
    }
}

/// The factor that moves a shift from its end of the spectrum into it.
fn inwards(which: usize, margin: f64) -> f64 {
    if which == 0 { 1.0 + margin } else { 1.0 - margin }
}

impl End {
    /// Whether a count says for certain that an eigenvalue near `value` is the end: it is alone on the outer side of the shift, or the shift is
    /// so close that nothing matters in between.
    fn is_certain(&self, which: usize, value: f64, shift: f64, below: usize) -> bool {
        let is_outside = if which == 0 { value < shift } else { value >= shift };
        let alone = if which == 0 { self.index + 1 } else { self.index };
        let empty = if which == 0 { self.index } else { self.index + 1 };
        let is_close = (value - shift).abs() <= CERTIFIED * value.abs();
        if is_outside { below == alone } else { below == empty && is_close }
    }

    /// A shift that lies inside of the next value by twice what the last prediction missed.
    fn shift(&self, which: usize) -> f64 {
        let margin = (2.0 * self.missed).clamp(MARGIN.0, MARGIN.1);
        self.predict() * inwards(which, margin)
    }

    fn predict(&self) -> f64 {
        let [a, b, c, d] = self.values;
        match self.known {
            0 | 1 => a,
            2 => 2.0 * a - b,
            3 => 3.0 * (a - b) + c,
            _ => 4.0 * (a + c) - 6.0 * b - d,
        }
    }

    fn settle(&mut self, value: f64) {
        let predicted = self.predict();
        self.missed = if self.known > 0 && value > 0.0 { (predicted / value - 1.0).abs() } else { MARGIN.1 };
        self.values = [value, self.values[0], self.values[1], self.values[2]];
        self.known = (self.known + 1).min(4);
    }
}

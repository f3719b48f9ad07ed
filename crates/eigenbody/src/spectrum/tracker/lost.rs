//! An end that was lost is found again.

use super::super::rayleigh::normalise;
use super::end::{CERTIFIED, MARGIN, outwards};
use super::{ROUNDS, Reading, Tracker};
use crate::scalar::Array;

/// Residual, against the eigenvalue, at which iteration stops where nothing is known of σ's place.
const RESIDUAL: f64 = 1e-12;
/// Sweeps after which a bracket is as short as numbers allow, whatever it was: 280 decades, then 53 bits, by thirds.
const SWEEPS: usize = 60;
/// Relative width of a bracket at which inverse iteration is tried, and to which it is shortened where that fails.
const SHORT: f64 = 0.1;
/// Relative width at which a bracket is as good as the numbers in it.
const WIDTH: f64 = 2.0 * f64::EPSILON;
/// How far from the edges of a bracket, relative to its size, a value lies inside of it for certain.
const EDGE: f64 = 1e-12;
/// Rounds of inverse iteration at one shift.
const SEEKING: usize = 3;
/// How far, relative to the value that was followed instead, an end is looked for beside it.
const BESIDE: f64 = 0.1;
/// Eigenvalues below this are not told from zero.
const SMALLEST: f64 = 1e-280;

impl Tracker<'_> {
    /// Finds an end: where another mode was followed there, as after a crossing, beside that mode's value; else anywhere.
    pub(super) fn find_again(&mut self, which: usize, followed: Option<f64>) -> Reading {
        let (next_to, spent) = match followed {
            Some(value) => self.beside(which, value),
            None => (None, 0),
        };
        let (found, sweeps) = next_to.map_or_else(|| self.search(which), |found| (found, 0));
        let Self { y, x, before, ends, .. } = self;
        for ((x, before), y) in x.iter_mut().zip(before).zip(&*y) {
            (x.0[which], before[0].0[which]) = (y.0[which], y.0[which]);
        }
        let (value, residual) = found;
        ends[which].known = 0;
        ends[which].settle(value);
        Reading { value, residual, factorisations: 2 * (spent + sweeps), restarted: true }
    }

    /// The eigenvalue next to `value` with its residual, if a count just outside of it says that it is the end; and the sweeps spent.
    fn beside(&mut self, which: usize, value: f64) -> (Option<(f64, f64)>, usize) {
        let (near, far) = (value * outwards(which, EDGE), value * outwards(which, BESIDE));
        let bracket = Bracket { lo: near.min(far), hi: near.max(far), below: (0, 0) };
        let (found, rounds) = self.settle_inside(which, value * outwards(which, MARGIN.0), &bracket, true);
        let Some((next, _)) = found else { return (None, rounds) };
        let is_end = self.is_last(which, next);
        (found.filter(|_| is_end), rounds + 1)
    }

    /// Whether no eigenvalue lies beyond this one.
    fn is_last(&mut self, which: usize, value: f64) -> bool {
        self.factors.factor(&self.pencil, Array([value * outwards(which, CERTIFIED); 2]));
        self.factors.below.0[which] as usize == self.ends[which].index + which
    }

    /// Bisection and inverse iteration, the last value the first guess: eigenvalue, residual, and sweeps.
    fn search(&mut self, which: usize) -> ((f64, f64), usize) {
        let (index, guess) = (self.ends[which].index, self.ends[which].values[0]);
        let mut bracket = self.bounds(which);
        let mut sweeps = 0;
        let mut width = SHORT;
        loop {
            if !self.shorten(&mut bracket, index, guess, width, &mut sweeps) {
                return ((0.0, 0.0), sweeps);
            }
            let (found, rounds) = self.settle_inside(which, bracket.middle(), &bracket, false);
            sweeps += rounds;
            let is_point = bracket.width() <= WIDTH || sweeps >= SWEEPS;
            match found {
                Some(found) => return (found, sweeps),
                None if is_point => return ((bracket.middle(), bracket.width() * bracket.middle()), sweeps),
                None => width = (width * 1e-3).max(WIDTH),
            }
        }
    }

    /// A bracket that holds for certain: λmin in (0, min H_dd/B_d], λmax in [max H_dd/B_d, Σ H_dd/B_d].
    fn bounds(&mut self, which: usize) -> Bracket {
        let diagonal = self.diagonal.update(&self.pencil);
        let [min, max, sum] = self.pencil.ratios(diagonal);
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

    /// Inverse iteration: eigenvalue and residual if it settles inside of the bracket, and the rounds it took. It starts at `shift`; for its
    /// first rounds, if asked to, without the found mode.
    fn settle_inside(
        &mut self,
        which: usize,
        mut shift: f64,
        bracket: &Bracket,
        without: bool,
    ) -> (Option<(f64, f64)>, usize) {
        let Self { pencil, factors, x, y, start, x_lane, .. } = self;
        let B = pencil.metric();
        y.iter_mut().zip(&*start).for_each(|(y, &x)| *y = Array([x; 2]));
        for round in 1..=ROUNDS + SEEKING {
            // A few rounds at one shift make the nearest mode stand out; from then on the shift follows.
            if round == 1 || round > SEEKING {
                factors.factor(pencil, Array([shift; 2]));
            }
            if without && round <= SEEKING {
                let part = sum(y.iter().zip(&*x).zip(B), |((y, x), b)| y.0[which] * x.0[which] * b);
                y.iter_mut().zip(&*x).for_each(|(y, x)| *y -= Array([part * x.0[which]; 2]));
            }
            normalise(y, B);
            x_lane.iter_mut().zip(&*y).for_each(|(x, y)| *x = y.0[which]);
            y.iter_mut().zip(B).for_each(|(y, &b)| *y *= Array([b; 2]));
            factors.solve(pencil, y);
            let energy = factors.energy(pencil, y).0[which];
            let growth = normalise(y, B)[which];
            let c = sum(y.iter().zip(&*x_lane).zip(B), |((y, x), b)| y.0[which] * x * b);
            let value = energy / (growth * growth);
            let residual = (1.0 - c * c).max(0.0).sqrt() / growth;
            if !value.is_finite() {
                return (None, round);
            }
            let seeking = if without { SEEKING } else { 1 };
            if round > seeking && residual <= RESIDUAL * value.abs() {
                // An edge may be an eigenvalue itself, and then not the one that is meant: one that stays the same in every
                // configuration is the first guess again.
                let edge = residual + EDGE * value.abs();
                let is_inside = value > bracket.lo + edge && value < bracket.hi - edge;
                return (is_inside.then_some((value, residual)), round);
            }
            if round >= SEEKING {
                shift = value;
            }
        }
        (None, ROUNDS + SEEKING)
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

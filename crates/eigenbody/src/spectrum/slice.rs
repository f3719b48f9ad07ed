//! All eigenvalues by slicing: every shift serves all of them, and eight of any eigenvalues share a pass.
//!
//! ```text
//! points = a coarse grid, with counts
//! each round, for every slice [lo, hi] between neighbouring points that is not yet narrow:
//!     c > 1 eigenvalues inside    c − 1 shifts in equal steps, of log σ while hi/lo > 2
//!     one inside                  two shifts around the interpolated zero of det(H − σB); wider around it after a miss
//! all shifts of a round are counted eight at a time, in parallel, and join the points
//! ```
//! What a round offers depends on the points alone, so that results do not depend on the number of threads.

use super::bisect::{Bracket, around, zero_between};
use super::sturm::{Count, Pencil, counts};
use crate::scalar::LANES;
use rayon::prelude::*;
use std::ops::Range;

/// More rounds than any spectrum has needed; a guard, not a budget.
const MAX_ROUNDS: usize = 200;
/// Relative width at which a slice is as good as the counts at its ends: a few ulps, within which counts are noisy.
const WIDTH: f64 = 32.0 * f64::EPSILON;
/// log|det| is rounded: a zero is not known better than to this part of its slice.
const BLUR: f64 = 1e-9;
/// Estimated errors of interpolated zeros are taken so many times.
const CAUTION: f64 = 3.0;
/// How fast the search widens where the interpolation missed.
const WIDER: f64 = 16.0;
/// Points beside a slice, without another eigenvalue in between, from which on interpolation pays.
const COMPANY: usize = 2;
/// Neighbours on either side whose poles are taken out before interpolating.
const NEIGHBOURS: usize = 4;
/// Passes times bodies below which a round is not worth sharing among threads.
const WORTH_SHARING: usize = 4000;

/// All eigenvalues of a pencil, ascending. An eigenvalue that cannot be told from zero is given as zero.
///
/// Cost: typically 1.2 passes of O(N) an eigenvalue, shared among all threads; allocates. Numerics: mostly as accurate as
/// [`extremes`](super::extremes) without double-double; to √ε·λmax inside the spectrum where a branch has the same eigenvalue for itself, as
/// limbs that are alike do, and in the unit-diagonal metric every tip at λ = 1. Of an H beyond the range of f64, which
/// `extremes` refuses, the values mean nothing.
///
/// ```
/// use eigenbody::spectrum::{slice, sturm::Pencil};
/// use eigenbody::{Family, Model};
/// let ring: Model<f64> = Family::onion(5, 1.0, 0.0, 1.0)?.model()?;
/// let values = slice(&Pencil::euclidean(&ring, &[0.0; 5], false)?);
/// // 1/(4 sin²(9π/22))
/// assert!((values[0] - 0.27155).abs() < 1e-5 && values.len() == 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn slice(pencil: &Pencil<'_, f64>) -> Vec<f64> {
    let mut slices = Slices::new(pencil);
    for _ in 0..MAX_ROUNDS {
        let shifts = slices.offer();
        if shifts.is_empty() {
            break;
        }
        slices.learn(&all_counts(pencil, &shifts));
    }
    slices.values()
}

/// What is known of the spectrum.
struct Slices {
    /// By ascending shift; counts ascend with it.
    points: Vec<Count>,
    /// For each eigenvalue, what the last interpolation told.
    aims: Vec<Aim>,
}

/// Where an eigenvalue was last expected.
#[derive(Clone, Copy)]
struct Aim {
    from: f64,
    to: f64,
}

impl Aim {
    /// Expected anywhere.
    const NONE: Self = Self { from: 0.0, to: f64::INFINITY };

    fn is_missed_by(&self, bracket: Bracket) -> bool {
        bracket.hi.shift <= self.from || bracket.lo.shift >= self.to
    }

    /// After a miss: ever wider, away from where it was expected; in equal steps once that is no narrower.
    fn widen(&mut self, bracket: Bracket, shifts: &mut [f64]) {
        let (lo, hi) = (bracket.lo.shift, bracket.hi.shift);
        let is_below = hi <= self.from;
        let mut step = self.to - self.from;
        if step * WIDER.powi(shifts.len() as i32) > 0.3 * bracket.width() {
            *self = Self::NONE;
            bracket.equal_steps(shifts);
            return;
        }
        for shift in shifts {
            step *= WIDER;
            *shift = if is_below { hi - step } else { lo + step };
        }
        *self = if is_below { Self { from: hi - step, to: hi } } else { Self { from: lo, to: lo + step } };
    }
}

impl Slices {
    fn new(pencil: &Pencil<'_, f64>) -> Self {
        let n = pencil.len();
        let mut slices = Self { points: Vec::new(), aims: vec![Aim::NONE; n] };
        if n > 0 {
            let (lower, upper) = bounds(pencil);
            let steps = (n / 8).next_multiple_of(LANES).max(LANES);
            let step = |k: usize| lower * (upper / lower).powf(k as f64 / (steps - 2) as f64);
            let mut grid: Vec<f64> = (0..steps - 1).map(step).collect();
            grid.push(0.0);
            slices.learn(&all_counts(pencil, &grid));
        }
        slices
    }

    /// Takes note of counts, in agreement with what is known.
    ///
    /// Counts ascend with the shift, but for rounding: within some hundred ulps of an eigenvalue of high multiplicity they may be
    /// wrong by several. Such shifts come late, when a slice is narrow. So the first come are believed.
    fn learn(&mut self, counts: &[Count]) {
        let known = self.points.clone();
        for &count in counts {
            let at = known.partition_point(|point| point.shift < count.shift);
            let least = at.checked_sub(1).map_or(0, |before| known[before].below);
            let most = known.get(at).map_or(self.aims.len(), |after| after.below);
            self.points.push(Count { below: count.below.clamp(least, most), ..count });
        }
        // Stable: of two at one shift, the first come stays.
        self.points.sort_by(|a, b| a.shift.total_cmp(&b.shift));
        self.points.dedup_by_key(|point| point.shift);
        let mut below = 0;
        for point in &mut self.points {
            below = below.max(point.below);
            point.below = below;
        }
    }

    /// The slices that hold eigenvalues, ascending: place of the upper end among the points, and the eigenvalues' indices.
    fn occupied(&self) -> impl Iterator<Item = (usize, Range<usize>)> + '_ {
        let mut below = 0;
        self.points.iter().enumerate().filter_map(move |(at, point)| {
            let inside = below..point.below;
            below = point.below;
            (!inside.is_empty()).then_some((at, inside))
        })
    }

    /// The shifts of the next round; none once all slices are narrow.
    fn offer(&mut self) -> Vec<f64> {
        let wide: Vec<_> = self
            .occupied()
            .filter_map(|(at, inside)| Some((at, inside, self.bracket(at)?)))
            .filter(|(.., bracket)| !bracket.is_narrow(WIDTH))
            .collect();
        let values = self.values();
        // While few slices are left, they share the lanes of a pass.
        let least = (LANES / wide.len().max(1)).max(2);
        let mut shifts = Vec::new();
        for (at, inside, bracket) in wide {
            let first = shifts.len();
            if inside.len() > 1 {
                shifts.resize(first + (inside.len() - 1).max(least - 1), 0.0);
                bracket.equal_steps(&mut shifts[first..]);
                continue;
            }
            shifts.resize(first + least, 0.0);
            let shifts = &mut shifts[first..];
            let aim = &mut self.aims[inside.start];
            if aim.is_missed_by(bracket) {
                aim.widen(bracket, shifts);
            } else if !has_company(&self.points, at) {
                bracket.equal_steps(shifts);
            } else {
                let nodes = deflated_nodes(&self.points, at, inside.start, &values);
                let (zero, error) = zero_between(&nodes, bracket);
                let least = (BLUR * bracket.width()).max(0.45 * WIDTH * bracket.hi.shift);
                let error = (CAUTION * error).max(least).min(0.1 * bracket.width());
                *aim = Aim { from: zero - error, to: zero + error };
                around(zero, error, bracket, shifts);
            }
        }
        shifts
    }

    /// The slice below a point; none where nothing is known below it, or only zero.
    fn bracket(&self, at: usize) -> Option<Bracket> {
        let lo = *self.points.get(at.checked_sub(1)?)?;
        (lo.shift > 0.0).then_some(Bracket { lo, hi: self.points[at] })
    }

    fn values(&self) -> Vec<f64> {
        let mut values = vec![0.0; self.aims.len()];
        for (at, inside) in self.occupied() {
            let Some(bracket) = self.bracket(at) else { continue };
            let part = bracket.width() / inside.len() as f64;
            for (k, value) in values[inside].iter_mut().enumerate() {
                *value = bracket.lo.shift + (k as f64 + 0.5) * part;
            }
        }
        values
    }
}

/// Whether enough points stand beside the slice below `points[at]`, without another eigenvalue in between, to interpolate.
fn has_company(points: &[Count], at: usize) -> bool {
    let left = points[..at - 1].iter().rev().take(2).filter(|point| point.below == points[at - 1].below);
    let right = points[at + 1..].iter().take(2).filter(|point| point.below == points[at].below);
    left.count() + right.count() >= COMPANY
}

/// The ends of the slice below `points[at]` and up to four points beside them, the nearest first; from their log|det| is taken
/// what the neighbours of eigenvalue `index` make of it where they are now believed to lie.
fn deflated_nodes(points: &[Count], at: usize, index: usize, values: &[f64]) -> Vec<Count> {
    let (lo, hi) = (points[at - 1].shift, points[at].shift);
    let near = index.saturating_sub(NEIGHBOURS)..(index + 1 + NEIGHBOURS).min(values.len());
    let beside = at.saturating_sub(3)..(at + 3).min(points.len());
    let is_near = |point: &Count| point.shift > 0.0 && near.start <= point.below && point.below <= near.end;
    let mut nodes: Vec<Count> = points[beside].iter().filter(|point| is_near(point)).copied().collect();
    let distance = |node: &Count| (lo - node.shift).max(node.shift - hi);
    nodes.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    let (lower, upper) = (&values[near.start..index], &values[index + 1..near.end]);
    for node in &mut nodes {
        let product = |values: &[f64]| {
            values.iter().fold(1.0, |product, value| product * ((node.shift - value) / (hi - lo)))
        };
        node.log2_det -= product(lower).abs().log2() + product(upper).abs().log2();
    }
    nodes
}

/// Counts at any number of shifts.
fn all_counts(pencil: &Pencil<'_, f64>, shifts: &[f64]) -> Vec<Count> {
    let pass = |shifts: &[f64]| {
        let mut lanes = [shifts[0]; LANES];
        lanes[..shifts.len()].copy_from_slice(shifts);
        counts(pencil, lanes)
    };
    if shifts.len() / LANES * pencil.len() < WORTH_SHARING {
        shifts.chunks(LANES).flat_map(pass).collect()
    } else {
        shifts.par_chunks(LANES).flat_map_iter(pass).collect()
    }
}

/// Numbers outside of which no eigenvalue lies, the lower one by counting.
fn bounds(pencil: &Pencil<'_, f64>) -> (f64, f64) {
    let diagonal = pencil.diagonal();
    let [least, _, trace] = pencil.ratios(&diagonal);
    // Twice the trace: cancellation in the diagonal of H* does not matter.
    let upper = 2.0 * trace;
    let mut lower = least.max(upper * f64::MIN_POSITIVE);
    for _ in 0..16 {
        let found = counts(pencil, std::array::from_fn(|k| lower * 0.1f64.powi(2 * k as i32)));
        lower *= 1e-14;
        if let Some(clear) = found.iter().find(|count| count.below == 0) {
            return (clear.shift, upper);
        }
    }
    (lower, upper)
}

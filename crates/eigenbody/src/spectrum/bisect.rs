//! One eigenvalue by its place in the spectrum: brackets that move by counts alone.
//!
//! ```text
//! bracket of eigenvalue k:   hi = min { σ : count(σ) > k },   lo = max { σ < hi : count(σ) ≤ k }
//! each pass offers new shifts between lo and hi:
//!     several eigenvalues inside     equal steps, of log σ while hi/lo > 2
//!     several, at the lower end      counts near the end of a spectrum grow as √(σ − λ₀): shifts around that λ₀
//!     one inside                     det(H − σB) changes sign once: interpolate it through the bracket's ends and their
//!                                    neighbours, and set shifts tightly around the zero
//!     a pass that shrank the bracket less than threefold is followed by one of equal steps
//! ```
//! Counts are exact for a matrix within rounding of the true one, so two shifts closer than that may count in the wrong order:
//! the definition above takes the innermost bracket that is consistent, whatever the order in which shifts were tried.

use super::sturm::Count;

/// Relative width at which a bracket is as good as the numbers in it.
const WIDTH: f64 = 2.0 * f64::EPSILON;

/// Eigenvalues below this are not told from zero.
const SMALLEST: f64 = 1e-280;

/// The search for eigenvalue `index`, 0 the smallest.
#[derive(Debug, Clone)]
pub(super) struct Search {
    index: usize,
    /// All that was counted, by ascending shift.
    points: Vec<Count>,
    /// Ratio of the bracket's width to its width before the last pass.
    shrink: f64,
}

/// Where the eigenvalue lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bracket {
    pub lo: Count,
    pub hi: Count,
}

impl Bracket {
    pub fn width(&self) -> f64 {
        self.hi.shift - self.lo.shift
    }
    pub fn middle(&self) -> f64 {
        self.lo.shift + 0.5 * self.width()
    }
    fn is_isolated(&self) -> bool {
        self.hi.below == self.lo.below + 1
    }
    /// As narrow, relative to the numbers in it, as `width`, or with no number in between.
    pub fn is_narrow(&self, width: f64) -> bool {
        let middle = self.middle();
        self.width() <= width * self.hi.shift.abs() || middle <= self.lo.shift || middle >= self.hi.shift
    }
    /// Shifts in equal steps, of log σ while hi/lo > 2.
    pub fn equal_steps(&self, shifts: &mut [f64]) {
        let (lo, hi) = (self.lo.shift, self.hi.shift);
        let steps = shifts.len() as f64 + 1.0;
        for (k, shift) in (1..).zip(shifts.iter_mut()) {
            let part = f64::from(k) / steps;
            *shift = if hi / lo > 2.0 { lo * (hi / lo).powf(part) } else { lo + part * (hi - lo) };
        }
    }
}

impl Search {
    pub fn new(index: usize) -> Self {
        Self { index, points: Vec::new(), shrink: 0.0 }
    }

    /// Takes note of counts. All eigenvalues of a positive definite pencil lie above σ = 0.
    pub fn learn(&mut self, counts: &[Count]) {
        let before = self.bracket().map(|bracket| bracket.width());
        for &count in counts {
            let at = self.points.partition_point(|point| point.shift < count.shift);
            if self.points.get(at).is_none_or(|point| point.shift != count.shift) {
                self.points.insert(at, count);
            }
        }
        if let (Some(before), Some(after)) = (before, self.bracket()) {
            self.shrink = after.width() / before;
        }
    }

    fn bracket(&self) -> Option<Bracket> {
        let above = self.points.iter().position(|point| point.below > self.index)?;
        let lo = self.points[..above].last()?;
        Some(Bracket { lo: *lo, hi: self.points[above] })
    }

    /// True once another pass would tell no more.
    pub fn is_settled(&self) -> bool {
        self.is_lost() || self.bracket().is_some_and(|bracket| bracket.is_narrow(WIDTH))
    }

    /// The eigenvalue as it stands; none if it cannot be told from zero.
    pub fn value(&self) -> Option<f64> {
        if self.is_lost() { None } else { self.bracket().map(|bracket| bracket.middle()) }
    }

    /// How far other eigenvalues are from a value, by what was counted: at least so much.
    pub fn gap(&self, value: f64) -> f64 {
        let up = self.points.iter().rfind(|point| point.below == self.index + 1);
        let down = self.points.iter().find(|point| point.below == self.index);
        let distance = |point: Option<&Count>| point.map_or(0.0, |point| (point.shift - value).abs());
        distance(up).min(distance(down))
    }

    /// Counts do not find the eigenvalue above zero, or above what f64 can hold.
    fn is_lost(&self) -> bool {
        self.points.first().is_some_and(|point| point.below > self.index)
            || self.bracket().is_some_and(|bracket| bracket.lo.shift == 0.0 && bracket.hi.shift < SMALLEST)
    }

    /// Shifts for the next pass, strictly inside the bracket.
    pub fn offer(&self, shifts: &mut [f64]) {
        let Some(bracket) = self.bracket() else { return };
        let (lo, hi) = (bracket.lo.shift, bracket.hi.shift);
        if lo == 0.0 {
            // No positive lower bound yet: ever larger steps down.
            for (k, shift) in shifts.iter_mut().enumerate() {
                *shift = hi * 0.1f64.powi(1 << k.min(6));
            }
        } else if self.shrink < 1.0 / 3.0 && bracket.is_isolated() {
            self.around_zero(bracket, shifts);
        } else if let (true, Some((edge, error))) =
            (hi / lo < 2.0 && self.shrink < 1.0 / 3.0, self.edge(bracket))
        {
            around(edge, error, bracket, shifts);
        } else {
            bracket.equal_steps(shifts);
        }
    }

    /// Shifts around the interpolated zero of det(H − σB).
    fn around_zero(&self, bracket: Bracket, shifts: &mut [f64]) {
        let at = self.points.partition_point(|point| point.shift < bracket.hi.shift);
        let (zero, error) = zero_between(&nodes(&self.points, at), bracket);
        let error = error.max(0.5 * WIDTH * bracket.hi.shift).min(0.1 * bracket.width());
        around(zero, error, bracket, shifts);
    }

    /// Where the spectrum begins, if σ_c = λ₀ + a c² as at the edge of a band, and how far that may be off.
    fn edge(&self, bracket: Bracket) -> Option<(f64, f64)> {
        if self.index > 0 {
            return None;
        }
        // The c-th eigenvalue lies below σ and the next one above: σ stands for c + ½ half-steps.
        let square = |point: &Count| (point.below as f64).powi(2);
        let further = self.points.iter().find(|point| point.below > 2 * bracket.hi.below)?;
        let (c1, c2) = (square(&bracket.hi), square(further));
        let edge = (bracket.hi.shift * c2 - further.shift * c1) / (c2 - c1);
        let inside = edge > bracket.lo.shift && edge < bracket.hi.shift;
        // Half a count in c, doubled in c².
        let error = (bracket.hi.shift - edge) / bracket.hi.below as f64;
        inside.then_some((edge, error))
    }
}

/// The two ends of a bracket, the upper one at `at` in `points`, and up to four points beside them, the nearest first, without
/// another eigenvalue in between.
pub(super) fn nodes(points: &[Count], at: usize) -> Vec<Count> {
    let (lo, hi) = (points[at - 1], points[at]);
    let left = points[..at - 1].iter().rev().take_while(|point| point.below == lo.below).take(2);
    let right = points[at + 1..].iter().take_while(|point| point.below == hi.below).take(2);
    let mut beside: Vec<&Count> = left.chain(right).collect();
    let distance = |point: &Count| (lo.shift - point.shift).max(point.shift - hi.shift);
    beside.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    [lo, hi].into_iter().chain(beside.into_iter().copied()).collect()
}

/// Shifts on both sides of a guess: at its estimated error, and at geometric steps from there to the bracket's width.
pub(super) fn around(guess: f64, error: f64, bracket: Bracket, shifts: &mut [f64]) {
    let (lo, hi) = (bracket.lo.shift, bracket.hi.shift);
    let pairs = (shifts.len() / 2).max(1);
    let ratio = (bracket.width() / error).powf(1.0 / pairs as f64);
    let mut step = error;
    for pair in shifts.chunks_mut(2) {
        for (shift, offset) in pair.iter_mut().zip([-step, step]) {
            let at = guess + offset;
            *shift = if at > lo && at < hi { at } else { bracket.middle() };
        }
        step *= ratio;
    }
}

/// The interpolated zero of det(H − σB) in a bracket, and how far that may be off.
pub(super) fn zero_between(nodes: &[Count], bracket: Bracket) -> (f64, f64) {
    let zero = interpolated_zero(nodes, bracket);
    let coarser = interpolated_zero(&nodes[..nodes.len() - 1], bracket);
    (zero, 2.0 * (zero - coarser).abs())
}

/// The zero λ of det(H − σB) in the bracket for which log|det| − log|σ − λ| is a polynomial of the lowest degree at the nodes.
///
/// That is where the highest divided difference vanishes. At the bracket's ends log|σ − λ| has poles, and the weights of two
/// neighbouring nodes have opposite signs: there is a change of sign between. In y = log(x/(1 − x)) the poles become straight
/// lines, and Newton's method needs few steps.
fn interpolated_zero(nodes: &[Count], Bracket { lo, hi }: Bracket) -> f64 {
    let width = hi.shift - lo.shift;
    let t: Vec<f64> = nodes.iter().map(|node| (node.shift - lo.shift) / width).collect();
    let weight = |j: usize| (0..t.len()).filter(|&k| k != j).fold(1.0, |w, k| w / (t[j] - t[k]));
    let weights: Vec<f64> = (0..t.len()).map(weight).collect();
    let det: f64 = (0..t.len()).map(|j| weights[j] * (nodes[j].log2_det - nodes[0].log2_det)).sum();
    let det = det * std::f64::consts::LN_2;
    // Negative where the pole at lo, of weight w, pulls −w log|x| up.
    let sign = -weights[0].signum();
    let (mut a, mut b) = (0.0, 1.0);
    let mut x: f64 = 0.5;
    for _ in 0..60 {
        let (mut value, mut slope) = (det, 0.0);
        for (t, w) in t.iter().zip(&weights) {
            value -= w * (x - t).abs().ln();
            slope -= w / (x - t);
        }
        if value * sign < 0.0 {
            a = x;
        } else {
            b = x;
        }
        let step = value / (slope * x * (1.0 - x));
        // y ← y − step, in terms of x.
        let grown = (x / (1.0 - x)) * (-step).exp();
        let next = grown / (1.0 + grown);
        let next = if next > a && next < b { next } else { 0.5 * (a + b) };
        if (next - x).abs() <= 1e-12 * x.min(1.0 - x) {
            x = next;
            break;
        }
        x = next;
    }
    lo.shift + x * width
}

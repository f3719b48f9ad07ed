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
struct Bracket {
    lo: Count,
    hi: Count,
}

impl Bracket {
    fn width(&self) -> f64 {
        self.hi.shift - self.lo.shift
    }
    fn middle(&self) -> f64 {
        self.lo.shift + 0.5 * self.width()
    }
    fn is_isolated(&self) -> bool {
        self.hi.below == self.lo.below + 1
    }
    /// As narrow as the numbers in it, or with no number in between.
    fn is_narrow(&self) -> bool {
        let middle = self.middle();
        self.width() <= WIDTH * self.hi.shift.abs() || middle <= self.lo.shift || middle >= self.hi.shift
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
        self.is_lost() || self.bracket().is_some_and(|bracket| bracket.is_narrow())
    }

    /// The eigenvalue as it stands; none if it cannot be told from zero.
    pub fn value(&self) -> Option<f64> {
        if self.is_lost() { None } else { self.bracket().map(|bracket| bracket.middle()) }
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
        } else if hi / lo < 2.0 && self.shrink < 1.0 / 3.0 && bracket.is_isolated() {
            self.around_zero(bracket, shifts);
        } else if let (true, Some((edge, error))) = (self.shrink < 1.0 / 3.0, self.edge(bracket)) {
            around(edge, error, bracket, shifts);
        } else {
            let steps = shifts.len() as f64 + 1.0;
            for (k, shift) in (1..).zip(shifts.iter_mut()) {
                let part = f64::from(k) / steps;
                *shift = if hi / lo > 2.0 { lo * (hi / lo).powf(part) } else { lo + part * (hi - lo) };
            }
        }
    }

    /// Shifts around the interpolated zero: at its estimated error and at geometric steps from there to the bracket's width.
    fn around_zero(&self, bracket: Bracket, shifts: &mut [f64]) {
        let (lo, hi) = (bracket.lo.shift, bracket.hi.shift);
        let at = self.points.partition_point(|point| point.shift < lo);
        // Both ends first, then neighbours further out, nearer ones first.
        let mut nodes = vec![bracket.lo, bracket.hi];
        let outer = [at.checked_sub(1), Some(at + 2), at.checked_sub(2), Some(at + 3)];
        nodes.extend(outer.into_iter().flatten().filter_map(|i| self.points.get(i)));
        nodes.truncate(5);
        let zero = interpolated_zero(&nodes);
        let coarser = interpolated_zero(&nodes[..nodes.len() - 1]);
        let error = (2.0 * (zero - coarser).abs()).max(0.5 * WIDTH * hi).min(0.1 * (hi - lo));
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

/// Shifts on both sides of a guess: at its estimated error, and at geometric steps from there to the bracket's width.
fn around(guess: f64, error: f64, bracket: Bracket, shifts: &mut [f64]) {
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

/// The zero, between the first two nodes, of the polynomial through det(H − σB) at all nodes.
fn interpolated_zero(nodes: &[Count]) -> f64 {
    let (lo, hi) = (nodes[0].shift, nodes[1].shift);
    // Newton's divided differences in t = (σ − lo)/(hi − lo), determinants relative to the first one.
    let t: Vec<f64> = nodes.iter().map(|node| (node.shift - lo) / (hi - lo)).collect();
    let mut table: Vec<f64> = nodes
        .iter()
        .map(|node| {
            let sign = if (node.below + nodes[0].below) % 2 == 0 { 1.0 } else { -1.0 };
            sign * (node.log2_det - nodes[0].log2_det).clamp(-900.0, 900.0).exp2()
        })
        .collect();
    let n = nodes.len();
    for level in 1..n {
        for i in (level..n).rev() {
            table[i] = (table[i] - table[i - 1]) / (t[i] - t[i - level]);
        }
    }
    let value = |x: f64| (0..n).rev().fold(0.0, |sum, i| sum * (x - t[i]) + table[i]);
    // The values at 0 and 1 have opposite signs: the nodes are there.
    let (mut a, mut b) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if value(middle) > 0.0 { a = middle } else { b = middle }
    }
    lo + 0.5 * (a + b) * (hi - lo)
}

//! All eigenvalues by slicing: brackets shared, then each one bisected on its own.
//!
//! ```text
//! count at geometrically spaced shifts; split the widest slices until every slice holds one eigenvalue or is too narrow to split
//! then each eigenvalue by the search of `bisect`, starting from its slice
//! ```

use super::bisect::Search;
use super::sturm::{Count, Pencil, counts};
use crate::scalar::LANES;

/// More passes for one eigenvalue than any has needed; a guard, not a budget.
const MAX_PASSES: usize = 60;

/// All eigenvalues of a pencil, ascending. An eigenvalue that cannot be told from zero is given as zero.
///
/// Cost about 7 passes of O(N) an eigenvalue; allocates. Numerics: each as accurate as [`extremes`](super::extremes) without
/// double-double.
pub fn slice(pencil: &Pencil<f64>) -> Vec<f64> {
    let mut points: Vec<Count> = Vec::new();
    let n = pencil.len();
    let (lower, upper) = bounds(pencil);
    // A first grid: a few points an eigenvalue, in equal steps of log σ.
    let grid: Vec<f64> = (0..n.next_multiple_of(LANES))
        .map(|k| lower * (upper / lower).powf(k as f64 / (n.next_multiple_of(LANES) - 1).max(1) as f64))
        .collect();
    learn(&mut points, &counts(pencil, [0.0; LANES])[..1]);
    for shifts in grid.chunks_exact(LANES) {
        let mut eight = [0.0; LANES];
        eight.copy_from_slice(shifts);
        learn(&mut points, &counts(pencil, eight));
    }
    (0..n).map(|index| one(pencil, index, &mut points)).collect()
}

/// Eigenvalue `index`, starting from what is known; what it learns serves the next ones.
fn one(pencil: &Pencil<f64>, index: usize, points: &mut Vec<Count>) -> f64 {
    let mut search = Search::new(index);
    let above = points.partition_point(|point| point.below <= index);
    let near = above.saturating_sub(3)..(above + 3).min(points.len());
    search.start(&points[near]);
    let mut shifts = [0.0; LANES];
    for _ in 0..MAX_PASSES {
        if search.is_settled() {
            break;
        }
        search.offer(&mut shifts);
        let found = counts(pencil, shifts);
        search.learn(&found);
        learn(points, &found);
    }
    search.value().unwrap_or(0.0)
}

fn learn(points: &mut Vec<Count>, counts: &[Count]) {
    for &count in counts {
        let at = points.partition_point(|point| point.shift < count.shift);
        if points.get(at).is_none_or(|point| point.shift != count.shift) {
            points.insert(at, count);
        }
    }
}

/// Numbers outside of which no eigenvalue lies, the lower one by counting.
fn bounds(pencil: &Pencil<f64>) -> (f64, f64) {
    let diagonal = pencil.diagonal();
    let ratios: Vec<f64> =
        diagonal.iter().zip(pencil.metric()).filter(|(_, b)| **b > 0.0).map(|(h, b)| h / b).collect();
    let upper = ratios.iter().sum::<f64>() * (1.0 + 1e-9);
    let mut lower = ratios.iter().copied().fold(f64::INFINITY, f64::min).max(upper * f64::MIN_POSITIVE);
    for _ in 0..16 {
        let found = counts(pencil, std::array::from_fn(|k| lower * 0.1f64.powi(2 * k as i32)));
        lower *= 1e-14;
        if let Some(clear) = found.iter().find(|count| count.below == 0) {
            return (clear.shift, upper);
        }
    }
    (lower, upper)
}

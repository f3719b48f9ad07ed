mod count;
mod diagonal;
mod growth;
mod pivots;

use super::systems::System;
use eigenbody::scalar::{Dd, LANES, Scalar};
use eigenbody::spectrum::sturm::{Count, Pencil, counts};
use growth::Growth;

/// Counts at any number of shifts. What makes no number is no count.
fn count_all(pencil: &Pencil<'_, f64>, shifts: &[f64]) -> Vec<Count> {
    let mut all: Vec<Count> = Vec::with_capacity(shifts.len());
    for eight in shifts.chunks(LANES) {
        let mut lanes = [1.0; LANES];
        lanes[..eight.len()].copy_from_slice(eight);
        all.extend(&counts(pencil, lanes)[..eight.len()]);
    }
    assert!(all.iter().all(|count| count.log2_det.is_finite()), "{all:?}");
    all
}

/// How many counts have eigenvalues more than 2 ε ‖H‖ away on the wrong side. None may be farther away than rounding takes it: n ε of
/// what the elimination adds up.
fn misplaced(system: &System, pencil: &Pencil<'_, f64>, values: &[Dd], counts: &[Count]) -> usize {
    let n = values.len();
    let two_ulp = 2.0 * f64::EPSILON * values[n - 1].hi();
    let mut growth = None;
    let mut wrong = 0;
    for count in counts {
        let shift = Dd::from_f64(count.shift);
        let below = values.iter().filter(|&&value| value < shift).count();
        let distance = |k: usize| (values[k] - shift).abs().hi();
        let range = below.min(count.below)..below.max(count.below);
        let far: Vec<usize> = range.filter(|&k| distance(k) > two_ulp).collect();
        wrong += usize::from(!far.is_empty());
        for k in far {
            let growth = growth.get_or_insert_with(|| Growth::new(system, pencil));
            let (distance, allowed) = (distance(k), n as f64 * f64::EPSILON * growth.sum(count.shift, k));
            assert!(
                distance <= allowed,
                "{}: {count:?} misplaces {k} by {distance:e}, {allowed:e} allowed",
                system.name
            );
        }
    }
    wrong
}

//! Counts by the signs of pivots against the dense spectrum in double-double.

use super::{count_all, misplaced};
use crate::spectrum::systems::{exact, metrics, systems};
use eigenbody::model::Random;
use eigenbody::scalar::Dd;

/// Between eigenvalues, and outside: log-uniform, halfway between neighbours, negative, zero, and as far as f64 goes.
fn apart(values: &[f64], seed: u64) -> Vec<f64> {
    let (min, max) = (values[0], values[values.len() - 1]);
    let mut random = Random::new(seed);
    let mut shifts: Vec<f64> =
        (0..300).map(|_| 0.5 * min * (4.0 * max / min).powf(random.uniform())).collect();
    shifts.extend(values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
    shifts.extend([0.0, -0.0, -min, -max, 1e300, -1e300, f64::MIN_POSITIVE, 5e-324]);
    shifts
}

/// On eigenvalues and some ulp beside them.
fn beside(values: &[f64]) -> Vec<f64> {
    let ulps = [-512.0, -64.0, -8.0, -4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0, 8.0, 64.0, 512.0];
    values.iter().flat_map(|&value| ulps.map(|k| value * (1.0 + k * f64::EPSILON))).collect()
}

/// Over 100,000 counts away from eigenvalues: none is wrong. Many more on top of eigenvalues: wrong only within rounding.
///
/// Free-floating trees with several branches on the way to the heaviest body were once swept out of order: the sums of one branch
/// went to another, and counts were off by any number.
#[test]
fn counts_are_those_of_the_dense_spectrum() {
    let (mut far, mut near) = (0, 0);
    for (seed, system) in systems(30).iter().enumerate() {
        let H = system.matrix();
        for metric in metrics(system.model.nv()) {
            let pencil = system.pencil_in(&metric);
            let values = exact(&H, &pencil);
            let ascending: Vec<f64> = values.iter().map(|value: &Dd| value.hi()).collect();
            let counts = count_all(&pencil, &apart(&ascending, seed as u64));
            assert_eq!(misplaced(system, &pencil, &values, &counts), 0, "{}: {metric}", system.name);
            far += counts.len();
            let counts = count_all(&pencil, &beside(&ascending));
            misplaced(system, &pencil, &values, &counts);
            near += counts.len();
        }
    }
    assert!(far >= 100_000 && near >= 50_000, "{far} {near}");
}

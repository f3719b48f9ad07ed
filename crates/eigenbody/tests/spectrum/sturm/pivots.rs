//! Pivots that vanish: shifts equal to what a tip body weighs, and eigenvalues that many identical leaves share.

use super::{count_all, misplaced};
use crate::robots::{configuration, plan};
use crate::spectrum::systems::{System, exact};
use eigenbody::model::Random;
use eigenbody::{Base, Family, Metric};

/// Counts at σ = H_dd/B_d of every tip: how many there are, and how many of them are wrong.
fn at_zero_pivots(system: &System, metric: &Metric<f64>) -> (usize, usize) {
    let pencil = system.pencil_in(metric);
    let values = exact(&system.matrix(), &pencil);
    let diagonal = pencil.diagonal();
    let shifts: Vec<f64> = tips(system).into_iter().map(|d| diagonal[d] / pencil.metric()[d]).collect();
    let counts = count_all(&pencil, &shifts);
    (counts.len(), misplaced(system, &pencil, &values, &counts))
}

/// A tip's last column is eliminated first, with the pivot H_dd/B_d − σ, here exactly zero. No count is wrong.
#[test]
fn pivots_of_zero_count_right() {
    let mut zeros = 0;
    for n in 2..=60 {
        let branching = 1.0 + (n % 7) as f64;
        for (skew, taper) in [(0.0, 1.0), (0.5, 0.9), (1.0, 1.125)] {
            let model = Family::hydra(n, branching, skew, taper).unwrap().model::<f64>().unwrap();
            let q = configuration(&model, n as u64);
            let system = System::new(format!("hydra({n}, {branching}, {skew}, {taper})"), model, q, false);
            let (all, wrong) = at_zero_pivots(&system, &Metric::Euclidean);
            assert_eq!(wrong, 0, "{}", system.name);
            zeros += all;
        }
    }
    assert!(zeros > 1000, "{zeros}");
}

/// The same with joints of every kind, and with weights, where the pivot is rounding of zero. What a pivot of 10⁻¹⁴ leaves behind has
/// two digits left for the body's other columns: one count in a thousand may be off.
#[test]
fn pivots_that_are_rounding_count_right() {
    let (mut zeros, mut wrong) = (0, 0);
    for seed in 1..=300 {
        let base = if seed % 3 == 0 { Base::Floating } else { Base::Fixed };
        let model = plan::<f64>(seed, 4 + seed as usize % 24).build(base);
        let (nv, q) = (model.nv(), configuration(&model, seed));
        if nv == 0 {
            continue;
        }
        let system = System::new(format!("random tree {seed}"), model, q, false);
        let mut random = Random::new(seed);
        let weights = (0..nv).map(|_| random.between(0.1, 10.0)).collect();
        for metric in [Metric::Euclidean, Metric::Diagonal(weights)] {
            let found = at_zero_pivots(&system, &metric);
            (zeros, wrong) = (zeros + found.0, wrong + found.1);
        }
    }
    assert!(zeros > 2000 && wrong * 1000 <= zeros, "{wrong} of {zeros}");
}

/// Last DoF of every body that carries none.
fn tips(system: &System) -> Vec<usize> {
    let bodies = system.model.bodies();
    let carries = |i: usize| bodies.iter().any(|body| body.parent() == Some(i));
    (0..bodies.len()).filter(|&i| !carries(i)).map(|i| bodies[i].dofs().end - 1).collect()
}

/// One link with m identical leaves, onion(m+1, m, 0, 1): eigenvalue 1 m − 1 times, and a pair ((m+2) ± √((m+2)² − 4))/2.
#[test]
fn twin_leaves_are_counted_together() {
    for m in 1..=64 {
        let model = Family::onion(m + 1, m as f64, 0.0, 1.0).unwrap().model::<f64>().unwrap();
        let q = configuration(&model, m as u64);
        let system = System::new("twins", model, q, false);
        let pencil = system.pencil();
        let sum = (m + 2) as f64;
        let large = 0.5 * (sum + (sum * sum - 4.0).sqrt());
        // 2 ε ‖H‖, and 4 ε for the closed form
        let slack = 6.0 * f64::EPSILON * large;
        for (value, below, after) in [(1.0 / large, 0, 1), (1.0, 1, m), (large, m, m + 1)] {
            let found = count_all(&pencil, &[value - slack, value + slack, value]);
            assert_eq!((found[0].below, found[1].below), (below, after), "{m} leaves, λ = {value}");
            assert!((below..=after).contains(&found[2].below), "{m} leaves: {:?}", found[2]);
        }
    }
}

/// Trees of identical links have clusters of every size: counts beside each are right.
#[test]
fn clusters_are_counted_together() {
    for (n, branching) in [(21, 4.0), (40, 3.0), (57, 7.0), (63, 2.0), (66, 1.5), (66, 64.0)] {
        let model = Family::onion(n, branching, 0.0, 1.0).unwrap().model::<f64>().unwrap();
        let system = System::new(format!("onion({n}, {branching})"), model, vec![0.0; n], false);
        let (pencil, values) = (system.pencil(), exact(&system.matrix(), &system.pencil()));
        // 2, 4 .. ε ‖H‖ beside
        let ulp = f64::EPSILON * values[n - 1].hi();
        for value in &values {
            let shifts = [-64.0, -4.0, -2.0, 0.0, 2.0, 4.0, 64.0].map(|k| value.hi() + k * ulp);
            misplaced(&system, &pencil, &values, &count_all(&pencil, &shifts));
        }
    }
}

//! What f64 loses: the same numbers, computed in double-double.

use crate::robots::{Case, cases};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::{Family, mass_matrix};

/// |δH_de| ≤ c·depth·ε·√(H_dd H_ee): largest c over the robot's entries.
fn constant(case: &Case<f64>) -> f64 {
    let H = mass_matrix(&case.model, &case.q).unwrap();
    let q: Vec<Dd> = case.q.iter().map(|&q| Dd::from_f64(q)).collect();
    let exact = mass_matrix(&case.model.cast::<Dd>(), &q).unwrap();
    let tree = case.model.dofs();
    let depth = (0..case.nv()).map(|d| 1 + tree.ancestors(d).count()).max().unwrap_or(0) as f64;
    let mut c = 0.0f64;
    for d in 0..case.nv() {
        for e in 0..case.nv() {
            let error = (Dd::from_f64(H[(d, e)]) - exact[(d, e)]).abs().to_f64();
            c = c.max(error / (depth * f64::EPSILON * (H[(d, d)] * H[(e, e)]).sqrt()));
        }
    }
    c
}

#[test]
fn entries_are_good_to_the_geometric_mean_of_their_diagonal() {
    for case in cases::<f64>(60) {
        let c = constant(&case);
        assert!(c <= 2.0, "{}: c = {c}", case.name);
    }
    for taper in [0.7, 1.0, 1.3] {
        let model = Family::hydra(40, 1.0, 0.2, taper).unwrap().model::<f64>().unwrap();
        let c = constant(&Case::new(String::new(), model, 1));
        assert!(c <= 2.0, "taper {taper}: c = {c}");
    }
}

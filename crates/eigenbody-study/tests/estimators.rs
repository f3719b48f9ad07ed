use eigenbody::{Family, Matrix, mass_matrix};
use eigenbody_study::estimators::{correlation, estimates, median, pivot_ratio};
use eigenbody_study::{Lab, select};

/// The product of the pivots is the determinant: here the pivots are 4, 3, 2, from L D Lᵀ by hand. Exact in binary.
#[test]
fn pivots_of_a_known_elimination() {
    let L = [[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, 2.0, 1.0]];
    let D = [4.0, 3.0, 2.0];
    let H = Matrix::from_fn(3, 3, |i, j| (0..3).map(|k| L[i][k] * D[k] * L[j][k]).sum());
    assert_eq!(pivot_ratio(&H), 2.0);
}

/// r ≤ κ ≤ r κ′ to n ε κ′ of rounding, in random configurations of trees with every kind of joint.
#[test]
fn the_bracket_holds() {
    let family = Family::auto_tree(16, 1.5, 0.3, 0.9).unwrap();
    let model = family.model::<f64>().unwrap();
    for seed in 0..50 {
        let found = estimates(&mass_matrix(&model, &model.random(seed)).unwrap()).unwrap();
        let (lower, upper) = found.bracket;
        // 40 DoFs, κ′ up to 1e4: 1e-10 is 40 ε κ′
        let slack = 1.0 + 1e-10;
        assert!(lower <= found.kappa * slack && found.kappa <= upper * slack, "seed {seed}: {found:?}");
        assert_eq!(lower, found.diagonal_ratio);
    }
}

/// What is known of the scaled ratio: near κ on a small swing, far off on a wide one, where the bracket still holds.
#[test]
fn the_scaled_ratio_misses_on_a_wide_swing() {
    let lab = Lab { quick: true, ..Lab::default() };
    let table = select(&["S-beyond-swing"]).unwrap()[0].run(&lab).unwrap().table;
    let numbers = |name: &str| -> Vec<f64> { table.number(name).iter().map(|x| x.unwrap()).collect() };
    let (kappa, scaled) = (numbers("kappa"), numbers("delta_scaled"));
    let missed: Vec<f64> = kappa.iter().zip(&scaled).map(|(k, s)| (s / k - 1.0).abs()).collect();
    assert!(median(&missed) > 0.5, "{}", median(&missed));
    assert!(missed.iter().any(|&m| m > 3.0));
    for ((kappa, lower), upper) in kappa.iter().zip(numbers("lower")).zip(numbers("upper")) {
        // 4 ε κ of rounding, κ up to 1100
        assert!(lower <= kappa * (1.0 + 1e-12) && *kappa <= upper * (1.0 + 1e-12));
    }
}

#[test]
fn statistics() {
    assert_eq!(correlation(&[1.0, 2.0, 3.0], &[2.0, 4.0, 6.0]), 1.0);
    assert_eq!(correlation(&[1.0, 2.0, 3.0], &[3.0, 2.0, 1.0]), -1.0);
    assert_eq!((median(&[3.0, 1.0, 2.0]), median(&[4.0, 1.0, 2.0, 3.0])), (2.0, 2.5));
    assert!(median(&[]).is_nan());
}

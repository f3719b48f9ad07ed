//! `data/families.json`: 143 robots and postures, computed in ball arithmetic, against the dense path in f64.
//!
//! Rows with κ ≥ 10¹⁰ are out of reach of a dense solver in f64, whose λmin is good to ε·κ: double-double takes them.

use crate::reference::{Row, families, number};
use eigenbody::model::Model;
use eigenbody::scalar::{Dd, Real};
use eigenbody::{Conditioning, Metric, conditioning, floating_mass_matrix, mass_matrix};

impl Row {
    fn conditioning<T: Real>(&self) -> Conditioning<T> {
        let model: Model<T> = self.family().model().unwrap();
        let q = self.posture().configuration(&model);
        let H = if self.floating {
            floating_mass_matrix(&model, &q)
        } else {
            Ok(mass_matrix(&model, &q).unwrap())
        };
        let H = H.unwrap();
        let weights = Metric::Euclidean.weights_of(&H, |_| false).unwrap();
        conditioning(&H, &weights).unwrap()
    }

    /// Relative errors of λmin, λmax, κ, κ′ and r; the last two exist on a fixed base only.
    fn errors<T: Real>(&self) -> [f64; 5] {
        let found: Conditioning<T> = self.conditioning();
        let error = |found: Option<T>, expected: &str| {
            let expected = number(expected);
            found.map_or(f64::INFINITY, |found| (found.to_f64() / expected - 1.0).abs())
        };
        let optional =
            |found, expected: &Option<String>| expected.as_deref().map_or(0.0, |e| error(found, e));
        [
            error(found.lambda_min, &self.lambda_min),
            error(found.lambda_max, &self.lambda_max),
            error(found.kappa, &self.kappa),
            optional(found.kappa_weighted, &self.kappa_weighted),
            optional(found.diagonal_ratio, &self.diagonal_ratio),
        ]
    }
}

/// The reference has 15 digits or more, the double-precision solver ε·κ: 10⁻⁶ holds both with κ < 10¹⁰.
#[test]
fn dense_f64_reproduces_every_row_below_1e10() {
    let rows: Vec<Row> = families().into_iter().filter(|row| number(&row.kappa) < 1e10).collect();
    assert_eq!(rows.len(), 136);
    for row in &rows {
        let errors = row.errors::<f64>();
        assert!(errors.iter().all(|&e| e <= 1e-6), "{errors:?} {row:?}");
    }
}

/// 16 f64 roundings for π/2, 2.45 and the comparison.
#[test]
fn dense_double_double_reproduces_every_row_above_1e10() {
    let rows: Vec<Row> = families().into_iter().filter(|row| number(&row.kappa) >= 1e10).collect();
    assert_eq!(rows.len(), 7);
    for row in &rows {
        let errors = row.errors::<Dd>();
        let tolerance = 16.0 * f64::EPSILON;
        assert!(errors.iter().all(|&e| e <= tolerance), "{errors:?} {row:?}");
    }
}

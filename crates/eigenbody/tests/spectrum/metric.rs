use eigenbody::error::InputError;
use eigenbody::{Family, Matrix, Metric, mass_matrix};

/// DoFs of auto_tree: revolute, prismatic, helical, cylindrical, universal, planar, ball, floating.
const TRANSLATIONS: [bool; 19] = [
    false, true, false, false, true, false, false, true, true, false, false, false, false, false, false,
    false, true, true, true,
];

#[test]
fn weights_of_every_metric() {
    let model = Family::auto_tree(8, 1.0, 0.3, 0.9).unwrap().model::<f64>().unwrap();
    let H = mass_matrix(&model, &model.neutral()).unwrap();
    assert_eq!(Metric::Euclidean.weights(&model, &H).unwrap(), [1.0; 19]);
    let own: Vec<f64> = (0..19).map(|d| H[(d, d)]).collect();
    assert_eq!(Metric::UnitDiagonal.weights(&model, &H).unwrap(), own);
    let lengths = TRANSLATIONS.map(|translation| if translation { 4.0 } else { 1.0 });
    assert_eq!(Metric::Length(0.5).weights(&model, &H).unwrap(), lengths);
    let given: Vec<f64> = (1..20).map(f64::from).collect();
    assert_eq!(Metric::Diagonal(given.clone()).weights(&model, &H).unwrap(), given);
}

#[test]
fn weights_must_be_positive() {
    let H = Matrix::from_fn(3, 3, |i, j| if i == j { [1.0, 0.0, 2.0][i] } else { 0.0 });
    let refused = |what, index, value| Err(InputError::NotPositive { what, index, value });
    assert_eq!(Metric::UnitDiagonal.weights_of(&H, |_| false), refused("diagonal of H", 1, 0.0));
    let given = Metric::Diagonal(vec![1.0, 2.0, -3.0]);
    assert_eq!(given.weights_of(&H, |_| false), refused("B", 2, -3.0));
    let short = Metric::Diagonal(vec![1.0]);
    assert_eq!(short.weights_of(&H, |_| false), Err(InputError::Length { what: "B", expected: 3, found: 1 }));
    for length in [0.0, f64::INFINITY, f64::NAN] {
        let refused = Metric::Length(length).weights_of(&H, |d| d == 1);
        assert!(matches!(refused, Err(InputError::NotPositive { what: "B", index: 1, .. })), "{length}");
    }
}

#[test]
fn metrics_have_names() {
    let names = [Metric::Euclidean, Metric::UnitDiagonal, Metric::Length(0.5), Metric::Diagonal(vec![1.0])];
    assert_eq!(names.map(|m| m.to_string()), ["euclidean", "unit-diagonal", "length=0.5", "diagonal"]);
}

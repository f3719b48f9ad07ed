use crate::robots::{cases, numbers};
use eigenbody::scalar::Real;
use eigenbody::{Family, Matrix, Metric, Model, Posture, conditioning, mass_matrix};

fn metrics<T: Real>(n: usize) -> [Metric<T>; 4] {
    let given = numbers::<T>(n, 5).into_iter().map(|x| x * x + T::from_f64(0.01)).collect();
    [Metric::Euclidean, Metric::UnitDiagonal, Metric::Length(T::from_f64(0.3)), Metric::Diagonal(given)]
}

scalars!(bracket_holds);

/// r ≤ κ ≤ r κ′ in every metric.
fn bracket_holds<T: Real>() {
    let mut seen = 0;
    for case in cases::<T>(14).into_iter().filter(|case| case.nv() > 0) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        for metric in metrics(case.nv()) {
            let weights = metric.weights(&case.model, &H).unwrap();
            let report = conditioning(&H, &weights).unwrap();
            // Where single precision does not resolve λmin there is no κ, and a note instead.
            let (Some(kappa), Some((low, high))) = (report.kappa, report.bracket) else {
                assert!(!report.notes.is_empty() && T::EPSILON > 1e-10, "{}", case.name);
                continue;
            };
            seen += 1;
            assert!(report.notes.is_empty());
            let (r, weighted) = (report.diagonal_ratio.unwrap(), report.kappa_weighted.unwrap());
            assert_eq!((low, high), (r, r * weighted));
            let [kappa, low, high] = [kappa, low, high].map(T::to_f64);
            // n ε κ: the error of κ itself, relative
            let slack = 1.0 + 4.0 * case.nv() as f64 * T::EPSILON * kappa;
            assert!(
                low <= kappa * slack && kappa <= high * slack,
                "{} {metric}: {low} {kappa} {high}",
                case.name
            );
        }
    }
    assert!(seen > 60, "{seen}");
}

/// In the unit-diagonal metric κ is κ′ and r is 1; κ′ itself is the same in every metric.
#[test]
fn weighted_kappa_is_free_of_units() {
    for case in cases::<f64>(9).into_iter().filter(|case| case.nv() > 0) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let n = case.nv() as f64;
        let report =
            |metric: &Metric<f64>| conditioning(&H, &metric.weights(&case.model, &H).unwrap()).unwrap();
        let own = report(&Metric::UnitDiagonal);
        let weighted = own.kappa_weighted.unwrap();
        assert_eq!(own.kappa, Some(weighted));
        assert!((own.diagonal_ratio.unwrap() - 1.0).abs() <= 2.0 * f64::EPSILON);
        for metric in metrics(case.nv()) {
            assert_eq!(report(&metric).kappa_weighted, Some(weighted), "{}: {metric}", case.name);
        }
        // Other units: every DoF measured in another length; κ′ to 4 n ε κ′
        let units: Vec<f64> = numbers::<f64>(case.nv(), 3).into_iter().map(|x| 10f64.powf(2.0 * x)).collect();
        let scaled = Matrix::from_fn(H.rows(), H.rows(), |i, j| units[i] * H[(i, j)] * units[j]);
        let again = conditioning(&scaled, &vec![1.0; H.rows()]).unwrap().kappa_weighted.unwrap();
        assert!((again / weighted - 1.0).abs() <= 4.0 * n * f64::EPSILON * weighted, "{again} {weighted}");
    }
}

fn hydra(n: usize) -> (Model<f64>, Matrix<f64>) {
    let model = Family::hydra(n, 1.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    let H = mass_matrix(&model, &Posture::Zag(0.0).configuration(&model)).unwrap();
    (model, H)
}

/// The stiffest mode of a straight chain turns all joints one way; the softest works every joint against its neighbours.
#[test]
fn softest_and_stiffest_modes() {
    let (_, H) = hydra(10);
    let report = conditioning(&H, &[1.0; 10]).unwrap();
    assert!(report.stiffest.as_ref().unwrap().iter().all(|&x| x > 0.0));
    let softest = report.softest.as_ref().unwrap();
    assert!(softest.windows(2).all(|pair| pair[0] * pair[1] < 0.0), "{softest:?}");
    assert_eq!(report.lambda_min, Some(report.eigenvalues.as_ref().unwrap()[0]));
    assert_eq!(report.lambda_max, Some(report.eigenvalues.as_ref().unwrap()[9]));
}

/// An eigenvalue below rounding is not reported as one: two identical rows.
#[test]
fn singular_matrices_have_no_kappa() {
    let H = Matrix::from_fn(3, 3, |i, j| if i.max(j) < 2 || i == j { 1.0 } else { 0.25 });
    let report = conditioning(&H, &[1.0; 3]).unwrap();
    assert_eq!(
        (report.lambda_min, report.kappa, report.kappa_weighted, report.bracket),
        (None, None, None, None)
    );
    assert_eq!(report.diagonal_ratio, Some(1.0));
    assert!(report.lambda_max.unwrap() > 2.0);
    assert_eq!(report.notes.len(), 2);
    assert!(
        report.notes[0].starts_with("λmin is not resolved") && report.notes[1].starts_with("λ′min"),
        "{:?}",
        report.notes
    );
}

/// The line is drawn at n ε λmax.
#[test]
fn small_eigenvalues_are_resolved_or_not() {
    let report = |least: f64| {
        let H = Matrix::from_fn(2, 2, |i, j| if i != j { 0.0 } else { [1.0, least][i] });
        conditioning(&H, &[1.0; 2]).unwrap()
    };
    assert_eq!((report(1e-15).kappa, report(1e-15).notes.len()), (Some(1.0 / 1e-15), 0));
    assert_eq!((report(1e-16).kappa, report(1e-16).notes.len()), (None, 1));
    // κ′ looks at the matrix with its units taken out: the identity.
    assert!((report(1e-16).kappa_weighted.unwrap() - 1.0).abs() <= 4.0 * f64::EPSILON);
}

/// A DoF without inertia has no κ′ and no diagonal ratio; it is named.
#[test]
fn dofs_without_inertia_are_named() {
    let H = Matrix::from_fn(3, 3, |i, j| if i == j { [1.0, 0.0, 2.0][i] } else { 0.0 });
    let report = conditioning(&H, &[1.0; 3]).unwrap();
    assert_eq!((report.kappa, report.kappa_weighted, report.diagonal_ratio), (None, None, None));
    assert!(report.notes.iter().any(|note| note.starts_with("DoF 1 has no inertia")), "{:?}", report.notes);
}

/// An indefinite matrix is no mass matrix: its negative eigenvalue is in the spectrum, not in κ.
#[test]
fn indefinite_matrices_have_no_kappa() {
    let H = Matrix::<f64>::from_fn(2, 2, |i, j| if i == j { 1.0 } else { 2.0 });
    let report = conditioning(&H, &[1.0; 2]).unwrap();
    assert_eq!((report.lambda_min, report.kappa), (None, None));
    assert!((report.eigenvalues.as_ref().unwrap()[0] + 1.0).abs() <= 4.0 * f64::EPSILON);
}

#[test]
fn no_dofs_no_modes() {
    let report = conditioning(&Matrix::<f64>::zeros(0, 0), &[]).unwrap();
    assert!(report.softest.is_none() && report.stiffest.is_none() && report.kappa.is_none());
    assert!(report.notes[0].contains("no degrees of freedom"));
}

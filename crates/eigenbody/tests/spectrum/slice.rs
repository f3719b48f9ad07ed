//! All eigenvalues by slicing.

use eigenbody::spectrum::slice;
use eigenbody::spectrum::sturm::{Pencil, counts};
use eigenbody::{Family, Model, Posture};

fn at_zero(model: &Model<f64>) -> Pencil<'_, f64> {
    Pencil::euclidean(model, &Posture::Zero.configuration(model), false).unwrap()
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found / expected - 1.0).abs();
    assert!(error <= tolerance, "{what}: {found:e}, expected {expected:e}, off by {error:.1e}");
}

/// The circular onion's are 1/(4 sin²((2k − 1)π/(4N + 2))).
#[test]
fn of_the_circular_onion() {
    for n in [1, 2, 3, 10, 300] {
        let values = slice(&at_zero(&Family::onion(n, 1.0, 0.0, 1.0).unwrap().model().unwrap()));
        assert_eq!(values.len(), n);
        for (k, value) in (1..).zip(values.iter().rev()) {
            let angle = (2 * k - 1) as f64 * std::f64::consts::PI / (4 * n + 2) as f64;
            // Half a slice, and the angle's rounding near π/2 and 0.
            assert_close(
                *value,
                0.25 / angle.sin().powi(2),
                20.0 * f64::EPSILON,
                &format!("n = {n}, k = {k}"),
            );
        }
    }
}

/// A star of n − 1 twins on a hub: n − 2 of the eigenvalues are 1. Counts among them may be wrong by several.
#[test]
fn of_many_twins() {
    for n in [5, 17, 65] {
        let values = slice(&at_zero(&Family::onion(n, (n - 1) as f64, 0.0, 1.0).unwrap().model().unwrap()));
        assert!(values.is_sorted());
        for value in &values[1..n - 1] {
            assert_close(*value, 1.0, 200.0 * f64::EPSILON, &format!("{n} links"));
        }
        // The other two: sum and product follow from the trace n + n − 1 and the determinant 1.
        let sum = (n + 1) as f64;
        let upper = 0.5 * (sum + (sum * sum - 4.0).sqrt());
        assert_close(values[n - 1], upper, 200.0 * f64::EPSILON, "largest");
        assert_close(values[0], 1.0 / upper, 200.0 * f64::EPSILON, "smallest");
    }
}

/// A tree with eigenvalues of multiplicity 62, where counts within a hundred ulps are wrong by up to eight: every value is
/// where counts beside it, out of that reach, say.
#[test]
fn where_counts_beside_it_say() {
    let model = Family::hydra(1000, 2.0, 0.5, 1.0).unwrap().model().unwrap();
    let pencil = at_zero(&model);
    let values = slice(&pencil);
    assert!(values.is_sorted());
    for (pair, k) in values.chunks(2).zip((0..).step_by(2)) {
        let mut shifts = [0.0; 8];
        for (shift, value) in shifts.chunks_exact_mut(2).zip(pair) {
            shift.copy_from_slice(&[value * (1.0 - 1e-13), value * (1.0 + 1e-13)]);
        }
        let found = counts(&pencil, shifts);
        for (index, sides) in (k..).zip(found.chunks_exact(2)).take(pair.len()) {
            let (below, above) = (sides[0].below, sides[1].below);
            assert!(below <= index && index < above, "eigenvalue {index}: {below} below, {above} up to it");
        }
    }
}

/// To the bit, on any number of threads.
#[test]
fn does_not_depend_on_threads() {
    let model = Family::hydra(300, 1.0, 0.0, 1.0).unwrap().model().unwrap();
    let pencil = at_zero(&model);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| slice(&pencil))
    };
    assert_eq!(on(1), on(3));
}

//! The circular onion has its spectrum in closed form: onion(N,1,0,1), λ_k = 1/(4 sin²((2k−1)π/(4N+2))), k = 1..N.
//!
//! H_ij = N + 1 − max(i,j), whatever q: its inverse is tridiagonal (2 on the diagonal, 1 first, −1 beside it).

use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spectrum::eigen;
use eigenbody::{Family, Matrix, Posture, conditioning, mass_matrix};
use std::f64::consts::PI;

fn mass<T: Real>(n: usize) -> Matrix<T> {
    let model = Family::onion(n, 1.0, 0.0, 1.0).unwrap().model::<T>().unwrap();
    mass_matrix(&model, &Posture::Zag(0.7).configuration(&model)).unwrap()
}

/// Ascending: k = N first.
fn closed_form(n: usize) -> Vec<f64> {
    let eigenvalue = |k: usize| 0.25 / ((2 * k - 1) as f64 * PI / (4 * n + 2) as f64).sin().powi(2);
    (1..=n).rev().map(eigenvalue).collect()
}

#[test]
fn mass_matrix_counts_the_links_carried() {
    let H = mass::<f64>(12);
    for i in 0..12 {
        for j in 0..12 {
            let expected = (12 - i.max(j)) as f64;
            // 12 ε of the sum of the terms: turned unit inertias are summed
            assert!((H[(i, j)] - expected).abs() <= 12.0 * f64::EPSILON * expected, "{i} {j}: {}", H[(i, j)]);
        }
    }
}

#[test]
fn extremes_and_kappa_to_1e_10() {
    for n in [1, 2, 3, 10, 100, 500] {
        let report = conditioning(&mass::<f64>(n), &vec![1.0; n]).unwrap();
        let exact = closed_form(n);
        let (min, max) = (exact[0], exact[n - 1]);
        let check = |found: Option<f64>, exact: f64, what| {
            let error = (found.unwrap() / exact - 1.0).abs();
            assert!(error < 1e-10, "{what} of N = {n}: {error:e}");
        };
        check(report.lambda_min, min, "λmin");
        check(report.lambda_max, max, "λmax");
        check(report.kappa, max / min, "κ");
    }
}

#[test]
fn every_eigenvalue() {
    for n in [1, 2, 3, 10, 60, 200] {
        let spectrum = eigen(&mass::<f64>(n), &vec![1.0; n]).unwrap();
        let exact = closed_form(n);
        // n ε λmax: H entries and a backward stable solver
        let tolerance = n as f64 * f64::EPSILON * exact[n - 1];
        for (found, exact) in spectrum.values.iter().zip(&exact) {
            assert!((found - exact).abs() <= tolerance, "N = {n}: {found} {exact}");
        }
    }
}

/// The same against the closed form in double-double: the angle from π to 32 digits.
#[test]
fn every_eigenvalue_in_double_double() {
    let n = 40;
    let pi = Dd::from_sum(PI, 1.2246467991473532e-16);
    let spectrum = eigen(&mass::<Dd>(n), &vec![Dd::ONE; n]).unwrap();
    let number = |k: usize| Dd::from_f64(k as f64);
    let largest = closed_form(n)[n - 1];
    for (i, found) in spectrum.values.iter().enumerate() {
        let sine = (pi * number(2 * (n - i) - 1) / number(4 * n + 2)).sin_cos().0;
        let exact = Dd::ONE / (number(4) * sine * sine);
        // 16 n ε λmax: constants of double-double products are larger
        let tolerance = 16.0 * n as f64 * Dd::EPSILON * largest;
        assert!((*found - exact).abs().to_f64() <= tolerance, "{i}: {found:?} {exact:?}");
    }
}

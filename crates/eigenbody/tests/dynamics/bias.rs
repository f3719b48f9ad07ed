use super::{largest, rate, rate_error};
use crate::robots::cases;
use eigenbody::dynamics::{energy, gravity_force};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::Vec3;
use eigenbody::{bias_force, mass_matrix};

/// Ḣ − 2C is skew: vᵀ Ḣ v = 2 vᵀ C(q, v) without gravity.
#[test]
fn rate_of_H_minus_twice_coriolis_is_skew() {
    for case in cases::<Dd>(20) {
        let model = case.model.with_gravity(Vec3::ZERO).unwrap();
        let C = bias_force(&model, &case.q, &case.v).unwrap();
        let dot = |x: &[Dd]| x.iter().zip(&case.v).fold(Dd::ZERO, |sum, (&a, &b)| sum + a * b);
        let expected = 2.0 * dot(&C).to_f64();
        let vHv = |q: &[Dd]| dot(&mass_matrix(&model, q).unwrap().times(&case.v));
        let found = rate(&model, &case.q, &case.v, |q, _| vHv(q));
        let size = vHv(&case.q).to_f64() + largest(&C);
        let tolerance = rate_error(model.nv(), size);
        assert!((found - expected).abs() <= tolerance, "{}: {found} {expected} {tolerance:e}", case.name);
    }
}

/// g(q) is the gradient of the potential energy.
#[test]
fn gravity_force_is_the_gradient_of_the_potential() {
    for case in cases::<Dd>(14) {
        let (model, n) = (&case.model, case.nv());
        let g = gravity_force(model, &case.q).unwrap();
        let zeros = vec![Dd::ZERO; n];
        let potential = |q: &[Dd]| energy(model, q, &zeros).unwrap().potential;
        let size = potential(&case.q).to_f64().abs() + largest(&g);
        for d in 0..n {
            let mut unit = zeros.clone();
            unit[d] = Dd::ONE;
            let found = rate(model, &case.q, &unit, |q, _| potential(q));
            let expected = g[d].to_f64();
            // One DoF moves at unit speed: n = 1 in the truncation, all n in the rounding
            let tolerance = rate_error(n, size);
            assert!((found - expected).abs() <= tolerance, "{}: g[{d}] {found} {expected}", case.name);
        }
    }
}

/// C(q, v) = g(q) + what is quadratic in v.
#[test]
fn velocity_enters_quadratically() {
    for case in cases::<f64>(30) {
        let g = gravity_force(&case.model, &case.q).unwrap();
        let at = |s: f64| {
            let v: Vec<f64> = case.v.iter().map(|v| s * v).collect();
            bias_force(&case.model, &case.q, &v).unwrap()
        };
        let (one, three) = (at(1.0), at(3.0));
        // 16 n ε of the larger force
        let tolerance = 16.0 * case.nv() as f64 * f64::EPSILON * (largest(&three) + largest(&g));
        for d in 0..case.nv() {
            let error = three[d] - g[d] - 9.0 * (one[d] - g[d]);
            assert!(error.abs() <= tolerance, "{}: {error:e} {tolerance:e}", case.name);
        }
    }
}

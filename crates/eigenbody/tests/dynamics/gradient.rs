use super::{rate, rate_error};
use crate::robots::cases;
use eigenbody::dynamics::{energy, kinetic_energy_gradient};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::{Family, Metric, Model, conditioning, mass_matrix};

/// Against central differences in double-double, for joints of every kind.
#[test]
fn gradient_is_the_rate_of_energy() {
    for case in cases::<Dd>(40) {
        let (model, n) = (&case.model, case.nv());
        let gradient = kinetic_energy_gradient(model, &case.q, &case.v).unwrap();
        let size = energy(model, &case.q, &case.v).unwrap().kinetic.to_f64();
        for d in 0..n {
            let mut along = vec![Dd::ZERO; n];
            along[d] = Dd::ONE;
            let found = rate(model, &case.q, &along, |q, _| energy(model, q, &case.v).unwrap().kinetic);
            let tolerance = rate_error(n, size);
            let expected = gradient[d].to_f64();
            assert!((found - expected).abs() <= tolerance, "{}: DoF {d}: {expected} {found}", case.name);
        }
    }
}

/// Twice the gradient along a mode is the rate of its eigenvalue.
#[test]
fn gradient_of_an_eigenvalue() {
    let robot: Model<Dd> = Family::hydra(6, 1.5, 0.5, 0.9).unwrap().model().unwrap();
    let q: Vec<Dd> = (1..=6).map(|k| Dd::from_f64(0.3 * f64::from(k))).collect();
    let verdict = |q: &[Dd]| {
        let H = mass_matrix(&robot, q).unwrap();
        let unit = Metric::Euclidean.weights_of(&H, |_| false).unwrap();
        conditioning(&H, &unit).unwrap()
    };
    let now = verdict(&q);
    for (mode, which) in [(now.softest.unwrap(), 0), (now.stiffest.unwrap(), 1)] {
        let gradient = kinetic_energy_gradient(&robot, &q, &mode).unwrap();
        for d in 0..6 {
            let mut along = [Dd::ZERO; 6];
            along[d] = Dd::ONE;
            let lambda = |q: &[Dd]| [verdict(q).lambda_min, verdict(q).lambda_max][which].unwrap();
            let found = rate(&robot, &q, &along, |q, _| lambda(q));
            let expected = 2.0 * gradient[d].to_f64();
            // The values themselves: 20 ε² of λmax over the step.
            let tolerance = rate_error(6, 1.0) + 20.0 * f64::EPSILON * f64::EPSILON * 50.0 / super::STEP;
            assert!((found - expected).abs() <= tolerance, "{which} {d}: {expected} {found} {tolerance:e}");
        }
    }
}

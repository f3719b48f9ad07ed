use super::{largest, rate, rate_error};
use crate::robots::cases;
use eigenbody::dynamics::{energy, energy_shares};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::{inverse_dynamics, mass_matrix};

scalars!(kinetic_energy_is_half_v_H_v);

fn kinetic_energy_is_half_v_H_v<T: Real>() {
    for case in cases::<T>(60) {
        let n = case.nv();
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let Hv = H.times(&case.v);
        let twice = Hv.iter().zip(&case.v).fold(T::ZERO, |sum, (&a, &b)| sum + a * b).to_f64();
        let kinetic = energy(&case.model, &case.q, &case.v).unwrap().kinetic.to_f64();
        // 4 n ε of the sum of |v_d H_de v_e|
        let sum = (0..n * n).fold(0.0, |sum, k| {
            let (d, e) = (k / n, k % n);
            sum + (case.v[d] * H[(d, e)] * case.v[e]).abs().to_f64()
        });
        let tolerance = 4.0 * n as f64 * T::EPSILON * sum;
        assert!((kinetic - 0.5 * twice).abs() <= tolerance, "{}: {kinetic} {twice}", case.name);
    }
}

/// d/dt (kinetic + potential) = τ·v.
#[test]
fn power_is_the_rate_of_energy() {
    for case in cases::<Dd>(20) {
        let tau = inverse_dynamics(&case.model, &case.q, &case.v, &case.vdot).unwrap();
        let power = tau.iter().zip(&case.v).fold(Dd::ZERO, |sum, (&a, &b)| sum + a * b).to_f64();
        let found = rate(&case.model, &case.q, &case.v, |q, t| {
            let v: Vec<Dd> = case.v.iter().zip(&case.vdot).map(|(&v, &a)| v + a * t).collect();
            let total = energy(&case.model, q, &v).unwrap();
            total.kinetic + total.potential
        });
        let now = energy(&case.model, &case.q, &case.v).unwrap();
        let size = now.kinetic.to_f64() + now.potential.to_f64().abs() + largest(&tau);
        let tolerance = rate_error(case.nv(), size);
        assert!((found - power).abs() <= tolerance, "{}: {found} {power} {tolerance:e}", case.name);
    }
}

/// Nothing has a part in no energy.
#[test]
fn shares_of_a_motion_without_energy() {
    for case in cases::<f64>(10) {
        let shares = energy_shares(&case.model, &case.q, &vec![0.0; case.nv()]).unwrap();
        assert!(shares.bodies.iter().chain(&shares.armature).all(|&part| part == 0.0), "{shares:?}");
        let moving = energy_shares(&case.model, &case.q, &case.v).unwrap();
        let sum: f64 = moving.bodies.iter().chain(&moving.armature).sum();
        // N + nv sums and divisions
        let terms = (moving.bodies.len() + case.nv()) as f64;
        assert!(case.nv() == 0 || (sum - 1.0).abs() <= terms * f64::EPSILON, "{}: {sum}", case.name);
    }
}

use super::{largest, rate, rate_error};
use crate::robots::cases;
use eigenbody::dynamics::{link_pose, momentum};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::{Force, Vec3};
use eigenbody::{forward_dynamics, mass_matrix};

/// Linear momentum is the rate of the first moment of mass: mass × velocity of the centre of mass.
#[test]
fn linear_momentum_is_the_rate_of_the_first_moment() {
    for case in cases::<Dd>(20) {
        let now = momentum(&case.model, &case.q, &case.v).unwrap();
        let size = now.mass.to_f64() + largest(&now.h.lin.to_array()) + largest(&now.moment.to_array());
        for k in 0..3 {
            let moment = |q: &[Dd]| momentum(&case.model, q, &case.v).unwrap().moment.to_array()[k];
            let found = rate(&case.model, &case.q, &case.v, |q, _| moment(q));
            let expected = now.h.lin.to_array()[k].to_f64();
            let tolerance = rate_error(case.nv(), size);
            assert!((found - expected).abs() <= tolerance, "{}: {found} {expected} {tolerance:e}", case.name);
        }
    }
}

/// A floating robot whose joints push as they like changes momentum by gravity alone: ḣ = [m c × g; m g].
#[test]
fn gravity_alone_changes_the_momentum_of_a_floating_robot() {
    for gravity in [Vec3::ZERO, Vec3::from_f64([0.3, -2.0, 9.0])] {
        for case in cases::<Dd>(14).into_iter().filter(|case| case.model.has_floating_base()) {
            let model = case.model.with_gravity(gravity).unwrap();
            let mut tau = case.vdot.clone();
            tau[..6].fill(Dd::ZERO);
            let vdot = forward_dynamics(&model, &case.q, &case.v, &tau).unwrap();
            let now = momentum(&model, &case.q, &case.v).unwrap();
            let pull = gravity * now.mass;
            let expected = [now.moment.cross(gravity).to_array(), pull.to_array()].concat();
            // Accelerations enter as velocities do: their size is that of v²
            let reach = (1.0 + largest(&vdot)).powi(2);
            let size = reach * (now.mass.to_f64() + largest(&now.h.to_array()) + largest(&expected));
            for k in 0..6 {
                let found = rate(&model, &case.q, &case.v, |q, t| {
                    let v: Vec<Dd> = case.v.iter().zip(&vdot).map(|(&v, &a)| v + a * t).collect();
                    momentum(&model, q, &v).unwrap().h.to_array()[k]
                });
                let tolerance = rate_error(model.nv(), size);
                let expected = expected[k].to_f64();
                assert!((found - expected).abs() <= tolerance, "{}: ḣ[{k}] {found} {expected}", case.name);
            }
        }
    }
}

/// A base's rows of H v are the momentum in the base's frame.
#[test]
fn base_rows_of_H_v_are_the_momentum() {
    for case in cases::<f64>(30).into_iter().filter(|case| case.model.has_floating_base()) {
        let H = mass_matrix(&case.model, &case.q).unwrap();
        let base = case.model.bodies()[0].link();
        let X = link_pose(&case.model, &case.q, base).unwrap();
        let Hv = H.times(&case.v);
        let vector = |k: usize| Vec3::new(Hv[k], Hv[k + 1], Hv[k + 2]);
        let in_world = X.transpose_force(Force::new(vector(0), vector(3)));
        let h = momentum(&case.model, &case.q, &case.v).unwrap().h;
        // 8 n ε of n terms of H
        let n = case.nv() as f64;
        let tolerance = 8.0 * n * f64::EPSILON * n * H.max_abs();
        for (a, b) in in_world.to_array().iter().zip(h.to_array()) {
            assert!((a - b).abs() <= tolerance, "{}: {a} {b}", case.name);
        }
    }
}

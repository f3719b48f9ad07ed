//! What f64 loses: the same numbers, computed in double-double.

use crate::robots::{Case, cases};
use eigenbody::model::JointSpec;
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Family, Joint, Model, ModelBuilder, forward_dynamics, inverse_dynamics, mass_matrix};

/// |δH_de| ≤ c·depth·ε·√(H_dd H_ee): largest c over the robot's entries.
fn constant(case: &Case<f64>) -> f64 {
    let H = mass_matrix(&case.model, &case.q).unwrap();
    let q: Vec<Dd> = case.q.iter().map(|&q| Dd::from_f64(q)).collect();
    let exact = mass_matrix(&case.model.cast::<Dd>(), &q).unwrap();
    let tree = case.model.dofs();
    let depth = (0..case.nv()).map(|d| 1 + tree.ancestors(d).count()).max().unwrap_or(0) as f64;
    let mut c = 0.0f64;
    for d in 0..case.nv() {
        for e in 0..case.nv() {
            let error = (Dd::from_f64(H[(d, e)]) - exact[(d, e)]).abs().to_f64();
            c = c.max(error / (depth * f64::EPSILON * (H[(d, d)] * H[(e, e)]).sqrt()));
        }
    }
    c
}

#[test]
fn entries_are_good_to_the_geometric_mean_of_their_diagonal() {
    for case in cases::<f64>(60) {
        let c = constant(&case);
        assert!(c <= 2.0, "{}: c = {c}", case.name);
    }
    for taper in [0.7, 1.0, 1.3] {
        let model = Family::hydra(40, 1.0, 0.2, taper).unwrap().model::<f64>().unwrap();
        let c = constant(&Case::new(String::new(), model, 1));
        assert!(c <= 2.0, "taper {taper}: c = {c}");
    }
}

/// A small rotor on a skew axis far from the arm's.
fn spinner<T: Real>(mass: f64, inertia: f64) -> Model<T> {
    let ball =
        |m: f64, x: f64, I: f64| RigidInertia::from_com(m, Vec3::new(x, 0.0, 0.0), Sym3::diagonal(I, I, I));
    let mut robot = ModelBuilder::<f64>::new("spinner");
    let base = robot.link("base", RigidInertia::ZERO);
    let arm = robot.link("arm", ball(2.0, 0.5, 0.1));
    let rotor = robot.link("rotor", ball(mass, 0.0, inertia));
    robot.joint(JointSpec::new("turn", Joint::Revolute, base, arm));
    let spin = JointSpec::new("spin", Joint::Revolute, arm, rotor);
    let place = Transform::translation(Vec3::new(0.7, 0.3, 0.9));
    robot.joint(spin.at(place).about(Vec3::new(0.6, 0.3, 0.7)));
    robot.gravity(Vec3::ZERO);
    robot.build(Base::Fixed).unwrap().cast()
}

/// What a hinge feels of a body whose mass lies on its axis is that body's own inertia, however small.
fn small_bodies_keep_their_digits<T: Real>() {
    for (mass, inertia) in [(0.1, 1e-5), (0.1, 1e-6), (0.1, 1e-8), (1.0, 1e-9)] {
        let model = spinner::<T>(mass, inertia);
        for k in 0..50 {
            let q = [0.1, 0.037].map(|rate| T::from_f64(rate * f64::from(k)));
            let H = mass_matrix(&model, &q).unwrap();
            let own = H[(1, 1)].to_f64();
            // 8 ε of the inertia itself
            assert!((own / inertia - 1.0).abs() <= 8.0 * T::EPSILON, "{mass}, {inertia:e}: {own:e}");
            let (still, unit) = ([T::ZERO; 2], [T::ZERO, T::ONE]);
            let tau = inverse_dynamics(&model, &q, &still, &unit).unwrap();
            let felt = tau[1].to_f64();
            assert!((felt / inertia - 1.0).abs() <= 8.0 * T::EPSILON, "{mass}, {inertia:e}: {felt:e}");
            // κ′ is near 1.
            let back = forward_dynamics(&model, &q, &still, &tau).unwrap()[1].to_f64();
            assert!((back - 1.0).abs() <= 16.0 * T::EPSILON, "{mass}, {inertia:e}: {back}");
        }
    }
}

#[test]
fn small_bodies_keep_their_digits_in_single_precision() {
    small_bodies_keep_their_digits::<f32>();
}

#[test]
fn small_bodies_keep_their_digits_in_double_precision() {
    small_bodies_keep_their_digits::<f64>();
}

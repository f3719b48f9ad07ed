//! Configurations that move: q ⊕ v on every joint's own manifold.

use crate::robots::{configuration, numbers, vector};
use eigenbody::dynamics::{energy, link_pose};
use eigenbody::model::{JointSpec, Random};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::{Mat3, Motion, RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Joint, Model, ModelBuilder};

const KINDS: [fn() -> Joint<Dd>; 9] = [
    || Joint::Revolute,
    || Joint::Continuous,
    || Joint::Prismatic,
    || Joint::Helical { pitch: Dd::from_f64(0.3) },
    || Joint::Cylindrical,
    || Joint::Universal { first: Vec3::from_f64([1.0, 0.4, 0.2]) },
    || Joint::Planar,
    || Joint::Spherical,
    || Joint::Floating,
];

fn one_joint(kind: Joint<Dd>) -> Model<Dd> {
    let mut robot = ModelBuilder::new("one");
    let base = robot.link("base", RigidInertia::ZERO);
    let one = Dd::ONE;
    let body = robot.link("body", RigidInertia::from_com(one, Vec3::X, Sym3::diagonal(one, one, one)));
    let placement = Transform::translation(Vec3::from_f64([0.3, -0.2, 0.9]));
    let axis = Vec3::from_f64([0.2, -0.5, 0.7]);
    robot.joint(JointSpec::new("joint", kind, base, body).at(placement).about(axis));
    robot.build(Base::Fixed).unwrap()
}

fn distance(a: &Transform<Dd>, b: &Transform<Dd>) -> f64 {
    let flat = |X: &Transform<Dd>| [X.E.x, X.E.y, X.E.z, X.r].map(Vec3::to_array).concat();
    flat(a).into_iter().zip(flat(b)).fold(0.0, |m, (a, b)| m.max((a - b).abs().to_f64()))
}

/// A constant velocity for unit time is the same velocity for half of it, twice: exactly on the manifold, fast or slow.
#[test]
fn motion_at_constant_velocity_adds_up() {
    for (k, kind) in KINDS.into_iter().enumerate() {
        let model = one_joint(kind());
        for (round, speed) in [1e-25, 1e-9, 0.03, 0.9, 1.1, 3.0, 12.0].into_iter().enumerate() {
            let q = configuration(&model, (10 * k + round) as u64);
            let v: Vec<Dd> =
                numbers(model.nv(), round as u64).into_iter().map(|v: Dd| v * Dd::from_f64(speed)).collect();
            let half: Vec<Dd> = v.iter().map(|&v| v * Dd::from_f64(0.5)).collect();
            let once = model.integrate(&q, &v).unwrap();
            let twice = model.integrate(&model.integrate(&q, &half).unwrap(), &half).unwrap();
            let poses = [&once, &twice].map(|q| link_pose(&model, q, 1).unwrap());
            // 64 ε of the distance travelled and the frame's own place
            let tolerance = 64.0 * Dd::EPSILON * (2.0 + speed);
            let error = distance(&poses[0], &poses[1]);
            assert!(error <= tolerance, "{} at {speed}: {error:e}", kind().kind());
        }
    }
}

/// q ⊕ v moves the body as S v says: the velocity of the frame, by differences, has the kinetic energy of v.
#[test]
fn motion_starts_along_the_joints_columns() {
    let h = 1e-12;
    for (k, kind) in KINDS.into_iter().enumerate() {
        let model = one_joint(kind());
        let q = configuration(&model, k as u64);
        let v: Vec<Dd> = numbers(model.nv(), k as u64);
        let step: Vec<Dd> = v.iter().map(|&v| v * Dd::from_f64(h)).collect();
        let before = link_pose(&model, &q, 1).unwrap();
        let after = link_pose(&model, &model.integrate(&q, &step).unwrap(), 1).unwrap();
        let displacement = (after.r - before.r) * Dd::from_f64(1.0 / h);
        let turn = after.E * before.E.transpose();
        let half = Dd::from_f64(0.5 / h);
        let ang = Vec3::new(turn.y.z - turn.z.y, turn.z.x - turn.x.z, turn.x.y - turn.y.x) * half;
        let lin = before.E * displacement;
        let inertia = RigidInertia::from_com(Dd::ONE, Vec3::X, Sym3::diagonal(Dd::ONE, Dd::ONE, Dd::ONE));
        let velocity = Motion::new(ang, lin);
        let expected = (velocity.dot(inertia.times(velocity)) * Dd::from_f64(0.5)).to_f64();
        let found = energy(&model, &q, &v).unwrap().kinetic.to_f64();
        // First differences: h times the second derivative, 16 for speeds up to 2
        assert!(
            (found - expected).abs() <= 16.0 * h * expected.max(1.0),
            "{}: {found} {expected}",
            kind().kind()
        );
    }
}

/// Quaternions stay unit, and a configuration near enough to unit is the one on its ray.
#[test]
fn quaternions_stay_on_the_sphere() {
    for kind in [Joint::Spherical, Joint::Floating] {
        let model = one_joint(kind);
        let mut q = configuration(&model, 4);
        let at = kind.quaternion().unwrap();
        for step in 0..50 {
            q = model.integrate(&q, &numbers(model.nv(), step)).unwrap();
            let norm = q[at..].iter().fold(Dd::ZERO, |sum, &x| sum + x * x);
            // 8 ε a step
            assert!((norm - Dd::ONE).abs().to_f64() <= 8.0 * f64::from(step as u32 + 1) * Dd::EPSILON);
        }
        let stretched: Vec<Dd> = q
            .iter()
            .enumerate()
            .map(|(i, &x)| if i < at { x } else { x * Dd::from_f64(1.0 + 5e-7) })
            .collect();
        let poses = [&q, &stretched].map(|q| link_pose(&model, q, 1).unwrap());
        assert!(distance(&poses[0], &poses[1]) <= 16.0 * Dd::EPSILON);
    }
}

/// A turn by the exponential map is Rodrigues' rotation.
#[test]
fn spherical_steps_are_rotations_about_their_axis() {
    let model = one_joint(Joint::Spherical);
    let neutral = model.neutral();
    let mut random = Random::new(9);
    for _ in 0..20 {
        let w: Vec3<Dd> = vector(&mut random) * Dd::from_f64(4.0);
        let angle = w.norm();
        let expected = Mat3::rotation_about(w * (Dd::ONE / angle), angle.sin_cos());
        let q = model.integrate(&neutral, &w.to_array()).unwrap();
        let found = link_pose(&model, &q, 1).unwrap();
        let error = distance(&found, &Transform::new(expected, found.r));
        // 64 ε: two half-angle products each way
        assert!(error <= 64.0 * Dd::EPSILON, "{error:e}");
    }
}

/// to ⊖ from leads from one to the other, near or far, and back.
#[test]
fn differences_lead_from_one_to_the_other() {
    for (k, kind) in KINDS.into_iter().enumerate() {
        let model = one_joint(kind());
        for (round, speed) in [1e-20, 1e-9, 1e-4, 0.03, 0.9, 3.0].into_iter().enumerate() {
            let from = configuration(&model, (10 * k + round) as u64);
            let v: Vec<Dd> =
                numbers(model.nv(), round as u64).into_iter().map(|v: Dd| v * Dd::from_f64(speed)).collect();
            let to = model.integrate(&from, &v).unwrap();
            let there = model.integrate(&from, &model.difference(&from, &to).unwrap()).unwrap();
            let poses = [&to, &there].map(|q| link_pose(&model, q, 1).unwrap());
            // the Bernoulli series is cut at 1e-24
            let error = distance(&poses[0], &poses[1]);
            assert!(error <= 1e-22 * (1.0 + speed), "{} at {speed}: {error:e}", kind().kind());
        }
    }
}

/// θ + δ θ̇ is where δ v leads from q₀ ⊕ θ, to second order in δ = 1e-12.
#[test]
fn tangent_rates_are_velocities() {
    let delta = Dd::from_f64(1e-12);
    for kind in KINDS {
        let (model, joint) = (one_joint(kind()), kind());
        for (round, turn) in [1e-3, 0.4, 0.7, 2.5].into_iter().enumerate() {
            let q = configuration(&model, round as u64);
            let theta: Vec<Dd> =
                numbers(model.nv(), 1 + round as u64).iter().map(|&x: &Dd| x * Dd::from_f64(turn)).collect();
            let v: Vec<Dd> = numbers(model.nv(), 70 + round as u64);
            let mut rate = v.clone();
            joint.tangent_rate(&theta, &v, &mut rate);
            let along =
                |a: &[Dd], b: &[Dd]| -> Vec<Dd> { a.iter().zip(b).map(|(&a, &b)| a + delta * b).collect() };
            let inside = model.integrate(&q, &along(&theta, &rate)).unwrap();
            let zero = vec![Dd::ZERO; v.len()];
            let outside = model.integrate(&model.integrate(&q, &theta).unwrap(), &along(&zero, &v)).unwrap();
            let error =
                distance(&link_pose(&model, &inside, 1).unwrap(), &link_pose(&model, &outside, 1).unwrap());
            assert!(error <= 100.0 * 1e-24, "{} at {turn}: {error:e}", joint.kind());
        }
    }
}

/// ⟨dexp⁻ᵀ_u f, v⟩ = ⟨f, dexp_u⁻¹ v⟩, and dexpᵀ undoes dexp⁻ᵀ.
#[test]
fn duals_are_transposes() {
    for kind in KINDS {
        let joint = kind();
        let n = joint.nv();
        for (round, turn) in [1e-3, 0.4, 0.7, 2.5].into_iter().enumerate() {
            let scaled = |seed: u64, by: f64| -> Vec<Dd> {
                numbers(n, seed).iter().map(|&x: &Dd| x * Dd::from_f64(by)).collect()
            };
            let (u, f, v) = (scaled(round as u64, turn), scaled(40, 1.0), scaled(50, 1.0));
            let minus: Vec<Dd> = u.iter().map(|&u| -u).collect();
            let (mut dual, mut rate, mut back) = (f.clone(), v.clone(), f.clone());
            joint.dexp_inverse_dual(&u, &f, &mut dual);
            // dexp_u⁻¹ is the rate against −u
            joint.tangent_rate(&minus, &v, &mut rate);
            let dot = |a: &[Dd], b: &[Dd]| a.iter().zip(b).fold(Dd::ZERO, |sum, (&a, &b)| sum + a * b);
            let error = (dot(&dual, &v) - dot(&f, &rate)).abs().to_f64();
            assert!(error <= 1e-26, "{} at {turn}: {error:e}", joint.kind());
            joint.dexp_dual(&u, &dual, &mut back);
            let error = back.iter().zip(&f).fold(0.0f64, |m, (&a, &b)| m.max((a - b).abs().to_f64()));
            // both series are cut, at 1e-24 and, for |u| = 4.3, at 4.3³⁰/31!
            assert!(
                error <= 1e-12f64.min(1e-21 + 1e-15 * turn.powi(20)),
                "{} at {turn}: {error:e}",
                joint.kind()
            );
        }
    }
}

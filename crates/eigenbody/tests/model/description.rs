//! H belongs to the robot, not to its description: other frames, another order, fixed joints merged by hand.

use crate::robots::{Plan, configuration, numbers, plan, rotation, vector};
use eigenbody::model::Random;
use eigenbody::scalar::{Real, Scalar};
use eigenbody::spatial::{Transform, Vec3};
use eigenbody::{Base, Joint, Matrix, Model, inverse_dynamics, mass_matrix};

scalars!(turned_frames_leave_H, order_permutes_H, merged_fixed_joints_leave_H);

/// q of `other`, whose joints have the same names in another order.
fn same_configuration<T: Real>(model: &Model<T>, q: &[T], other: &Model<T>) -> Vec<T> {
    let mut out = other.neutral();
    for joint in other.joints() {
        let twin = model.joints().iter().find(|j| j.name() == joint.name()).unwrap();
        out[joint.coordinates()].copy_from_slice(&q[twin.coordinates()]);
    }
    out
}

/// For each DoF of `other` the DoF of the same name in `model`.
fn twins<T: Scalar>(model: &Model<T>, other: &Model<T>) -> Vec<usize> {
    let names: Vec<String> = (0..model.nv()).map(|d| model.dof_name(d)).collect();
    (0..other.nv()).map(|d| names.iter().position(|name| *name == other.dof_name(d)).unwrap()).collect()
}

/// The two descriptions have one H and one τ.
fn assert_same<T: Real>(one: &Plan<T>, other: &Plan<T>, base: Base, seed: u64) {
    let (one, other) = (one.build(base), other.build(base));
    let q = configuration(&one, seed);
    let q_other = same_configuration(&one, &q, &other);
    let twin = twins(&one, &other);
    let n = one.nv();
    assert_eq!(other.nv(), n);
    let (H, again) = (mass_matrix(&one, &q).unwrap(), mass_matrix(&other, &q_other).unwrap());
    let permuted = Matrix::from_fn(n, n, |d, e| H[(twin[d], twin[e])]);
    // 8 n ε √(H_dd H_ee): the same numbers rounded twice, turned and shifted in between
    for d in 0..n {
        for e in 0..n {
            let size = (permuted[(d, d)] * permuted[(e, e)]).sqrt().to_f64();
            let error = (again[(d, e)] - permuted[(d, e)]).abs().to_f64();
            let tolerance = 8.0 * (n + 1) as f64 * T::EPSILON * size;
            assert!(error <= tolerance, "seed {seed}: H[{d}, {e}] off by {error:e}, {tolerance:e}");
        }
    }
    let (v, vdot): (Vec<T>, Vec<T>) = (numbers(n, seed + 1), numbers(n, seed + 2));
    let pick = |x: &[T]| -> Vec<T> { twin.iter().map(|&d| x[d]).collect() };
    let tau = pick(&inverse_dynamics(&one, &q, &v, &vdot).unwrap());
    let tau_again = inverse_dynamics(&other, &q_other, &pick(&v), &pick(&vdot)).unwrap();
    // 16 n ε of the largest force
    let size = tau.iter().fold(1.0f64, |m, x| m.max(x.to_f64().abs()));
    for (a, b) in tau.iter().zip(&tau_again) {
        let error = (*a - *b).abs().to_f64();
        assert!(error <= 16.0 * (n + 1) as f64 * T::EPSILON * size, "seed {seed}: τ off by {error:e}");
    }
}

fn over_plans<T: Real>(other: impl Fn(&Plan<T>, u64) -> Plan<T>) {
    for seed in 0..30 {
        let one = plan(seed, 1 + seed as usize);
        for base in [Base::Fixed, Base::Floating] {
            assert_same(&one, &other(&one, seed), base, seed);
        }
    }
}

/// Every link's frame turned, those behind fixed joints shifted too. Planar, spherical and floating joints keep theirs:
/// their velocities are written in it.
fn turned_frames_leave_H<T: Real>() {
    over_plans(|plan: &Plan<T>, seed| {
        let mut random = Random::new(seed + 100);
        let mut turned = plan.clone();
        for link in &plan.links {
            let kind = plan.joints.iter().find(|joint| joint.child == link.name).map(|joint| joint.kind);
            let E = rotation(&mut random);
            let r: Vec3<T> = vector(&mut random);
            match kind {
                None | Some(Joint::Planar | Joint::Spherical | Joint::Floating) => {}
                Some(Joint::Fixed) => turned.turn(&link.name, Transform::new(E, r)),
                Some(_) => turned.turn(&link.name, Transform::new(E, Vec3::ZERO)),
            }
        }
        turned
    });
}

fn order_permutes_H<T: Real>() {
    over_plans(|plan: &Plan<T>, seed| plan.clone().shuffled(seed + 200));
}

fn merged_fixed_joints_leave_H<T: Real>() {
    over_plans(|plan: &Plan<T>, _| {
        let mut merged = plan.clone();
        while merged.merge_one() {}
        assert!(merged.joints.iter().all(|joint| joint.kind != Joint::Fixed));
        merged
    });
}

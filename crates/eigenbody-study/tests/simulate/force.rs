//! Forces against closed forms: springs, damping, torques over time, controllers.

use super::{apart, chain};
use eigenbody::dynamics::gravity_force;
use eigenbody::spatial::Vec3;
use eigenbody::{Family, Model};
use eigenbody_study::simulate::{
    Algorithm, Controller, DORMAND_PRINCE, Forces, Method, Simulation, State, Steps, Trajectory,
    joint_springs,
};

fn after(model: &Model<f64>, q: &[f64], forces: Forces, method: Method, t: f64) -> State {
    let steps = match method {
        Method::RungeKutta(_) => Steps::Adaptive(1e-12),
        _ => Steps::Fixed(1e-4),
    };
    let v = vec![0.0; model.nv()];
    let mut simulation = Simulation::new(model, q, &v, method, steps, forces, Algorithm::Aba).unwrap();
    while simulation.state().t < t {
        simulation.step(t).unwrap();
    }
    simulation.state().clone()
}

/// One rod, no gravity, spring and damper: the damped oscillation of a textbook, by every method to its order.
#[test]
fn a_spring_and_a_damper() {
    let model = chain(1).with_gravity(Vec3::ZERO).unwrap();
    let (inertia, k, c): (f64, f64, f64) = (2.2 / 3.0, 30.0, 1.5);
    let forces = || Forces { springs: joint_springs(&model, k, c), rest: vec![0.2], ..Forces::default() };
    let (sigma, t) = (c / (2.0 * inertia), 1.3);
    let omega = (k / inertia - sigma * sigma).sqrt();
    let expected = 0.2 + 0.5 * (-sigma * t).exp() * ((omega * t).cos() + sigma / omega * (omega * t).sin());
    for (method, error) in [
        (Method::RungeKutta(DORMAND_PRINCE), 1e-10),
        (Method::ImplicitMidpoint, 1e-7),
        (Method::SemiImplicitEuler, 1e-2),
    ] {
        let found = after(&model, &[0.7], forces(), method, t).q[0];
        assert!((found - expected).abs() < error, "{}: {found} is not {expected}", method.name());
    }
}

/// Torque that grows evenly on a rod that nothing else moves: q = t³/6 over its inertia; held after the table's end.
#[test]
fn a_torque_over_time() {
    let model = chain(1).with_gravity(Vec3::ZERO).unwrap();
    let torque = Trajectory::new(vec![0.0, 1.0], vec![vec![0.0], vec![1.0]], 1).unwrap();
    let forces = Forces { torque: Some(torque), ..Forces::default() };
    let (inertia, method) = (2.2 / 3.0, Method::RungeKutta(DORMAND_PRINCE));
    let at = |t| after(&model, &[0.0], forces.clone(), method, t).q[0] * inertia;
    assert!((at(1.0) - 1.0 / 6.0).abs() < 1e-10);
    // from there on at 1 N m: 1/6 + ½ t + ½ t²
    assert!((at(1.5) - (1.0 / 6.0 + 0.25 + 0.125)).abs() < 1e-9);
}

/// A controller on joints of every kind comes to rest at its target, but for gravity, which it does not know.
#[test]
fn a_controller_holds_a_posture() {
    let model: Model<f64> = Family::auto_tree(6, 1.5, 0.3, 0.9).unwrap().model().unwrap();
    let target = model.random(2);
    let controller = Controller::tuned(&model, Trajectory::constant(target.clone()), 2.0, 1.0).unwrap();
    let kp = controller.kp.clone();
    let forces = Forces { controller: Some(controller), ..Forces::default() };
    let end = after(&model, &model.random(1), forces, Method::RungeKutta(DORMAND_PRINCE), 20.0);
    let rest = State { t: 0.0, q: end.q.clone(), v: vec![0.0; model.nv()] };
    assert!(apart(&model, &end, &rest) < 1e-6, "it moves: {:?}", end.v);
    // kp (target ⊖ q) = g(q)
    let (way, weight) = (model.difference(&end.q, &target).unwrap(), gravity_force(&model, &end.q).unwrap());
    for d in 0..model.nv() {
        assert!((kp[d] * way[d] - weight[d]).abs() < 1e-4 * (1.0 + weight[d].abs()), "dof {d}");
    }
}

/// Along a trajectory a controller lags behind by little: it knows the target's velocity.
#[test]
fn a_controller_follows_a_trajectory() {
    let model = chain(3).with_gravity(Vec3::ZERO).unwrap();
    let times: Vec<f64> = (0..=100).map(|k| f64::from(k) * 0.02).collect();
    let rows = times.iter().map(|t| vec![0.5 * (1.0 - t.cos()); 3]).collect();
    let target = Trajectory::new(times, rows, 3).unwrap();
    let controller = Controller::tuned(&model, target, 5.0, 1.0).unwrap();
    let forces = Forces { controller: Some(controller), ..Forces::default() };
    let end = after(&model, &[0.0; 3], forces, Method::RungeKutta(DORMAND_PRINCE), 1.5);
    let expected = 0.5 * (1.0 - 1.5f64.cos());
    assert!(end.q.iter().all(|q| (q - expected).abs() < 0.02), "{:?} is not {expected}", end.q);
}

#[test]
fn forces_that_do_not_fit_are_refused() {
    let model = chain(2);
    let refused = |forces| {
        let method = Method::RungeKutta(DORMAND_PRINCE);
        Simulation::new(&model, &[0.0; 2], &[0.0; 2], method, Steps::Adaptive(1e-9), forces, Algorithm::Aba)
            .is_err()
    };
    assert!(!refused(Forces::default()));
    let long = joint_springs(&chain(3), 0.0, 1.0);
    assert!(refused(Forces { springs: long, ..Forces::default() }), "a spring on a third link");
    let springs = joint_springs(&model, 1.0, 0.0);
    assert!(refused(Forces { springs, ..Forces::default() }), "springs without rest");
    assert!(refused(Forces { torque: Some(Trajectory::constant(vec![0.0; 3])), ..Forces::default() }));
    assert!(Trajectory::new(vec![0.0, 0.0], vec![vec![0.0]; 2], 1).is_err(), "times stand still");
    assert!(Trajectory::new(vec![], vec![], 1).is_err());
}

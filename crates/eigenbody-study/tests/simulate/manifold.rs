//! Orders on the manifold: joints of every kind, on a floating base.

use super::apart;
use eigenbody::{Family, Model};
use eigenbody_study::simulate::{
    Algorithm, DORMAND_PRINCE, Forces, Method, RK4, Simulation, State, Steps, joint_springs,
};

fn robot() -> Model<f64> {
    let tree = Family::auto_tree(9, 1.5, 0.3, 1.0).unwrap().floating().model::<f64>().unwrap();
    let kinds: Vec<&str> = tree.joints().iter().map(|joint| joint.kind().kind()).collect();
    for kind in ["floating", "spherical", "planar", "revolute"] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
    tree
}

fn after_a_fifth(model: &Model<f64>, method: Method, h: f64) -> State {
    let (q, v) =
        (model.random(3), (0..model.nv()).map(|d| ((7 * d % 5) as f64 - 2.0) * 1.5).collect::<Vec<_>>());
    let forces = Forces { springs: joint_springs(model, 0.0, 0.01), ..Forces::default() };
    let mut simulation =
        Simulation::new(model, &q, &v, method, Steps::Fixed(h), forces, Algorithm::Aba).unwrap();
    let steps = (0.2 / h).round() as usize;
    for k in 1..=steps {
        simulation.step(k as f64 * h).unwrap();
    }
    simulation.state().clone()
}

/// Halving the step divides the error by 2 to the order, to half an order: turns of a radian a step and less.
#[test]
fn orders_hold_on_balls_and_floating_bases() {
    let model = robot();
    let best = after_a_fifth(&model, Method::RungeKutta(DORMAND_PRINCE), 0.2 / 2048.0);
    for (method, order, steps) in [
        (Method::SemiImplicitEuler, 1.0, 256.0),
        (Method::ImplicitMidpoint, 2.0, 128.0),
        (Method::RungeKutta(RK4), 4.0, 64.0),
        (Method::RungeKutta(DORMAND_PRINCE), 5.0, 64.0),
    ] {
        let error = |steps: f64| apart(&model, &after_a_fifth(&model, method, 0.2 / steps), &best);
        let found = (error(steps) / error(2.0 * steps)).log2();
        assert!((found - order).abs() < 0.45, "{}: order {found}", method.name());
    }
}

/// Just before the end of a step the interpolant is at its end.
#[test]
fn the_interpolant_ends_where_the_step_does() {
    let model = robot();
    let start = (model.random(3), vec![1.0; model.nv()]);
    for tableau in [RK4, DORMAND_PRINCE] {
        let method = Method::RungeKutta(tableau);
        let mut simulation = Simulation::new(
            &model,
            &start.0,
            &start.1,
            method,
            Steps::Fixed(0.01),
            Forces::default(),
            Algorithm::Aba,
        )
        .unwrap();
        simulation.step(1.0).unwrap();
        let mut close = simulation.state().clone();
        simulation.at(0.01 * (1.0 - 1e-12), &mut close);
        let error = apart(&model, &close, simulation.state());
        assert!(error > 0.0 && error < 1e-9, "{error:e}");
    }
}

//! Methods on one line: orders, tolerances, samples, and what cannot be simulated.

use super::{SECOND, apart, chain, run};
use eigenbody::Model;
use eigenbody_study::simulate::{
    Algorithm, DORMAND_PRINCE, Forces, Method, RK4, Schedule, Simulation, SimulationError, State, Steps,
    Trajectory, joint_springs, simulate,
};
use std::ops::ControlFlow;

/// A tighter tolerance is a better motion. The bound is 1000 tolerances: how far neighbouring motions of four links part in a second.
#[test]
fn tolerance_governs_the_error() {
    let model = chain(4);
    let best = run(&model, &Schedule { steps: Steps::Adaptive(1e-12), ..SECOND });
    for tolerance in [1e-5, 1e-7, 1e-9] {
        let motion = run(&model, &Schedule { steps: Steps::Adaptive(tolerance), ..SECOND });
        let error = apart(&model, &motion[10], &best[10]);
        assert!(error < 1000.0 * tolerance, "{tolerance:e}: {error:e}");
    }
}

/// Samples within steps come from an interpolant: as good as if every step had ended on one, to 10⁴ tolerances.
#[test]
fn samples_within_steps_are_as_good() {
    let model = chain(4);
    let tight = Steps::Adaptive(1e-9);
    let many = run(&model, &Schedule { steps: tight, intervals: 1000, ..SECOND });
    let best = run(&model, &Schedule { steps: Steps::Adaptive(1e-13), intervals: 1000, ..SECOND });
    for (a, b) in many.iter().zip(&best) {
        let error = apart(&model, a, b);
        assert!(error < 1e4 * 1e-9, "t = {}: {error:e}", a.t);
    }
}

/// Interpolants meet the step's ends, and between them err as h⁴ (Runge-Kutta 4, order 3) and h⁵ (Dormand-Prince, order 4).
#[test]
fn interpolants_have_their_order() {
    for tableau in [RK4, DORMAND_PRINCE] {
        for stage in 0..tableau.b.len() {
            assert!((tableau.weight(stage, 1.0) - tableau.b[stage]).abs() < 1e-14);
            assert_eq!(tableau.weight(stage, 0.0), 0.0);
        }
    }
    let model = chain(2);
    let within = |method, h: f64| {
        let start = ([0.3, 0.3], [1.0, -2.0]);
        let mut simulation = begin(&model, method, Steps::Fixed(h), &start.0, &start.1);
        simulation.step(1.0).unwrap();
        let mut found = simulation.state().clone();
        simulation.at(0.37 * h, &mut found);
        let mut fine = begin(
            &model,
            Method::RungeKutta(DORMAND_PRINCE),
            Steps::Fixed(0.37 * h / 20.0),
            &start.0,
            &start.1,
        );
        (0..20).for_each(|_| fine.step(1.0).unwrap());
        apart(&model, &found, fine.state())
    };
    for (tableau, order) in [(RK4, 4.0), (DORMAND_PRINCE, 5.0)] {
        let method = Method::RungeKutta(tableau);
        let found = (within(method, 0.02) / within(method, 0.01)).log2();
        assert!((found - order).abs() < 0.4, "order {order}: {found}");
    }
}

fn begin<'m>(model: &'m Model<f64>, method: Method, steps: Steps, q: &[f64], v: &[f64]) -> Simulation<'m> {
    Simulation::new(model, q, v, method, steps, Forces::default(), Algorithm::Aba).unwrap()
}

/// A blow out of nowhere: the steps that run into it are taken back.
#[test]
fn steps_that_are_too_long_are_refused() {
    let model = chain(2);
    let torque = Trajectory::new(
        vec![0.0, 0.5, 0.51, 0.52],
        vec![vec![0.0; 2], vec![0.0; 2], vec![0.0, 200.0], vec![0.0; 2]],
        2,
    );
    let forces = Forces { torque: Some(torque.unwrap()), ..Forces::default() };
    let method = Method::RungeKutta(DORMAND_PRINCE);
    let mut simulation = Simulation::new(
        &model,
        &[-1.5, 0.0],
        &[0.0; 2],
        method,
        Steps::Adaptive(1e-9),
        forces,
        Algorithm::Aba,
    )
    .unwrap();
    while simulation.state().t < 1.0 {
        simulation.step(1.0).unwrap();
    }
    let effort = simulation.effort();
    assert!(effort.refused > 0 && effort.steps > effort.refused, "{effort:?}");
    // 2 N m s of angular impulse on 2.2/3 kg m², and more, because the first link gives way: it turns fast
    assert!(simulation.state().v[1].abs() > 1.0, "{:?}", simulation.state());
    // First same as last: six accelerations a step, and one for the first
    assert_eq!(effort.evaluations, 6 * (effort.steps + effort.refused) + 1);
}

/// A step that failed leaves nothing behind. The implicit midpoint rule went on from the momentum of the step before the last one, and
/// from the ξ at which it had given up.
#[test]
fn after_a_step_that_failed_a_shorter_one_goes_on() {
    let model = chain(2);
    let blow =
        Trajectory::new(vec![0.0, 0.3, 0.4], vec![vec![0.0; 2], vec![0.0; 2], vec![0.0, 1e9]], 2).unwrap();
    for method in [Method::ImplicitMidpoint, Method::RungeKutta(RK4), Method::RungeKutta(DORMAND_PRINCE)] {
        let after = |failures: usize| {
            let forces = Forces { torque: Some(blow.clone()), ..Forces::default() };
            let mut simulation = Simulation::new(
                &model,
                &[-1.0, 0.5],
                &[1.0, -2.0],
                method,
                Steps::Fixed(0.1),
                forces,
                Algorithm::Aba,
            )
            .unwrap();
            (0..3).for_each(|_| simulation.step(0.3).unwrap());
            let before = simulation.state().clone();
            for _ in 0..failures {
                assert!(simulation.step(1.0).unwrap_err().is_along_the_way());
                assert_eq!(simulation.state(), &before);
            }
            (1..3).for_each(|k| simulation.step(0.3 + f64::from(k) * 1e-6).unwrap());
            simulation.state().clone()
        };
        // The same numbers go through the same operations: to the last bit.
        let expected = after(0);
        for failures in [1, 2] {
            assert_eq!(after(failures), expected, "{}, {failures} failures", method.name());
        }
    }
}

#[test]
fn samples_stand_where_they_should() {
    for steps in [Steps::Fixed(0.03), Steps::Fixed(0.7), Steps::Adaptive(1e-6)] {
        let motion = run(&chain(1), &Schedule { steps, ..SECOND });
        let times: Vec<f64> = motion.iter().map(|state| state.t).collect();
        // Products of a tenth: to ε
        assert!(
            times.iter().enumerate().all(|(k, t)| (t - k as f64 / 10.0).abs() <= f64::EPSILON),
            "{times:?}"
        );
        assert_eq!(times.len(), 11);
    }
}

#[test]
fn a_run_ends_where_it_is_told() {
    let model = chain(1);
    let mut simulation = begin(&model, SECOND.method, SECOND.steps, &[0.3], &[0.0]);
    let mut samples = 0;
    let flow = simulation.run(1.0, 10, &mut [], &mut |_| {
        samples += 1;
        if samples == 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(flow.unwrap().is_break() && samples == 4);
}

#[test]
fn what_cannot_be_simulated_is_refused() {
    let refused = |model: &Model<f64>, schedule: &Schedule| {
        simulate(model, &model.neutral(), &vec![0.0; model.nv()], schedule).unwrap_err()
    };
    let model = chain(1);
    for schedule in [
        Schedule { span_s: 0.0, ..SECOND },
        Schedule { span_s: f64::NAN, ..SECOND },
        Schedule { intervals: 0, ..SECOND },
        Schedule { steps: Steps::Fixed(-1.0), ..SECOND },
        Schedule { steps: Steps::Adaptive(f64::INFINITY), ..SECOND },
        Schedule { method: Method::RungeKutta(RK4), ..SECOND },
        Schedule { method: Method::ImplicitMidpoint, ..SECOND },
    ] {
        assert!(matches!(refused(&model, &schedule), SimulationError::Schedule(_)), "{schedule:?}");
    }
    let wrong = simulate(&model, &[0.0, 0.0], &[0.0], &SECOND).unwrap_err();
    assert!(matches!(wrong, SimulationError::Input(_)), "{wrong}");
}

/// A tolerance below rounding cannot be met; it ends, and says where.
#[test]
fn an_impossible_tolerance_ends() {
    let model = chain(2);
    let schedule = Schedule { steps: Steps::Adaptive(1e-30), ..SECOND };
    let stuck = simulate(&model, &[0.3, 0.3], &[0.0, 0.0], &schedule).unwrap_err();
    assert!(matches!(&stuck, SimulationError::Stuck { joint, .. } if joint.starts_with("joint_")), "{stuck}");
}

/// Steps far longer than the mechanism's own times: each method ends with the time, the joint and the reason, and what came before
/// stands.
#[test]
fn a_blow_up_is_located() {
    let model = chain(4);
    let stiff = Forces { springs: joint_springs(&model, 1e6, 0.0), rest: vec![0.0; 4], ..Forces::default() };
    for method in [Method::SemiImplicitEuler, Method::RungeKutta(RK4), Method::ImplicitMidpoint] {
        let mut simulation = Simulation::new(
            &model,
            &[0.1; 4],
            &[0.0; 4],
            method,
            Steps::Fixed(0.05),
            stiff.clone(),
            Algorithm::Aba,
        )
        .unwrap();
        let mut seen: Vec<State> = Vec::new();
        let error = simulation.run(10.0, 200, &mut [], &mut |report| {
            if let eigenbody_study::simulate::Report::Sample(state) = report {
                seen.push(state.clone());
            }
            ControlFlow::Continue(())
        });
        let error = error.unwrap_err();
        assert!(error.is_along_the_way() && error.to_string().contains("'joint_"), "{error}");
        assert!(!seen.is_empty() && seen.len() < 200, "{}", seen.len());
        assert!(seen.iter().all(|state| state.q.iter().chain(&state.v).all(|x| x.is_finite())));
    }
}

/// Two algorithms for the accelerations, one motion: to 10⁴ n ε κ′ over a second.
#[test]
fn articulated_bodies_and_composite_bodies_agree() {
    let model = chain(6);
    let end = |algorithm| {
        let method = Method::RungeKutta(RK4);
        let mut simulation = Simulation::new(
            &model,
            &[0.3; 6],
            &[0.0; 6],
            method,
            Steps::Fixed(1e-3),
            Forces::default(),
            algorithm,
        )
        .unwrap();
        while simulation.state().t < 1.0 {
            simulation.step(1.0).unwrap();
        }
        simulation.state().clone()
    };
    let error = apart(&model, &end(Algorithm::Aba), &end(Algorithm::CrbaLtl));
    assert!(error > 0.0 && error < 1e4 * 6.0 * f64::EPSILON * 1e2, "{error:e}");
}

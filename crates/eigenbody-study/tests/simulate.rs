use eigenbody::dynamics::energy;
use eigenbody::{Family, Model};
use eigenbody_study::simulate::{DORMAND_PRINCE, RK4, Schedule, SimulationError, State, Steps, simulate};

fn chain(n: usize) -> Model<f64> {
    Family::slender_chain(n, 2.2, 1.0).unwrap().model().unwrap()
}

fn run(model: &Model<f64>, schedule: &Schedule) -> Vec<State> {
    simulate(model, &vec![0.3; model.nq()], &vec![0.0; model.nv()], schedule).unwrap()
}

const SECOND: Schedule =
    Schedule { method: DORMAND_PRINCE, steps: Steps::Adaptive(1e-10), span_s: 1.0, intervals: 10 };

fn apart(a: &State, b: &State) -> f64 {
    let pairs = a.q.iter().zip(&b.q).chain(a.v.iter().zip(&b.v));
    pairs.fold(0.0, |worst, (a, b)| worst.max((a - b).abs()))
}

/// Halving the step divides the error by 2⁴ and by 2⁵: to a tenth of the order, steps being short.
#[test]
fn orders_are_what_they_say() {
    let model = chain(1);
    let best = run(&model, &Schedule { steps: Steps::Fixed(1e-3), ..SECOND });
    for (method, order) in [(RK4, 4.0), (DORMAND_PRINCE, 5.0)] {
        let error = |h: f64| {
            let motion = run(&model, &Schedule { method, steps: Steps::Fixed(h), ..SECOND });
            apart(&motion[10], &best[10])
        };
        let found = (error(0.02) / error(0.01)).log2();
        assert!((found - order).abs() < 0.4, "order {order}: {found}");
    }
}

/// A tighter tolerance is a better motion. The bound is 1000 tolerances: how far neighbouring motions of four links part in a second.
#[test]
fn adaptive_steps_keep_the_tolerance() {
    let model = chain(4);
    let best = run(&model, &Schedule { steps: Steps::Adaptive(1e-12), ..SECOND });
    for tolerance in [1e-5, 1e-7, 1e-9] {
        let motion = run(&model, &Schedule { steps: Steps::Adaptive(tolerance), ..SECOND });
        let error = apart(&motion[10], &best[10]);
        assert!(error < 1000.0 * tolerance, "{tolerance:e}: {error:e}");
    }
}

/// A first step that is far too long, an eighth of two seconds, is taken back.
#[test]
fn steps_that_are_too_long_are_rejected() {
    let model = chain(4);
    let whole = Schedule { span_s: 2.0, intervals: 1, ..SECOND };
    let (one, many) = (run(&model, &whole), run(&model, &Schedule { intervals: 200, ..whole }));
    // 10⁴ tolerances: how far neighbouring motions of four links part in two seconds
    let error = apart(&one[1], &many[200]);
    assert!(error < 1e4 * 1e-10, "{error:e}");
}

/// No actuator, no friction: energy is kept, to 1000 tolerances of what moves.
#[test]
fn energy_is_kept() {
    let model = chain(10);
    let motion = run(&model, &Schedule { span_s: 2.0, ..SECOND });
    let total = |state: &State| {
        let energy = energy(&model, &state.q, &state.v).unwrap();
        (energy.kinetic + energy.potential, energy.kinetic)
    };
    let start = total(&motion[0]).0;
    let moving = motion.iter().map(|state| total(state).1).fold(0.0, f64::max);
    assert!(moving > 10.0);
    for state in &motion {
        let drift = (total(state).0 - start).abs();
        assert!(drift < 1000.0 * 1e-10 * moving, "t = {}: {drift:e} of {moving}", state.t);
    }
}

#[test]
fn samples_stand_where_they_should() {
    let motion = run(&chain(1), &Schedule { steps: Steps::Fixed(0.03), ..SECOND });
    let times: Vec<f64> = motion.iter().map(|state| state.t).collect();
    // Products of a tenth: to ε
    assert!(times.iter().enumerate().all(|(k, t)| (t - k as f64 / 10.0).abs() <= f64::EPSILON));
    assert_eq!(times.len(), 11);
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
        Schedule { method: RK4, ..SECOND },
    ] {
        assert!(matches!(refused(&model, &schedule), SimulationError::Schedule(_)), "{schedule:?}");
    }
    let tree = Family::auto_tree(8, 1.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    assert_eq!(refused(&tree, &SECOND), SimulationError::Joint("joint_6".into()));
    let wrong = simulate(&model, &[0.0, 0.0], &[0.0], &SECOND).unwrap_err();
    assert!(matches!(wrong, SimulationError::Dynamics { .. }), "{wrong}");
}

/// A tolerance below rounding cannot be met; it ends, and says so.
#[test]
fn an_impossible_tolerance_ends() {
    let model = chain(2);
    let schedule = Schedule { steps: Steps::Adaptive(1e-30), ..SECOND };
    let stuck = simulate(&model, &[0.3, 0.3], &[0.0, 0.0], &schedule).unwrap_err();
    assert!(matches!(stuck, SimulationError::Stuck(_)), "{stuck}");
}

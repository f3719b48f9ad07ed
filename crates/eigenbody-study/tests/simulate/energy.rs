//! What a motion without actuators and friction keeps: energy, and momentum where nothing pulls.

use super::{SECOND, chain, run};
use eigenbody::dynamics::{energy, momentum};
use eigenbody::spatial::Vec3;
use eigenbody::{Family, Model};
use eigenbody_study::motion::cost::{RELEASES, long_run};
use eigenbody_study::simulate::{DORMAND_PRINCE, Method, Schedule, State, Steps, simulate};

/// Largest change of the total energy against the largest kinetic energy.
fn drift(model: &Model<f64>, motion: &[State]) -> f64 {
    let total = |state: &State| {
        let energy = energy(model, &state.q, &state.v).unwrap();
        (energy.kinetic + energy.potential, energy.kinetic)
    };
    let start = total(&motion[0]).0;
    let (moving, worst) =
        motion.iter().map(total).fold((0.0f64, 0.0f64), |(moving, worst), (sum, kinetic)| {
            (moving.max(kinetic), worst.max((sum - start).abs()))
        });
    assert!(moving > 1.0);
    worst / moving
}

/// Ten links without friction for ten seconds, Dormand-Prince at 1e-12.
#[test]
fn energy_is_kept_for_ten_seconds() {
    let model = chain(10);
    let schedule = Schedule { steps: Steps::Adaptive(1e-12), span_s: 10.0, intervals: 500, ..SECOND };
    let found = drift(&model, &run(&model, &schedule));
    assert!(found < 1e-9, "{found:e}");
}

/// The implicit midpoint rule: over five hundred swings of two links the energy's error is that of the first ten. (A thousand seconds
/// of ten links are in docs/cost.md.)
#[test]
fn the_midpoint_rule_keeps_the_energy_bounded() {
    let model = chain(2);
    let span = |span_s: f64| {
        let steps = Steps::Fixed(2e-3);
        let schedule =
            Schedule { method: Method::ImplicitMidpoint, steps, span_s, intervals: (span_s * 50.0) as usize };
        drift(&model, &run(&model, &schedule))
    };
    let (short, long) = (span(20.0), span(1000.0));
    assert!(long < 2.0 * short && long < 1e-3, "{short:e} in 20 s, {long:e} in 1000 s");
}

/// Ten links that swing: no tenth of the time has more error than twice the first one, peaks or mean.
#[test]
fn the_midpoint_rule_keeps_the_energy_of_ten_links_bounded() {
    let found = long_run(RELEASES[0], 60.0, 4e-3).unwrap();
    let [peak, _] = found.tenths[0];
    for tenth in &found.tenths {
        assert!(tenth[0] < 2.0 * peak && tenth[1].abs() < 0.5 * peak, "{:?}", found.tenths);
    }
    assert!(peak < 1e-5 && found.fastest > 1.0, "{peak:e}");
}

fn adrift() -> (Model<f64>, Vec<f64>, Vec<f64>) {
    let model: Model<f64> = Family::hydra(9, 1.0, 0.4, 1.0)
        .unwrap()
        .floating()
        .model::<f64>()
        .unwrap()
        .with_gravity(Vec3::ZERO)
        .unwrap();
    let v = (0..model.nv()).map(|d| ((7 * d % 5) as f64 - 1.8) * 0.5).collect();
    (model.clone(), model.random(4), v)
}

/// Free-floating, no gravity: linear and angular momentum stay to 1e-12.
fn momentum_stays(method: Method, steps: Steps) {
    let (model, q, v) = adrift();
    assert!(model.has_floating_base());
    let motion = simulate(&model, &q, &v, &Schedule { method, steps, span_s: 5.0, intervals: 50 }).unwrap();
    let start = momentum(&model, &q, &v).unwrap().h;
    let (ang, lin) = (start.ang.norm(), start.lin.norm());
    assert!(ang > 1.0 && lin > 1.0);
    for state in &motion {
        let now = momentum(&model, &state.q, &state.v).unwrap().h;
        let error = ((now.ang - start.ang).norm() / ang).max((now.lin - start.lin).norm() / lin);
        assert!(error < 1e-12, "{}, t = {}: {error:e}", method.name(), state.t);
    }
}

#[test]
fn momentum_stays_under_dormand_prince() {
    momentum_stays(Method::RungeKutta(DORMAND_PRINCE), Steps::Adaptive(1e-14));
}

/// Exactly, whatever the step: here the method errs by a thousandth.
#[test]
fn momentum_stays_under_the_midpoint_rule() {
    momentum_stays(Method::ImplicitMidpoint, Steps::Fixed(0.01));
}

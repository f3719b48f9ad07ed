//! Events: where a function of the motion changes its sign.

use super::{SECOND, chain};
use eigenbody::model::JointSpec;
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, Joint, Model, ModelBuilder};
use eigenbody_study::simulate::{
    Algorithm, DORMAND_PRINCE, Event, Forces, Method, Report, Simulation, Steps, Watch, joint_limits,
};
use std::ops::ControlFlow;

fn watched(model: &Model<f64>, q: &[f64], v: &[f64], watches: &mut [Watch<'_>]) -> (Vec<Event>, Vec<f64>) {
    let method = Method::RungeKutta(DORMAND_PRINCE);
    let mut simulation =
        Simulation::new(model, q, v, method, Steps::Adaptive(1e-11), Forces::default(), Algorithm::Aba)
            .unwrap();
    let (mut events, mut times) = (Vec::new(), Vec::new());
    _ = simulation
        .run(1.0, SECOND.intervals, watches, &mut |report| {
            match report {
                Report::Event(event) => {
                    times.push(event.t);
                    events.push(event);
                }
                Report::Sample(state) => times.push(state.t),
                Report::Step => {}
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    (events, times)
}

/// A rod let go from the horizontal hangs after ¼ of its period, by the complete elliptic integral K(sin 45°) = 1.85407467730137:
/// K √(2l/3g).
#[test]
fn a_rod_hangs_when_it_should() {
    let model = chain(1);
    let mut watch =
        [Watch::new("past", "before", "beyond", |state| -std::f64::consts::FRAC_PI_2 - state.q[0])];
    let (events, times) = watched(&model, &[0.0], &[0.0], &mut watch);
    let expected = 1.854_074_677_301_372 * (2.0f64 / (3.0 * 9.81)).sqrt();
    assert_eq!(events[0].what, "past");
    assert!((events[0].t - expected).abs() < 1e-10, "{} is not {expected}", events[0].t);
    // reported among the samples, in the order of time
    assert!(times.is_sorted() && times.len() == SECOND.intervals + 1 + events.len());
}

/// A slide with limits, pushed off: it passes the upper one when it should, comes from below the lower one at the start.
#[test]
fn joint_limits_are_noticed() {
    let mut robot = ModelBuilder::new("slide");
    let base = robot.link("base", RigidInertia::ZERO);
    let body = robot.link("body", RigidInertia::from_com(1.0, Vec3::ZERO, Sym3::diagonal(1.0, 1.0, 1.0)));
    let rail = JointSpec::new("rail", Joint::Prismatic, base, body).about(Vec3::X);
    robot.joint(JointSpec { limits: Some((-0.5, 0.25)), ..rail });
    let model: Model<f64> = robot.build(Base::Fixed).unwrap().with_gravity(Vec3::ZERO).unwrap();
    let (events, _) = watched(&model, &[-0.75], &[2.0], &mut joint_limits(&model));
    let found: Vec<(f64, &str)> = events.iter().map(|event| (event.t, event.what.as_str())).collect();
    let expected = [
        (0.0, "'rail' is beyond its lower limit -0.5"),
        (0.125, "'rail' returns within its lower limit -0.5"),
        (0.5, "'rail' passes its upper limit 0.25"),
    ];
    for ((found, what), (t, expected)) in found.iter().zip(expected) {
        // bisection ends at 2⁻⁴⁰ of a step
        assert!((found - t).abs() < 1e-11 && *what == expected, "{found}: {what}");
    }
    assert_eq!(found.len(), 3);
}

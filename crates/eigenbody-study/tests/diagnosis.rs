//! Robots with one thing wrong with each, and robots with nothing wrong.

use eigenbody::model::JointSpec;
use eigenbody::search::{Effort, Measure};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Family, Joint, Model, ModelBuilder};
use eigenbody_study::diagnosis::{Diagnosis, Limits, Mechanism, Question, Severity, Use, diagnose};
use std::ops::ControlFlow::Continue;

fn quick() -> Question {
    Question { effort: Effort { samples: 128, starts: 4, ..Effort::default() }, ..Question::default() }
}

fn check(model: &Model<f64>) -> Diagnosis {
    diagnose(model, &quick(), |_| Continue(())).unwrap()
}

fn ids(found: &Diagnosis) -> Vec<&'static str> {
    found.findings.iter().map(|finding| finding.id).collect()
}

/// A box of 1 kg at 0.2 m from its joint.
fn solid(mass: f64) -> RigidInertia<f64> {
    RigidInertia::from_com(
        mass,
        Vec3::new(0.2, 0.0, 0.1),
        Sym3::diagonal(0.01 * mass, 0.02 * mass, 0.025 * mass),
    )
}

/// Three joints about z, x and z at one point: a neck. The links between are `between`; the head is solid.
fn neck(between: RigidInertia<f64>) -> Model<f64> {
    let mut robot = ModelBuilder::new("neck");
    let links = [("base", RigidInertia::ZERO), ("first", between), ("second", between), ("head", solid(1.0))];
    let [base, first, second, head] = links.map(|(name, inertia)| robot.link(name, inertia));
    robot.joint(JointSpec::new("yaw", Joint::Revolute, base, first).about(Vec3::Z));
    robot.joint(JointSpec::new("roll", Joint::Revolute, first, second).about(Vec3::X));
    robot.joint(JointSpec::new("twist", Joint::Revolute, second, head).about(Vec3::Z));
    robot.build(Base::Fixed).unwrap()
}

#[test]
fn axes_that_align_are_named() {
    let found = check(&neck(RigidInertia::ZERO));
    assert!(found.null_motions.is_empty(), "only singular where the axes align: {:?}", found.null_motions);
    assert_eq!(ids(&found), ["solves", "single-precision", "gains"]);
    for finding in &found.findings {
        assert_eq!((finding.severity, finding.joints.len()), (Severity::Warning, 2), "{finding:?}");
        let Some(Mechanism::Opposition { joints, angle, links }) = &finding.mechanism else {
            panic!("{finding:?}");
        };
        assert_eq!(joints.each_ref().map(String::as_str), ["yaw", "twist"]);
        assert_eq!(links.iter().map(String::as_str).collect::<Vec<_>>(), ["first", "second", "head"]);
        assert!(*angle < 1e-3, "{angle}");
    }
}

#[test]
fn inertia_between_mends_it() {
    let found = check(&neck(solid(0.5)));
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    assert!(found.digits.unwrap().left_in_f32() > 5.0);
}

#[test]
fn a_light_tip_is_named() {
    let mut robot = ModelBuilder::new("arm");
    let base = robot.link("base", RigidInertia::ZERO);
    let upper = robot.link("upper", solid(5.0));
    let needle = robot.link("needle", solid(1e-9));
    robot.joint(JointSpec::new("shoulder", Joint::Revolute, base, upper));
    let place = Transform::translation(Vec3::new(0.4, 0.0, 0.0));
    robot.joint(JointSpec::new("wrist", Joint::Revolute, upper, needle).at(place));
    let found = check(&robot.build(Base::Fixed).unwrap());
    // κ is 10⁹, but in its own units every joint is well: nothing endangers a solve.
    assert!(found.by(Measure::KappaWeighted).unwrap().spread.worst < 20.0);
    assert_eq!(ids(&found), ["gains"]);
    let finding = &found.findings[0];
    assert_eq!(finding.endangers, Use::Gains);
    let expected = Mechanism::LightTip { joint: "wrist".into(), link: "needle".into() };
    assert_eq!(finding.mechanism, Some(expected));
}

#[test]
fn what_moves_no_mass_anywhere_is_found_exactly() {
    let mut robot = ModelBuilder::new("idle");
    let [base, arm, a, b] = [("base", 0.0), ("arm", 1.0), ("a", 0.0), ("b", 0.0)]
        .map(|(name, mass)| robot.link(name, if mass > 0.0 { solid(mass) } else { RigidInertia::ZERO }));
    robot.joint(JointSpec::new("arm_joint", Joint::Revolute, base, arm));
    robot.joint(JointSpec::new("idle_a", Joint::Revolute, arm, a));
    robot.joint(JointSpec::new("idle_b", Joint::Prismatic, arm, b));
    let found = check(&robot.build(Base::Fixed).unwrap());
    assert_eq!(ids(&found), ["moves-no-mass"]);
    assert_eq!((found.findings[0].severity, found.findings[0].value), (Severity::Error, 2.0));
    let mut joints = found.findings[0].joints.clone();
    joints.sort();
    assert_eq!(joints, ["idle_a", "idle_b"]);
}

#[test]
fn limits_decide_what_is_a_finding() {
    let chain: Model<f64> = Family::hydra(10, 1.0, 0.0, 1.0).unwrap().model().unwrap();
    assert!(check(&chain).findings.is_empty());
    let strict = Question { limits: Limits { kappa: 1e4, ..Limits::default() }, ..quick() };
    let found = diagnose(&chain, &strict, |_| Continue(())).unwrap();
    assert_eq!(ids(&found), ["gains"]);
    assert_eq!(found.findings[0].mechanism, Some(Mechanism::Spread));
}

/// The prediction is near what factors of H lose in f32 and f64: within one digit mostly, one and a half always. ABA may do better.
#[test]
fn lost_digits_are_as_predicted() {
    for (n, taper) in [(3, 1.0), (6, 0.8), (10, 1.0), (14, 0.9)] {
        let chain: Model<f64> = Family::hydra(n, 1.0, 0.3, taper).unwrap().model().unwrap();
        let digits = check(&chain).digits.unwrap();
        for loss in &digits.measured {
            assert!(loss.f32 <= loss.predicted + 1.5 && loss.f64 <= loss.predicted + 1.5, "{n} {loss:?}");
            assert!(loss.predicted <= digits.predicted_loss + 1.0, "{n} {loss:?} {}", digits.predicted_loss);
        }
        let cholesky = digits.measured[0];
        for lost in [cholesky.f32, cholesky.f64] {
            assert!(
                (lost - digits.predicted_loss).abs() <= 1.5,
                "{n} {cholesky:?} {}",
                digits.predicted_loss
            );
        }
    }
}

#[test]
fn a_robot_that_cannot_move_has_no_findings() {
    let mut robot = ModelBuilder::new("rock");
    robot.link("rock", solid(1.0));
    let found = check(&robot.build(Base::Fixed).unwrap());
    assert!(found.worst.is_empty() && found.findings.is_empty());
}

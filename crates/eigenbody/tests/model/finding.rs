//! What is suspicious is recorded and left as it is.

use eigenbody::model::{Finding, JointSpec, MimicSpec, Place};
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, Joint, Model, ModelBuilder};

fn with_inertia(inertia: RigidInertia<f64>) -> Model<f64> {
    let mut robot = ModelBuilder::new("test");
    let base = robot.link("base", RigidInertia::ZERO);
    let tip = robot.link("tip", inertia);
    robot.joint(JointSpec::new("hinge", Joint::Revolute, base, tip));
    robot.build(Base::Fixed).unwrap()
}

fn box_of(m: f64, xx: f64, yy: f64, zz: f64) -> RigidInertia<f64> {
    RigidInertia::from_com(m, Vec3::new(0.3, -0.4, 0.2), Sym3::diagonal(xx, yy, zz))
}

fn messages(model: &Model<f64>) -> Vec<String> {
    model.findings().iter().map(ToString::to_string).collect()
}

#[test]
fn physical_links_have_none() {
    assert_eq!(messages(&with_inertia(box_of(2.0, 0.1, 0.2, 0.25))), Vec::<String>::new());
    // A flat plate: the largest moment is the sum of the other two, to rounding.
    assert_eq!(messages(&with_inertia(box_of(2.0, 0.1, 0.2, 0.3))), Vec::<String>::new());
}

#[test]
fn indefinite_inertia() {
    let model = with_inertia(box_of(2.0, 0.1, -0.2, 0.25));
    let [Finding::InertiaNotPositive { link, principal, .. }] = model.findings() else { panic!("{model:?}") };
    assert_eq!((link.index(), model.findings()[0].place()), (1, Place::Link(*link)));
    // 16 ε of m c², which was added and taken away
    for (found, expected) in principal.iter().zip([-0.2, 0.1, 0.25]) {
        assert!((found - expected).abs() <= 16.0 * f64::EPSILON * 2.0, "{principal:?}");
    }
    let message = "inertia of link 'tip' is not positive definite: principal moments -2.000e-1, 1.000e-1, 2.500e-1 kg m²";
    assert_eq!(messages(&model), [message]);
}

#[test]
fn triangle_inequality() {
    let message =
        "inertia of link 'tip' is not physical: principal moments 1.000e-1 + 2.000e-1 < 4.000e-1 kg m²";
    assert_eq!(messages(&with_inertia(box_of(2.0, 0.1, 0.4, 0.2))), [message]);
}

/// A thin rod has no moment about its axis.
#[test]
fn rod_without_thickness_is_found() {
    let model = with_inertia(box_of(1.0, 0.0, 0.1, 0.1));
    assert!(
        matches!(model.findings(), [Finding::InertiaNotPositive { principal: [0.0, ..], .. }]),
        "{model:?}"
    );
}

/// A frame without any inertia is no fault of the link, but a moving body that weighs nothing is.
#[test]
fn massless_bodies() {
    assert_eq!(messages(&with_inertia(RigidInertia::ZERO)), ["moving link 'tip' has no mass"]);

    let mut robot = ModelBuilder::new("frames");
    let base = robot.link("base", RigidInertia::ZERO);
    let arm = robot.link("arm", box_of(1.0, 0.1, 0.1, 0.1));
    let frame = robot.link("tool", RigidInertia::ZERO);
    robot.joint(JointSpec::new("hinge", Joint::Revolute, base, arm));
    robot.joint(JointSpec::new("flange", Joint::Fixed, arm, frame));
    assert_eq!(messages(&robot.build(Base::Fixed).unwrap()), Vec::<String>::new());
}

/// A mimic joint that cannot follow is found and left free. Of a cylindrical joint it was said that it does not move.
#[test]
fn mimic_of_what_cannot_be_followed() {
    for (kind, follows, message) in [
        (Joint::Revolute, "thumb", "which is no moving joint"),
        (Joint::Fixed, "palm", "which is no moving joint"),
        (Joint::Cylindrical, "palm", "which has 2 coordinates"),
        (Joint::Spherical, "palm", "which has 4 coordinates"),
    ] {
        let mut robot = ModelBuilder::<f64>::new("test");
        let base = robot.link("base", RigidInertia::ZERO);
        let hand = robot.link("hand", box_of(1.0, 0.1, 0.1, 0.1));
        let tip = robot.link("tip", box_of(1.0, 0.1, 0.1, 0.1));
        robot.joint(JointSpec::new("palm", kind, base, hand));
        let mimic = Some(MimicSpec { joint: follows.into(), multiplier: 1.0, offset: 0.0 });
        let joint = robot.joint(JointSpec { mimic, ..JointSpec::new("finger", Joint::Revolute, hand, tip) });
        let model = robot.build(Base::Fixed).unwrap();
        let message = format!("mimic joint 'finger' follows '{follows}', {message}; it is left free");
        assert_eq!(messages(&model), [message]);
        assert_eq!(model.findings()[0].place(), Place::Joint(joint));
        assert!(model.coupling().is_none());
    }
}

/// A chain of balls of this mass and radius of gyration.
fn balls(names: &[&str], m: &[f64], radius: f64) -> Model<f64> {
    let mut robot = ModelBuilder::new("test");
    let mut last = robot.link("base", RigidInertia::ZERO);
    for (name, &m) in names.iter().zip(m) {
        let i = m * radius * radius;
        let link = robot.link(*name, RigidInertia::from_com(m, Vec3::ZERO, Sym3::diagonal(i, i, i)));
        robot.joint(JointSpec::new(*name, Joint::Revolute, last, link));
        last = link;
    }
    robot.build(Base::Fixed).unwrap()
}

#[test]
fn masses_in_grams_and_lengths_in_millimetres() {
    assert_eq!(messages(&balls(&["a", "b", "c"], &[1.0; 3], 0.05)), Vec::<String>::new());
    let expected = "links have a density of about 1.0e6 kg/m³: masses in grams, where kg and m are expected?";
    assert_eq!(messages(&balls(&["a", "b", "c"], &[1000.0; 3], 0.05)), [expected]);
    let expected =
        "links have a density of about 1.0e-6 kg/m³: lengths in millimetres, where kg and m are expected?";
    assert_eq!(messages(&balls(&["a", "b", "c"], &[1.0; 3], 50.0)), [expected]);
}

#[test]
fn a_mass_spread_wider_than_any_robot() {
    let model = balls(&["wide"], &[1.0], 30.0);
    assert_eq!(messages(&model), ["mass of link 'wide' is spread over 3.000e1 m (radius of gyration)"]);
}

#[test]
fn twins_that_differ() {
    let names = ["left_leg", "right_leg", "l_arm", "r_arm"];
    let model = balls(&names, &[1.0, 1.1, 2.0, 2.0], 0.1);
    assert_eq!(
        messages(&model),
        ["links 'left_leg' and 'right_leg' have different masses or moments of inertia"]
    );
    let Place::Link(link) = model.findings()[0].place() else { panic!("{model:?}") };
    assert_eq!(link.index(), 1);
}

/// A model with another inertia has the findings of that one, as if it had been built with it.
#[test]
fn findings_follow_a_changed_inertia() {
    let names = ["left_leg", "right_leg", "l_arm", "r_arm"];
    let model = balls(&names, &[1.0, 1.1, 2.0, 2.0], 0.1);
    let ball = |m: f64, r: f64| {
        RigidInertia::from_com(m, Vec3::ZERO, Sym3::diagonal(m * r * r, m * r * r, m * r * r))
    };
    let with = |link: usize, inertia| messages(&model.clone().with_inertia(link, inertia).unwrap());
    let legs = "links 'left_leg' and 'right_leg' have different masses or moments of inertia";
    let arms = "links 'l_arm' and 'r_arm' have different masses or moments of inertia";
    assert_eq!(with(1, ball(1.1, 0.1)), Vec::<String>::new());
    assert_eq!(with(2, ball(1.0, 0.1)), Vec::<String>::new());
    assert_eq!(with(2, ball(1.2, 0.1)), [legs]);
    assert_eq!(with(4, ball(3.0, 0.1)), [legs, arms]);
    let wide = "mass of link 'right_leg' is spread over 3.000e1 m (radius of gyration)";
    assert_eq!(with(2, ball(1.1, 30.0)), [wide, legs]);
    let massless = model.clone().with_inertia(3, RigidInertia::ZERO).unwrap();
    assert_eq!(messages(&massless), [legs, "moving link 'l_arm' has no mass"]);
    assert_eq!(messages(&massless.with_inertia(3, ball(2.0, 0.1)).unwrap()), [legs]);

    let tip = with_inertia(box_of(2.0, 0.1, 0.4, 0.2)).with_inertia(1, box_of(2.0, 0.1, 0.2, 0.2)).unwrap();
    assert_eq!(messages(&tip), Vec::<String>::new());
    let flat = tip.with_inertia(1, box_of(2.0, 0.1, 0.4, 0.2)).unwrap();
    assert_eq!(messages(&flat), messages(&with_inertia(box_of(2.0, 0.1, 0.4, 0.2))));
}

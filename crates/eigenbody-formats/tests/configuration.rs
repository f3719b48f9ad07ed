//! Configurations by name.

use eigenbody::{Base, Model, Posture};
use eigenbody_formats::{LoadOptions, UrdfOptions, configuration, load, read_urdf_str};
use insta::assert_snapshot;
use std::f64::consts::PI;

fn family(text: &str) -> Model<f64> {
    load(text, &LoadOptions::default()).unwrap().model
}

/// Joints `a`, `arm/left-2.x:y` and the mimic joint `b` = 2·a + 0.5, then a floating joint `ball`.
fn gripper(base: Base) -> Model<f64> {
    let joint = |name: &str, kind: &str, child: &str, rest: &str| {
        format!(
            r#"<link name="{child}"/>
               <joint name="{name}" type="{kind}"><parent link="base"/><child link="{child}"/>{rest}</joint>"#
        )
    };
    let text = [
        r#"<robot name="gripper"><link name="base"/>"#.into(),
        joint("a", "revolute", "l1", r#"<limit lower="-1" upper="2"/>"#),
        joint("arm/left-2.x:y", "continuous", "l2", ""),
        joint("b", "prismatic", "l3", r#"<mimic joint="a" multiplier="2" offset="0.5"/>"#),
        joint("ball", "floating", "l4", ""),
        joint("x=y, z", "continuous", "l5", ""),
        joint("weld", "fixed", "l6", ""),
        "</robot>".into(),
    ];
    read_urdf_str(&text.concat(), "gripper.urdf", &UrdfOptions { base }).unwrap().model
}

fn error(text: &str, model: &Model<f64>) -> String {
    configuration(text, model, true).unwrap_err().to_string()
}

#[test]
fn postures_are_those_of_the_core() {
    let model = family("auto_tree(9)");
    let posture = |text| configuration(text, &model, true).unwrap();
    assert_eq!(posture(" zero "), Posture::Zero.configuration(&model));
    assert_eq!(posture("zag(pi/2)"), Posture::Zag(PI / 2.0).configuration(&model));
    assert_eq!(posture(" curl ( -0.1 ) "), Posture::Curl(-0.1).configuration(&model));
    assert_eq!(posture("random(7)"), model.random(7));
    assert_eq!(posture("random(18446744073709551615)"), model.random(u64::MAX));
}

#[test]
fn all_coordinates_can_be_listed() {
    let model = family("hydra(3)");
    assert_eq!(configuration("q = [ 1, -pi, 1e-3 ]", &model, true).unwrap(), [1.0, -PI, 1e-3]);
    assert_snapshot!(error("q=[1, 2]", &model), @"q=[1, 2], column 3: q has 2 numbers, expected 3");
    assert_snapshot!(error("q=[]", &model), @"q=[], column 3: q has 0 numbers, expected 3");
    assert_snapshot!(error("q=[1, 2, 3, 4]", &model), @"q=[1, 2, 3, 4], column 3: q has 4 numbers, expected 3");
    assert_snapshot!(error("q=[1, 2, three]", &model), @"q=[1, 2, three], column 10: 'three' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("q=[1, 2, 3", &model), @"q=[1, 2, 3, column 11: expected ']', found the end");
    assert_snapshot!(error("q=[1, 2, 3] + 1", &model), @"q=[1, 2, 3] + 1, column 13: expected the end, found '+'");
    assert_snapshot!(error("q=1", &model), @"q=1, column 1: q takes a list of 3 numbers: q=[..]");
}

#[test]
fn joints_can_be_named() {
    let model = gripper(Base::Fixed);
    // a, arm/left-2.x:y, b, ball (x, y, z, w, x, y, z), "x=y, z"
    let at = |text| configuration(text, &model, false).unwrap();
    assert_eq!(at("a=1, b=3")[..4], [1.0, 0.0, 3.0, 0.0]);
    assert_eq!(at("arm/left-2.x:y = pi/2,a=[2]")[..3], [2.0, PI / 2.0, 0.0]);
    assert_eq!(at("ball=[1, 2, 3, 0, 0, 0, -1], a=1")[3..10], [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, -1.0]);
    assert_eq!(at("x=y, z=2, b=1"), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0]);
}

#[test]
fn a_floating_base_is_a_joint() {
    let model = gripper(Base::Floating);
    let q = configuration("floating_base=[1, 2, 3, 0, 1, 0, 0]", &model, true).unwrap();
    assert_eq!(q[..7], [1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!(configuration("zero", &model, true).unwrap()[..7], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn a_joint_called_q_is_told_from_the_whole_of_q() {
    let text = r#"<robot name="r"><link name="a"/><link name="b"/>
        <joint name="q" type="continuous"><parent link="a"/><child link="b"/></joint></robot>"#;
    let model = read_urdf_str(text, "r.urdf", &UrdfOptions::default()).unwrap().model;
    assert_eq!(configuration("q=2", &model, true).unwrap(), [2.0]);
    assert_eq!(configuration("q=[3]", &model, true).unwrap(), [3.0]);
}

#[test]
fn mimic_joints_follow_where_they_are_coupled() {
    let model = gripper(Base::Fixed);
    let coupled = |text| configuration(text, &model, true).unwrap();
    // b = 2 a + 0.5, which is 0.5 where a is zero.
    assert_eq!(coupled("zero")[..3], [0.0, 0.0, 0.5]);
    assert_eq!(coupled("a=1")[..3], [1.0, 0.0, 2.5]);
    assert_eq!(coupled("curl(1)")[..3], [1.0, 1.0, 2.5]);
    assert_eq!(coupled("q=[1, 2, 0, 0, 0, 1, 0, 0, 0, 4]"), [1., 2., 2.5, 0., 0., 0., 1., 0., 0., 0., 4.]);
    let (random, free) = (coupled("random(3)"), model.random(3));
    assert_eq!((random[0], random[1], random[2]), (free[0], free[1], 2.0 * free[0] + 0.5));
    assert_eq!(random[3..], free[3..]);

    let free = |text| configuration(text, &model, false).unwrap();
    assert_eq!(free("zero")[..3], [0.0, 0.0, 0.0]);
    assert_eq!(free("random(3)"), model.random(3));

    assert_snapshot!(error("b=1", &model), @"b=1, column 1: joint 'b' is a mimic joint: it follows another and has no value of its own");
    assert_snapshot!(error("q=[1, 2, 3]", &model), @"q=[1, 2, 3], column 3: q has 3 numbers, expected 10 independent coordinates");
    assert_snapshot!(error("a=1e308", &model), @"a=1e308, column 1: q[2] is not a finite number");
}

#[test]
fn impossible_values_are_refused() {
    let model = gripper(Base::Fixed);
    assert_snapshot!(error("c=1", &model), @"c=1, column 1: no moving joint is named 'c'");
    assert_snapshot!(error("weld=1", &model), @"weld=1, column 1: no moving joint is named 'weld'");
    assert_snapshot!(error("a=1, arm/left2.x:y=2", &model), @"a=1, arm/left2.x:y=2, column 6: no moving joint is named 'arm/left2.x:y'; did you mean 'arm/left-2.x:y'?");
    assert_snapshot!(error("a=1, a=2", &model), @"a=1, a=2, column 6: a second value for joint 'a'");
    assert_snapshot!(error("a=[1, 2]", &model), @"a=[1, 2], column 3: joint 'a' takes one number, found 2");
    assert_snapshot!(error("a=1, ball=3", &model), @"a=1, ball=3, column 11: joint 'ball' takes a list of 7 numbers, found 1");
    assert_snapshot!(error("ball=[0, 0, 0, 1, 1, 0, 0]", &model), @"ball=[0, 0, 0, 1, 1, 0, 0], column 6: q[6..10] of joint 'ball' has norm 1.4142135623730951, expected a unit quaternion w, x, y, z");
    assert_snapshot!(error("q=[0, 0, 0, 0, 0, 2, 0, 0, 0, 0]", &model), @"q=[0, 0, 0, 0, 0, 2, 0, 0, 0, 0], column 19: q[6..10] of joint 'ball' has norm 2, expected a unit quaternion w, x, y, z");
    assert_snapshot!(error("a=nan", &model), @"a=nan, column 3: 'nan' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("a=1/0", &model), @"a=1/0, column 4: the value is not a finite number");
    assert_snapshot!(error("a=", &model), @"a=, column 3: the text ends here; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("a=1,", &model), @"a=1,, column 5: expected joint=value");
    assert_snapshot!(error("a=1 b=2", &model), @"a=1 b=2, column 5: expected ',' or the end, found 'b'");
}

#[test]
fn what_is_no_configuration_is_told_what_one_is() {
    let model = family("hydra(3)");
    assert_snapshot!(error("", &model), @"empty text, column 1: no configuration; expected zero, zag(angle), curl(angle), random(seed), q=[..] or joint=value, ..");
    assert_snapshot!(error("home", &model), @"home, column 1: no configuration; expected zero, zag(angle), curl(angle), random(seed), q=[..] or joint=value, ..");
    assert_snapshot!(error("zag", &model), @"zag, column 1: no configuration; expected zero, zag(angle), curl(angle), random(seed), q=[..] or joint=value, ..");
    assert_snapshot!(error("zag(banana)", &model), @"zag(banana), column 5: 'banana' is not a number; expected a number such as 0.3 or pi/2");
    assert_snapshot!(error("zag(1", &model), @"zag(1, column 6: expected ')', found the end");
    assert_snapshot!(error("zag(1, 2)", &model), @"zag(1, 2), column 6: expected ')', found ','");
    assert_snapshot!(error("zero(1)", &model), @"zero(1), column 1: no configuration; expected zero, zag(angle), curl(angle), random(seed), q=[..] or joint=value, ..");
    assert_snapshot!(error("random(1.5)", &model), @"random(1.5), column 8: expected a whole number from 0 to 18446744073709551615");
    assert_snapshot!(error("random(-1)", &model), @"random(-1), column 8: expected a whole number from 0 to 18446744073709551615");
    assert_snapshot!(error("random(18446744073709551616)", &model), @"random(18446744073709551616), column 8: expected a whole number from 0 to 18446744073709551615");
    assert_snapshot!(error("jiont_2=1", &model), @"jiont_2=1, column 1: no moving joint is named 'jiont_2'; did you mean 'joint_2'?");
}

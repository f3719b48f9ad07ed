//! What else a joint says: limits, mimic, order; and what is passed over.

use super::{joint, model};

const LINKS: &str = r#"<link name="base"/><link name="a"/><link name="b"/>"#;

#[test]
fn limits_are_those_of_revolute_and_prismatic_joints() {
    let limits = |kind: &str, rest: &str| {
        let text = r#"<link name="base"/><link name="a"/>"#.to_owned() + &joint(kind, "base", "a", rest);
        model(&text).joints()[0].limits()
    };
    assert_eq!(limits("revolute", r#"<limit lower="-1" upper="2.5" effort="1"/>"#), Some((-1.0, 2.5)));
    assert_eq!(limits("prismatic", r#"<limit upper="2.5"/>"#), Some((0.0, 2.5)));
    assert_eq!(limits("revolute", ""), None);
    assert_eq!(limits("continuous", r#"<limit lower="-1" upper="1"/>"#), None);
    assert_eq!(limits("planar", r#"<limit lower="-1" upper="1"/>"#), None);
}

#[test]
fn a_mimic_joint_is_in_the_coupling() {
    let follow = |mimic: &str| {
        let leader = joint("continuous", "base", "a", "");
        let text = format!("{LINKS}{}{leader}", joint("prismatic", "base", "b", mimic));
        // b stands first in the file, so first in q.
        model(&text).coupling().map(|coupling| coupling.expand(&[3.0]))
    };
    assert_eq!(follow(""), None);
    assert_eq!(follow(r#"<mimic joint="a"/>"#), Some(vec![3.0, 3.0]));
    assert_eq!(follow(r#"<mimic joint="a" multiplier="-2" offset="0.5"/>"#), Some(vec![-5.5, 3.0]));
}

#[test]
fn coordinates_follow_the_order_of_the_joints() {
    let (a, b) = (joint("continuous", "base", "a", ""), joint("continuous", "a", "b", ""));
    let names = |text: &str| model(text).joints().iter().map(|j| j.name().to_owned()).collect::<Vec<_>>();
    assert_eq!(names(&format!("{LINKS}{a}{b}")), ["a", "b"]);
    assert_eq!(names(&format!("{b}{LINKS}{a}")), ["b", "a"]);
}

#[test]
fn what_does_not_touch_inertia_is_passed_over() {
    let hinge = joint(
        "revolute",
        "base",
        "a",
        r#"<dynamics friction="nan"/><safety_controller k_velocity="x"/><calibration rising="?"/>"#,
    );
    let rest = r#"
        <!-- comment --> stray text
        <material name="blue"><color rgba="0 0 1 1"/></material>
        <transmission name="t"><type>simple</type><joint name="t1"><hardwareInterface/></joint></transmission>
        <gazebo reference="a"><link name="c"/><joint name="g"/></gazebo>
        <ros2_control name="c" type="system"><joint name="a"/></ros2_control>
        <foreign:link xmlns:foreign="http://example.org/other"/>"#;
    let base = r#"<link name="base"><visual><origin xyz="a b"/></visual><collision/></link><link name="a"/>"#;
    let model = model(&format!("{base}{hinge}{rest}"));
    assert_eq!((model.links().len(), model.nv()), (2, 1));
}

#[test]
fn damping_is_a_number() {
    let hinge = joint("revolute", "base", "a", r#"<dynamics damping="nan"/>"#);
    let text = format!(r#"<robot name="r"><link name="base"/><link name="a"/>{hinge}</robot>"#);
    let refused =
        eigenbody_formats::read_urdf_str(&text, "r.urdf", &Default::default()).unwrap_err().to_string();
    assert!(refused.starts_with("r.urdf:1:") && refused.contains("damping"), "{refused}");
}

#[test]
fn a_file_may_have_a_namespace() {
    let text = r#"<robot name="r" xmlns="http://www.ros.org"><link name="base"/></robot>"#;
    let loaded = eigenbody_formats::read_urdf_str(text, "r.urdf", &Default::default()).unwrap();
    assert_eq!(loaded.model.links().len(), 1);
}

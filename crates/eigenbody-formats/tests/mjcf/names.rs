//! Names, order, configurations, findings.

use super::{loaded, world};
use eigenbody::Base;
use eigenbody::model::{JointInfo, LinkInfo};
use eigenbody_formats::{MjcfOptions, read_mjcf_str};
use insta::assert_snapshot;

const BALL: &str = "<geom size='.1'/>";

#[test]
fn replicated_names_count_with_the_digits_of_the_last() {
    let inner = "<replicate count='2'><body name='l'><joint name='j'/><geom size='.1'/></body></replicate>";
    let found =
        world(&format!("<replicate count='11' sep='-'><body name='k'>{inner}{BALL}</body></replicate>"));
    let names: Vec<&str> = found.model.joints().iter().map(JointInfo::name).collect();
    assert_eq!((names.len(), names[0], names[1], names[21]), (22, "j0-00", "j1-00", "j1-10"));
}

#[test]
fn what_has_no_name_gets_one_that_is_free() {
    let found = world(&format!(
        "<body name='body_2'><joint name='joint_0'/>{BALL}<body><joint/>{BALL}</body></body>"
    ));
    let joints: Vec<&str> = found.model.joints().iter().map(JointInfo::name).collect();
    let links: Vec<&str> = found.model.links().iter().map(LinkInfo::name).collect();
    assert_eq!(joints, ["joint_0", "joint_1"]);
    assert_eq!(links, ["world", "body_2", "body_2_"]);
}

#[test]
fn a_chain_of_joints_in_one_body_is_no_finding() {
    let found = world(&format!("<body><joint/><joint axis='1 0 0'/>{BALL}</body>"));
    assert_eq!(found.findings(), Vec::<String>::new());
    assert_eq!(found.model.bodies().len(), 2);
}

#[test]
fn findings_point_at_the_element() {
    let text = "<mujoco>
  <worldbody>
    <body name='a'><joint name='a'/><geom size='.1'/><body name='b'><joint name='b'/></body></body>
    <body name='c'><joint name='c'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 3'/></body>
  </worldbody>
  <equality><weld body1='a' body2='c'/><joint joint1='a' joint2='b' polycoef='0 1 1'/></equality>
  <tendon><fixed name='t' armature='1'><joint joint='a' coef='1'/><joint joint='b' coef='1'/></fixed></tendon>
</mujoco>";
    assert_snapshot!(loaded(text).findings().join("\n"), @"
    test.xml:4:5: warning: inertia of link 'c' is not physical: principal moments 1.000e0 + 1.000e0 < 3.000e0 kg m²
    test.xml:3:54: warning: moving link 'b' has no mass
    test.xml:6:13: warning: <weld> closes a loop: H is that of the tree without it; --loops closed is with it
    test.xml:6:40: warning: <joint> is an equality that --mimic on does not apply
    test.xml:7:11: warning: fixed 't' has armature that couples several joints: H is without it
    ");
}

#[test]
fn equalities_are_followed_on_request() {
    let text = format!(
        "<mujoco><compiler angle='radian'/><worldbody>
           <body><joint name='a' ref='0.1'/>{BALL}<body pos='1 0 0'><joint name='b' ref='0.2'/>{BALL}</body></body>
         </worldbody><equality>
           <joint joint1='b' joint2='a' polycoef='0.5 2'/>
           <joint joint1='a' joint2='b'/><joint joint1='b' joint2='a' active='false'/>
         </equality></mujoco>"
    );
    let found = loaded(&text);
    assert!(!found.mimic);
    let coupling = found.model.coupling().unwrap();
    assert_eq!(coupling.nv(), 1);
    // b − 0.2 = 0.5 + 2 (a − 0.1)
    let q = coupling.expand(&[0.4]);
    // 4 ε of the largest
    assert!((q[1] - (0.2 + 0.5 + 2.0 * 0.3)).abs() < 4.0 * f64::EPSILON * 1.3, "{q:?}");
    // The second closes a circle and is noted, the third is off.
    assert_eq!(found.findings().len(), 1);
}

#[test]
fn keyframes_are_configurations() {
    let text = format!(
        "<mujoco><worldbody><body pos='1 0 0'><freejoint/>{BALL}<body><joint name='a' ref='90'/>{BALL}</body></body></worldbody>
         <keyframe><key name='home' qpos='0 0 1 2 0 0 0 0.5'/><key/></keyframe></mujoco>"
    );
    let found = loaded(&text);
    let at = |text: &str| found.configuration(text, false).unwrap();
    assert_eq!(at("home"), [0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.5]);
    assert_eq!(at("key:home"), at("home"));
    assert_eq!(at("qpos0"), [1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    assert_eq!(at("key:1"), at("qpos0"));
    assert_eq!(at("a=0.1")[7], 0.1);
}

#[test]
fn one_tree_may_float() {
    let floating = MjcfOptions { base: Base::Floating };
    let read = |bodies: &str| {
        let text = format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>");
        read_mjcf_str(&text, "test.xml", &floating).map(|l| l.model)
    };
    let arm = format!("<body name='root'>{BALL}<body pos='1 0 0'><joint armature='1'/>{BALL}</body></body>");
    let model = read(&arm).unwrap();
    assert_eq!((model.nv(), model.has_floating_base()), (7, true));
    let free = format!("<body><joint type='free' armature='2'/>{BALL}</body>");
    let model = read(&free).unwrap();
    assert_eq!((model.nv(), model.armature()), (6, [2.0; 6].as_slice()));
    // What a free joint may not have where it is a joint, it may not have as the floating base: that was passed over.
    assert_snapshot!(read(&free.replace("'2'", "'-2'")).unwrap_err(), @"test.xml:1:26: the floating base has armature[0] = -2, expected zero or more");
    assert_snapshot!(read(&arm.repeat(2).replace(" name='root'", "")).unwrap_err(), @"test.xml: a floating base needs exactly one body in the world, welded to it or free");
}

#[test]
fn gravity_is_the_files() {
    let gravity = |option: &str| {
        let g = loaded(&format!("<mujoco>{option}<worldbody><body>{BALL}</body></worldbody></mujoco>"))
            .model
            .gravity();
        g.to_array()
    };
    assert_eq!(gravity(""), [0.0, 0.0, -9.81]);
    assert_eq!(gravity("<option gravity='1 2 3'/>"), [1.0, 2.0, 3.0]);
    assert_eq!(gravity("<option><flag gravity='disable'/></option>"), [0.0; 3]);
}

//! Every fault, at its place, in one line.

use eigenbody_formats::{UrdfOptions, read_urdf_str};
use insta::assert_snapshot;

fn fault_of(text: &str) -> String {
    read_urdf_str(text, "r.urdf", &UrdfOptions::default()).unwrap_err().to_string()
}

/// A robot of these elements, which begin at line 2.
fn fault(elements: &str) -> String {
    fault_of(&format!("<robot name=\"r\">\n{elements}\n</robot>"))
}

/// Links `a`, `b` and `c` on line 2, joints on the following lines.
fn joints(joints: &str) -> String {
    fault(&format!(r#"<link name="a"/><link name="b"/><link name="c"/>{}{joints}"#, '\n'))
}

/// Links `a` and `b` and a joint of a kind between them, all on line 2.
fn joint(kind: &str, rest: &str) -> String {
    let links = r#"<link name="a"/><link name="b"/>"#;
    let ends = r#"<parent link="a"/><child link="b"/>"#;
    fault(&format!(r#"{links}<joint name="j" type="{kind}">{ends}{rest}</joint>"#))
}

fn inertial(parts: &str) -> String {
    fault(&format!(r#"<link name="a"><inertial>{parts}</inertial></link>"#))
}

const MASS: &str = r#"<mass value="1"/>"#;
const INERTIA: &str = r#"<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>"#;

#[test]
fn text_that_is_no_xml() {
    assert_snapshot!(fault_of(""), @"r.urdf:1:1: not well-formed XML: the document does not have a root node");
    assert_snapshot!(fault_of("banana"), @"r.urdf:1:1: not well-formed XML: unknown token");
    assert_snapshot!(fault_of("<robot name='r'>\n  <link name='a'>\n</robot>"), @"r.urdf:3:1: not well-formed XML: expected 'link' tag, not 'robot'");
    assert_snapshot!(fault_of("<robot name='r'>\n<link name='a'/>"), @"r.urdf:1:1: not well-formed XML: the root node was opened but never closed");
    assert_snapshot!(fault_of("<robot name='r' name='s'/>"), @"r.urdf:1:17: not well-formed XML: attribute 'name' is already defined");
    assert_snapshot!(fault_of("<robot name='r'>\n<sensor:camera/></robot>"), @"r.urdf:1:1: the model has no links");
    assert_snapshot!(fault_of("<robot name='&lol;'/>"), @"r.urdf:1:14: not well-formed XML: unknown entity reference 'lol'");
}

#[test]
fn entities_are_not_expanded() {
    let bomb = r#"<!DOCTYPE lolz [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]><robot name="&b;"/>"#;
    assert_snapshot!(fault_of(bomb), @"r.urdf:1:1: document type declarations (<!DOCTYPE .. [..]>) are refused");
}

#[test]
fn xml_that_is_no_urdf() {
    assert_snapshot!(fault_of("<mujoco model='arm'/>"), @"r.urdf:1:1: no URDF: the root element <mujoco> is that of an MJCF file");
    assert_snapshot!(fault_of("<!-- world -->\n<sdf version='1.9'/>"), @"r.urdf:2:1: no URDF: the root element <sdf> is that of an SDF file");
    assert_snapshot!(fault_of("<html/>"), @"r.urdf:1:1: no URDF: the root element is <html>, expected <robot>");
    let xacro = r#"<robot name="r" xmlns:xacro="http://wiki.ros.org/xacro"><xacro:include/></robot>"#;
    assert_snapshot!(fault_of(xacro), @"r.urdf:1:57: <xacro:include> is a xacro macro; expand the file with xacro first");
    assert_snapshot!(fault_of("<robot/>"), @"r.urdf:1:1: the model has no links");
    assert_snapshot!(fault_of("\n<robot name='r'/>"), @"r.urdf:2:1: the model has no links");
}

#[test]
fn parts_that_are_missing() {
    assert_snapshot!(fault("<link/>"), @"r.urdf:2:1: <link> has no attribute 'name'");
    assert_snapshot!(joints("<joint type='fixed'/>"), @"r.urdf:3:1: <joint> has no attribute 'name'");
    assert_snapshot!(joints("<joint name='j'/>"), @"r.urdf:3:1: joint 'j' has no attribute 'type'");
    assert_snapshot!(joints("<joint name='j' type='fixed'/>"), @"r.urdf:3:1: joint 'j' has no <parent>");
    assert_snapshot!(joints("<joint name='j' type='fixed'><parent/></joint>"), @"r.urdf:3:30: <parent> has no attribute 'link'");
    assert_snapshot!(joints("<joint name='j' type='fixed'><parent link='a'/></joint>"), @"r.urdf:3:1: joint 'j' has no <child>");
    assert_snapshot!(inertial(&format!("<mass/>{INERTIA}")), @"r.urdf:2:26: <mass> has no attribute 'value'");
    assert_snapshot!(joint("revolute", "<axis/>"), @"r.urdf:2:100: <axis> has no attribute 'xyz'");
    assert_snapshot!(joint("revolute", "<mimic/>"), @"r.urdf:2:100: <mimic> has no attribute 'joint'");
}

#[test]
fn parts_that_are_there_twice() {
    assert_snapshot!(fault("<link name='a'><inertial/>\n  <inertial/></link>"), @"r.urdf:3:3: a second <inertial> in one <link>");
    assert_snapshot!(inertial(&format!("{MASS}{MASS}{INERTIA}")), @"r.urdf:2:43: a second <mass> in one <inertial>");
    assert_snapshot!(joint("revolute", "<axis xyz='1 0 0'/><axis xyz='0 1 0'/>"), @"r.urdf:2:119: a second <axis> in one <joint>");
    assert_snapshot!(joint("revolute", "<parent link='a'/>"), @"r.urdf:2:100: a second <parent> in one <joint>");
    assert_snapshot!(joint("revolute", "<origin rpy='0 0 0' quat_xyzw='0 0 0 1'/>"), @"r.urdf:2:120: <origin> has both 'rpy' and 'quat_xyzw', expected one orientation");
}

#[test]
fn numbers_that_are_none() {
    for (text, name) in
        [("nan", "NaN"), ("inf", "infinity"), ("-Infinity", "infinity"), ("1e999", "overflow")]
    {
        let message = inertial(&format!(r#"<mass value="{text}"/>{INERTIA}"#));
        assert!(message.ends_with(&format!("holds '{text}', expected a finite number")), "{name}: {message}");
    }
    assert_snapshot!(inertial(&format!("<mass value='heavy'/>{INERTIA}")), @"r.urdf:2:32: 'value' of <mass> holds 'heavy', expected a finite number");
    assert_snapshot!(inertial(&format!("<mass value=''/>{INERTIA}")), @"r.urdf:2:32: 'value' of <mass> holds 0 numbers, expected 1");
    assert_snapshot!(inertial(&format!("<mass value='1 2'/>{INERTIA}")), @"r.urdf:2:32: 'value' of <mass> holds 2 numbers, expected 1");
    assert_snapshot!(joint("revolute", "<origin xyz='0'/>"), @"r.urdf:2:108: 'xyz' of <origin> holds 1 number, expected 3");
    assert_snapshot!(joint("revolute", "<origin xyz='0 0'/>"), @"r.urdf:2:108: 'xyz' of <origin> holds 2 numbers, expected 3");
    assert_snapshot!(joint("revolute", "<origin xyz='0 0 0 0'/>"), @"r.urdf:2:108: 'xyz' of <origin> holds 4 numbers, expected 3");
    assert_snapshot!(joint("revolute", "<origin xyz='0 0,5 0'/>"), @"r.urdf:2:108: 'xyz' of <origin> holds '0,5', expected a finite number");
    assert_snapshot!(joint("revolute", "<origin rpy='0 ${pi} 0'/>"), @"r.urdf:2:108: 'rpy' of <origin> holds '${pi}', expected a finite number");
    assert_snapshot!(joint("revolute", "<origin quat_xyzw='0 0 0 0'/>"), @"r.urdf:2:108: 'quat_xyzw' of <origin> has norm 0, expected a unit quaternion x y z w");
    assert_snapshot!(joint("revolute", "<limit lower='-inf' upper='1'/>"), @"r.urdf:2:107: 'lower' of <limit> holds '-inf', expected a finite number");
    assert_snapshot!(joint("revolute", "<mimic joint='k' multiplier='twice'/>"), @"r.urdf:2:117: 'multiplier' of <mimic> holds 'twice', expected a finite number");
}

#[test]
fn numbers_that_no_robot_has() {
    assert_snapshot!(inertial(&format!("<mass value='-1'/>{INERTIA}")), @"r.urdf:2:1: link 'a' has mass -1, expected zero or more (kg)");
    assert_snapshot!(inertial(&format!("<origin xyz='1e200 0 0'/>{MASS}{INERTIA}")), @"r.urdf:2:1: inertia of link 'a' is not a finite number");
    assert_snapshot!(joint("revolute", "<axis xyz='0 0 0'/>"), @"r.urdf:2:33: joint 'j' has axis 0 0 0, expected a direction");
}

#[test]
fn joints_of_no_known_kind() {
    assert_snapshot!(joint("hinge", ""), @"r.urdf:2:49: joint 'j' has type 'hinge', expected one of revolute, continuous, prismatic, fixed, floating, planar");
    assert_snapshot!(joint("Revolute", ""), @"r.urdf:2:49: joint 'j' has type 'Revolute', expected one of revolute, continuous, prismatic, fixed, floating, planar");
}

#[test]
fn joints_between_links_that_are_not_there() {
    let between = |parent: &str, child: &str| {
        let links = r#"<link name="shoulder"/><link name="b"/>"#;
        fault(&format!(
            "{links}\n<joint name='j' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>"
        ))
    };
    assert_snapshot!(between("sholuder", "b"), @"r.urdf:3:38: joint 'j' names parent link 'sholuder', which is not in the file; did you mean 'shoulder'?");
    assert_snapshot!(between("shoulder", "elbow"), @"r.urdf:3:62: joint 'j' names child link 'elbow', which is not in the file");
}

#[test]
fn names_that_are_there_twice() {
    assert_snapshot!(fault("<link name='a'/>\n<link name='b'/>\n  <link name='a'/>"), @"r.urdf:4:3: a second link is named 'a'; the first is at 2:1");
    let twice = "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>
  <joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>";
    assert_snapshot!(joints(twice), @"r.urdf:4:3: a second joint is named 'j'; the first is at 3:1");
}

#[test]
fn links_that_are_no_tree() {
    let fixed = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name='{name}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>\n"
        )
    };
    let (ab, ac, bc) = (fixed("ab", "a", "b"), fixed("ac", "a", "c"), fixed("bc", "b", "c"));
    let (cb, ca, aa) = (fixed("cb", "c", "b"), fixed("ca", "c", "a"), fixed("aa", "a", "a"));
    assert_snapshot!(joints(&ab), @"r.urdf:2:33: two root links, 'a' and 'c'; a tree has one link that is no joint's child");
    assert_snapshot!(joints(&[&*ab, &ac, &bc].concat()), @"r.urdf:5:1: link 'c' is the child of joint 'ac' and of joint 'bc'; in a tree a link has one parent");
    assert_snapshot!(joints(&[&*ab, &bc, &ca].concat()), @"r.urdf:5:1: joint 'ca' closes a loop: its child link 'a' is among its own ancestors");
    assert_snapshot!(joints(&[&*bc, &cb].concat()), @"r.urdf:4:1: joint 'cb' closes a loop: its child link 'b' is among its own ancestors");
    assert_snapshot!(joints(&[&*aa, &ab, &ac].concat()), @"r.urdf:3:1: joint 'aa' closes a loop: its child link 'a' is among its own ancestors");
}

#[test]
fn joints_that_mimic_each_other() {
    let follow = |name: &str, child: &str, of: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent link='a'/><child link='{child}'/><mimic joint='{of}'/></joint>\n"
        )
    };
    assert_snapshot!(joints(&(follow("j", "b", "k") + &follow("k", "c", "j"))), @"r.urdf:3:1: joint 'j' mimics itself, directly or through others");
    assert_snapshot!(joints(&(follow("j", "b", "j") + &follow("k", "c", "j"))), @"r.urdf:3:1: joint 'j' mimics itself, directly or through others");
    assert_snapshot!(joint("planar", "<mimic joint='k'/>"), @"r.urdf:2:33: joint 'j' of kind planar cannot mimic another: only joints with one coordinate can");
}

#[test]
fn inertials_that_are_not_whole_are_noted() {
    let notes = |parts: &str| {
        let text = format!("<robot name='r'><link name='a'><inertial>{parts}</inertial></link></robot>");
        let loaded = read_urdf_str(&text, "r.urdf", &UrdfOptions::default()).unwrap();
        loaded.findings().last().cloned().unwrap_or_default()
    };
    assert_snapshot!(notes(""), @"r.urdf:1:17: warning: <inertial> of link 'a' has no <mass>: it counts for nothing");
    assert_snapshot!(notes(INERTIA), @"r.urdf:1:17: warning: <inertial> of link 'a' has no <mass>: it counts for nothing");
    assert_snapshot!(notes(MASS), @"r.urdf:1:17: warning: <inertial> of link 'a' has no <inertia> of six entries: its mass counts as a point");
    assert_snapshot!(notes(&format!("{MASS}{}", INERTIA.replace(r#"iyz="0""#, ""))), @"r.urdf:1:17: warning: <inertial> of link 'a' has no <inertia> of six entries: its mass counts as a point");
}

/// A word that nobody reads is noted where another one may have been meant; words of others are let be.
#[test]
fn slips_are_noted() {
    let notes = |elements: &str| {
        let text = format!("<robot name='r'><link name='a'/><link name='b'/>{elements}</robot>");
        let loaded = read_urdf_str(&text, "r.urdf", &UrdfOptions::default()).unwrap();
        loaded.findings().into_iter().filter(|line| line.contains("means nothing")).collect::<Vec<_>>()
    };
    let fixed = "<joint name='f' type='fixed'><parent link='a'/><child link='b'/></joint>";
    let joint = |rest: &str| {
        notes(&format!("<joint name='j' type='revolute'><parent link='a'/><child link='b'/>{rest}</joint>"))
            .concat()
    };
    assert_snapshot!(joint("<orgin xyz='0 0 1'/>"), @"r.urdf:1:116: warning: <orgin> in joint 'j' means nothing there and is passed over; did you mean 'origin'?");
    assert_snapshot!(joint("<origin xzy='0 0 1'/>"), @"r.urdf:1:124: warning: 'xzy' in <origin> means nothing there and is passed over; did you mean 'xyz'?");
    assert_snapshot!(joint("<axes xyz='0 0 1'/>"), @"r.urdf:1:116: warning: <axes> in joint 'j' means nothing there and is passed over; did you mean 'axis'?");
    assert_snapshot!(joint("<limit low='1'/>"), @"r.urdf:1:123: warning: 'low' in <limit> means nothing there and is passed over; did you mean 'lower'?");
    assert_snapshot!(notes(&format!("{fixed}<lnk name='c'/>")).concat(), @"r.urdf:1:121: warning: <lnk> in robot 'r' means nothing there and is passed over; did you mean 'link'?");
    let others =
        "<gazebo reference='a'/><sensor/><link name='c' id='3'><contact/></link>
        <joint name='k' type='fixed'><parent link='a'/><child link='c'/><limit current='1' gear_velocity='10'/></joint>";
    assert_eq!(notes(&format!("{fixed}{others}")), [""; 0]);
}

#[test]
fn crossed_limits_are_no_limits() {
    let text = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'>
        <parent link='a'/><child link='b'/><limit lower='2' upper='1'/></joint></robot>";
    let loaded = read_urdf_str(text, "r.urdf", &UrdfOptions::default()).unwrap();
    assert_eq!(loaded.model.joints()[0].limits(), None);
    assert_snapshot!(loaded.findings().last().unwrap(), @"r.urdf:1:49: warning: joint 'j' has lower limit 2 above upper limit 1: taken as unlimited");
}

#[test]
fn a_message_is_one_line_whatever_the_names() {
    let message = joint("a&#10;b&#27;[31m", "");
    assert!(!message.contains(char::is_control), "{message}");
    let message = fault("<link name='a&#10;b'/><link name='c'/>");
    assert!(!message.contains(char::is_control), "{message}");
}

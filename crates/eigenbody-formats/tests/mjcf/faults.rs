//! Every fault, at its place, in one line.

use eigenbody_formats::{MjcfOptions, read_mjcf_str};
use insta::assert_snapshot;

fn fault_of(text: &str) -> String {
    read_mjcf_str(text, "m.xml", &MjcfOptions::default()).unwrap_err().to_string()
}

/// A file of these sections, which begin at line 2.
fn fault(sections: &str) -> String {
    fault_of(&format!("<mujoco>\n{sections}\n</mujoco>"))
}

/// A file with these bodies, which begin at line 2.
fn world(bodies: &str) -> String {
    fault(&format!("<worldbody>{bodies}</worldbody>"))
}

/// A moving body with this geom.
fn geom(geom: &str) -> String {
    world(&format!("<body name='b'><joint/>{geom}</body>"))
}

/// A body with these joints.
fn joints(joints: &str) -> String {
    world(&format!("<body name='b'>{joints}<geom size='.1'/></body>"))
}

#[test]
fn text_that_is_no_mjcf() {
    assert_snapshot!(fault_of("<mujoco>"), @"m.xml:1:1: not well-formed XML: the root node was opened but never closed");
    assert_snapshot!(fault_of("<!DOCTYPE m [<!ENTITY a 'ha'>]><mujoco model='&a;'/>"), @"m.xml:1:1: document type declarations (<!DOCTYPE .. [..]>) are refused");
    assert_snapshot!(fault_of("<mujocoinclude/>"), @"m.xml:1:1: no MJCF: the root element is <mujocoinclude>, expected <mujoco>");
    let deep = "<default class='main'>".repeat(600) + &"</default>".repeat(600);
    assert_snapshot!(fault(&deep), @"m.xml:2:11001: elements are nested deeper than 500");
}

#[test]
fn elements_and_attributes_that_are_unknown() {
    assert_snapshot!(fault("<wordlbody/>"), @"m.xml:2:1: <mujoco> has no element <wordlbody>; did you mean 'worldbody'?");
    assert_snapshot!(world("<bdy/>"), @"m.xml:2:12: <worldbody> has no element <bdy>; did you mean 'body'?");
    assert_snapshot!(geom("<geom size='.1' densty='1'/>"), @"m.xml:2:51: <geom> has no attribute 'densty'; did you mean 'density'?");
    assert_snapshot!(world("<replicate count='2' pos='0 0 0'/>"), @"m.xml:2:33: <replicate> has no attribute 'pos'");
    assert_snapshot!(world("<body><inertial pos='0 0 0' mass='1'/><inertial pos='0 0 0' mass='1'/></body>"), @"m.xml:2:50: a second <inertial> in one <body>");
    assert_snapshot!(fault("<worldbody name='w'/>"), @"m.xml:2:12: <worldbody> has no attribute 'name'");
}

#[test]
fn values() {
    assert_snapshot!(geom("<geom size='big'/>"), @"m.xml:2:41: 'size' of <geom> holds 'big', expected a number");
    assert_snapshot!(geom("<geom size='.1' pos='1 2'/>"), @"m.xml:2:51: 'pos' of <geom> holds 2 numbers, expected 3");
    assert_snapshot!(geom("<geom size='.1' pos='1 2 inf'/>"), @"m.xml:2:51: 'pos' of <geom> holds 'inf', expected a finite number");
    assert_snapshot!(geom("<geom size='.1' density='nan'/>"), @"m.xml:2:51: 'density' of <geom> holds 'nan', expected a number");
    assert_snapshot!(geom("<geom type='ball' size='.1'/>"), @"m.xml:2:41: 'type' of <geom> holds 'ball', expected one of plane, hfield, sphere, capsule, ellipsoid, cylinder, box, mesh, sdf");
    assert_snapshot!(fault("<compiler angle='grad'/>"), @"m.xml:2:11: 'angle' of <compiler> holds 'grad', expected one of radian, degree");
    assert_snapshot!(fault("<compiler eulerseq='xyw'/>"), @"m.xml:2:11: 'eulerseq' of <compiler> holds 'xyw', expected three of the letters x, y, z, X, Y, Z");
    assert_snapshot!(fault("<compiler coordinate='global'/>"), @"m.xml:2:1: <compiler> cannot be read: global coordinates are no longer part of MJCF");
    assert_snapshot!(world("<body><inertial mass='1'/></body>"), @"m.xml:2:18: <inertial> has no attribute 'pos'");
    assert_snapshot!(world("<replicate/>"), @"m.xml:2:12: <replicate> has no attribute 'count'");
    assert_snapshot!(world("<replicate count='1e9'/>"), @"m.xml:2:23: 'count' of <replicate> holds '1e9', expected a whole number from 0 to 200000");
    assert_snapshot!(world("<replicate count='2.5'/>"), @"m.xml:2:23: 'count' of <replicate> holds '2.5', expected a whole number from 0 to 200000");
}

#[test]
fn classes() {
    assert_snapshot!(fault("<default class='robot'/>"), @"m.xml:2:10: the outermost default class is named 'robot', expected 'main' or no name");
    assert_snapshot!(fault("<default><default/></default>"), @"m.xml:2:10: the default class has no name; only the outermost may have none");
    assert_snapshot!(fault("<default><default class='a'/>\n<default class='a'/></default>"), @"m.xml:3:10: a second default class is named 'a'; the first is at 2:10");
    assert_snapshot!(fault("<default><default class='visual'/></default><worldbody><body><geom class='visuel'/></body></worldbody>"), @"m.xml:2:68: no default class is named 'visuel'; did you mean 'visual'?");
    assert_snapshot!(world("<body childclass='a'/>"), @"m.xml:2:18: no default class is named 'a'");
}

#[test]
fn orientations() {
    assert_snapshot!(world("<body quat='1 0 0 0' euler='0 0 0'/>"), @"m.xml:2:33: <body> has 'quat' and 'euler', expected one orientation");
    assert_snapshot!(world("<body quat='0 0 0 0'/>"), @"m.xml:2:18: 'quat' of <body> is too short to give a direction");
    assert_snapshot!(world("<body axisangle='0 0 0 1'/>"), @"m.xml:2:18: 'axisangle' of <body> is too short to give a direction");
    assert_snapshot!(world("<body xyaxes='1 0 0 2 0 0'/>"), @"m.xml:2:18: 'xyaxes' of <body> is too short to give a direction");
    assert_snapshot!(world("<body zaxis='0 0 0'/>"), @"m.xml:2:18: 'zaxis' of <body> is too short to give a direction");
}

#[test]
fn bodies_and_joints() {
    assert_snapshot!(fault("<worldbody><joint/></worldbody>"), @"m.xml:2:12: <joint> cannot stand in the world body, which is fixed");
    assert_snapshot!(fault("<worldbody><inertial pos='0 0 0' mass='1'/></worldbody>"), @"m.xml:2:12: <inertial> cannot stand in the world body, which is fixed");
    assert_snapshot!(joints("<joint axis='0 0 0'/>"), @"m.xml:2:34: 'axis' of <joint> is too short to give a direction");
    assert_snapshot!(joints("<joint range='2 1'/>"), @"m.xml:2:27: <joint>: range 2 1 is empty, expected the lower limit first");
    assert_snapshot!(fault("<compiler autolimits='false'/><worldbody><body><joint range='0 1'/></body></worldbody>"), @r#"m.xml:2:48: <joint> has a range but does not say limited="true" or "false", and autolimits is off"#);
    assert_snapshot!(joints("<joint type='ball'/><joint/>"), @"m.xml:2:47: body 'b' has a rotation after a ball joint, which has all rotations already");
    assert_snapshot!(joints("<freejoint/><joint/>"), @"m.xml:2:39: body 'b' has more than 6 degrees of freedom");
    assert_snapshot!(world("<body><geom size='.1'/><body><freejoint name='f'/><geom size='.1'/></body></body>"), @"m.xml:2:41: joint 'f' is free, so its body must stand in the world body");
    assert_snapshot!(joints("<joint name='j'/>\n<joint name='j' axis='1 0 0'/>"), @"m.xml:3:1: a second joint is named 'j'; the first is at 2:27");
    assert_snapshot!(world("<body name='b'/>\n<body name='b'/>"), @"m.xml:3:1: a second link is named 'b'; the first is at 2:12");
    assert_snapshot!(joints("<joint armature='-1'/>"), @"m.xml:2:27: joint 'joint_0' has armature -1, expected zero or more (kg m² or kg)");
    assert_snapshot!(world("<body><joint/><replicate count='2'><joint/></replicate></body>"), @"m.xml:2:47: <joint> cannot stand directly in a <replicate>: the joint would be on the body outside it");
    assert_snapshot!(world("<body><replicate count='2'><inertial pos='0 0 0' mass='1'/></replicate></body>"), @"m.xml:2:39: <inertial> cannot be read: it stands in a <replicate>");
    assert_snapshot!(world("<body><flexcomp name='f'/></body>"), @"m.xml:2:18: flexcomp 'f' cannot be read: it generates bodies");
}

#[test]
fn masses() {
    assert_snapshot!(geom("<geom type='box' size='.1'/>"), @"m.xml:2:35: <geom>: size 2 is 0, expected more than 0 for a box");
    assert_snapshot!(geom("<geom type='box' size='.1' fromto='0 0 0 0 0 0'/>"), @"m.xml:2:35: <geom>: fromto names one point twice");
    assert_snapshot!(geom("<geom size='.1' fromto='0 0 0 1 0 0'/>"), @"m.xml:2:35: <geom>: fromto is for capsules, cylinders, boxes and ellipsoids");
    assert_snapshot!(geom("<geom type='capsule' size='.1' pos='1 0 0' fromto='0 0 0 1 0 0'/>"), @"m.xml:2:35: <geom>: pos and fromto exclude each other");
    assert_snapshot!(geom("<geom size='.1' mass='-1'/>"), @"m.xml:2:35: <geom>: mass -1, inertia [-0.004000000000000001, -0.004000000000000001, -0.004000000000000001] and density may not be negative");
    assert_snapshot!(geom("<geom size='.1' mass='0'/><geom size='.1' mass='0'/>"), @"m.xml:2:12: body 'b' has several geoms, but no mass");
    assert_snapshot!(world("<body><joint/><inertial pos='0 0 0' mass='-1'/></body>"), @"m.xml:2:12: <body> has a negative mass or moment of inertia");
    let inertial = |rest: &str| world(&format!("<body><inertial pos='0 0 0' mass='1' {rest}/></body>"));
    assert_snapshot!(inertial("diaginertia='1 1 1' fullinertia='1 1 1 0 0 0'"), @"m.xml:2:18: <inertial> has both diaginertia and fullinertia, expected one of them");
    assert_snapshot!(inertial("euler='10 0 0' fullinertia='1 1 1 0 0 0'"), @"m.xml:2:18: <inertial> has fullinertia and an orientation, expected one of them");
}

#[test]
fn assets() {
    let mesh = |attributes: &str| {
        fault(&format!(
            "<asset><mesh name='m' {attributes}/></asset><worldbody><body><joint/>\n<geom type='mesh' mesh='m'/></body></worldbody>"
        ))
    };
    assert_snapshot!(geom("<geom type='mesh' mesh='m'/>"), @"m.xml:2:53: no mesh is named 'm'");
    assert_snapshot!(geom("<geom type='mesh'/>"), @"m.xml:2:35: <geom>: it names no mesh");
    assert_snapshot!(geom("<geom type='sdf' mesh='m'/>"), @"m.xml:2:35: <geom> cannot be read: its shape comes from a plugin");
    assert_snapshot!(mesh("file='no/such.stl'"), @"m.xml:2:8: mesh 'm': file 'no/such.stl': no such file");
    assert_snapshot!(mesh("vertex='0 0 0 1 0 0'"), @"m.xml:2:8: mesh 'm': 2 vertices, expected at least 4");
    assert_snapshot!(mesh("vertex='0 0 0 1 0 0 0 1 0 1 1 0'"), @"m.xml:2:8: mesh 'm': all vertices lie in one plane");
    assert_snapshot!(mesh("vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='0 1 4'"), @"m.xml:2:8: mesh 'm': face 0 names vertex 4 of 4");
    assert_snapshot!(mesh("vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='0 1 2' inertia='exact'"), @r#"m.xml:2:8: mesh 'm': its volume is too small; inertia="shell" needs no volume"#);
    assert_snapshot!(mesh("vertex='0 0 0 1 0 0 0 1 0 0 0 1' face='0 1 2 0 1 3' inertia='exact'"), @"m.xml:2:8: mesh 'm': its faces around the edge from vertex 0 to vertex 1 are turned against each other");
    assert_snapshot!(mesh("vertex='0 0 0 1 0 0 0 1 0 0 0 1' maxhullvert='4'"), @r#"m.xml:2:8: mesh 'm': inertia="convex" with a limited maxhullvert depends on the order in which a hull is built"#);
    assert_snapshot!(mesh("builtin='sphere' params='3'"), @"m.xml:2:8: mesh 'm' cannot be read: built-in meshes are generated by MuJoCo");
    assert_snapshot!(fault("<asset><mesh name='m'/>\n<mesh file='x/m.stl'/></asset>"), @"m.xml:3:1: a second mesh is named 'm'; the first is at 2:8");
}

#[test]
fn keyframes() {
    let key = |key: &str| {
        fault(&format!(
            "<worldbody><body><joint/><geom size='.1'/></body><body><freejoint/><geom size='.1'/></body></worldbody>\n<keyframe>{key}</keyframe>"
        ))
    };
    assert_snapshot!(key("<key name='home' qpos='1 2'/>"), @"m.xml:3:28: key 'home': qpos holds 2 numbers, expected 8");
    assert_snapshot!(key("<key qpos='1 0 0 0 0 0 0 0'/>"), @"m.xml:3:16: key '0': the quaternion of joint 'joint_1' is zero");
}

#[test]
fn attachments() {
    assert_snapshot!(world("<body name='arm'/><attach body='amr' prefix='p'/>"), @"m.xml:2:38: no body or frame is named 'amr' to attach; did you mean 'arm'?");
    assert_snapshot!(world("<attach body='arm'/>"), @"m.xml:2:12: <attach> has no attribute 'prefix'");
    assert_snapshot!(world("<attach model='arm' prefix='p'/>"), @"m.xml:2:20: no model is named 'arm'");
    assert_snapshot!(world("<attach prefix='p'/>"), @"m.xml:2:12: <attach> cannot be read: it names neither model, body nor frame");
    assert_snapshot!(fault("<asset><model name='m' file='no/such.xml'/></asset>"), @"m.xml:2:24: 'no/such.xml' cannot be included: no such file");
}

#[test]
fn a_total_mass_that_depends_on_what_is_fused() {
    assert_snapshot!(fault("<compiler settotalmass='1' fusestatic='true'/><worldbody><body><geom size='.1'/></body></worldbody>"), @"m.xml:2:1: <compiler> cannot be read: settotalmass with fusestatic depends on which fixed bodies MuJoCo keeps");
}

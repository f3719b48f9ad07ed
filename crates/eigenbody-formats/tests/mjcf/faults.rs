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
    assert_snapshot!(geom("<geom size='.1' pos='1'/>"), @"m.xml:2:51: 'pos' of <geom> holds 1 number, expected 3");
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
    // Where nothing is read but the class.
    assert_snapshot!(world("<geom class='a' size='.1'/>"), @"m.xml:2:18: no default class is named 'a'");
    assert_snapshot!(world("<site class=''/>"), @"m.xml:2:18: no default class is named ''");
    assert_snapshot!(world("<camera class='a'/>"), @"m.xml:2:20: no default class is named 'a'");
    assert_snapshot!(world("<light class='a'/>"), @"m.xml:2:19: no default class is named 'a'");
    assert_snapshot!(fault("<asset><material name='m' class='a'/></asset>"), @"m.xml:2:27: no default class is named 'a'");
    assert_snapshot!(fault("<contact><pair class='a'/></contact>"), @"m.xml:2:16: no default class is named 'a'");
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
    assert_snapshot!(world("<body name='b'/>\n<body name='b'/>"), @"m.xml:3:1: a second body is named 'b'; the first is at 2:12");
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
    assert_snapshot!(mesh("vertex='0 0 0'"), @"m.xml:2:8: mesh 'm': 1 vertex, expected at least 4");
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

/// Three bodies with a joint, a geom and a site each; the sections begin at line 3.
fn named(sections: &str) -> Result<(), String> {
    let body = |n: usize| {
        format!(
            "<body name='b{n}'><joint name='j{n}'/><geom name='g{n}' size='.1'/><site name='s{n}'/><camera name='c{n}'/></body>"
        )
    };
    let bodies: String = (1..4).map(body).collect();
    let copies = "<replicate count='0'><body name='none'><joint name='spare'/></body></replicate>\
         <replicate count='2'><replicate count='2' sep='-'><body name='leg'><joint name='hip'/><geom name='toe' size='.1'/></body></replicate></replicate>";
    let text = format!("<mujoco>\n<worldbody>{bodies}{copies}</worldbody>\n{sections}\n</mujoco>");
    read_mjcf_str(&text, "m.xml", &MjcfOptions::default()).map(drop).map_err(|error| error.to_string())
}

/// What names something that is not there, as MuJoCo refuses it.
#[test]
fn what_is_named_must_be_there() {
    let of = |section: &'static str| {
        move |element: &str| named(&format!("<{section}>{element}</{section}>")).unwrap_err()
    };
    let actuator = of("actuator");
    assert_snapshot!(actuator("<motor joint='j9'/>"), @"m.xml:3:18: no joint is named 'j9'; did you mean 'j1'?");
    assert_snapshot!(actuator("<motor jointinparent='hips'/>"), @"m.xml:3:18: no joint is named 'hips'; did you mean 'hip'?");
    assert_snapshot!(actuator("<motor tendon='t'/>"), @"m.xml:3:18: no tendon is named 't'");
    assert_snapshot!(actuator("<general body='nobody'/>"), @"m.xml:3:20: no body is named 'nobody'");
    assert_snapshot!(actuator("<motor site='nowhere'/>"), @"m.xml:3:18: no site is named 'nowhere'");
    assert_snapshot!(actuator("<motor site='s1' refsite='nowhere'/>"), @"m.xml:3:28: no site is named 'nowhere'");
    assert_snapshot!(actuator("<motor cranksite='s1' slidersite='nowhere' cranklength='1'/>"), @"m.xml:3:33: no site is named 'nowhere'");
    assert_snapshot!(actuator("<motor cranksite='s1' cranklength='1'/>"), @"m.xml:3:11: <motor> has no attribute 'slidersite'");
    assert_snapshot!(actuator("<motor name='m' joint=''/>"), @"m.xml:3:11: motor 'm' acts on nothing, expected one of joint, jointinparent, tendon, site, body, cranksite");
    let equality = of("equality");
    assert_snapshot!(equality("<joint joint1='j1' joint2='nobody'/>"), @"m.xml:3:30: no joint is named 'nobody'");
    assert_snapshot!(equality("<joint joint1='nobody' active='false'/>"), @"m.xml:3:18: no joint is named 'nobody'");
    assert_snapshot!(equality("<joint joint2='j1'/>"), @"m.xml:3:11: <joint> has no attribute 'joint1'");
    assert_snapshot!(equality("<connect body1='b1' body2='nobody' anchor='0 0 0'/>"), @"m.xml:3:31: no body is named 'nobody'");
    assert_snapshot!(equality("<connect body1='b1'/>"), @"m.xml:3:11: <connect> has no attribute 'anchor'");
    assert_snapshot!(equality("<weld site1='s1' site2='nowhere'/>"), @"m.xml:3:28: no site is named 'nowhere'");
    assert_snapshot!(equality("<weld site1='s1'/>"), @"m.xml:3:11: <weld> has no attribute 'site2'");
    assert_snapshot!(equality("<weld/>"), @"m.xml:3:11: <weld> has no attribute 'body1'");
    assert_snapshot!(equality("<tendon tendon1='t'/>"), @"m.xml:3:19: no tendon is named 't'");
    let tendon = of("tendon");
    assert_snapshot!(tendon("<fixed><joint joint='nobody' coef='1'/></fixed>"), @"m.xml:3:23: no joint is named 'nobody'");
    assert_snapshot!(tendon("<fixed><joint joint='j1'/></fixed>"), @"m.xml:3:16: <joint> has no attribute 'coef'");
    assert_snapshot!(tendon("<spatial><site site='s1'/><site site='nowhere'/></spatial>"), @"m.xml:3:41: no site is named 'nowhere'");
    assert_snapshot!(tendon("<spatial><geom geom='nothing'/></spatial>"), @"m.xml:3:24: no geom is named 'nothing'");
    assert_snapshot!(tendon("<spatial><geom geom='g1' sidesite='nowhere'/></spatial>"), @"m.xml:3:34: no site is named 'nowhere'");
    let contact = of("contact");
    assert_snapshot!(contact("<exclude body1='b1' body2='nobody'/>"), @"m.xml:3:30: no body is named 'nobody'");
    assert_snapshot!(contact("<exclude body1='b1'/>"), @"m.xml:3:10: <exclude> has no attribute 'body2'");
    assert_snapshot!(contact("<pair geom1='g1' geom2='nothing'/>"), @"m.xml:3:27: no geom is named 'nothing'");
    let sensor = of("sensor");
    assert_snapshot!(sensor("<jointpos joint='nobody'/>"), @"m.xml:3:19: no joint is named 'nobody'");
    assert_snapshot!(sensor("<framepos objtype='xbody' objname='nobody'/>"), @"m.xml:3:35: no body is named 'nobody'");
    assert_snapshot!(sensor("<framepos objtype='site' objname='s1' reftype='camera' refname='c9'/>"), @"m.xml:3:64: no camera is named 'c9'; did you mean 'c1'?");
    assert_snapshot!(sensor("<user dim='1' objtype='key' objname='home'/>"), @"m.xml:3:37: no key is named 'home'");
    assert_snapshot!(sensor("<actuatorpos actuator='m'/>"), @"m.xml:3:22: no actuator is named 'm'");
}

/// What MuJoCo takes: the world, copies by their first names, what no copy is left of, and empty texts.
#[test]
fn what_is_named_may_be_many_or_none() {
    let sections = "<actuator><motor name='m' joint='hip'/><motor joint='hip-01'/><motor joint='hip-1'/><motor joint='spare'/></actuator>
        <tendon><fixed name='t'><joint joint='j1' coef='1'/></fixed></tendon>
        <equality><joint joint1='j1' joint2=''/><tendon tendon1='t'/></equality>
        <contact><exclude body1='world' body2='leg'/><pair geom1='toe-11' geom2='g1'/></contact>
        <sensor><framepos objtype='site' objname='s1'/><user dim='1'/><actuatorpos actuator='m'/><tendonpos tendon='t'/></sensor>";
    assert_eq!(named(sections), Ok(()));
}

/// Among one kind every name is borne once.
#[test]
fn names_that_are_borne_twice() {
    assert_snapshot!(world("<geom name='g' size='.1'/>\n<geom name='g' size='.1'/>"), @"m.xml:3:1: a second geom is named 'g'; the first is at 2:12");
    assert_snapshot!(world("<site name='s'/><body><site name='s'/></body>"), @"m.xml:2:34: a second site is named 's'; the first is at 2:12");
    assert_snapshot!(world("<camera name='c'/><camera name='c'/>"), @"m.xml:2:30: a second camera is named 'c'; the first is at 2:12");
    assert_snapshot!(world("<frame name='f'/><frame name='f'/>"), @"m.xml:2:29: a second frame is named 'f'; the first is at 2:12");
    assert_snapshot!(world("<body name='world'/>"), @"m.xml:2:12: a second body is named 'world'; the first is at 1:1");
    assert_snapshot!(world("<geom name='g0' size='.1'/><replicate count='2'><geom name='g' size='.1'/></replicate>"), @"m.xml:2:60: a second geom is named 'g0'; the first is at 2:12");
    assert_snapshot!(fault("<keyframe><key name='k'/>\n<key name='k'/></keyframe>"), @"m.xml:3:1: a second key is named 'k'; the first is at 2:11");
    assert_snapshot!(named("<actuator><motor name='m' joint='j1'/><general name='m' joint='j2'/></actuator>").unwrap_err(), @"m.xml:3:39: a second actuator is named 'm'; the first is at 3:11");
    assert_snapshot!(named("<equality><weld name='e' body1='b1'/><joint name='e' joint1='j1'/></equality>").unwrap_err(), @"m.xml:3:38: a second equality is named 'e'; the first is at 3:11");
    assert_snapshot!(named("<contact><exclude name='x' body1='b1' body2='b2'/><exclude name='x' body1='b1' body2='b3'/></contact>").unwrap_err(), @"m.xml:3:51: a second exclude is named 'x'; the first is at 3:10");
    assert_snapshot!(fault("<asset><hfield name='h'/>\n<hfield name='h'/></asset>"), @"m.xml:3:1: a second hfield is named 'h'; the first is at 2:8");
    let apart = "<body name='x'><joint name='x'/><geom name='x' size='.1'/><site name='x'/><light name='x'/><camera name='x'/></body><geom name='' size='.1'/><geom name='' size='.1'/>";
    let text = format!(
        "<mujoco><worldbody>{apart}</worldbody><contact><pair name='y'/><exclude name='y' body1='x' body2='x'/></contact></mujoco>"
    );
    assert!(read_mjcf_str(&text, "m.xml", &MjcfOptions::default()).is_ok());
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

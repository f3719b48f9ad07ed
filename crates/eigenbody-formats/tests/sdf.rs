//! SDF files: the same robots as in URDF, the graph of poses, the errors.

use eigenbody::dynamics::{Tie, closure_residual, link_poses};
use eigenbody::model::LinkInfo;
use eigenbody::spatial::Vec3;
use eigenbody::{Base, mass_matrix};
use eigenbody_formats::{
    Form, Loaded, SdfOptions, Shape, UrdfOptions, read_sdf, read_sdf_str, read_urdf_str,
};
use insta::assert_snapshot;

fn loaded(model: &str) -> Loaded {
    let text = format!(r#"<sdf version="1.9"><model name="m">{model}</model></sdf>"#);
    read_sdf_str(&text, "m.sdf", &SdfOptions::default()).unwrap()
}

/// What is wrong with the elements of a model, which begin at line 2.
fn fault(model: &str) -> String {
    let text = format!("<sdf version=\"1.9\"><model name=\"m\">\n{model}</model></sdf>");
    read_sdf_str(&text, "m.sdf", &SdfOptions::default()).unwrap_err().to_string()
}

fn inertial(com: &str) -> String {
    format!(
        "<inertial><mass>2</mass><pose>{com}</pose><inertia><ixx>0.5</ixx><iyy>0.4</iyy><izz>0.3</izz><ixy>0.01</ixy></inertia></inertial>"
    )
}

const ENDS: &str = "<parent>a</parent><child>b</child>";

/// An arm of two links with two joints, in the two formats.
fn arms() -> (Loaded, Loaded) {
    let sdf = loaded(&format!(
        r#"<link name="a">{i}</link>
           <link name="b"><pose>1 2 3 0.1 0.2 0.3</pose>{i}</link>
           <link name="c"><pose relative_to="k">0 0 0 0 0 0</pose>{i}</link>
           <joint name="j" type="revolute">{ENDS}<axis><xyz>1 2 2</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis></joint>
           <joint name="k" type="prismatic"><pose relative_to="b">0.5 0 0 0 0.7 0</pose><parent>b</parent><child>c</child>
             <axis><xyz expressed_in="b">0 1 1</xyz></axis></joint>"#,
        i = inertial("0.1 0.2 0.3 0.4 0.5 0.6"),
    ));
    let inertial = r#"<inertial><origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/><mass value="2"/>
        <inertia ixx="0.5" iyy="0.4" izz="0.3" ixy="0.01" ixz="0" iyz="0"/></inertial>"#;
    // (0, 1, 1) of link b in the frame of joint k, turned by 0.7 about y.
    let (s, c) = 0.7f64.sin_cos();
    let urdf = format!(
        r#"<robot name="m"><link name="a">{inertial}</link><link name="b">{inertial}</link><link name="c">{inertial}</link>
           <joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>
             <axis xyz="1 2 2"/><limit lower="-1" upper="2"/></joint>
           <joint name="k" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0.5 0 0" rpy="0 0.7 0"/>
             <axis xyz="{} 1 {c}"/></joint></robot>"#,
        -s,
    );
    (sdf, read_urdf_str(&urdf, "m.urdf", &UrdfOptions::default()).unwrap())
}

#[test]
fn the_same_arm_as_in_urdf() {
    let (sdf, urdf) = arms();
    assert_eq!(sdf.model.joints()[0].limits(), urdf.model.joints()[0].limits());
    for seed in 0..5 {
        let q = urdf.model.random(seed);
        let (found, expected) = (mass_matrix(&sdf.model, &q).unwrap(), mass_matrix(&urdf.model, &q).unwrap());
        for (a, b) in found.as_slice().iter().zip(expected.as_slice()) {
            // 20 ε of the largest entry
            assert!((a - b).abs() <= 20.0 * f64::EPSILON * expected.max_abs(), "{a} {b}");
        }
    }
}

#[test]
fn a_joint_need_not_stand_where_its_link_does() {
    // 2 kg at (1, 0, 0) of link b, turned about a joint at (0, −1, 0): 2·(1 + 1) + 0.3.
    let at = "<pose>0 -1 0 0 0 0</pose>";
    let joint =
        format!(r#"<joint name="j" type="continuous">{at}{ENDS}<axis><xyz>0 0 1</xyz></axis></joint>"#);
    let found =
        loaded(&format!(r#"<link name="a"/><link name="b">{}</link>{joint}"#, inertial("1 0 0 0 0 0")));
    let H = mass_matrix(&found.model, &[0.7]).unwrap();
    assert!((H[(0, 0)] - 4.3).abs() < 10.0 * f64::EPSILON * 4.3, "{}", H[(0, 0)]);
}

#[test]
fn frames_and_nested_models_have_full_names() {
    let found = loaded(
        r#"<link name="base"/>
           <frame name="mount" attached_to="base"><pose degrees="true">1 0 0 0 0 90</pose></frame>
           <model name="arm" placement_frame="flange"><pose relative_to="mount"/>
             <link name="l"/><frame name="flange" attached_to="l"><pose>0 2 0 0 0 0</pose></frame></model>
           <joint name="j" type="revolute"><pose relative_to="base"/><parent>mount</parent><child>arm</child>
             <axis><xyz>0 0 1</xyz></axis></joint>"#,
    );
    let names: Vec<&str> = found.model.links().iter().map(LinkInfo::name).collect();
    assert_eq!(names, ["world", "base", "arm::l"]);
    // The flange stands at the mount, so the link at (1, 0, 0) + Rz(90°) (0, −2, 0), three metres from the joint.
    let H = mass_matrix(&found.model, &[0.3]).unwrap()[(0, 0)];
    assert!((H - 10.0).abs() < 20.0 * f64::EPSILON * 10.0, "{H}");
}

#[test]
fn what_is_left_out_is_what_the_format_says() {
    let auto = r#"<link name="b"><inertial auto="true"><density>500</density></inertial>
        <collision name="c"><pose>1 0 0 0 0 0</pose><geometry><box><size>0.2 0.4 0.6</size></box></geometry></collision></link>"#;
    let joint = format!(r#"<joint name="j" type="revolute">{ENDS}<axis/></joint>"#);
    let found = loaded(&format!(r#"<link name="a"/>{auto}{joint}"#));
    let m = 500.0 * 0.2 * 0.4 * 0.6;
    let expected = m * (0.04 + 0.16) / 12.0 + m;
    let H = mass_matrix(&found.model, &[0.0]).unwrap()[(0, 0)];
    assert!((H - expected).abs() < 10.0 * f64::EPSILON * expected, "{H} {expected}");
}

#[test]
fn a_loop_is_cut_at_the_joint_that_closes_it() {
    let joint = |name: &str, from: &str, to: &str| {
        format!(
            "\n<joint name=\"{name}\" type=\"revolute\"><parent>{from}</parent><child>{to}</child><axis/></joint>"
        )
    };
    let links = r#"<link name="a"/><link name="b"/><link name="c"/>"#;
    let found = loaded(
        &(links.to_owned() + &joint("ab", "a", "b") + &joint("bc", "b", "c") + &joint("ca", "c", "a")),
    );
    assert_eq!(found.model.nv(), 2);
    assert_snapshot!(found.findings().join("\n"), @"m.sdf:4:1: warning: joint 'ca' closes a loop: H is that of the tree without it; --loops closed is with it");
    let closures = found.closures().unwrap();
    assert_eq!(closures.len(), 1);
    assert_eq!((closures[0].name.as_str(), closures[0].tie), ("joint 'ca'", Tie::Hinge(Vec3::Z)));
}

/// A joint that closes a loop holds where the file puts it: at q = 0 every loop of an SDF file is closed.
#[test]
fn loops_are_closed_in_the_pose_of_the_file() {
    let kinds = [
        ("fixed", "", 6),
        ("ball", "", 3),
        ("revolute", "<axis><xyz>0 1 1</xyz></axis>", 5),
        ("prismatic", "<axis><xyz>1 2 0</xyz></axis>", 5),
        ("universal", "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>", 4),
    ];
    for (kind, axes, rows) in kinds {
        let found = loaded(&format!(
            r#"<link name="a"><pose>0.1 0 0 0.3 0 0</pose></link><link name="b"><pose>1 0.2 0 0 0.5 0</pose></link>
            <link name="c"><pose>1 1 0.4 0 0 0.7</pose></link>
            <joint name="ab" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>
            <joint name="bc" type="ball"><parent>b</parent><child>c</child></joint>
            <joint name="ca" type="{kind}"><pose>0.2 0.1 0 0.4 0 0</pose><parent>c</parent><child>a</child>{axes}</joint>"#
        ));
        let closures = found.closures().unwrap();
        assert_eq!((closures.len(), closures[0].rows()), (1, rows), "{kind}");
        let open = closure_residual(&found.model, &found.model.neutral(), &closures).unwrap();
        // a few products of rotations with lengths near 1
        assert!(open.iter().all(|x| x.abs() < 32.0 * f64::EPSILON), "{kind}: {open:?}");
    }
}

#[test]
fn static_models_and_bases() {
    let text = r#"<sdf version="1.9"><world name="w"><gravity>0 0 -1.6</gravity>
        <model name="table"><static>true</static><link name="top"/></model>
        <model name="ball"><pose>0 0 1 0 0 0</pose><link name="b"/></model></world></sdf>"#;
    let world = read_sdf_str(text, "w.sdf", &SdfOptions::default()).unwrap();
    assert_eq!((world.model.nv(), world.model.gravity().z), (0, -1.6));
    let floating = SdfOptions { base: Base::Floating };
    assert_snapshot!(read_sdf_str(text, "w.sdf", &floating).unwrap_err(), @"w.sdf: a floating base needs exactly one link that no joint carries");
    let one = r#"<sdf version="1.9"><model name="m"><link name="b"/></model></sdf>"#;
    assert_eq!(read_sdf_str(one, "m.sdf", &floating).unwrap().model.nv(), 6);
}

#[test]
fn models_of_other_files() {
    let folder = tempfile::tempdir().unwrap();
    let part = folder.path().join("part");
    std::fs::create_dir(&part).unwrap();
    std::fs::write(
        part.join("model.sdf"),
        r#"<sdf version="1.9"><model name="part"><link name="l"/></model></sdf>"#,
    )
    .unwrap();
    let main = folder.path().join("main.sdf");
    let write = |include: &str| {
        let text = format!(
            r#"<sdf version="1.9"><model name="m"><link name="base"/>{include}
               <joint name="j" type="revolute"><parent>base</parent><child>hand::l</child><axis/></joint></model></sdf>"#
        );
        std::fs::write(&main, text).unwrap();
        read_sdf(&main, &SdfOptions::default())
    };
    let found = write("<include><uri>model://part</uri><name>hand</name></include>").unwrap();
    assert_eq!(found.model.joints().len(), 1);
    let fault = |include: &str| {
        let error = write(include).unwrap_err().to_string();
        error.replace(&format!("{}/", folder.path().display()), "")
    };
    assert_snapshot!(fault("<include><uri>model://absent</uri></include>"), @"main.sdf:1:55: 'model://absent' cannot be included: no such file");
    assert_snapshot!(fault("<include><uri>main.sdf</uri></include>"), @"main.sdf:1:55: 'main.sdf' includes itself, or more than 500 files are included");
    assert_snapshot!(fault("<include merge='true'><uri>part</uri></include>"), @"main.sdf:1:55: <include> cannot be read: merged includes mix two models' frames");
}

#[test]
fn every_fault_has_its_place() {
    let of = |text: &str| read_sdf_str(text, "m.sdf", &SdfOptions::default()).unwrap_err().to_string();
    assert_snapshot!(of("<sdf>"), @"m.sdf:1:1: not well-formed XML: the root node was opened but never closed");
    assert_snapshot!(of("<robot/>"), @"m.sdf:1:1: no SDF: the root element is <robot>, expected <sdf>");
    assert_snapshot!(of("<sdf version='1.9'/>"), @"m.sdf:1:1: <sdf> holds no <model> and no <world>");
    assert_snapshot!(of("<sdf><model/></sdf>"), @"m.sdf:1:6: <model> has no attribute 'name'");
    assert_snapshot!(fault("<link/>"), @"m.sdf:2:1: <link> has no attribute 'name'");
    assert_snapshot!(fault("<link name='a::b'/>"), @"m.sdf:2:7: the name 'a::b' holds '::', which separates names of models");
    assert_snapshot!(fault("<link name='a'/>\n<link name='a'/>"), @"m.sdf:3:1: a second link, joint, frame or model is named 'a'; the first is at 2:1");
    assert_snapshot!(fault("<link name='a'><pose>1 2 3</pose></link>"), @"m.sdf:2:16: <pose> holds '1 2 3', expected x y z roll pitch yaw");
    assert_snapshot!(fault("<link name='a'><pose rotation_format='quat_xyzw'>0 0 0 0 0 0 0</pose></link>"), @"m.sdf:2:16: <pose> holds '0 0 0 0 0 0 0', expected x y z and a quaternion x y z w");
    assert_snapshot!(fault("<link name='a'><pose relative_to='base'/></link>"), @"m.sdf:2:22: no link, joint, frame or model is named 'base' here");
    assert_snapshot!(fault("<link name='a'><pose relative_to='b'/></link><link name='b'><pose relative_to='a'/></link>"), @"m.sdf:2:1: the pose of 'a' is relative to itself, directly or through others");
    assert_snapshot!(fault("<link name='a'><inertial><mass>heavy</mass></inertial></link>"), @"m.sdf:2:26: <mass> holds 'heavy', expected a finite number");
    assert_snapshot!(fault("<link name='a'><inertial><mass>-1</mass></inertial></link>"), @"m.sdf:2:1: link 'a' has mass -1, expected zero or more (kg)");
    assert_snapshot!(fault("<link name='a'><inertial/><inertial/></link>"), @"m.sdf:2:27: a second <inertial> in one <link>");
    let links = "<link name='a'/><link name='b'/>\n";
    let joint =
        |kind: &str, rest: &str| fault(&format!("{links}<joint name='j' type='{kind}'>{rest}</joint>"));
    assert_snapshot!(joint("screw", ENDS), @"m.sdf:3:17: joint 'j' has type 'screw', expected one of revolute, continuous, prismatic, revolute2, universal, ball, fixed");
    assert_snapshot!(joint("revolute", ENDS), @"m.sdf:3:1: joint 'j' has no <axis>");
    assert_snapshot!(joint("fixed", "<parent>a</parent>"), @"m.sdf:3:1: joint 'j' has no <child>");
    assert_snapshot!(joint("fixed", "<parent>c</parent><child>b</child>"), @"m.sdf:3:30: no link, joint, frame or model is named 'c' here");
    assert_snapshot!(joint("fixed", "<parent>a</parent><child>world</child>"), @"m.sdf:3:1: joint 'j' moves the world: its child is 'world'");
    assert_snapshot!(joint("revolute", &format!("{ENDS}<axis><xyz>0 0 0</xyz></axis>")), @"m.sdf:3:1: joint 'j' has axis 0 0 0, expected a direction");
    let auto = "<link name='a'><inertial auto='true'/><collision name='c'><geometry><mesh/></geometry></collision></link>";
    assert_snapshot!(fault(auto), @"m.sdf:2:69: <mesh> cannot be read: inertia comes from boxes, spheres, cylinders, capsules and ellipsoids");
}

/// What a model names is there, whether or not anything stands on it.
#[test]
fn names_that_mean_nothing() {
    let of = |text: &str| read_sdf_str(text, "m.sdf", &SdfOptions::default()).unwrap_err().to_string();
    assert_snapshot!(of("<sdf version='1.9'><model name='m' canonical_link='bse'><link name='base'/></model></sdf>"), @"m.sdf:1:36: no link is named 'bse' here; did you mean 'base'?");
    assert_snapshot!(of("<sdf version='1.9'><model name='m' canonical_link='f'><link name='base'/><frame name='f'/></model></sdf>"), @"m.sdf:1:36: no link is named 'f' here");
    assert_snapshot!(of("<sdf version='1.9'><model name='m' placement_frame='grip'><link name='base'/></model></sdf>"), @"m.sdf:1:36: no link, joint, frame or model is named 'grip' here");
    assert_snapshot!(of("<sdf version='1.9'><model name='m' placement_frame='world'><link name='base'/></model></sdf>"), @"m.sdf:1:36: no link, joint, frame or model is named 'world' here");
    assert_snapshot!(of("<sdf version='1.9'><model name='m'><pose relative_to='base'/><link name='base'/></model></sdf>"), @"m.sdf:1:42: no link, joint, frame or model is named 'base' here");
    assert_snapshot!(fault("<model name='arm' canonical_link='b'><link name='a'/></model>"), @"m.sdf:2:19: no link is named 'b' here");
    assert_snapshot!(fault("<model name='arm' placement_frame='b'><link name='a'/></model>"), @"m.sdf:2:19: no link, joint, frame or model is named 'b' here");
    assert_snapshot!(fault("<link name='a'/><frame name='f' attached_to='b'/>"), @"m.sdf:2:33: no link, joint, frame or model is named 'b' here");
    assert_snapshot!(fault("<link name='a'/><frame name='f'><pose relative_to='b'/></frame>"), @"m.sdf:2:39: no link, joint, frame or model is named 'b' here");
    let inner = "<link name='a'/><model name='arm' canonical_link='l' placement_frame='f'><link name='l'/><frame name='f' attached_to='l'/></model>";
    assert_eq!(loaded(inner).model.links().len(), 3);
    let empty = "<sdf version='1.9'><model name='m' canonical_link='' placement_frame=''><pose relative_to=''/><link name='a'/></model></sdf>";
    assert!(read_sdf_str(empty, "m.sdf", &SdfOptions::default()).is_ok());
}

#[test]
fn models_of_one_name() {
    let of = |text: &str| read_sdf_str(text, "m.sdf", &SdfOptions::default()).unwrap_err().to_string();
    let model = |name: &str, link: &str| format!("<model name='{name}'><link name='{link}'/></model>");
    let two = format!("{}\n{}", model("m", "a"), model("m", "b"));
    assert_snapshot!(of(&format!("<sdf version='1.9'>\n{two}</sdf>")), @"m.sdf:3:1: a second link, joint, frame or model is named 'm'; the first is at 2:1");
    assert_snapshot!(of(&format!("<sdf version='1.9'><world name='w'>\n{two}</world></sdf>")), @"m.sdf:3:1: a second link, joint, frame or model is named 'm'; the first is at 2:1");
    assert_snapshot!(fault(&two), @"m.sdf:3:1: a second link, joint, frame or model is named 'm'; the first is at 2:1");
}

#[test]
fn versions() {
    let of = |version: &str| {
        let text = format!("<sdf version='{version}'><model name='m'><link name='a'/></model></sdf>");
        read_sdf_str(&text, "m.sdf", &SdfOptions::default()).map(drop).map_err(|error| error.to_string())
    };
    for version in ["1.0", "1.4", "1.9", "1.12"] {
        assert_eq!(of(version), Ok(()), "{version}");
    }
    assert_snapshot!(of("x").unwrap_err(), @"m.sdf:1:6: <sdf> has version 'x', expected 1.x");
    assert_snapshot!(of("2.0").unwrap_err(), @"m.sdf:1:6: <sdf> has version '2.0', expected 1.x");
    assert_snapshot!(of("1.").unwrap_err(), @"m.sdf:1:6: <sdf> has version '1.', expected 1.x");
    assert_snapshot!(of("").unwrap_err(), @"m.sdf:1:6: <sdf> has version '', expected 1.x");
}

/// Mass stands in its link's frame: another one that is named would be passed over.
#[test]
fn a_pose_of_mass_relative_to_another_frame() {
    let pose = "<pose relative_to='b'>1 0 0 0 0 0</pose>";
    assert_snapshot!(fault(&format!("<link name='b'/><link name='a'><inertial>{pose}</inertial></link>")), @"m.sdf:2:48: <pose> cannot be read: mass is read in the frame of its link alone");
    let shape = "<geometry><sphere><radius>1</radius></sphere></geometry>";
    assert_snapshot!(fault(&format!("<link name='b'/><link name='a'><inertial auto='true'/><collision name='c'>{pose}{shape}</collision></link>")), @"m.sdf:2:81: <pose> cannot be read: mass is read in the frame of its link alone");
}

/// A link's own frame may stand away from its joint's, by which it is carried.
#[test]
fn visuals_are_drawn_where_they_stand() {
    let visual = |name: &str, pose: &str, geometry: &str| {
        format!(r#"<visual name="{name}"><pose>{pose}</pose><geometry>{geometry}</geometry></visual>"#)
    };
    let seen = [
        visual("v1", "0 0 1 0 0 0", "<box><size>2 4 6</size></box>"),
        visual("v2", "0 1 0 0 0 0", "<cylinder><radius>0.1</radius><length>0.6</length></cylinder>"),
        visual("v3", "0 0 0 0 0 0", "<mesh><uri>model://m/arm.stl</uri><scale>2 2 2</scale></mesh>"),
        visual("v4", "0 0 0 0 0 0", "<plane><normal>0 0 1</normal></plane>"),
        visual("v5", "0 0 0 0 0 0", "<sphere><radius>many</radius></sphere>"),
        r#"<visual name="v6"><pose relative_to="j">0 0 0 0 0 0</pose><geometry><sphere><radius>1</radius></sphere></geometry></visual>"#
            .to_owned(),
    ]
    .concat();
    let model = format!(
        r#"<link name="a"><pose>1 0 0 0 0 0</pose>{seen}</link>
        <joint name="j" type="revolute"><pose>0 0 -0.5 0 0 0</pose><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>"#
    );
    let robot = loaded(&model);
    let links = robot.model.links();
    let poses = link_poses(&robot.model, &[0.0]).unwrap();
    let drawn: Vec<(Form, [f64; 3])> = robot
        .looks
        .iter()
        .map(|look| {
            let link = links.iter().position(|link| link.name() == look.link).unwrap();
            (look.form.clone(), (look.pose * poses[link]).r.to_array())
        })
        .collect();
    let mesh = Form::Mesh { file: "model://m/arm.stl".into(), scale: [2.0; 3] };
    assert_eq!(
        drawn,
        [
            (Form::Primitive(Shape::Box([1.0, 2.0, 3.0])), [1.0, 0.0, 1.0]),
            (Form::Primitive(Shape::Cylinder([0.1, 0.3])), [1.0, 1.0, 0.0]),
            (mesh, [1.0, 0.0, 0.0]),
        ]
    );
}

/// A word that nobody reads is noted where another one may have been meant; words of others are let be.
#[test]
fn slips_are_noted() {
    let notes = |link: &str| {
        let findings = loaded(&format!("<link name='a'>{link}</link>")).findings();
        findings.into_iter().filter(|line| line.contains("means nothing")).collect::<Vec<_>>()
    };
    assert_snapshot!(notes("<inertal><mass>2</mass></inertal>").concat(), @"m.sdf:1:51: warning: <inertal> in link 'a' means nothing there and is passed over; did you mean 'inertial'?");
    assert_snapshot!(notes("<inertial><mas>2</mas></inertial>").concat(), @"m.sdf:1:61: warning: <mas> in <inertial> means nothing there and is passed over; did you mean 'mass'?");
    assert_snapshot!(notes("<pose relative='b'>0 0 1 0 0 0</pose>").concat(), @"m.sdf:1:57: warning: 'relative' in <pose> means nothing there and is passed over; did you mean 'relative_to'?");
    assert_eq!(
        notes("<enable_gravity>1</enable_gravity><particle_emitter/><custom:mass xmlns:custom='x'/>"),
        [""; 0]
    );
    assert_snapshot!(fault("<link name='a'><pose degrees='maybe'>0 0 0 0 0 90</pose></link>"), @"m.sdf:2:16: <pose> holds 'maybe', expected 'degrees' to be true or false");
}

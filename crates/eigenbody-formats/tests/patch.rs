//! A model's own file with other numbers in it.

use crate::folder::Folder;
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, InputError, Model};
use eigenbody_formats::{LoadOptions, Loaded, load, patched};
use insta::assert_snapshot;

const ARM: &str = r#"<mujoco model="arm"> <!-- angles in degrees -->
  <default><joint damping="0.1" armature="0.5"/></default>
  <worldbody>
    <geom type="plane" size="1 1 .1"/>
    <body name="upper" pos="0 0 1">
      <joint name="shoulder" axis='0 1 0' range='-90 90' limited="false"/>
      <joint name="turn" axis="0 0 1" armature = "0.25"/>
      <geom size=".1" fromto="0 0 0 0 0 -.5" type="capsule"/>
      <body name="hand" pos="0 0 -.5" euler="0 30 0"><joint name="wrist" type="slide" pos=".1 0 0"/><inertial pos="0 0 .1" mass="1" diaginertia=".1 .1 .1"/></body>
    </body>
  </worldbody>
  <actuator><motor joint="shoulder" gear="10"/></actuator>
</mujoco>
"#;

/// The file again after a change of its model.
fn change(
    folder: &Folder,
    name: &str,
    text: &str,
    change: impl Fn(Model<f64>) -> Result<Model<f64>, InputError>,
) -> Result<String, String> {
    change_on(Base::Fixed, folder, name, text, change)
}

fn change_on(
    base: Base,
    folder: &Folder,
    name: &str,
    text: &str,
    change: impl Fn(Model<f64>) -> Result<Model<f64>, InputError>,
) -> Result<String, String> {
    let path = folder.file(name, text);
    let options = LoadOptions { base, ..LoadOptions::default() };
    let loaded: Loaded = load(path.to_str().unwrap(), &options).unwrap();
    let mended = change(loaded.model.clone()).unwrap();
    patched(&loaded, &mended).map_err(|error| folder.cut(&error.to_string()))
}

/// Lines that differ, `-` before and `+` after.
fn differences(before: &str, after: &str) -> String {
    let (before, after): (Vec<&str>, Vec<&str>) = (before.lines().collect(), after.lines().collect());
    let gone = before.iter().filter(|line| !after.contains(line)).map(|line| format!("-{line}"));
    let new = after.iter().filter(|line| !before.contains(line)).map(|line| format!("+{line}"));
    gone.chain(new).collect::<Vec<_>>().join("\n")
}

/// The same body with matter added to it, about the link's origin.
fn heavier(model: Model<f64>, link: &str, added: RigidInertia<f64>) -> Result<Model<f64>, InputError> {
    let k = model.links().iter().position(|l| l.name() == link).unwrap();
    let (info, body) = (&model.links()[k], model.links()[k].body().unwrap());
    let own = info.link_from_body().inverse().transpose_rigid(*model.bodies()[body].inertia());
    model.with_inertia(k, own + added)
}

fn ball() -> RigidInertia<f64> {
    RigidInertia::from_com(0.5, Vec3::new(0.0, 0.0, 0.25), Sym3::diagonal(0.01, 0.01, 0.01))
}

#[test]
fn only_what_is_changed_changes_in_mjcf() {
    let folder = Folder::new();
    let text = change(&folder, "arm.xml", ARM, |arm| {
        let arm = arm.with_armature(vec![1.0, 2.0, 0.5])?;
        let arm = arm.with_limits(0, Some((-0.5, 1.0)))?.with_limits(2, Some((-0.125, 0.25)))?;
        heavier(heavier(arm, "hand", ball())?, "upper", ball())
    });
    assert_snapshot!(differences(ARM, &text.unwrap()), @r#"
    -      <joint name="shoulder" axis='0 1 0' range='-90 90' limited="false"/>
    -      <joint name="turn" axis="0 0 1" armature = "0.25"/>
    -      <body name="hand" pos="0 0 -.5" euler="0 30 0"><joint name="wrist" type="slide" pos=".1 0 0"/><inertial pos="0 0 .1" mass="1" diaginertia=".1 .1 .1"/></body>
    +      <joint name="shoulder" axis='0 1 0' range='-28.64788975654116 57.29577951308232' limited="true" armature="1.0"/>
    +      <joint name="turn" axis="0 0 1" armature = "2.0"/>
    +      <body name="hand" pos="0 0 -.5" euler="0 30 0"><joint name="wrist" type="slide" pos=".1 0 0" range="-0.125 0.25" limited="true"/><inertial pos="0 0 .1" mass="1" diaginertia=".1 .1 .1"/>
    +        <body name="hand more"><inertial pos="0.1 0.0 0.25" mass="0.5" fullinertia="0.010000000000000009 0.009999999999999995 0.009999999999999995 0.0 0.0 0.0"/></body>
    +      </body>
    +      <body name="upper more"><inertial pos="0.0 0.0 0.25" mass="0.5" fullinertia="0.009999999999999787 0.009999999999999787 0.009999999999999995 0.0 0.0 0.0"/></body>
    "#);
}

#[test]
fn nothing_changed_is_the_file() {
    assert_eq!(change(&Folder::new(), "arm.xml", ARM, Ok).unwrap(), ARM);
}

#[test]
fn angles_of_mjcf_may_be_in_radians() {
    let radians = ARM.replace("<default>", "<compiler angle=\"radian\"/><default>").replace("-90 90", "-1 1");
    let text =
        change(&Folder::new(), "arm.xml", &radians, |arm| arm.with_limits(0, Some((-0.5, 0.75)))).unwrap();
    assert_snapshot!(differences(&radians, &text), @r#"
    -      <joint name="shoulder" axis='0 1 0' range='-1 1' limited="false"/>
    +      <joint name="shoulder" axis='0 1 0' range='-0.5 0.75' limited="true"/>
    "#);
}

#[test]
fn what_mjcf_cannot_change_alone() {
    let folder = Folder::new();
    folder.file(
        "hand.xml",
        r#"<mujocoinclude><body name="b"><joint name="j"/><geom size=".1"/></body></mujocoinclude>"#,
    );
    let armed = |model: Model<f64>| {
        let armature = (1..=model.nv()).map(|d| d as f64).collect();
        model.with_armature(armature)
    };
    let in_world = |text: &str| format!("<mujoco><worldbody>{text}</worldbody></mujoco>");
    let fault = |text: &str| change(&folder, "main.xml", &in_world(text), armed).unwrap_err();
    assert_snapshot!(fault(r#"<include file="hand.xml"/>"#), @"joint 'j' stands in 'hand.xml', which is included: that file would have to change");
    assert_snapshot!(fault(
        r#"<replicate count="2" offset="1 0 0"><body name="b"><joint name="j"/><geom size=".1"/></body></replicate>"#
    ), @"joint 'j0' is one of several that one element makes: they would all change");
    assert_snapshot!(fault(r#"<body><freejoint name="f"/><geom size=".1"/></body>"#), @"joint 'f': its element is no <joint>, and has no armature");
    assert_snapshot!(fault(r#"<body><joint name="ball" type="ball"/><geom size=".1"/></body>"#), @"joint 'ball': its degrees of freedom have one armature together");
    let copies = in_world(
        r#"<replicate count="2" offset="1 0 0"><body name="b"><joint/><geom size=".1"/></body></replicate>"#,
    );
    assert_snapshot!(change(&folder, "main.xml", &copies, |model| heavier(model, "b0", ball())).unwrap_err(), @"link 'b0' is one of several that one element makes: they would all change");
    // What the file says does not count there.
    let doubled = in_world(r#"<body name="b"><joint name="j"/><geom size=".1"/></body>"#)
        .replace("<worldbody>", "<compiler settotalmass=\"3\"/><worldbody>");
    assert_snapshot!(change(&folder, "main.xml", &doubled, |model| heavier(model, "b", ball())).unwrap_err(), @"with link 'b' changed where it stands the file would read as another model");
}

const NECK: &str = r#"<robot name="neck">
  <link name="base"/>
  <link name="first"><visual><geometry><mesh filename="first.stl"/></geometry></visual></link>
  <link name="head">
    <inertial>
      <origin xyz="0 0 0.1" rpy="0.1 0.2 0.3"/> <mass value="1"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/>
    </inertial>
  </link>
  <joint name="yaw" type="revolute"><parent link="base"/><child link="first"/><axis xyz="0 1 0"/>
    <limit effort="30" velocity="2" lower="-1.5" upper="1.5"/> <dynamics damping="0.5"/>
  </joint>
  <joint name="nod" type="continuous"><parent link="first"/><child link="head"/><origin xyz="0 0 0.5" rpy="0 0.5 0"/></joint>
  <!-- kept -->
</robot>
"#;

#[test]
fn only_what_is_changed_changes_in_urdf() {
    let folder = Folder::new();
    let text = change(&folder, "neck.urdf", NECK, |neck| {
        let neck = neck.with_armature(vec![0.5, 0.125])?.with_limits(0, Some((-1.0, 1.5)))?;
        heavier(heavier(neck, "head", ball())?, "first", ball())
    });
    assert_snapshot!(differences(NECK, &text.unwrap()), @r#"
    -<robot name="neck">
    -  <link name="first"><visual><geometry><mesh filename="first.stl"/></geometry></visual></link>
    -    <inertial>
    -      <origin xyz="0 0 0.1" rpy="0.1 0.2 0.3"/> <mass value="1"/>
    -      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/>
    -    </inertial>
    -    <limit effort="30" velocity="2" lower="-1.5" upper="1.5"/> <dynamics damping="0.5"/>
    +<robot name="neck" xmlns:drake="http://drake.mit.edu">
    +  <link name="first"><visual><geometry><mesh filename="first.stl"/></geometry></visual>
    +    <inertial><origin xyz="0.0 0.0 0.25"/><mass value="0.5"/>
    +      <inertia ixx="0.010000000000000002" ixy="0.0" ixz="0.0" iyy="0.010000000000000002" iyz="0.0" izz="0.01"/></inertial>
    +    <inertial><origin xyz="0.0 0.0 0.15"/><mass value="1.5"/>
    +      <inertia ixx="0.13221932433564085" ixy="-0.02752129520046335" ixz="0.029247731978370203" iyy="0.2091797676114701" iyz="0.003952080301277903" izz="0.2536009080528891"/></inertial>
    +    <limit effort="30" velocity="2" lower="-1.0" upper="1.5"/> <dynamics damping="0.5"/>
    +  <transmission name="yaw transmission">
    +    <type>transmission_interface/SimpleTransmission</type>
    +    <joint name="yaw"/>
    +    <actuator name="yaw motor"><drake:rotor_inertia value="0.5"/><drake:gear_ratio value="1"/></actuator>
    +  </transmission>
    +  <transmission name="nod transmission">
    +    <type>transmission_interface/SimpleTransmission</type>
    +    <joint name="nod"/>
    +    <actuator name="nod motor"><drake:rotor_inertia value="0.125"/><drake:gear_ratio value="1"/></actuator>
    +  </transmission>
    "#);
}

/// Rotors that are there stay, and what is added comes to them.
#[test]
fn rotors_come_to_rotors() {
    let folder = Folder::new();
    let once = change(&folder, "neck.urdf", NECK, |neck| neck.with_armature(vec![0.5, 0.0])).unwrap();
    let twice = change(&folder, "neck.urdf", &once, |neck| neck.with_armature(vec![0.25, 0.0])).unwrap();
    let path = folder.file("twice.urdf", &twice);
    let loaded = load(path.to_str().unwrap(), &LoadOptions::default()).unwrap().with_rotors().unwrap();
    assert_eq!(loaded.model.armature(), [0.75, 0.0]);
    assert_eq!(twice.matches("xmlns:drake").count(), 1);
}

#[test]
fn a_floating_base_can_change_too() {
    let folder = Folder::new();
    let text =
        change_on(Base::Floating, &folder, "neck.urdf", NECK, |neck| heavier(neck, "base", ball())).unwrap();
    assert_snapshot!(differences(NECK, &text), @r#"
    -  <link name="base"/>
    +  <link name="base">
    +    <inertial><origin xyz="0.0 0.0 0.25"/><mass value="0.5"/>
    +      <inertia ixx="0.010000000000000002" ixy="0.0" ixz="0.0" iyy="0.010000000000000002" iyz="0.0" izz="0.01"/></inertial>
    "#);
}

#[test]
fn what_urdf_cannot_say() {
    let folder = Folder::new();
    let fault = |change_of: &dyn Fn(Model<f64>) -> Result<Model<f64>, InputError>| {
        change(&folder, "neck.urdf", NECK, change_of).unwrap_err()
    };
    assert_snapshot!(fault(&|neck| neck.with_limits(1, Some((-1.0, 1.0)))), @"joint 'nod': it has no <limit> that could change");
    let armed = NECK.replace("</robot>", concat!(
        r#"<transmission name="t"><joint name="yaw"/><actuator name="a"><rotorInertia>2</rotorInertia></actuator>"#,
        "</transmission></robot>"
    ));
    let path = folder.file("armed.urdf", armed);
    let options = LoadOptions::default();
    let loaded = load(path.to_str().unwrap(), &options).unwrap().with_rotors().unwrap();
    let lighter = loaded.model.clone().with_armature(vec![1.0, 0.0]).unwrap();
    assert_snapshot!(patched(&loaded, &lighter).unwrap_err(), @"joint 'yaw': a rotor can only add armature");
}

#[test]
fn what_is_no_file_of_these() {
    let options = LoadOptions::default();
    let loaded = load("puma560", &options).unwrap();
    let mended = loaded.model.clone().with_armature(vec![1.0; 6]).unwrap();
    assert_snapshot!(patched(&loaded, &mended).unwrap_err(), @"puma560 is no URDF or MJCF file that could be changed");
}

#[test]
fn a_file_that_has_changed_is_left_alone() {
    let folder = Folder::new();
    let path = folder.file("arm.xml", ARM);
    let loaded = load(path.to_str().unwrap(), &LoadOptions::default()).unwrap();
    folder.file("arm.xml", ARM.replace("mass=\"1\"", "mass=\"2\""));
    let error = patched(&loaded, &loaded.model).unwrap_err().to_string();
    assert_snapshot!(folder.cut(&error), @"arm.xml is no longer the file that was read");
}

//! Xacro files, with and without the feature.

use eigenbody_formats::{LoadOptions, load};

const ARM: &str = r#"<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="mass" value="2"/>
<xacro:macro name="rod" params="name parent">
  <link name="${name}"><inertial><mass value="${mass * 0.5}"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="${0.25 * 1.0}"/></inertial></link>
  <joint name="${name}_joint" type="continuous">
    <parent link="${parent}"/><child link="${name}"/><axis xyz="0 0 1"/></joint>
</xacro:macro>
<link name="base"/>
<xacro:rod name="upper" parent="base"/>
<xacro:rod name="lower" parent="upper"/>
</robot>"#;

fn written(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.urdf.xacro");
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

#[cfg(feature = "xacro")]
#[test]
fn macros_expand_to_links_and_joints() {
    let (_folder, path) = written(ARM);
    let arm = load(&path, &LoadOptions::default()).unwrap().model;
    assert_eq!((arm.nv(), arm.dof_name(1).as_str()), (2, "lower_joint"));
    let H = eigenbody::mass_matrix(&arm, &[0.3, -0.2]).unwrap();
    assert_eq!((H[(0, 0)], H[(1, 1)]), (0.5, 0.25));
}

#[cfg(feature = "xacro")]
#[test]
fn what_does_not_expand_is_said() {
    let (_folder, path) = written(&ARM.replace("${mass * 0.5}", "${weight}"));
    let message =
        load(&path, &LoadOptions::default()).unwrap_err().to_string().replace(&path, "arm.urdf.xacro");
    assert!(message.starts_with("arm.urdf.xacro: ") && message.contains("weight"), "{message}");
    assert_eq!(message.lines().count(), 1);
}

#[cfg(not(feature = "xacro"))]
#[test]
fn without_the_feature_the_way_is_told() {
    let (_folder, path) = written(ARM);
    let message =
        load(&path, &LoadOptions::default()).unwrap_err().to_string().replace(&path, "arm.urdf.xacro");
    insta::assert_snapshot!(message, @"arm.urdf.xacro:2:1: <xacro:property> is a xacro macro; expand the file with xacro first");
}

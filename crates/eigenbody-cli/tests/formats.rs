//! Files of every format, from the command line.

use crate::run::{Scratch, failure, json, run, stdout};
use insta::assert_snapshot;

const ARM: &str = r#"<mujoco model="arm"><compiler angle="radian"/>
  <worldbody>
    <body name="upper"><joint name="shoulder" range="-1 2" armature="0.5"/><geom size="0.1" pos="0.5 0 0"/>
      <body name="lower" pos="1 0 0"><joint name="elbow"/><geom size="0.1" pos="0.5 0 0"/></body></body>
  </worldbody>
  <equality><joint joint1="elbow" joint2="shoulder" polycoef="0 2"/></equality>
  <keyframe><key name="bent" qpos="0.1 0.2"/></keyframe>
</mujoco>"#;

#[test]
fn a_keyframe_is_a_configuration() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.xml", ARM);
    assert_eq!(json(&["matrix", &arm, "--at", "bent", "--json"])["q"], serde_json::json!([0.1, 0.2]));
    assert_eq!(json(&["matrix", &arm, "--at", "qpos0", "--json"])["q"], serde_json::json!([0.0, 0.0]));
}

#[test]
fn equalities_are_followed_when_asked() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.xml", ARM);
    let dofs = |mimic: &[&str]| json(&[&["matrix", &arm, "--json"], mimic].concat())["dofs"].clone();
    assert_eq!(dofs(&[]), serde_json::json!(["shoulder", "elbow"]));
    assert_eq!(dofs(&["--mimic", "on"]), serde_json::json!(["shoulder"]));
}

#[test]
fn info_lists_what_a_model_consists_of() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.xml", ARM);
    let page = stdout(&["info", &arm]).replace(&arm, "arm.xml");
    assert_snapshot!(page, @"arm.xml
  arm: 2 moving bodies, 8.378 kg, 2 degrees of freedom, 2 coordinates, fixed base

  tree
  └ upper (revolute, 4.189 kg)
    └ lower (revolute, 4.189 kg)

   row  degree of freedom  joint     q  limits               armature  follows
   0    shoulder           revolute  0  -1.000 .. 2.000 rad  0.5000
   1    elbow              revolute  1                                 shoulder

  configurations in the file: qpos0, bent

  no findings");
    let info = json(&["info", &arm, "--json"]);
    assert_eq!((info["nv"].as_u64(), info["dofs"][0]["armature"].as_f64()), (Some(2), Some(0.5)));
}

#[test]
fn a_converted_model_has_the_same_matrix() {
    let scratch = Scratch::new();
    let arm = scratch.file("arm.xml", ARM);
    let copy = scratch.path("copy.xml").to_str().unwrap().to_owned();
    assert!(run(&["convert", &arm, "-o", &copy]).status.success());
    let rows = |file: &str| json(&["matrix", file, "--at", "q=[0.3,0.4]", "--json"])["rows"].clone();
    let (before, after) = (rows(&arm), rows(&copy));
    for (i, j) in [(0, 0), (0, 1), (1, 1)] {
        let entry = |rows: &serde_json::Value| rows[i][j].as_f64().unwrap();
        // 20 ε of the largest entry, about 13
        assert!((entry(&before) - entry(&after)).abs() < 20.0 * f64::EPSILON * 13.0);
    }
    let urdf = scratch.path("copy.urdf").to_str().unwrap().to_owned();
    let message = failure(&["convert", &arm, "-o", &urdf]).replace(&arm, "arm.xml");
    assert_snapshot!(message, @"error: arm.xml: joint 'shoulder' has armature, for which URDF has no place; write MJCF (.xml) instead");
    let message = failure(&["convert", &arm, "-o", "arm.step"]);
    assert_snapshot!(message, @"error: -o arm.step: expected a file named .urdf or .xml (MJCF)");
}

/// Two links and a slider: H_c = (H of the tree along the one motion that is left) / |q̇|², loops moved shut from where they were.
#[test]
fn closed_loops() {
    let scratch = Scratch::new();
    let path = scratch.file(
        "fourbar.xml",
        r#"<mujoco><worldbody><site name="ground" pos="1.7 0 0"/>
<body><joint name="j1"/><geom type="capsule" fromto="0 0 0 1 0 0" size=".05"/>
<body pos="1 0 0"><joint name="j2"/><geom type="capsule" fromto="0 0 0 1 0 0" size=".05"/>
<body pos="1 0 0"><joint name="j3"/><geom type="capsule" fromto="0 0 0 1 0 0" size=".05"/><site name="tip" pos="1 0 0"/></body></body></body>
</worldbody><equality><connect site1="ground" site2="tip"/></equality></mujoco>"#,
    );
    let at = "q=[1.2,-0.9,-1]";
    let matrix = json(&["matrix", &path, "--at", at, "--loops", "closed", "--json"]);
    let numbers = |value: &serde_json::Value| -> Vec<f64> {
        value
            .as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_f64().unwrap_or_else(|| x[0].as_f64().unwrap()))
            .collect()
    };
    let (q, N) = (numbers(&matrix["q"]), numbers(&matrix["basis"]));
    assert!((q[0].cos() + (q[0] + q[1]).cos() + (q[0] + q[1] + q[2]).cos() - 1.7).abs() < 1e-10, "{q:?}");
    assert_eq!((matrix["loops"]["rank"].as_u64(), matrix["loops"]["freedom"].as_u64()), (Some(2), Some(1)));
    let tree = json(&["matrix", &path, "--at", &format!("q={q:?}"), "--json"]);
    let H = |i: usize, j: usize| tree["rows"][i][j].as_f64().unwrap();
    let expected: f64 =
        (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| N[i] * H(i, j) * N[j]).sum();
    let found = matrix["rows"][0][0].as_f64().unwrap();
    // nine products
    assert!((found / expected - 1.0).abs() < 30.0 * f64::EPSILON, "{found} {expected}");
    let spectrum = json(&["spectrum", &path, "--at", at, "--loops", "closed", "--json"]);
    assert_eq!((spectrum["lambda_max"].as_f64(), spectrum["kappa"].as_f64()), (Some(found), Some(1.0)));
    assert_eq!(spectrum["findings"].as_array().unwrap().len(), 0);
    insta::assert_snapshot!(failure(&["spectrum", &path, "--loops", "closed", "--method", "sturm"]), @"error: --loops closed leaves no tree: it takes neither --method sturm nor --count-below");
}

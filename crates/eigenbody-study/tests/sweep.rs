//! Sweeps: what a plan is recognised by.

use eigenbody_study::Cell;
use eigenbody_study::sweep::{Plan, Spec};

/// A plan of one robot in a file of this name, in a folder of its own, and its rows.
fn plan(file: &str, robot: &str, at: &str) -> (Plan, Vec<Vec<Cell>>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(file), robot).unwrap();
    let spec = Spec::parse(&format!("[[robots]]\nmodel = \"{file}\"\nat = \"{at}\"\n")).unwrap();
    let plan = Plan::new(spec, folder.path()).unwrap();
    let rows = plan.compute(0).unwrap().rows;
    (plan, rows)
}

/// Two hinges, the second one following the first.
fn arm(mimic: &str) -> String {
    let link = |name: &str| {
        format!(
            r#"<link name="{name}"><inertial><origin xyz="0 0.3 0.1"/><mass value="2"/>
            <inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>"#
        )
    };
    let joint = |name: &str, parent: &str, child: &str, more: &str| {
        format!(
            r#"<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>
            <origin xyz="0 0.5 0"/><axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>{more}</joint>"#
        )
    };
    let (links, follows) = (["a", "b"].map(link).concat(), format!(r#"<mimic joint="first" {mimic}/>"#));
    let joints = joint("first", "base", "a", "") + &joint("second", "a", "b", &follows);
    format!(r#"<robot name="arm"><link name="base"/>{links}{joints}</robot>"#)
}

fn keyed(angle: f64) -> String {
    format!(
        r#"<mujoco><worldbody><body><joint/><geom size="0.1"/>
        <body pos="0 0.5 0"><joint axis="1 0 0"/><geom size="0.1" pos="0 0 0.3"/></body></body></worldbody>
        <keyframe><key name="home" qpos="{angle} {angle}"/></keyframe></mujoco>"#
    )
}

/// A sweep was taken up again after its robot's mimic joint had been edited: multipliers, offsets and keyframes were no part of the
/// fingerprint, and the table got rows of two robots.
#[test]
fn plans_whose_rows_differ_differ() {
    let arms = ["multiplier=\"1\"", "multiplier=\"2\"", "offset=\"0.5\""]
        .map(|mimic| plan("arm.urdf", &arm(mimic), "first=0.3"));
    let homes = [0.3, 0.4].map(|angle| plan("arm.xml", &keyed(angle), "home"));
    for ((a, rows), (b, others)) in [(&arms[0], &arms[1]), (&arms[0], &arms[2]), (&homes[0], &homes[1])] {
        assert_ne!(rows, others);
        assert_ne!(a.fingerprint("1"), b.fingerprint("1"));
        assert_ne!(a.models_text(), b.models_text());
    }
}

/// Where a file stands and what its comments say is no part of a plan; the spec and the version are.
#[test]
fn plans_whose_rows_agree_agree() {
    let text = arm("multiplier=\"2\"");
    let of = |text: &str, at: &str| plan("arm.urdf", text, at).0.fingerprint("1");
    assert_eq!(of(&text, "first=0.3"), of(&(text.clone() + "<!-- edited -->"), "first=0.3"));
    assert_ne!(of(&text, "first=0.3"), of(&text, "first=0.4"));
    let (plan, _) = plan("arm.urdf", &text, "first=0.3");
    assert_ne!(plan.fingerprint("1"), plan.fingerprint("2"));
}

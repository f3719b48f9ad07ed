//! H, entry by entry.

use super::cases::CASES;
use super::{loaded, world};
use eigenbody::mass_matrix;

#[test]
fn every_case_is_mujocos() {
    for (name, text, q, expected) in CASES {
        let H = mass_matrix(&loaded(text).model, q).unwrap();
        assert_eq!(H.as_slice().len(), expected.len(), "{name}");
        let largest = expected.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (found, expected) in H.as_slice().iter().zip(*expected) {
            // 200 ε of the largest entry, for both programs' sums; MuJoCo's ellipsoid shell is a difference of two
            // ellipsoids a micrometre apart, which loses five digits.
            let lost = if *name == "shells" { 1e5 } else { 1.0 };
            let close = (found - expected).abs() <= 200.0 * f64::EPSILON * lost * largest;
            assert!(close, "{name}: {found:e} instead of {expected:e} of {largest:e}");
        }
    }
}

#[test]
fn an_aligned_body_moves_about_its_principal_axes() {
    let body =
        r#"<body pos="1 2 3"><freejoint align="true"/><geom type="box" size=".1 .2 .3" pos="1 0 0"/></body>"#;
    let loaded = world(body);
    let q = loaded.configuration("qpos0", false).unwrap();
    assert_eq!(q, [2.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0]);
    let H = mass_matrix(&loaded.model, &q).unwrap();
    let m = 8.0 * 0.1 * 0.2 * 0.3 * 1000.0;
    let expected = [m * 0.13 / 3.0, m * 0.10 / 3.0, m * 0.05 / 3.0, m, m, m];
    for i in 0..6 {
        for j in 0..6 {
            let expected = if i == j { expected[i] } else { 0.0 };
            // 10 ε of the mass
            assert!((H[(i, j)] - expected).abs() <= 10.0 * f64::EPSILON * m, "{i} {j} {}", H[(i, j)]);
        }
    }
}

#[test]
fn a_free_joint_has_its_armature_on_all_six() {
    let ball = |joint: &str| {
        let loaded = world(&format!("<body>{joint}<geom size='.1'/></body>"));
        mass_matrix(&loaded.model, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]).unwrap()
    };
    let (bare, heavy) = (ball("<freejoint/>"), ball("<joint type='free' armature='2'/>"));
    for i in 0..6 {
        // 2 ε of the sum
        assert!((heavy[(i, i)] - bare[(i, i)] - 2.0).abs() <= 2.0 * f64::EPSILON * heavy[(i, i)]);
    }
}

#[test]
fn actuators_of_a_replicated_joint_are_replicated() {
    let text = "<mujoco><worldbody><replicate count='2'><body><joint name='j'/><geom size='.1'/></body></replicate></worldbody>
        <actuator><motor joint='j' armature='2' gear='3'/><motor joint='j1' armature='1'/></actuator>
        <tendon><fixed armature='1'><joint joint='j0' coef='2'/></fixed></tendon></mujoco>";
    let loaded = loaded(text);
    assert_eq!((loaded.model.armature(), loaded.findings().len()), ([22.0, 19.0].as_slice(), 0));
}

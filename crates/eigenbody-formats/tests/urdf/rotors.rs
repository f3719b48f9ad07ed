//! Rotor inertia behind gears, for those who ask.

use eigenbody_formats::{Loaded, UrdfOptions, read_urdf_str};
use insta::assert_snapshot;

fn read(transmission: &str) -> Result<Loaded, String> {
    let text = format!(
        r#"<robot name="r" xmlns:drake="http://drake.mit.edu"><link name="a"/><link name="b"/>
           <joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>
           <transmission name="t">{transmission}</transmission></robot>"#
    );
    read_urdf_str(&text, "r.urdf", &UrdfOptions::default()).map_err(|error| error.to_string())
}

const ACTUATOR: &str = r#"<joint name="j"/><actuator name="m"><mechanicalReduction>50</mechanicalReduction>
    <rotorInertia>2e-4</rotorInertia></actuator>"#;

#[test]
fn a_rotor_counts_with_the_square_of_its_gear() {
    let drake = r#"<joint name="j"/><actuator name="m"><drake:rotor_inertia value="2e-4"/><drake:gear_ratio value="50"/></actuator>"#;
    for transmission in [ACTUATOR, drake] {
        let loaded = read(transmission).unwrap();
        assert_eq!(loaded.model.armature(), [0.0]);
        let with = loaded.with_rotors().unwrap();
        assert!((with.model.armature()[0] - 0.5).abs() < f64::EPSILON);
        assert!(!with.findings().iter().any(|finding| finding.contains("rotor")));
    }
}

#[test]
fn a_rotor_that_is_left_out_is_noted() {
    let found = read(ACTUATOR).unwrap().findings();
    assert_snapshot!(found.last().unwrap(), @"r.urdf:3:12: warning: the rotor of joint 'j' has inertia: H is without it; --rotors on adds it");
    // A transmission without inertia says nothing of H.
    assert!(read(r#"<joint name="j"/>"#).unwrap().rotors.is_empty());
}

#[test]
fn rotors_that_make_no_sense() {
    assert_snapshot!(read(&ACTUATOR.replace("2e-4", "light")).unwrap_err(), @"r.urdf:4:5: <rotorInertia> holds 'light', expected a finite number");
    let with = |transmission: &str| read(transmission).unwrap().with_rotors().unwrap_err().to_string();
    assert_snapshot!(with(&ACTUATOR.replace("\"j\"", "\"k\"")), @"r.urdf: a rotor is on joint 'k', which is no moving joint");
    assert_snapshot!(with(&ACTUATOR.replace("2e-4", "-1")), @"r.urdf: armature[0] = -2500, expected zero or more");
}

//! Springs, dampers and feedback: numbers that MuJoCo 4.0 has for the same file.

use eigenbody::stability::{Integrator, Spring, SpringSource};
use eigenbody_formats::{Loaded, MjcfOptions, Stepping, read_mjcf_str};

const FILE: &str = r#"<mujoco><option timestep="0.005" integrator="implicitfast"/>
<default><position kp="7" kv="2"/><default class="a"><general biastype="affine" biasprm="0 -3 -1"/></default></default>
<worldbody><body name="b"><joint name="j" stiffness="1 2 3" damping="4 5 6"/><geom size=".1"/>
<body pos="1 0 0"><joint name="k" springdamper="0.1 1"/><geom size=".1" pos=".2 0 0"/>
<body pos="1 0 0"><joint name="bl" type="ball" stiffness="1" damping="2"/><geom size=".1" pos=".2 .1 0"/></body></body></body></worldbody>
<tendon><fixed name="t" stiffness="3" damping="1"><joint joint="j" coef="1"/><joint joint="k" coef="-2"/></fixed></tendon>
<actuator>ACTUATORS</actuator></mujoco>"#;

fn read(actuators: &str) -> Loaded {
    read_mjcf_str(&FILE.replace("ACTUATORS", actuators), "a.xml", &MjcfOptions::default()).unwrap()
}

/// Stiffness, damping and arms of the one actuator.
fn actuator(element: &str) -> (f64, f64, Vec<(usize, f64)>) {
    let all = read(element).springs;
    let found: Vec<Spring> = all.into_iter().filter(|s| s.source == SpringSource::Actuator).collect();
    match found.as_slice() {
        [] => (0.0, 0.0, Vec::new()),
        [one] => (one.stiffness, one.damping, one.arms.clone()),
        _ => panic!("{found:?}"),
    }
}

#[test]
fn joints_and_tendons() {
    let loaded = read("");
    assert_eq!(loaded.stepping, Some(Stepping { step: 0.005, integrator: Integrator::ImplicitVelocity }));
    let of = |name: &str| loaded.springs.iter().filter(|s| s.name == name).cloned().collect::<Vec<_>>();
    let j = &of("j")[0];
    assert_eq!((j.stiffness, j.damping, j.source), (1.0, 4.0, SpringSource::Joint));
    // As MuJoCo 4.0 prints them, to its digits.
    let k = &of("k")[0];
    assert!((k.stiffness - 29.02206814).abs() < 1e-6 && (k.damping - 5.80441363).abs() < 1e-6, "{k:?}");
    assert_eq!(of("bl").len(), 3);
    assert_eq!(of("t")[0].arms, [(0, 1.0), (1, -2.0)]);
}

#[test]
fn actuators_by_their_shorthands() {
    for (element, stiffness, damping) in [
        (r#"<motor joint="j" gear="3"/>"#, 0.0, 0.0),
        (r#"<position joint="j"/>"#, 7.0, 2.0),
        (r#"<velocity joint="j"/>"#, 0.0, 1.0),
        (r#"<velocity joint="j" kv="9"/>"#, 0.0, 9.0),
        (r#"<general joint="j" class="a"/>"#, 3.0, 1.0),
        (r#"<general joint="j" class="a" biastype="none"/>"#, 0.0, 0.0),
        (r#"<intvelocity joint="j" kp="3" actrange="0 1"/>"#, 3.0, 0.0),
        (r#"<damper joint="j" kv="3" ctrlrange="0 1"/>"#, 0.0, 0.0),
        (r#"<cylinder joint="j" bias="1 -2 -3"/>"#, 2.0, 3.0),
        (r#"<position class="a" joint="j"/>"#, 7.0, 1.0),
        (r#"<motor class="a" joint="j"/>"#, 0.0, 0.0),
        (r#"<general joint="j"/>"#, 7.0, 2.0),
    ] {
        let (k, c, arms) = actuator(element);
        assert_eq!((k, c), (stiffness, damping), "{element}");
        assert!(arms.is_empty() || arms == [(0, 1.0)], "{element} {arms:?}");
    }
}

#[test]
fn gears_tendons_balls_and_damping_ratios() {
    let (k, c, arms) = actuator(r#"<position joint="k" kp="4" dampratio="1" gear="2"/>"#);
    assert!(k == 4.0 && (c - 1.07744268).abs() < 1e-7 && arms == [(1, 2.0)], "{k} {c} {arms:?}");
    assert_eq!(actuator(r#"<position tendon="t" kp="3" gear="2"/>"#), (3.0, 2.0, vec![(0, 2.0), (1, -4.0)]));
    let (k, _, arms) = actuator(r#"<position joint="bl" gear="1 2 3" kp="5"/>"#);
    assert_eq!((k, arms), (5.0, vec![(2, 1.0), (3, 2.0), (4, 3.0)]));
}

#[test]
fn what_cannot_be_taken_along_is_noted() {
    let loaded = read(r#"<muscle name="m" joint="j"/>"#);
    assert!(
        loaded.findings().iter().any(|note| note.contains("time steps are judged without")),
        "{:?}",
        loaded.findings()
    );
}

#[test]
fn flags_turn_springs_off() {
    let off = |flag: &str| {
        let text = FILE.replace("<option ", "<option><flag FLAG/></option><option ").replace("FLAG", flag);
        let text =
            text.replace("ACTUATORS", r#"<position joint="j"/>"#).replace(r#"integrator="implicitfast""#, "");
        read_mjcf_str(&text, "a.xml", &MjcfOptions::default()).unwrap()
    };
    assert!(off(r#"actuation="disable""#).springs.iter().all(|s| s.source != SpringSource::Actuator));
    assert!(
        off(r#"spring="disable""#)
            .springs
            .iter()
            .filter(|s| s.source == SpringSource::Joint)
            .all(|s| s.stiffness == 0.0)
    );
    assert_eq!(off(r#"eulerdamp="disable""#).stepping.unwrap().integrator, Integrator::SemiImplicitEuler);
    assert_eq!(off(r#"gravity="enable""#).stepping.unwrap().integrator, Integrator::DampedEuler);
}

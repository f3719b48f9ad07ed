//! Loops: what they are fastened to, and where they are closed.

use super::world;
use eigenbody::dynamics::{Tie, closure_residual};
use eigenbody_formats::{MjcfOptions, read_mjcf_str};

const BALL: &str = "<geom size='.1'/>";

fn with(bodies: &str, equality: &str) -> eigenbody_formats::Loaded {
    let text = format!("<mujoco><worldbody>{bodies}</worldbody><equality>{equality}</equality></mujoco>");
    read_mjcf_str(&text, "m.xml", &MjcfOptions::default()).unwrap()
}

/// By bodies, loops are closed in the pose of the file, which coordinates with `ref` do not have at zero.
#[test]
fn the_pose_of_the_file_closes_them() {
    let bodies = format!(
        "<body name='a' pos='1 0 0' euler='0 20 0'><joint ref='30' axis='0 1 0' pos='.1 0 0'/>{BALL}
         <body name='b' pos='0 1 0'><joint type='slide' ref='0.2'/><joint axis='1 0 0'/>{BALL}</body></body>"
    );
    let q = [30f64.to_radians(), 0.2, 0.0];
    for equality in [
        "<connect body1='b' anchor='.1 .2 .3'/>",
        "<connect body1='a' body2='b' anchor='.1 .2 .3'/>",
        "<weld body1='a' body2='b'/>",
        "<weld body1='b'/>",
    ] {
        let found = with(&bodies, equality);
        let closures = found.closures().unwrap();
        let open = closure_residual(&found.model, &q, &closures).unwrap();
        assert_eq!(open.len(), if closures[0].tie == Tie::Weld { 6 } else { 3 });
        // a few products of rotations with lengths near 1
        assert!(open.iter().all(|x| x.abs() < 32.0 * f64::EPSILON), "{equality}: {open:?}");
        let elsewhere = closure_residual(&found.model, &[0.0; 3], &closures).unwrap();
        assert!(elsewhere.iter().any(|x| x.abs() > 0.01), "{equality}: {elsewhere:?}");
    }
}

/// A pose that the file gives, and sites, hold as they are: open by what they are apart.
#[test]
fn given_poses_hold() {
    let bodies = format!(
        "<body name='a' pos='1 0 0'><joint/>{BALL}<frame pos='0 0 1'><site name='s' pos='.1 0 0'/></frame></body>
         <body name='b' pos='0 1 0'><joint/>{BALL}</body><site name='t' pos='1 0 .5'/>"
    );
    let open = |equality: &str| {
        let found = with(&bodies, equality);
        closure_residual(&found.model, &[0.0; 2], &found.closures().unwrap()).unwrap()
    };
    assert_eq!(open("<weld body1='a' body2='b' relpose='0 1 0 1 0 0 0'/>"), [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let apart = open("<connect site1='t' site2='s'/>");
    assert!(apart.iter().zip([0.1, 0.0, 0.5]).all(|(x, y)| (x - y).abs() < 4.0 * f64::EPSILON), "{apart:?}");
}

#[test]
fn what_it_is_fastened_to_must_be_one() {
    let bodies = format!(
        "<body name='a'><joint/>{BALL}</body><replicate count='2'><body name='b'><joint/>{BALL}</body></replicate>"
    );
    let found = with(&bodies, "<connect name='c' body1='a' body2='b' anchor='0 0 0'/>");
    let message = "m.xml: connect 'c' cannot be closed: an end of it names not one body or site of the model";
    assert_eq!(found.closures().unwrap_err().to_string(), message);
    assert_eq!(world(&bodies).closures().unwrap(), []);
}

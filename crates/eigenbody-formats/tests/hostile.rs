//! Files made to break a reader: an error or a model, in bounded time and memory, never a panic.

use crate::mjcf::CASES;
use crate::mutation::mutated;
use eigenbody::model::Random;
use eigenbody_formats::{MjcfOptions, UrdfOptions, read_mjcf_str, read_urdf_str};

/// How many of so many mutations of some texts are still read.
fn survivors(texts: &[&str], count: usize, read: impl Fn(&str) -> bool) -> usize {
    let mut random = Random::new(20040101);
    (0..count).filter(|k| read(&mutated(texts[k % texts.len()], &mut random))).count()
}

#[test]
fn five_thousand_broken_urdf_files() {
    let pendulum = include_str!("data/pendulum.urdf");
    let arm = r#"<robot name="arm"><link name="a"/><link name="b"><inertial><origin xyz="1 0 0" rpy="0 1 2"/><mass value="2"/>
        <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><link name="c"/>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>
        <joint name="k" type="prismatic"><parent link="b"/><child link="c"/><mimic joint="j" multiplier="2"/></joint></robot>"#;
    let read = |text: &str| read_urdf_str(text, "r.urdf", &UrdfOptions::default()).is_ok();
    let survived = survivors(&[pendulum, arm], 5000, read);
    // Most accidents are noticed, some are harmless.
    assert!((100..4500).contains(&survived), "{survived}");
}

#[test]
fn ten_thousand_broken_mjcf_files() {
    let texts: Vec<&str> = CASES.iter().map(|case| case.1).collect();
    let read = |text: &str| read_mjcf_str(text, "m.xml", &MjcfOptions::default()).is_ok();
    let survived = survivors(&texts, 10_000, read);
    assert!((200..9000).contains(&survived), "{survived}");
}

/// What the reader says of a world.
fn world(bodies: &str) -> Result<usize, String> {
    let text = format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>");
    let read = read_mjcf_str(&text, "m.xml", &MjcfOptions::default());
    read.map(|loaded| loaded.model.nv()).map_err(|error| error.to_string())
}

#[test]
fn bodies_as_deep_as_the_reference_reads() {
    let chain = |n: usize| "<body><joint/><geom size='.1'/>".repeat(n) + &"</body>".repeat(n);
    assert_eq!(world(&chain(490)), Ok(490));
    assert_eq!(world(&chain(510)).unwrap_err(), "m.xml:1:15464: elements are nested deeper than 500");
}

#[test]
fn replicates_of_replicates() {
    let nested =
        "<replicate count='100'>".repeat(4) + "<body><geom size='.1'/></body>" + &"</replicate>".repeat(4);
    assert_eq!(world(&nested).unwrap_err(), "m.xml:1:43: more than 200000 bodies");
    let geoms = format!("<body><joint/>{}</body>", nested.replace("<body>", "").replace("</body>", ""));
    assert_eq!(world(&geoms).unwrap_err(), "m.xml:1:57: more than 1000000 geoms");
}

#[test]
fn attachments_of_themselves() {
    let frame =
        "<body><joint/><geom size='.1'/><frame name='f'><attach frame='f' prefix='p'/></frame></body>";
    assert_eq!(world(frame).unwrap_err(), "m.xml:1:75: no body or frame is named 'f' to attach");
    let doubling: String = (0..30).map(|k| format!("<attach body='b' prefix='p{k}'/>")).collect();
    let body = format!("<body name='b'><geom size='.1'/>{doubling}</body>");
    assert_eq!(world(&body).unwrap_err(), "m.xml:1:569: more than 200000 bodies");
}

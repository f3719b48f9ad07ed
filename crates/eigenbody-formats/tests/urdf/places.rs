//! Findings at their lines.

use super::{joint, link};
use eigenbody::Base;
use eigenbody::model::Place;
use eigenbody_formats::{Location, UrdfOptions, read_urdf_str};
use insta::assert_snapshot;

#[test]
fn a_finding_is_printed_with_its_place() {
    let flat = link("ünflat", 1.0, "", [1.0, 1.0, 3.0, 0.0, 0.0, 0.0]);
    let hinge = joint("continuous", "base", "ünflat", r#"<mimic joint="nobody"/>"#);
    let text = format!("<robot name=\"r\">\n<link name=\"base\"/> <!-- äöü --> {flat}\n\n  {hinge}</robot>");
    let loaded = read_urdf_str(&text, "r.urdf", &UrdfOptions::default()).unwrap();
    let found = loaded.findings();
    assert_eq!(found.len(), 2);
    assert_snapshot!(found[0], @"r.urdf:2:34: warning: inertia of link 'ünflat' is not physical: principal moments 1.000e0 + 1.000e0 < 3.000e0 kg m²");
    assert_snapshot!(found[1], @"r.urdf:5:3: warning: mimic joint 'ünflat' follows 'nobody', which is no moving joint; it is left free");
    assert_eq!(loaded.warning(&loaded.model.findings()[1]), found[1]);
    assert_eq!(loaded.location(loaded.model.findings()[0].place()), Some(Location { line: 2, column: 34 }));
    assert_eq!(loaded.location(Place::Model), None);
}

#[test]
fn a_family_has_findings_without_a_place() {
    let loaded = eigenbody_formats::load("chain(1)", &Default::default()).unwrap();
    assert_snapshot!(loaded.findings()[0], @"chain(1, m=1, l=1): warning: inertia of link 'link_1' is not positive definite: principal moments 0.000e0, 8.333e-2, 8.333e-2 kg m²");
}

#[test]
fn a_fixed_joint_may_be_called_floating_base() {
    let weld =
        r#"<joint name="floating_base" type="fixed"><parent link="base"/><child link="trunk"/></joint>"#;
    let text = format!(r#"<robot name="r"><link name="base"/><link name="trunk"/>{weld}</robot>"#);
    let options = UrdfOptions { base: Base::Floating };
    assert_eq!(read_urdf_str(&text, "r.urdf", &options).unwrap().model.nv(), 6);
    let error = read_urdf_str(&text.replace("fixed", "planar"), "r.urdf", &options).unwrap_err();
    assert_snapshot!(error, @"r.urdf:1:56: the name 'floating_base' is that of the floating base's own joint; rename this joint");
}

#[test]
fn a_long_robot_is_read_in_one_pass() {
    // Every link is a finding, all on one line: positions found one by one would take n² steps.
    let n = 20_000;
    let mut text = String::from(r#"<robot name="long"><link name="0"/>"#);
    for i in 1..=n {
        text += &link(&i.to_string(), 1.0, "", [1.0, 1.0, 3.0, 0.0, 0.0, 0.0]);
        text += &joint("continuous", &(i - 1).to_string(), &i.to_string(), r#"<origin xyz="1 0 0"/>"#);
    }
    text = text.replace('\n', " ") + "</robot>";
    let loaded = read_urdf_str(&text, "long.urdf", &UrdfOptions::default()).unwrap();
    assert_eq!((loaded.model.nv(), loaded.findings().len()), (n, n));
    let last = loaded.location(loaded.model.findings()[n - 1].place()).unwrap();
    assert_eq!(text[last.column as usize - 1..].find(&format!(r#"<link name="{n}">"#)), Some(0));
}

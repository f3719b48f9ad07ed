//! Models written and read again: the same H, degree of freedom by degree of freedom.

use crate::mjcf::CASES;
use eigenbody::model::JointSpec;
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Joint, Model, ModelBuilder, family, mass_matrix};
use eigenbody_formats::{MjcfOptions, UrdfOptions, read_mjcf_str, read_urdf_str, write_mjcf, write_urdf};
use insta::assert_snapshot;

/// The same H in five configurations, rows matched by name; q is the same where the order is.
fn assert_same(model: &Model<f64>, again: &Model<f64>) {
    assert_eq!((model.nq(), model.nv()), (again.nq(), again.nv()));
    let names: Vec<String> = (0..again.nv()).map(|d| again.dof_name(d)).collect();
    let row = |d: usize| {
        let name = model.dof_name(d);
        names.iter().position(|n| *n == name).unwrap_or_else(|| panic!("no {name} in {names:?}"))
    };
    let order: Vec<usize> = (0..model.nv()).map(row).collect();
    for seed in 0..5 {
        let q = model.random(seed);
        let mut q_again = again.neutral();
        for joint in model.joints() {
            let find = |name: &str| again.joints().iter().find(|j| j.name() == name);
            for (k, from) in joint.coordinates().enumerate() {
                // A joint in two parts has the coordinates of both.
                let to = match find(joint.name()) {
                    Some(joint) => joint.coordinates().start + k,
                    None => find(&model.dof_name(joint.dofs().start + k)).unwrap().coordinates().start,
                };
                q_again[to] = q[from];
            }
        }
        let (H, H_again) = (mass_matrix(model, &q).unwrap(), mass_matrix(again, &q_again).unwrap());
        for i in 0..model.nv() {
            for j in 0..model.nv() {
                let difference = (H[(i, j)] - H_again[(order[i], order[j])]).abs();
                // 200 ε of the largest entry, for centres of mass and angles on the way
                assert!(difference <= 200.0 * f64::EPSILON * H.max_abs(), "{i} {j} {difference:e}");
            }
        }
    }
}

fn through_mjcf(model: &Model<f64>) {
    let text = write_mjcf(model).unwrap();
    assert_same(model, &read_mjcf_str(&text, "again.xml", &MjcfOptions::default()).unwrap().model);
}

fn through_urdf(model: &Model<f64>, base: Base) {
    let text = write_urdf(model).unwrap();
    assert_same(model, &read_urdf_str(&text, "again.urdf", &UrdfOptions { base }).unwrap().model);
}

/// A link of 2 kg beside its origin.
fn rod() -> RigidInertia<f64> {
    RigidInertia::from_com(2.0, Vec3::new(0.1, -0.2, 0.3), Sym3::diagonal(0.2, 0.3, 0.4))
}

/// A chain of joints of these kinds, each somewhere else and otherwise.
fn chain(kinds: &[Joint<f64>], base: Base) -> Model<f64> {
    let mut robot = ModelBuilder::new("a <b> & \"c\"");
    let mut last = robot.link("root", rod());
    for (k, kind) in kinds.iter().enumerate() {
        let link = robot.link(format!("l{k}"), rod());
        let E = eigenbody::spatial::Mat3::rotation_rpy(
            0.3 * k as f64,
            std::f64::consts::FRAC_PI_2 * (k % 2) as f64,
            1.0,
        );
        let at = Transform::new(E, Vec3::new(0.5, 0.1, -0.2));
        robot.joint(
            JointSpec::new(format!("j{k}"), *kind, last, link).at(at).about(Vec3::new(1.0, 2.0, -1.0)),
        );
        last = link;
    }
    robot.build(base).unwrap()
}

#[test]
fn mjcf_files_survive_both_formats() {
    for (name, text, ..) in CASES {
        let model = read_mjcf_str(text, "m.xml", &MjcfOptions::default()).unwrap().model;
        through_mjcf(&model);
        let plain = model.armature().iter().all(|&a| a == 0.0) && *name != "ball";
        if plain {
            through_urdf(&model, Base::Fixed);
        }
    }
}

#[test]
fn every_kind_that_a_format_knows() {
    let first = Vec3::new(1.0, 1.0, 0.0);
    let shared = [
        Joint::Revolute,
        Joint::Prismatic,
        Joint::Universal { first },
        Joint::Continuous,
        Joint::Cylindrical,
    ];
    through_urdf(&chain(&shared, Base::Fixed), Base::Fixed);
    through_urdf(&chain(&shared, Base::Floating), Base::Floating);
    through_urdf(&chain(&[Joint::Planar, Joint::Floating], Base::Fixed), Base::Fixed);
    through_mjcf(&chain(&shared, Base::Fixed));
    through_mjcf(&chain(&shared, Base::Floating));
    through_mjcf(&chain(&[Joint::Spherical, Joint::Revolute], Base::Fixed));
    through_mjcf(&family::puma560().unwrap());
}

#[test]
fn mimic_joints_follow_as_before() {
    let text = r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>
        <joint name="k" type="revolute"><parent link="b"/><child link="c"/><mimic joint="j" multiplier="-2" offset="0.5"/></joint></robot>"#;
    let model = read_urdf_str(text, "r.urdf", &UrdfOptions::default()).unwrap().model;
    let mjcf = read_mjcf_str(&write_mjcf(&model).unwrap(), "r.xml", &MjcfOptions::default()).unwrap().model;
    let urdf = read_urdf_str(&write_urdf(&model).unwrap(), "r.urdf", &UrdfOptions::default()).unwrap().model;
    for again in [mjcf, urdf] {
        assert_eq!(again.coupling().unwrap().expand(&[0.25]), [0.25, 0.0]);
    }
}

#[test]
fn what_a_format_cannot_say_is_refused() {
    assert_snapshot!(write_urdf(&chain(&[Joint::Spherical], Base::Fixed)).unwrap_err(), @"joint 'j0' of kind spherical has no counterpart in URDF");
    assert_snapshot!(write_urdf(&family::puma560().unwrap()).unwrap_err(), @"joint 'joint_1' has armature, for which URDF has no place; write MJCF (.xml) instead");
    let mut robot = ModelBuilder::new("bad");
    let base = robot.link("base", RigidInertia::ZERO);
    let bad = RigidInertia::from_com(1.0, Vec3::X, Sym3::diagonal(0.1, -0.5, 0.1));
    let bad = robot.link("inside_out", bad);
    robot.joint(JointSpec::new("j0", Joint::Revolute, base, bad));
    let bad = robot.build(Base::Fixed).unwrap();
    assert_snapshot!(write_mjcf(&bad).unwrap_err(), @"link 'inside_out' has principal moments of inertia down to -5e-1 kg m²; MJCF allows none below zero");
    assert_snapshot!(write_mjcf(&chain(&[Joint::Helical { pitch: 0.1 }], Base::Fixed)).unwrap_err(), @"joint 'j0' of kind helical has no counterpart in MJCF");
    assert_snapshot!(write_mjcf(&chain(&[Joint::Planar], Base::Fixed)).unwrap_err(), @"joint 'j0' of kind planar has no counterpart in MJCF");
    assert_snapshot!(write_mjcf(&chain(&[Joint::Revolute, Joint::Floating], Base::Fixed)).unwrap_err(), @"joint 'j1' of kind floating has no counterpart in MJCF");
}

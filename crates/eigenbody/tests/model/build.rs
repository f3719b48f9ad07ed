//! Descriptions that are no kinematic tree are refused, each with the link or joint at fault.

use eigenbody::model::{JointId, JointSpec, LinkId, MimicSpec, Place};
use eigenbody::spatial::{Mat3, RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, BuildError, InputError, Joint, Model, ModelBuilder};

type Robot = ModelBuilder<f64>;
type Spec = JointSpec<f64>;

fn ball() -> RigidInertia<f64> {
    RigidInertia::from_com(1.0, Vec3::ZERO, Sym3::diagonal(0.1, 0.1, 0.1))
}

/// Links a, b, c without joints.
fn links(robot: &mut Robot) -> [LinkId; 3] {
    ["a", "b", "c"].map(|name| robot.link(name, ball()))
}

fn hinge(name: &str, parent: LinkId, child: LinkId) -> Spec {
    JointSpec::new(name, Joint::Revolute, parent, child)
}

/// a -j1-> b -j2-> c, with j2 changed.
fn with(change: impl FnOnce(&mut Spec)) -> Result<Model<f64>, BuildError> {
    let mut robot = Robot::new("test");
    let [a, b, c] = links(&mut robot);
    robot.joint(hinge("j1", a, b));
    let mut spec = hinge("j2", b, c);
    change(&mut spec);
    robot.joint(spec);
    robot.build(Base::Fixed)
}

#[track_caller]
fn assert_joint(result: Result<Model<f64>, BuildError>, joint: usize, message: &str) {
    let error = result.unwrap_err();
    assert_eq!(error.to_string(), message);
    let Place::Joint(id) = error.place() else { panic!("{error:?} points at {:?}", error.place()) };
    assert_eq!(id.index(), joint);
}

#[track_caller]
fn assert_link(result: Result<Model<f64>, BuildError>, link: usize, message: &str) {
    let error = result.unwrap_err();
    assert_eq!(error.to_string(), message);
    let Place::Link(id) = error.place() else { panic!("{error:?} points at {:?}", error.place()) };
    assert_eq!(id.index(), link);
}

#[test]
fn plain_chain_is_built() {
    let model = with(|_| ()).unwrap();
    assert_eq!((model.nv(), model.links().len(), model.findings().len()), (2, 3, 0));
}

#[test]
fn empty_robot() {
    let error = Robot::new("empty").build(Base::Fixed).unwrap_err();
    assert_eq!((error.clone(), error.place()), (BuildError::NoLinks, Place::Model));
}

#[test]
fn loops() {
    let mut robot = Robot::new("test");
    let [a, b, c] = links(&mut robot);
    robot.joint(hinge("j1", a, b));
    robot.joint(hinge("j2", b, c));
    robot.joint(hinge("j3", c, a));
    let message = "joint 'j3' closes a loop: its child link 'a' is among its own ancestors";
    assert_joint(robot.build(Base::Fixed), 2, message);

    let mut robot = Robot::new("root beside a loop");
    let [_, b, c] = links(&mut robot);
    robot.joint(hinge("j1", b, c));
    robot.joint(hinge("j2", c, b));
    let message = "joint 'j2' closes a loop: its child link 'b' is among its own ancestors";
    assert_joint(robot.build(Base::Fixed), 1, message);

    let mut robot = Robot::new("itself");
    let a = robot.link("a", ball());
    robot.joint(hinge("j1", a, a));
    let message = "joint 'j1' closes a loop: its child link 'a' is among its own ancestors";
    assert_joint(robot.build(Base::Fixed), 0, message);
}

#[test]
fn two_roots() {
    let mut robot = Robot::new("test");
    let [a, b, _] = links(&mut robot);
    robot.joint(hinge("j1", a, b));
    let message = "two root links, 'a' and 'c'; a tree has one link that is no joint's child";
    assert_link(robot.build(Base::Fixed), 2, message);
}

#[test]
fn two_parents() {
    let mut robot = Robot::new("test");
    let [a, b, c] = links(&mut robot);
    robot.joint(hinge("j1", a, b));
    robot.joint(hinge("j2", a, c));
    robot.joint(hinge("j3", b, c));
    let message = "link 'c' is the child of joint 'j2' and of joint 'j3'; in a tree a link has one parent";
    assert_joint(robot.build(Base::Fixed), 2, message);
}

#[test]
fn duplicate_names() {
    let mut robot = Robot::new("test");
    let (a, b) = (robot.link("a", ball()), robot.link("a", ball()));
    robot.joint(hinge("j1", a, b));
    assert_link(robot.build(Base::Fixed), 1, "a second link is named 'a'");
    assert_joint(with(|j| j.name = "j1".into()), 1, "a second joint is named 'j1'");
}

/// The floating base brings a joint of that name; without one the name is free.
#[test]
fn floating_base_is_a_name_taken() {
    for base in [Base::Fixed, Base::Floating] {
        let mut robot = Robot::new("test");
        let (a, b) = (robot.link("a", ball()), robot.link("b", ball()));
        robot.joint(hinge("floating_base", a, b));
        match base {
            Base::Fixed => assert_eq!(robot.build(base).unwrap().nv(), 1),
            Base::Floating => assert_joint(robot.build(base), 0, "a second joint is named 'floating_base'"),
        }
    }
}

#[test]
fn links_that_cannot_be() {
    let build = |change: fn(&mut RigidInertia<f64>)| {
        let mut robot = Robot::new("test");
        let a = robot.link("a", ball());
        let mut inertia = ball();
        change(&mut inertia);
        let b = robot.link("b", inertia);
        robot.joint(hinge("j1", a, b));
        robot.build(Base::Fixed)
    };
    assert_link(build(|I| I.m = -1.0), 1, "link 'b' has mass -1, expected zero or more (kg)");
    assert_link(build(|I| I.m = f64::NAN), 1, "mass of link 'b' is not a finite number");
    assert_link(build(|I| I.h.y = f64::INFINITY), 1, "centre of mass of link 'b' is not a finite number");
    assert_link(build(|I| I.I.xz = f64::NAN), 1, "inertia of link 'b' is not a finite number");
}

#[test]
fn joints_that_cannot_be() {
    const NAN: f64 = f64::NAN;
    let bad = |what: &str| format!("{what} of joint 'j2' is not a finite number");
    assert_joint(with(|j| j.axis.x = NAN), 1, &bad("axis"));
    assert_joint(with(|j| j.placement.r.z = NAN), 1, &bad("origin"));
    assert_joint(with(|j| j.placement.E.y.x = NAN), 1, &bad("orientation"));
    assert_joint(with(|j| j.armature = vec![NAN]), 1, &bad("armature"));
    assert_joint(with(|j| j.limits = Some((NAN, 1.0))), 1, &bad("limit"));
    assert_joint(with(|j| j.kind = Joint::Helical { pitch: NAN }), 1, &bad("pitch"));
    let first = Vec3::new(NAN, 0.0, 0.0);
    assert_joint(with(|j| j.kind = Joint::Universal { first }), 1, &bad("first axis"));
    let mimic = MimicSpec { joint: "j1".into(), multiplier: NAN, offset: 0.0 };
    assert_joint(with(|j| j.mimic = Some(mimic)), 1, &bad("mimic"));

    let zero = "joint 'j2' has axis 0 0 0, expected a direction";
    assert_joint(with(|j| j.axis = Vec3::ZERO), 1, zero);
    assert_joint(with(|j| j.kind = Joint::Universal { first: Vec3::ZERO }), 1, zero);
    let two = "joint 'j2' has 2 armature values, expected 1: one a degree of freedom, or none";
    assert_joint(with(|j| j.armature = vec![0.1, 0.2]), 1, two);
    let negative = "joint 'j2' has armature -0.1, expected zero or more (kg m² or kg)";
    assert_joint(with(|j| j.armature = vec![-0.1]), 1, negative);
    let crossed = "joint 'j2' has lower limit 1 above upper limit -1";
    assert_joint(with(|j| j.limits = Some((1.0, -1.0))), 1, crossed);
}

/// Infinite limits are limits, and a fixed, ball or floating joint needs no axis.
#[test]
fn what_is_no_error() {
    assert!(with(|j| j.limits = Some((f64::NEG_INFINITY, f64::INFINITY))).is_ok());
    for kind in [Joint::Fixed, Joint::Spherical, Joint::Floating] {
        assert!(with(|j| (j.kind, j.axis) = (kind, Vec3::ZERO)).is_ok(), "{kind:?}");
    }
}

/// Axes of any length, on any side. An axis of 10²⁰⁰ once became the zero vector, one of 10⁻²⁰⁰ was taken for zero: their
/// squares overflow and vanish.
#[test]
fn axes_are_made_unit() {
    let H = |axis: Vec3<f64>| {
        let model = with(|j| (j.axis, j.placement) = (axis, Transform::translation(Vec3::X))).unwrap();
        eigenbody::mass_matrix(&model, &[0.3, 0.4]).unwrap()
    };
    let [a, b, c] = [0.6, -0.64, 0.48];
    for (axis, along) in [(Vec3::Z, 1.0), (-Vec3::Z, -1.0), (Vec3::X, 0.0), (-Vec3::Y, 0.0)] {
        // 2 ε: a product or two with a number that is a third of another
        assert!((H(axis)[(0, 1)] - 0.1 * along).abs() <= 2.0 * f64::EPSILON * 0.1, "{axis:?}");
    }
    for length in [1e-308, 1e-200, 1e-3, 1.0, 7.0, 1e200, 1e308] {
        let H = H(Vec3::new(a, b, c) * length);
        // 8 ε: a ball about its centre, 0.1 about every axis; 0.48 of it about z
        assert!((H[(1, 1)] - 0.1).abs() <= 8.0 * f64::EPSILON * 0.1, "length {length}: {}", H[(1, 1)]);
        assert!((H[(0, 1)] - 0.048).abs() <= 8.0 * f64::EPSILON * 0.1, "length {length}: {}", H[(0, 1)]);
    }
}

/// Names, limits and places survive: joints in the order given, links in theirs.
#[test]
fn description_can_be_read_back() {
    let mut robot = Robot::new("reader");
    robot.gravity(Vec3::new(0.0, 0.0, -1.62));
    let [a, b, c] = links(&mut robot);
    let lift = Transform::new(Mat3::IDENTITY, Vec3::new(0.0, 0.0, 2.0));
    let second = robot.joint(JointSpec { limits: Some((-1.0, 2.0)), ..hinge("second", b, c).at(lift) });
    let first: JointId =
        robot.joint(JointSpec::new("first", Joint::Cylindrical, a, b).with_armature([0.1, 0.2]));
    assert_eq!((second.index(), first.index()), (0, 1));
    let model = robot.build(Base::Fixed).unwrap();
    assert_eq!((model.name(), model.gravity().z, model.has_floating_base()), ("reader", -1.62, false));
    let names: Vec<String> = (0..3).map(|d| model.dof_name(d)).collect();
    assert_eq!(names, ["second", "first/angle", "first/displacement"]);
    assert_eq!((0..3).map(|d| model.is_translation(d)).collect::<Vec<_>>(), [false, false, true]);
    assert_eq!(model.armature(), [0.0, 0.1, 0.2]);
    assert_eq!((model.joints()[0].limits(), model.joints()[1].limits()), (Some((-1.0, 2.0)), None));
    // The first joint carries the second: bodies stand in that order, DoFs in that of the file.
    assert_eq!(model.dofs().order().collect::<Vec<_>>(), [1, 2, 0]);
    assert_eq!([0, 1, 2].map(|d| model.dofs().parent(d)), [Some(2), None, Some(1)]);
    let links: Vec<_> = model.links().iter().map(|link| (link.name(), link.body())).collect();
    assert_eq!(links, [("a", None), ("b", Some(0)), ("c", Some(1))]);
    assert_eq!(model.bodies()[1].parent(), Some(0));
}

/// Twice a rotation would give numbers of a robot twice as large, and no error.
#[test]
fn orientations_are_rotations() {
    let message = "joint 'j2' has an orientation that is no rotation";
    let twice = Mat3::IDENTITY * 2.0;
    let mirror = Mat3::from_rows(Vec3::X, Vec3::Y, -Vec3::Z);
    let sheared = Mat3::from_rows(Vec3::X, Vec3::new(2e-6, 1.0, 0.0), Vec3::Z);
    for E in [twice, mirror, sheared, Mat3::ZERO] {
        assert_joint(with(|j| j.placement = Transform::new(E, Vec3::ZERO)), 1, message);
    }
    let rounded = Mat3::rotation_rpy(0.3, -1.1, 2.0) * (1.0 + 4e-7);
    assert!(with(|j| j.placement = Transform::new(rounded, Vec3::ZERO)).is_ok());
}

#[test]
fn gravity_is_finite() {
    for gravity in [Vec3::new(0.0, 0.0, f64::NAN), Vec3::new(f64::INFINITY, 0.0, 0.0)] {
        let mut robot = Robot::new("test");
        robot.link("a", ball());
        robot.gravity(gravity);
        let error = robot.build(Base::Fixed).unwrap_err();
        assert_eq!((error.clone(), error.place()), (BuildError::GravityNotFinite, Place::Model));
    }
    let model = with(|_| ()).unwrap();
    let refused = InputError::NotFinite { what: "gravity", index: 2 };
    assert_eq!(model.with_gravity(Vec3::new(0.0, 0.0, f64::NAN)), Err(refused));
}

/// A link's number from another description, in which there are more.
#[test]
fn links_of_another_builder() {
    let mut other = Robot::new("other");
    links(&mut other);
    let far = other.link("d", ball());
    let message = "joint 'j2' is on link number 3, counted from 0, and there are 3";
    assert_joint(with(|j| j.parent = far), 1, message);
    assert_joint(with(|j| j.child = far), 1, message);
}

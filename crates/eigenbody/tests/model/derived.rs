//! What follows from a model and is made when it is first asked for.

use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Family, Model, mass_matrix};

/// What kernels have made of a model for themselves is no part of it, and goes with the inertia that it was made of.
#[test]
fn a_model_that_has_been_used_is_still_the_same() {
    let fresh: Model<f64> = Family::hydra(4, 1.0, 0.4, 1.0).unwrap().model().unwrap();
    let (used, q) = (fresh.clone(), [0.3; 4]);
    let H = mass_matrix(&used, &q).unwrap();
    assert_eq!(used, fresh);
    let rod = RigidInertia::from_com(3.0, Vec3::X, Sym3::diagonal(0.1, 0.2, 0.3));
    let [used, fresh] = [used, fresh].map(|model| {
        let link = model.bodies()[3].link();
        mass_matrix(&model.with_inertia(link, rod).unwrap(), &q).unwrap()
    });
    assert_eq!(used, fresh);
    assert_ne!(used, H);
}

/// What a builder refuses, a built model refuses too, and says which link or joint it is about.
#[test]
fn impossible_changes() {
    use eigenbody::InputError::*;
    use eigenbody::model::JointSpec;
    use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
    use eigenbody::{Base, Joint, ModelBuilder};
    let ball = RigidInertia::from_com(1.0, Vec3::ZERO, Sym3::diagonal(0.1, 0.1, 0.1));
    let mut robot = ModelBuilder::<f64>::new("test");
    let [base, a, b] = ["base", "a", "b"].map(|name| robot.link(name, ball));
    robot.joint(JointSpec::new("hinge", Joint::Revolute, base, a));
    robot.joint(JointSpec::new("ball", Joint::Spherical, a, b));
    let model = robot.build(Base::Fixed).unwrap();

    let with = |link, inertia| model.clone().with_inertia(link, inertia).unwrap_err();
    assert_eq!(with(3, ball), NoSuch { what: "link", index: 3, count: 3 });
    assert_eq!(with(0, ball), Immovable { link: "base".into() });
    let negative = RigidInertia { m: -1.0, ..ball };
    assert_eq!(with(1, negative), Negative { what: "mass", index: 0, value: -1.0 });
    let nan = RigidInertia { h: Vec3::new(0.0, f64::NAN, 0.0), ..ball };
    assert_eq!(with(1, nan), NotFinite { what: "centre of mass", index: 1 });

    let with = |joint, limits| model.clone().with_limits(joint, Some(limits)).unwrap_err();
    assert_eq!(with(2, (0.0, 1.0)), NoSuch { what: "joint", index: 2, count: 2 });
    assert_eq!(with(1, (0.0, 1.0)), SeveralCoordinates { joint: "ball".into() });
    assert_eq!(with(0, (0.0, f64::NAN)), NotFinite { what: "limit", index: 1 });
    assert_eq!(with(0, (2.0, 1.0)), CrossedLimits { joint: "hinge".into(), lower: 2.0, upper: 1.0 });
    assert!(model.clone().with_limits(0, Some((1.0, f64::INFINITY))).is_ok());

    let with = |armature: [f64; 4]| model.clone().with_armature(armature.to_vec());
    assert_eq!(with([0.0, 0.0, -0.5, 0.0]), Err(Negative { what: "armature", index: 2, value: -0.5 }));
    assert!(with([0.0; 4]).is_ok());
}

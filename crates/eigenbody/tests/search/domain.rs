use eigenbody::model::JointSpec;
use eigenbody::search::Domain;
use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
use eigenbody::{Base, Family, Joint, Model, ModelBuilder};

fn one_joint(kind: Joint<f64>, limits: Option<(f64, f64)>) -> Model<f64> {
    let mut robot = ModelBuilder::new("one");
    let base = robot.link("base", RigidInertia::ZERO);
    let body = RigidInertia::from_com(1.0, Vec3::new(0.1, 0.2, 0.3), Sym3::diagonal(0.1, 0.1, 0.1));
    let body = robot.link("body", body);
    robot.joint(JointSpec { limits, ..JointSpec::new("joint", kind, base, body) });
    robot.build(Base::Fixed).unwrap()
}

#[test]
fn limits_hold_wherever_a_point_is_moved() {
    let model = one_joint(Joint::Revolute, Some((-0.5, 2.0)));
    let domain = Domain::new(&model, false);
    for (u, q) in [(0.0, -0.5), (0.5, 0.75), (1.0, 2.0)] {
        assert!((domain.configuration(&domain.point(&[u]))[0] - q).abs() < 1e-15);
    }
    let mut point = domain.point(&[0.9]);
    for _ in 0..50 {
        point = domain.moved(&point, &[0.37]);
        let q = domain.configuration(&point)[0];
        assert!((-0.5..=2.0).contains(&q), "{q}");
    }
    // Outside its limits, the nearest bound.
    assert_eq!(domain.configuration(&domain.nearest(&[7.0])), [2.0]);
}

#[test]
fn angles_without_limits_turn() {
    for model in [one_joint(Joint::Continuous, None), one_joint(Joint::Revolute, Some((-20.0, 20.0)))] {
        let domain = Domain::new(&model, false);
        let far = domain.moved(&domain.point(&[0.5]), &[100.0]);
        let q = domain.configuration(&far)[0];
        assert!(q.abs() <= std::f64::consts::PI && (q.cos() - 100f64.cos()).abs() < 1e-13, "{q}");
    }
}

#[test]
fn points_fit_every_kind_of_joint() {
    let tree: Model<f64> = Family::auto_tree(16, 1.5, 0.5, 0.9).unwrap().model().unwrap();
    let domain = Domain::new(&tree, false);
    assert_eq!(domain.nv(), tree.nv());
    let u: Vec<f64> = (0..domain.dimensions()).map(|k| (0.37 * k as f64).fract()).collect();
    let step: Vec<f64> = (0..domain.nv()).map(|d| 0.1 * (d % 5) as f64).collect();
    let moved = domain.moved(&domain.point(&u), &step);
    tree.check_q(&domain.configuration(&moved)).unwrap();
}

#[test]
fn a_joint_to_the_world_that_moves_freely_stays() {
    let free = one_joint(Joint::Floating, None);
    assert_eq!(Domain::new(&free, false).dimensions(), 0);
    assert_eq!(Domain::new(&free, false).nv(), 6);
}

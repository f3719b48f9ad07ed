//! Links, trees and postures of the families.

use eigenbody::dynamics::{link_pose, momentum};
use eigenbody::family::FamilyError;
use eigenbody::model::MAX_BODIES;
use eigenbody::scalar::Dd;
use eigenbody::{Family, Joint, Model, Posture, mass_matrix};

fn parents(branching: f64, n: usize) -> Vec<usize> {
    let family = Family::onion(n, branching, 0.0, 1.0).unwrap();
    (1..=n).map(|i| family.parent(i)).collect()
}

/// F figure 2: branching 1 is a chain, 1.5 alternates one child and two, 2 and 3 are full trees.
#[test]
fn parents_of_each_branching_factor() {
    assert_eq!(parents(1.0, 5), [0, 1, 2, 3, 4]);
    assert_eq!(parents(1.5, 8), [0, 1, 2, 2, 3, 4, 4, 5]);
    assert_eq!(parents(2.0, 7), [0, 1, 1, 2, 2, 3, 3]);
    assert_eq!(parents(3.0, 10), [0, 1, 1, 1, 2, 2, 2, 3, 3, 3]);
}

/// Models have the parents that `Family::parent` names, and every parent comes before its child.
#[test]
fn models_have_these_parents() {
    for branching in [1.0, 1.125, 1.5, 2.0, 2.5, 3.0, 7.0] {
        let family = Family::hydra(40, branching, 0.3, 1.0).unwrap();
        let model = family.model::<f64>().unwrap();
        for d in 0..40 {
            let parent = family.parent(d + 1);
            assert!(parent <= d);
            assert_eq!(model.dofs().parent(d), parent.checked_sub(1), "joint {d} at B = {branching}");
        }
    }
}

/// Link i+1 is link i scaled: length ρ, mass ρ³, inertia ρ⁵.
#[test]
fn links_scale() {
    let rho = 0.8f64;
    for family in [Family::hydra(6, 1.0, 0.0, rho).unwrap(), Family::onion(6, 1.0, 0.0, rho).unwrap()] {
        let model = family.model::<f64>().unwrap();
        let first = *model.bodies()[0].inertia();
        for (i, body) in model.bodies().iter().enumerate() {
            let scale = rho.powi(i as i32);
            // 16 ε: a taper of 0.8 raised to the 25th power
            let near = |found: f64, first: f64, power| {
                let expected = first * scale.powi(power);
                assert!((found - expected).abs() <= 16.0 * f64::EPSILON * expected, "{found} {expected}");
            };
            near(body.inertia().m, first.m, 3);
            near(body.inertia().h.x, first.h.x, 4);
            near(body.inertia().I.xx, first.I.xx, 5);
            near(body.inertia().I.yy, first.I.yy, 5);
            near(body.inertia().I.zz, first.I.zz, 5);
        }
    }
}

/// A thin tube of 1 kg and 1 m, radius 0.05 m: m r² about its axis, m (r²/2 + l²/12) + m l²/4 about its end.
#[test]
fn first_link_of_hydra_is_a_thin_tube() {
    let model = Family::hydra(1, 1.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    let body = model.bodies()[0].inertia();
    assert_eq!((body.m, body.h.to_array()), (1.0, [0.5, 0.0, 0.0]));
    let end = 0.05f64.powi(2) / 2.0 + 1.0 / 12.0 + 0.25;
    for (found, expected) in [(body.I.xx, 0.0025), (body.I.yy, end), (body.I.zz, end)] {
        assert!((found - expected).abs() <= f64::EPSILON, "{found} {expected}");
    }
}

/// The last link is R times the first, to the last bit but a few: ρ is a root in double-double.
#[test]
fn size_ratio_is_that_of_the_last_link() {
    for (n, ratio) in [(2, 0.1), (49, 0.5), (150, 0.1), (390, 0.2)] {
        let family = Family::hydra(n, 1.0, 0.0, 1.0).unwrap().with_size_ratio(ratio).unwrap();
        let model = family.model::<f64>().unwrap();
        let mass = model.bodies()[n - 1].inertia().m;
        let expected = ratio * ratio * ratio;
        assert!((mass - expected).abs() <= 2.0 * f64::EPSILON * expected, "N = {n}: {mass} {expected}");
    }
    let one = Family::hydra(1, 1.0, 0.0, 1.0).unwrap().with_size_ratio(0.5).unwrap();
    assert_eq!(one.model::<f64>().unwrap().bodies()[0].inertia().m, 1.0);
}

/// α = 0 is planar: every link stays in the x-y plane; α = 0.5 is not.
#[test]
fn hydra_is_planar_without_skew() {
    let height = |skew| {
        let model = Family::hydra(6, 1.5, skew, 1.0).unwrap().model::<f64>().unwrap();
        let q = Posture::Curl(0.4).configuration(&model);
        let heights = (0..model.links().len()).map(|link| link_pose(&model, &q, link).unwrap().r.z.abs());
        heights.fold(0.0, f64::max)
    };
    assert_eq!(height(0.0), 0.0);
    assert!(height(0.5) > 0.1);
}

/// A child's axis stands its parent's length along x, and is (0, −sin α, cos α) in the parent's frame.
#[test]
fn outboard_axis_is_skewed_about_x() {
    let (skew, rho) = (0.7f64, 0.9);
    let model = Family::hydra(3, 1.0, skew, rho).unwrap().model::<f64>().unwrap();
    let tip = model.links().iter().position(|link| link.name() == "link_3").unwrap();
    let pose = link_pose(&model, &[0.0; 3], tip).unwrap();
    assert!((pose.r.x - (1.0 + rho)).abs() <= 4.0 * f64::EPSILON);
    let (s, c) = (2.0 * skew).sin_cos();
    // Two skews in a row: the third row of E is the tip's z axis in the world.
    for (found, expected) in pose.E.z.to_array().iter().zip([0.0, -s, c]) {
        assert!((found - expected).abs() <= 4.0 * f64::EPSILON, "{found} {expected}");
    }
}

/// Every axis of an onion runs through the origin, also on a branched one.
#[test]
fn onion_is_spherical() {
    let model = Family::onion(9, 2.0, 1.0, 1.0).unwrap().model::<f64>().unwrap();
    let q = Posture::Curl(0.3).configuration(&model);
    for link in 0..model.links().len() {
        assert_eq!(link_pose(&model, &q, link).unwrap().r.to_array(), [0.0; 3]);
    }
}

#[test]
fn postures_on_fixed_and_floating_chains() {
    let fixed = Family::hydra(4, 1.0, 0.0, 1.0).unwrap();
    let model: Model<f64> = fixed.model().unwrap();
    assert_eq!(Posture::Zag(0.5).configuration(&model), [0.5, -0.5, 0.5, -0.5]);
    assert_eq!(Posture::Curl(0.5).configuration(&model), [0.5; 4]);
    assert_eq!(Posture::Zero.configuration(&model), [0.0; 4]);
    // Joint 1 is gone, its successors keep their signs.
    let model: Model<f64> = fixed.floating().model().unwrap();
    let base = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let expected = [base.as_slice(), &[-0.5, 0.5, -0.5]].concat();
    assert_eq!(Posture::Zag(0.5).configuration(&model), expected);
    assert_eq!(model.dof_name(6), "joint_2");
}

/// The joints of `auto_tree` run through all kinds; postures touch the single-coordinate ones only.
#[test]
fn auto_tree_has_every_kind() {
    let model = Family::auto_tree(8, 1.0, 0.2, 0.9).unwrap().model::<f64>().unwrap();
    let kinds: Vec<&str> = model.joints().iter().map(|joint| joint.kind().kind()).collect();
    let all =
        ["revolute", "prismatic", "helical", "cylindrical", "universal", "planar", "spherical", "floating"];
    assert_eq!(kinds, all);
    assert_eq!((model.nq(), model.nv()), (21, 19));
    let q = Posture::Zag(0.25).configuration(&model);
    assert_eq!(q[..3], [0.25, -0.25, 0.25]);
    assert_eq!(q[3..], model.neutral()[3..]);
    assert!(matches!(model.joints()[2].kind(), Joint::Helical { pitch } if *pitch == 0.1));
}

/// I₁₁ = (m/3)(N l)³/l for rods in line: one rod of N times the length and mass.
#[test]
fn slender_chain_in_line_is_one_rod() {
    let (n, m, l) = (7, 0.4, 0.3);
    let model = Family::slender_chain(n, m, l).unwrap().model::<f64>().unwrap();
    let (mass, length) = (m * n as f64, l * n as f64);
    let expected = mass * length * length / 3.0;
    let found = mass_matrix(&model, &[0.0; 7]).unwrap()[(0, 0)];
    assert!((found - expected).abs() <= 8.0 * n as f64 * f64::EPSILON * expected, "{found} {expected}");
    let total = momentum(&model, &[0.0; 7], &[0.0; 7]).unwrap();
    assert!((total.mass - mass).abs() <= 8.0 * f64::EPSILON * mass);
}

#[test]
fn names_are_expressions() {
    assert_eq!(Family::hydra(8, 1.0, 0.5, 1.0).unwrap().name(), "hydra(8, 1, 0.5, 1)");
    assert_eq!(Family::onion(33, 1.125, 0.0, 0.9).unwrap().name(), "onion(33, 1.125, 0, 0.9)");
    assert_eq!(Family::slender_chain(4, 2.2, 1.0).unwrap().name(), "chain(4, m=2.2, l=1)");
    assert_eq!(Family::auto_tree(9, 2.0, 0.0, 1.0).unwrap().name(), "auto_tree(9, 2, 0, 1)");
}

#[test]
fn parameters_out_of_range_are_refused() {
    assert_eq!(Family::hydra(0, 1.0, 0.0, 1.0), Err(FamilyError::Links(0.0)));
    let many = MAX_BODIES + 1;
    assert_eq!(Family::hydra(many, 1.0, 0.0, 1.0), Err(FamilyError::Links(many as f64)));
    assert_eq!(Family::onion(3, 0.9, 0.0, 1.0), Err(FamilyError::Branching(0.9)));
    assert!(matches!(Family::onion(3, f64::NAN, 0.0, 1.0), Err(FamilyError::Branching(_))));
    assert!(matches!(Family::onion(3, f64::INFINITY, 0.0, 1.0), Err(FamilyError::Branching(_))));
    assert!(matches!(Family::auto_tree(3, 1.0, f64::NAN, 1.0), Err(FamilyError::Skew(_))));
    for taper in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        assert!(matches!(Family::hydra(3, 1.0, 0.0, taper), Err(FamilyError::Taper(_))), "{taper}");
        let family = Family::hydra(3, 1.0, 0.0, 1.0).unwrap();
        assert!(matches!(family.with_size_ratio(taper), Err(FamilyError::Taper(_))), "{taper}");
    }
    assert_eq!(Family::slender_chain(2, 0.0, 1.0), Err(FamilyError::Size { what: "m (kg)", value: 0.0 }));
    assert_eq!(Family::slender_chain(2, 1.0, -1.0), Err(FamilyError::Size { what: "l (m)", value: -1.0 }));
}

/// A taper that leaves the scalar's range is an error of the model, not an infinite mass.
#[test]
fn inertias_beyond_the_range_are_refused() {
    let family = Family::hydra(100, 1.0, 0.0, 100.0).unwrap();
    assert!(family.model::<f64>().is_err() && family.model::<Dd>().is_err());
    assert!(Family::hydra(10, 1.0, 0.0, 100.0).unwrap().model::<f32>().is_err());
}

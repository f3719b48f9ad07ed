//! Constant rotations of every class, angles of every size.

use eigenbody::batch::Batch;
use eigenbody::dynamics::plain;
use eigenbody::model::{JointSpec, Random};
use eigenbody::scalar::Dd;
use eigenbody::spatial::{Mat3, RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Joint, Model, ModelBuilder, inverse_dynamics, mass_matrix};
use std::f64::consts::{FRAC_PI_2, PI};

/// A branched robot whose joints are placed with the given roll, pitch and yaw, again and again.
fn robot(angles: &[[f64; 3]], base: Base) -> Model<f64> {
    let mut random = Random::new(5);
    let mut robot = ModelBuilder::new("turns");
    robot.gravity(Vec3::from_f64([1.0, -3.0, -9.0]));
    let mut inertia = || {
        let c = Vec3::from_f64([0; 3].map(|_| random.between(-0.2, 0.2)));
        RigidInertia::from_com(random.between(0.5, 3.0), c, Sym3::diagonal(0.02, 0.03, 0.04))
    };
    let mut links = vec![robot.link("base", inertia())];
    for (k, &[roll, pitch, yaw]) in angles.iter().cycle().take(3 * angles.len()).enumerate() {
        let link = robot.link(format!("link {k}"), inertia());
        let kind = if k % 5 == 4 { Joint::Prismatic } else { Joint::Revolute };
        let parent = links[if k % 3 == 2 { links.len() / 2 } else { links.len() - 1 }];
        let place = Transform::new(Mat3::rotation_rpy(roll, pitch, yaw), Vec3::new(0.1, 0.2, -0.3));
        robot.joint(JointSpec::new(format!("joint {k}"), kind, parent, link).at(place).about(Vec3::Z));
        links.push(link);
    }
    robot.build(base).unwrap()
}

/// Exact quarter turns, turns rounded as files round them, none, half turns and any.
#[allow(clippy::approx_constant)]
const ANGLES: [[f64; 3]; 10] = [
    [FRAC_PI_2, 0.0, 0.0],
    [-FRAC_PI_2, 0.0, 0.0],
    [1.5708, 0.0, 0.0],
    [0.0, 0.0, 0.0],
    [0.0, 0.0, 0.7],
    [PI, 0.0, 0.0],
    [0.0, FRAC_PI_2, 0.0],
    [0.3, -1.0, 2.0],
    [1e-9, 0.0, 0.0],
    [0.0, 1e-15, FRAC_PI_2],
];

#[test]
fn every_class_of_rotation_agrees_with_double_double() {
    for base in [Base::Fixed, Base::Floating] {
        for first in 0..ANGLES.len() {
            let angles: Vec<[f64; 3]> = (0..ANGLES.len()).map(|k| ANGLES[(first + 3 * k) % 10]).collect();
            let model = robot(&angles, base);
            let (q, nv) = (model.random(3), model.nv());
            let exact =
                plain::mass_matrix(&model.cast::<Dd>(), &q.iter().map(|&q| q.into()).collect::<Vec<Dd>>());
            let (H, exact) = (mass_matrix(&model, &q).unwrap(), exact.unwrap());
            for d in 0..nv {
                for e in 0..nv {
                    let size = (exact[(d, d)].hi() * exact[(e, e)].hi()).sqrt();
                    // A few roundings of coordinates for every body on the way.
                    let bound = 4.0 * nv as f64 * f64::EPSILON * size;
                    let apart = (H[(d, e)] - exact[(d, e)].hi()).abs();
                    assert!(apart <= bound, "{base:?} {first} H({d}, {e}): {apart:e} of {bound:e}");
                }
            }
        }
    }
}

/// Beyond the range of the fast sines, and at its border, the library's own take over.
#[test]
fn large_angles_are_no_worse() {
    let model = robot(&ANGLES, Base::Fixed);
    let zeros = vec![0.0; model.nv()];
    for size in [1.0, 1e3, 799_999.0, 800_001.0, 1e7, 1e15] {
        let q: Vec<f64> = (0..model.nv()).map(|k| size * (1.0 - k as f64 / 100.0)).collect();
        let (tau, book) = (
            inverse_dynamics(&model, &q, &zeros, &zeros),
            plain::inverse_dynamics(&model, &q, &zeros, &zeros),
        );
        let (tau, book) = (tau.unwrap(), book.unwrap());
        // A prismatic joint this far out carries moments as large.
        let scale = book.iter().fold(0.0, |m: f64, x| m.max(x.abs())) * 50.0 * model.nv() as f64;
        for (x, y) in tau.iter().zip(&book) {
            assert!((x - y).abs() <= f64::EPSILON * scale, "{size:e}: {x} {y}");
        }
    }
}

/// A robot with every turn of a cube between the base and a child, and between that and a child of its own.
fn cube(base: Base) -> Model<f64> {
    let mut random = Random::new(8);
    let mut robot = ModelBuilder::new("cube");
    let mut inertia = || {
        let c = Vec3::from_f64([0; 3].map(|_| random.between(-0.2, 0.2)));
        RigidInertia::from_com(random.between(0.5, 3.0), c, Sym3::diagonal(0.02, 0.03, 0.04))
    };
    let root = robot.link("base", inertia());
    for k in 0..24 {
        let mut parent = root;
        for (turn, kind) in [(k, Joint::Revolute), ((7 * k + 5) % 24, Joint::Revolute), (k, Joint::Prismatic)]
        {
            let (roll, side) = (f64::from(turn % 4), turn / 4);
            let (pitch, yaw) = if side < 4 { (0.0, f64::from(side)) } else { (f64::from(2 * side - 9), 0.0) };
            let [roll, pitch, yaw] = [roll, pitch, yaw].map(|quarters| quarters * FRAC_PI_2);
            let name = format!("{k} {kind:?}, {}", parent == root);
            let link = robot.link(name.clone(), inertia());
            let place = Transform::new(Mat3::rotation_rpy(roll, pitch, yaw), Vec3::new(0.1, 0.2, -0.3));
            robot.joint(JointSpec::new(name, kind, parent, link).at(place).about(Vec3::Z));
            parent = link;
        }
    }
    robot.build(base).unwrap()
}

#[test]
fn every_turn_of_a_cube_agrees_with_the_book() {
    for base in [Base::Fixed, Base::Floating] {
        let model = cube(base);
        let nv = model.nv();
        let (mut q, mut v, mut vdot) = (Vec::new(), Vec::new(), Vec::new());
        for k in 0..9 {
            q.extend(model.random(k));
            v.extend((0..nv).map(|d| ((d + 1) as f64 * (k + 1) as f64).sin()));
            vdot.extend((0..nv).map(|d| ((d + 2) as f64 * (k + 1) as f64).cos()));
        }
        let batch = Batch::new(&model);
        let (mut H, mut tau, mut back) = (vec![0.0; 9 * nv * nv], vec![0.0; 9 * nv], vec![0.0; 9 * nv]);
        batch.mass_matrices(&q, &mut H).unwrap();
        batch.inverse_dynamics(&q, &v, &vdot, &mut tau).unwrap();
        batch.forward_dynamics(&q, &v, &tau, &mut back).unwrap();
        let states = q.chunks_exact(model.nq()).zip(v.chunks_exact(nv)).zip(vdot.chunks_exact(nv));
        for (k, ((q, v), vdot)) in states.enumerate() {
            let (book, alone) = (plain::mass_matrix(&model, q).unwrap(), mass_matrix(&model, q).unwrap());
            let forces = plain::inverse_dynamics(&model, q, v, vdot).unwrap();
            // Every number passes through a few bodies; accelerations have lost κ(H) besides.
            let largest = book.as_slice().iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            for (d, &expected) in book.as_slice().iter().enumerate() {
                let near = |found: f64| (found - expected).abs() <= 64.0 * f64::EPSILON * largest;
                assert!(near(H[k * nv * nv + d]) && near(alone.as_slice()[d]), "{base:?} {k} entry {d}");
            }
            let strongest = forces.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            for d in 0..nv {
                let apart = (tau[k * nv + d] - forces[d]).abs();
                assert!(apart <= 64.0 * f64::EPSILON * strongest, "{base:?} {k} force {d}: {apart:e}");
                let apart = (back[k * nv + d] - vdot[d]).abs();
                assert!(apart <= 1e-11, "{base:?} {k} acceleration {d}: {apart:e}");
            }
        }
    }
}

/// Along parallel axes shifts of origins add up until they are too far, and begin again.
#[test]
fn a_tall_stack_agrees_with_double_double() {
    let mut robot = ModelBuilder::new("stack");
    let inertia =
        || RigidInertia::from_com(1.0, Vec3::from_f64([0.03, 0.02, 0.01]), Sym3::diagonal(1e-3, 2e-3, 2e-3));
    let mut parent = robot.link("base", inertia());
    for k in 0..60 {
        let (roll, r) =
            if (2..57).contains(&k) { (0.0, [0.1, 0.0, 1.0]) } else { (FRAC_PI_2, [0.1, 0.05, 0.0]) };
        let link = robot.link(format!("link {k}"), inertia());
        let place = Transform::new(Mat3::rotation_rpy(roll, 0.0, 0.0), Vec3::from_f64(r));
        robot.joint(
            JointSpec::new(format!("joint {k}"), Joint::Revolute, parent, link).at(place).about(Vec3::Z),
        );
        parent = link;
    }
    let model = robot.build(Base::Fixed).unwrap();
    let (q, nv) = (model.random(4), model.nv());
    let exact =
        plain::mass_matrix(&model.cast::<Dd>(), &q.iter().map(|&q| q.into()).collect::<Vec<Dd>>()).unwrap();
    let mut H = vec![0.0; 8 * nv * nv];
    Batch::new(&model).mass_matrices(&q.repeat(8), &mut H).unwrap();
    for d in 0..nv {
        for e in 0..nv {
            let size = (exact[(d, d)].hi() * exact[(e, e)].hi()).sqrt();
            let apart = (H[d * nv + e] - exact[(d, e)].hi()).abs();
            assert!(apart <= 4.0 * nv as f64 * f64::EPSILON * size, "H({d}, {e}): {apart:e} of {size:e}");
        }
    }
}

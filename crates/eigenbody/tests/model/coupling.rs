//! Mimic joints: v = G ṗ.

use crate::robots::numbers;
use eigenbody::dynamics::energy;
use eigenbody::model::{JointSpec, MimicSpec};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, BuildError, Joint, Matrix, Model, ModelBuilder, mass_matrix};

/// A chain of joints j0, j1, .., some of which follow another: (name, multiplier, offset).
type Follows = Option<(&'static str, f64, f64)>;

fn chain<T: Real>(joints: &[(Joint<T>, Follows)]) -> Result<Model<T>, BuildError> {
    let number = T::from_f64;
    let mut robot = ModelBuilder::new("chain");
    let mut parent = robot.link("base", RigidInertia::ZERO);
    for (j, (kind, follows)) in joints.iter().enumerate() {
        let moments = Sym3::diagonal(number(0.02), number(0.03), number(0.04));
        let rod = RigidInertia::from_com(number(1.0 + j as f64), Vec3::from_f64([0.3, 0.1, 0.05]), moments);
        let link = robot.link(format!("link_{j}"), rod);
        let placement = Transform::translation(Vec3::from_f64([0.5, 0.0, 0.1]));
        let axis = Vec3::from_f64([0.1 * j as f64, 0.3, 1.0]);
        let mut spec = JointSpec::new(format!("j{j}"), *kind, parent, link).at(placement).about(axis);
        spec.mimic = follows.map(|(joint, multiplier, offset)| MimicSpec {
            joint: joint.into(),
            multiplier: number(multiplier),
            offset: number(offset),
        });
        robot.joint(spec);
        parent = link;
    }
    robot.build(Base::Fixed)
}

/// j1 = −2 j4 + 0.3, j2 free, j3 = 0.5 j1 − 0.1 = −j4 + 0.05, j5 follows a slide; a ball stands between.
fn hand<T: Real>() -> Model<T> {
    chain(&[
        (Joint::Spherical, None),
        (Joint::Revolute, Some(("j4", -2.0, 0.3))),
        (Joint::Prismatic, None),
        (Joint::Continuous, Some(("j1", 0.5, -0.1))),
        (Joint::Revolute, None),
        (Joint::Helical { pitch: T::from_f64(0.1) }, Some(("j2", 3.0, 0.0))),
    ])
    .unwrap()
}

/// DoFs: ball 0 to 2, then j1 .. j5. Independent: ball, j2, j4.
#[rustfmt::skip]
const G: [[f64; 5]; 8] = [
    [1.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, -2.0],
    [0.0, 0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, -1.0],
    [0.0, 0.0, 0.0, 0.0, 1.0],
    [0.0, 0.0, 0.0, 3.0, 0.0],
];

#[test]
fn independent_coordinates_are_those_that_follow_none() {
    let model = hand::<f64>();
    let coupling = model.coupling().unwrap();
    assert_eq!((coupling.nq(), coupling.nv()), (6, 5));
    assert_eq!(coupling.independent_dofs(), [0, 1, 2, 4, 6]);
    assert_eq!(coupling.independent_coordinates(), [0, 1, 2, 3, 5, 7]);
}

/// Chains compose, whatever the order of the joints: j3 = 0.5 (−2 j4 + 0.3) − 0.1.
#[test]
fn coordinates_expand_through_chains() {
    let model = hand::<f64>();
    let p = [0.5, 0.5, 0.5, 0.5, 0.2, 0.7];
    let q = model.coupling().unwrap().expand(&p);
    let expected = [0.5, 0.5, 0.5, 0.5, -2.0 * 0.7 + 0.3, 0.2, -0.7 + 0.05, 0.7, 0.6];
    for (q, expected) in q.iter().zip(expected) {
        // 4 ε: a product and two sums
        assert!((q - expected).abs() <= 4.0 * f64::EPSILON, "{q} {expected}");
    }
}

scalars!(reduction_is_the_explicit_product);

/// H_reduced = Gᵀ H G, and the kinetic energy is that of the expanded velocities.
fn reduction_is_the_explicit_product<T: Real>() {
    let model = hand::<T>();
    let coupling = model.coupling().unwrap();
    let p: Vec<T> = [0.5, 0.5, 0.5, 0.5, 0.2, 0.7].map(T::from_f64).to_vec();
    let q = coupling.expand(&p);
    let H = mass_matrix(&model, &q).unwrap();
    let g = |d: usize, a: usize| T::from_f64(G[d][a]);
    let product = Matrix::from_fn(5, 5, |a, b| {
        let terms = (0..64).map(|k| g(k / 8, a) * H[(k / 8, k % 8)] * g(k % 8, b));
        terms.fold(T::ZERO, |sum, x| sum + x)
    });
    let reduced = coupling.reduce(&H);
    // 64 ε of 3² max H: 64 terms, multipliers up to 3
    let tolerance = 64.0 * T::EPSILON * 9.0 * H.max_abs();
    for (a, b) in reduced.as_slice().iter().zip(product.as_slice()) {
        assert!((*a - *b).abs().to_f64() <= tolerance, "{a:?} {b:?}");
    }
    for seed in 0..5 {
        let pdot: Vec<T> = numbers(5, seed);
        let expand = |d: usize| (0..5).fold(T::ZERO, |sum, a| sum + g(d, a) * pdot[a]);
        let v: Vec<T> = (0..8).map(expand).collect();
        let kinetic = energy(&model, &q, &v).unwrap().kinetic;
        let by_matrix = reduced.times(&pdot).iter().zip(&pdot).fold(T::ZERO, |sum, (&a, &b)| sum + a * b);
        let error = (kinetic * T::from_f64(2.0) - by_matrix).abs().to_f64();
        assert!(error <= 5.0 * tolerance, "{error:e} {tolerance:e}");
    }
}

/// `cast` carries the map.
#[test]
fn map_survives_a_cast() {
    let model = hand::<f64>();
    let p: Vec<Dd> = [0.5, 0.5, 0.5, 0.5, 0.25, 0.75].map(Dd::from_f64).to_vec();
    let there: Vec<f64> =
        model.cast::<Dd>().coupling().unwrap().expand(&p).iter().map(|x| x.to_f64()).collect();
    let here = model.coupling().unwrap().expand(&[0.5, 0.5, 0.5, 0.5, 0.25, 0.75]);
    for (a, b) in here.iter().zip(&there) {
        assert!((a - b).abs() <= 4.0 * f64::EPSILON, "{a} {b}");
    }
}

#[test]
fn no_mimic_no_map() {
    let free = chain::<f64>(&[(Joint::Revolute, None), (Joint::Revolute, None)]).unwrap();
    assert!(free.coupling().is_none());
}

#[test]
fn loops_are_refused() {
    let follow = |of| (Joint::Revolute, Some((of, 1.0, 0.0)));
    for joints in [
        vec![follow("j0")],
        vec![follow("j1"), follow("j0")],
        vec![(Joint::Revolute, None), follow("j2"), follow("j3"), follow("j1")],
    ] {
        assert!(matches!(chain::<f64>(&joints), Err(BuildError::MimicLoop { .. })), "{joints:?}");
    }
}

/// A joint of several coordinates cannot follow; nothing can follow one, which is a finding.
#[test]
fn only_single_coordinates_mimic() {
    let ball = chain::<f64>(&[(Joint::Revolute, None), (Joint::Spherical, Some(("j0", 1.0, 0.0)))]);
    assert!(matches!(ball, Err(BuildError::MimicKind { kind: "spherical", .. })));
    let model = chain::<f64>(&[(Joint::Spherical, None), (Joint::Revolute, Some(("j0", 1.0, 0.0)))]).unwrap();
    assert!(model.coupling().is_none());
    assert_eq!(model.findings().len(), 1);
}

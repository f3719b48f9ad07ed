//! Inputs that do not fit, at every door.

use crate::robots::{Case, cases};
use eigenbody::conditioning::{Method, Question, conditioning, conditioning_at, count_below};
use eigenbody::dynamics::{
    AbaWorkspace, CrbaWorkspace, RneaWorkspace, bias_force_into, energy, forward_dynamics_into,
    gravity_force_into, inverse_dynamics_into, link_pose, mass_matrix_into, momentum,
};
use eigenbody::error::{Error, InputError, NotPositiveDefinite};
use eigenbody::factor::{Ltdl, Ltl};
use eigenbody::model::{DENSE_LIMIT, JointSpec};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::spectrum::{Metric, Tracker, eigen, eigenvalues, extreme_eigenvalues};
use eigenbody::{Base, Family, Joint, Matrix, Model, ModelBuilder};
use eigenbody::{bias_force, floating_mass_matrix, forward_dynamics, inverse_dynamics, mass_matrix};

fn robot() -> (Model<f64>, Vec<f64>, Vec<f64>) {
    let model = Family::auto_tree(8, 1.0, 0.2, 0.9).unwrap().floating().model::<f64>().unwrap();
    let (q, v) = (model.neutral(), vec![0.5; model.nv()]);
    (model, q, v)
}

/// Every door that takes q, with that q.
fn doors(model: &Model<f64>, q: &[f64], v: &[f64]) -> Vec<Result<(), Error>> {
    vec![
        mass_matrix(model, q).map(|_| ()).map_err(Error::from),
        inverse_dynamics(model, q, v, v).map(|_| ()).map_err(Error::from),
        bias_force(model, q, v).map(|_| ()).map_err(Error::from),
        forward_dynamics(model, q, v, v).map(|_| ()),
        floating_mass_matrix(model, q).map(|_| ()),
        energy(model, q, v).map(|_| ()).map_err(Error::from),
        momentum(model, q, v).map(|_| ()).map_err(Error::from),
        link_pose(model, q, 0).map(|_| ()).map_err(Error::from),
        gravity_force_into(model, q, &mut RneaWorkspace::new(model), &mut v.to_vec()).map_err(Error::from),
    ]
}

#[test]
fn configurations_are_checked_everywhere() {
    let (model, q, v) = robot();
    assert!(doors(&model, &q, &v).into_iter().all(|result| result == Ok(())));
    let nq = model.nq();
    let mut not_finite = q.clone();
    not_finite[8] = f64::INFINITY;
    let mut not_unit = q.clone();
    not_unit[3] = 0.9;
    let joint = "floating_base".to_string();
    for (bad, refused) in [
        (&q[1..], InputError::Length { what: "q", expected: nq, found: nq - 1 }),
        (&not_finite, InputError::NotFinite { what: "q", index: 8 }),
        (&not_unit, InputError::NotUnitQuaternion { joint, index: 3, norm: 0.9 }),
    ] {
        for (door, result) in doors(&model, bad, &v).into_iter().enumerate() {
            assert_eq!(result, Err(Error::Input(refused.clone())), "door {door}");
        }
    }
}

#[test]
fn velocities_and_forces_are_checked() {
    let (model, q, v) = robot();
    let nv = model.nv();
    let mut nan = v.clone();
    nan[2] = f64::NAN;
    let short = |what| InputError::Length { what, expected: nv, found: nv - 1 };
    let spoilt = |what| InputError::NotFinite { what, index: 2 };
    assert_eq!(inverse_dynamics(&model, &q, &v[1..], &v), Err(short("v")));
    assert_eq!(inverse_dynamics(&model, &q, &v, &v[1..]), Err(short("vdot")));
    assert_eq!(inverse_dynamics(&model, &q, &nan, &v), Err(spoilt("v")));
    assert_eq!(inverse_dynamics(&model, &q, &v, &nan), Err(spoilt("vdot")));
    assert_eq!(bias_force(&model, &q, &nan), Err(spoilt("v")));
    assert_eq!(forward_dynamics(&model, &q, &v[1..], &v), Err(short("v").into()));
    assert_eq!(forward_dynamics(&model, &q, &v, &v[1..]), Err(short("tau").into()));
    assert_eq!(forward_dynamics(&model, &q, &v, &nan), Err(spoilt("tau").into()));
    assert_eq!(energy(&model, &q, &nan), Err(spoilt("v")));
    assert_eq!(momentum(&model, &q, &v[1..]), Err(short("v")));
    assert_eq!(model.integrate(&q, &v[1..]), Err(short("v")));
    assert_eq!(model.integrate(&q, &nan), Err(spoilt("v")));
}

#[test]
fn outputs_of_the_wrong_size() {
    let (model, q, v) = robot();
    let nv = model.nv();
    let mut out = vec![0.0; nv + 1];
    let long = |what| InputError::Length { what, expected: nv, found: nv + 1 };
    let mut rnea = RneaWorkspace::new(&model);
    assert_eq!(inverse_dynamics_into(&model, &q, &v, &v, &mut rnea, &mut out), Err(long("tau")));
    assert_eq!(bias_force_into(&model, &q, &v, &mut rnea, &mut out), Err(long("C")));
    let mut aba = AbaWorkspace::new(&model);
    assert_eq!(forward_dynamics_into(&model, &q, &v, &v, &mut aba, &mut out), Err(long("vdot").into()));
    let mut crba = CrbaWorkspace::new(&model);
    let mut into = |rows, cols| mass_matrix_into(&model, &q, &mut crba, &mut Matrix::zeros(rows, cols));
    assert_eq!(into(nv + 1, nv), Err(long("rows of H")));
    assert_eq!(into(nv, nv + 1), Err(long("columns of H")));
    assert_eq!(into(nv, nv), Ok(()));
}

/// Outputs are written whole: what stood there before does not show.
#[test]
fn outputs_are_written_whole() {
    for Case { model, q, v, vdot, name } in cases::<f64>(14) {
        let n = model.nv();
        let (mut tau, mut H) = (vec![f64::NAN; n], Matrix::from_fn(n, n, |_, _| f64::NAN));
        let mut crba = CrbaWorkspace::new(&model);
        mass_matrix_into(&model, &q, &mut crba, &mut H).unwrap();
        mass_matrix_into(&model, &q, &mut crba, &mut H).unwrap();
        assert_eq!(H, mass_matrix(&model, &q).unwrap(), "{name}");
        let mut rnea = RneaWorkspace::new(&model);
        for _ in 0..2 {
            inverse_dynamics_into(&model, &q, &v, &vdot, &mut rnea, &mut tau).unwrap();
            assert_eq!(tau, inverse_dynamics(&model, &q, &v, &vdot).unwrap(), "{name}");
        }
        let mut aba = AbaWorkspace::new(&model);
        for _ in 0..2 {
            forward_dynamics_into(&model, &q, &v, &vdot, &mut aba, &mut tau).unwrap();
            assert_eq!(tau, forward_dynamics(&model, &q, &v, &vdot).unwrap(), "{name}");
        }
    }
}

/// Three hinges; the last carries nothing. Armature on it is all it needs.
fn massless_tip(armature: f64) -> Model<f64> {
    let mut robot = ModelBuilder::new("massless tip");
    let mut parent = robot.link("base", RigidInertia::ZERO);
    for j in 0..3 {
        let rod = RigidInertia::from_com(1.0, Vec3::new(0.5, 0.0, 0.0), Sym3::diagonal(0.1, 0.1, 0.1));
        let link = robot.link(format!("link_{j}"), if j < 2 { rod } else { RigidInertia::ZERO });
        let spec = JointSpec::new(format!("joint_{j}"), Joint::Revolute, parent, link);
        let armature = if j < 2 { 0.0 } else { armature };
        robot.joint(spec.at(Transform::translation(Vec3::X)).with_armature([armature]));
        parent = link;
    }
    robot.build(Base::Fixed).unwrap()
}

#[test]
fn massless_tip_is_located() {
    let model = massless_tip(0.0);
    let (q, v) = ([0.1, 0.2, 0.3], [0.0; 3]);
    let refused = Error::NotPositiveDefinite(NotPositiveDefinite { dof: 2, pivot: 0.0 });
    let H = mass_matrix(&model, &q).unwrap();
    assert_eq!(forward_dynamics(&model, &q, &v, &v), Err(refused.clone()));
    assert_eq!(Ltl::new(model.dofs()).factor(&H).map(|_| ()), Err(refused.clone()));
    assert_eq!(Ltdl::new(model.dofs()).factor(&H).map(|_| ()), Err(refused.clone()));
    assert_eq!(
        refused.to_string(),
        "the mass matrix is not positive definite: pivot 0e0 at degree of freedom 2"
    );
    assert!(forward_dynamics(&massless_tip(0.01), &q, &v, &v).is_ok());
}

/// A base without inertia in some direction cannot be removed: a rod does not resist a turn about itself.
#[test]
fn base_that_does_not_resist_is_located() {
    let rod = Family::slender_chain(2, 1.0, 1.0).unwrap().floating().model::<f64>().unwrap();
    let refused = floating_mass_matrix(&rod, &rod.neutral());
    assert!(
        matches!(refused, Err(Error::NotPositiveDefinite(NotPositiveDefinite { dof: 0..6, .. }))),
        "{refused:?}"
    );
}

#[test]
fn dense_matrices_have_a_limit() {
    let nv = DENSE_LIMIT + 1;
    let refused = InputError::TooLargeForDense { nv, limit: DENSE_LIMIT };
    let fixed = Family::hydra(nv, 2.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    assert_eq!(mass_matrix(&fixed, &fixed.neutral()), Err(refused.clone()));
    assert_eq!(fixed.check_dense(), Err(refused.clone()));
    let floating = Family::hydra(nv - 5, 2.0, 0.0, 1.0).unwrap().floating().model::<f64>().unwrap();
    assert_eq!(floating_mass_matrix(&floating, &floating.neutral()), Err(Error::Input(refused)));
    let least = Family::hydra(nv - 1, 2.0, 0.0, 1.0).unwrap().model::<f64>().unwrap();
    assert_eq!(least.check_dense(), Ok(()));
}

/// A slide on a hinge, at right angles: H₁₁ = 1 + q², of which nothing is left in f64 where q = 1e200.
fn crane() -> Model<f64> {
    let mut robot = ModelBuilder::new("crane");
    let inertia = RigidInertia::from_com(1.0, Vec3::ZERO, Sym3::diagonal(0.5, 0.5, 0.5));
    let [base, mast, trolley] = ["base", "mast", "trolley"].map(|name| robot.link(name, inertia));
    robot.joint(JointSpec::new("slew", Joint::Revolute, base, mast).about(Vec3::Z));
    robot.joint(JointSpec::new("slide", Joint::Prismatic, mast, trolley).about(Vec3::X));
    robot.build(Base::Fixed).unwrap()
}

#[test]
fn robots_beyond_the_range_have_no_spectrum() {
    let (model, near, far) = (crane(), [0.0, 1.0], [0.0, 1e200]);
    assert!(!mass_matrix(&model, &far).unwrap()[(0, 0)].is_finite());
    let ask = |method| Question { method, ..Question::default() };
    let of = |method| conditioning_at(&model, &far, &ask(method)).map(|_| ());
    let overflow = Err(Error::Input(InputError::Overflow { what: "H" }));
    assert_eq!(of(Method::Sturm), overflow);
    assert_eq!(of(Method::Dense), Err(InputError::NotFinite { what: "H", index: 0 }.into()));
    assert_eq!(of(Method::Auto), Err(InputError::NotFinite { what: "H", index: 0 }.into()));
    assert_eq!(count_below(&model, &far, &Question::default(), 1.0).map(|_| ()), overflow);
    let refused = forward_dynamics(&model, &far, &[0.0; 2], &[0.0; 2]);
    assert!(
        matches!(refused, Err(Error::NotPositiveDefinite(NotPositiveDefinite { dof: 0, pivot })) if !pivot.is_finite()),
        "{refused:?}"
    );
    let overflow = Err(InputError::Overflow { what: "an eigenvalue" });
    assert_eq!(Tracker::new(&model, &far, &Metric::Euclidean, false).map(|_| ()), overflow);
    let mut tracker = Tracker::new(&model, &near, &Metric::Euclidean, false).unwrap();
    assert_eq!(tracker.update(&far).map(|_| ()), overflow);
}

/// Eigenvalues of 1e300 are numbers; what the error of their modes is estimated from is none.
#[test]
fn modes_beyond_the_range_are_refused() {
    let mut robot = ModelBuilder::new("heavy arm");
    let moments = Sym3::diagonal(1.0e300, 1.1e300, 1.3e300);
    let inertia = RigidInertia::from_com(1e300, Vec3::new(0.3, 0.1, 0.2), moments);
    let mut parent = robot.link("base", RigidInertia::ZERO);
    for j in 0..3 {
        let link = robot.link(format!("link_{j}"), inertia);
        let joint = JointSpec::new(format!("joint_{j}"), Joint::Revolute, parent, link);
        let placement = Transform::translation(Vec3::new(1.0, 0.2, 0.0));
        robot.joint(joint.at(placement).about(Vec3::new(0.3, 0.5, 0.8)));
        parent = link;
    }
    let model = robot.build(Base::Fixed).unwrap();
    let question = Question { method: Method::Sturm, ..Question::default() };
    assert_eq!(
        conditioning_at(&model, &[0.3; 3], &question).map(|_| ()),
        Err(InputError::Overflow { what: "a mode" }.into())
    );
}

/// Eigenvalues 0 and 2.4e308 of a matrix of finite entries.
#[test]
fn eigenvalues_beyond_the_range_are_refused() {
    let H = Matrix::from_fn(2, 2, |_, _| 1.2e308);
    let overflow = InputError::Overflow { what: "an eigenvalue" };
    assert_eq!(eigenvalues(&H, &[1.0; 2]), Err(overflow.clone().into()));
    assert_eq!(eigen(&H, &[1.0; 2]).map(|_| ()), Err(overflow.clone().into()));
    assert_eq!(conditioning(&H, &[1.0; 2]).map(|_| ()), Err(overflow.clone().into()));
    assert_eq!(extreme_eigenvalues(&H, &[1.0; 2]), Err(InputError::Overflow { what: "λmax" }));
    assert_eq!(overflow.to_string(), "an eigenvalue is beyond the range of floating-point numbers");
}

#[test]
fn ratios_beyond_the_range_are_left_out() {
    let H = Matrix::from_fn(2, 2, |i, j| if i != j { 0.0 } else { [1e-200, 1e200][i] });
    let verdict = conditioning(&H, &[1.0; 2]).unwrap();
    assert_eq!((verdict.lambda_max, verdict.kappa_weighted), (Some(1e200), Some(1.0)));
    assert_eq!((verdict.lambda_min, verdict.kappa), (None, None));
    assert_eq!((verdict.diagonal_ratio, verdict.bracket), (None, None));
    assert_eq!(verdict.notes[1], "r is beyond the range of floating-point numbers");
}

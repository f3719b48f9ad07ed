use crate::robots::{Case, cases};
use eigenbody::dynamics::Reduction;
use eigenbody::error::{Error, InputError};
use eigenbody::model::{JointSpec, MimicSpec};
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Family, Joint, Matrix, Model, ModelBuilder, Posture};
use eigenbody::{floating_mass_matrix, mass_matrix};

/// H_jj − H_jb H_bb⁻¹ H_bj by plain elimination.
fn schur(H: &Matrix<Dd>) -> Matrix<Dd> {
    let (n, mut A) = (H.rows(), H.clone());
    for k in 0..6 {
        for i in k + 1..n {
            let ratio = A[(i, k)] / A[(k, k)];
            for j in k..n {
                let above = A[(k, j)];
                A[(i, j)] -= ratio * above;
            }
        }
    }
    Matrix::from_fn(n - 6, n - 6, |d, e| A[(6 + d, 6 + e)])
}

fn exact(model: &Model<f64>, q: &[f64]) -> Matrix<Dd> {
    let q: Vec<Dd> = q.iter().map(|&q| Dd::from_f64(q)).collect();
    mass_matrix(&model.cast::<Dd>(), &q).unwrap()
}

/// Largest c of |δH*_de| = c n ε √(B_dd B_ee), against the model's own base in double-double.
fn constant(model: &Model<f64>, q: &[f64], B: impl Fn(&Matrix<Dd>, &Matrix<Dd>, usize) -> Dd) -> f64 {
    let (found, H) = (floating_mass_matrix(model, q).unwrap(), exact(model, q));
    let exact = schur(&H);
    let size = |d| B(&H, &exact, d).to_f64().sqrt();
    let mut c = 0.0f64;
    for d in 0..found.rows() {
        for e in 0..found.rows() {
            let error = (Dd::from_f64(found[(d, e)]) - exact[(d, e)]).abs().to_f64();
            c = c.max(error / (model.nv() as f64 * f64::EPSILON * size(d) * size(e)));
        }
    }
    c
}

/// On bases as heavy as other links: good to the largest of H, the inertia of the whole among it, as large as that on any base.
#[test]
fn entries_are_good_to_the_largest_of_H() {
    for Case { name, model, q, .. } in cases::<f64>(60) {
        if model.has_floating_base() {
            let c = constant(&model, &q, |H, _, _| Dd::from_f64(H.max_abs()));
            assert!(c <= 2.0, "{name}: c = {c}");
        }
    }
}

/// On a base a millionth of the mass it carries: good to the diagonal of H* itself. Seen from there, seven digits were lost.
#[test]
fn light_base_costs_nothing() {
    for (n, taper) in [(2, 10.0), (3, 10.0), (5, 2.0), (5, 0.1), (20, 1.3), (20, 0.7)] {
        let model = Family::hydra(n, 1.0, 0.0, taper).unwrap().floating().model::<f64>().unwrap();
        let q = Posture::Zag(1.5).configuration(&model);
        let c = constant(&model, &q, |_, reduced, d| reduced[(d, d)]);
        assert!(c <= 2.0, "{}: c = {c}", model.name());
    }
}

/// A floating gripper: a slide, and two fingers of which the second follows the first.
fn gripper(base: Base) -> Model<f64> {
    let mut robot = ModelBuilder::new("gripper");
    let palm = robot.link("palm", ball(0.5));
    let wrist = robot.link("wrist", ball(2.0));
    robot.joint(JointSpec::new("slide", Joint::Prismatic, palm, wrist).about(Vec3::X));
    for (side, name) in [(0.2, "left"), (-0.2, "right")] {
        let finger = robot.link(name, ball(0.3));
        let mimic = MimicSpec { joint: "left".into(), multiplier: -0.5, offset: 0.1 };
        let place = Transform::translation(Vec3::new(0.1, side, 0.0));
        let spec = JointSpec::new(name, Joint::Revolute, wrist, finger).at(place);
        robot.joint(JointSpec { mimic: (name == "right").then_some(mimic), ..spec });
    }
    robot.build(base).unwrap()
}

fn ball(m: f64) -> RigidInertia<f64> {
    RigidInertia::from_com(m, Vec3::new(0.1, 0.2, -0.1), Sym3::diagonal(0.02, 0.03, 0.04) * m)
}

#[test]
fn mimic_first_then_the_base() {
    let model = gripper(Base::Floating);
    let mut q = model.random(3);
    q[9] = -0.5 * q[8] + 0.1;
    let H = exact(&model, &q);
    // v = G ṗ: the base's six, slide, left; right = −left/2
    let g = |d: usize, a: usize| match (d, a) {
        (8, 7) => Dd::from_f64(-0.5),
        _ if d == a => Dd::ONE,
        _ => Dd::ZERO,
    };
    let coupled = Matrix::from_fn(8, 8, |a, b| {
        let terms = (0..81).map(|k| g(k / 9, a) * H[(k / 9, k % 9)] * g(k % 9, b));
        terms.fold(Dd::ZERO, |sum, x| sum + x)
    });
    let expected = |mimic, base| match (mimic, base) {
        (false, false) => H.clone(),
        (true, false) => coupled.clone(),
        (false, true) => schur(&H),
        (true, true) => schur(&coupled),
    };
    let dofs: [(bool, bool, &[usize]); 4] = [
        (false, false, &[0, 1, 2, 3, 4, 5, 6, 7, 8]),
        (true, false, &[0, 1, 2, 3, 4, 5, 6, 7]),
        (false, true, &[6, 7, 8]),
        (true, true, &[6, 7]),
    ];
    for (mimic, base, rows) in dofs {
        let reduction = Reduction { mimic, base };
        assert_eq!(reduction.dofs(&model), rows);
        let (found, expected) = (reduction.mass_matrix(&model, &q).unwrap(), expected(mimic, base));
        assert_eq!(found.rows(), rows.len());
        for (a, b) in found.as_slice().iter().zip(expected.as_slice()) {
            // 16 n ε max H
            let tolerance = 16.0 * 9.0 * f64::EPSILON * H.max_abs();
            assert!((Dd::from_f64(*a) - *b).abs().to_f64() <= tolerance, "{reduction:?}: {a} {b:?}");
        }
    }
}

#[test]
fn fixed_base_cannot_be_removed() {
    let model = gripper(Base::Fixed);
    let reduction = Reduction { mimic: true, base: true };
    assert_eq!(
        reduction.mass_matrix(&model, &model.neutral()),
        Err(Error::Input(InputError::NoFloatingBase))
    );
    let reduction = Reduction { mimic: true, base: false };
    assert_eq!(reduction.mass_matrix(&model, &model.neutral()).unwrap().rows(), 2);
}

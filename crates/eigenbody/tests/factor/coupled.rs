//! Mimic joints followed, against G, H and C multiplied out.

use crate::robots::numbers;
use eigenbody::factor::{
    CoupledWorkspace, coupled_bias_force_into, coupled_forward_dynamics_into, coupled_inverse_dynamics_into,
};
use eigenbody::model::{Coupling, JointSpec, MimicSpec};
use eigenbody::spatial::{RigidInertia, Sym3, Transform, Vec3};
use eigenbody::{Base, Error, InputError, Joint, Matrix, Model, ModelBuilder, bias_force, mass_matrix};

/// A wrist on a slide, and four fingers of two joints each: the second joint follows the first, and all fingers the first one.
pub fn hand(base: Base) -> Model<f64> {
    let mut robot = ModelBuilder::new("hand");
    let ball =
        |m: f64| RigidInertia::from_com(m, Vec3::new(0.1, 0.2, -0.1), Sym3::diagonal(0.02, 0.03, 0.04) * m);
    let palm = robot.link("palm", ball(0.5));
    let wrist = robot.link("wrist", ball(2.0));
    robot.joint(JointSpec::new("slide", Joint::Prismatic, palm, wrist).about(Vec3::X));
    for finger in 0..4 {
        let side = Transform::translation(Vec3::new(0.1, 0.05 * finger as f64, 0.0));
        let lower = robot.link(format!("lower{finger}"), ball(0.3));
        let upper = robot.link(format!("upper{finger}"), ball(0.2));
        let follows =
            |joint: &str, multiplier, offset| Some(MimicSpec { joint: joint.into(), multiplier, offset });
        let spec = JointSpec::new(format!("knuckle{finger}"), Joint::Revolute, wrist, lower).at(side);
        let all = if finger == 0 { None } else { follows("knuckle0", 1.0 - 0.2 * finger as f64, 0.0) };
        robot.joint(JointSpec { mimic: all, ..spec });
        let own = follows(&format!("knuckle{finger}"), -0.5, 0.1);
        let place = Transform::translation(Vec3::new(0.2, 0.0, 0.05));
        let spec = JointSpec::new(format!("tip{finger}"), Joint::Revolute, lower, upper).at(place);
        robot.joint(JointSpec { mimic: own, ..spec.about(Vec3::new(0.0, 0.6, 0.8)) });
    }
    robot.build(base).unwrap()
}

struct Case {
    model: Model<f64>,
    q: Vec<f64>,
    /// Of the independent joints.
    rate: Vec<f64>,
    G: Matrix<f64>,
}

impl Case {
    fn new(base: Base) -> Self {
        let model = hand(base);
        let coupling = model.coupling().unwrap();
        let random = model.random(3);
        let free: Vec<f64> = coupling.independent_coordinates().iter().map(|&k| random[k]).collect();
        let (q, n) = (coupling.expand(&free), coupling.nv());
        let unit = |k: usize| {
            coupling.push_forward(&(0..n).map(|j| f64::from(u8::from(j == k))).collect::<Vec<_>>())
        };
        let columns: Vec<Vec<f64>> = (0..n).map(unit).collect();
        let G = Matrix::from_fn(model.nv(), n, |d, k| columns[k][d]);
        Self { rate: numbers(n, 5), q, G, model }
    }

    fn coupling(&self) -> &Coupling<f64> {
        self.model.coupling().unwrap()
    }

    /// Gᵀ (H G a + C(q, G ṗ)), multiplied out, and the sum of its terms' sizes.
    fn forces(&self, acceleration: &[f64]) -> (Vec<f64>, f64) {
        let H = mass_matrix(&self.model, &self.q).unwrap();
        let C = bias_force(&self.model, &self.q, &self.G.times(&self.rate)).unwrap();
        let Ha = H.times(&self.G.times(acceleration));
        let size = Ha.iter().chain(&C).map(|x| x.abs()).sum();
        let of = |k: usize| (0..C.len()).map(|d| self.G[(d, k)] * (Ha[d] + C[d])).sum();
        ((0..self.G.cols()).map(of).collect(), size)
    }
}

#[test]
fn forces_are_those_of_all_joints_projected() {
    for base in [Base::Fixed, Base::Floating] {
        let case = Case::new(base);
        let n = case.coupling().nv();
        assert!(n < case.model.nv() - 5);
        let mut room = CoupledWorkspace::new(&case.model, case.coupling()).unwrap();
        let acceleration: Vec<f64> = numbers(n, 9);
        let mut tau = vec![0.0; n];
        for rest in [false, true] {
            let a = if rest { vec![0.0; n] } else { acceleration.clone() };
            let (expected, size) = case.forces(&a);
            let (model, coupling) = (&case.model, case.coupling());
            match rest {
                true => coupled_bias_force_into(model, coupling, &case.q, &case.rate, &mut room, &mut tau),
                false => coupled_inverse_dynamics_into(
                    model, coupling, &case.q, &case.rate, &a, &mut room, &mut tau,
                ),
            }
            .unwrap();
            // RNEA and CRBA are backward stable: nv ε of the forces that meet.
            let tolerance = 4.0 * model.nv() as f64 * f64::EPSILON * size;
            for (found, expected) in tau.iter().zip(&expected) {
                assert!((found - expected).abs() <= tolerance, "{found} {expected} {tolerance:e}");
            }
        }
    }
}

/// GᵀHG p̈ + GᵀC gives back what was put in.
#[test]
fn accelerations_take_those_forces() {
    for base in [Base::Fixed, Base::Floating] {
        let case = Case::new(base);
        let n = case.coupling().nv();
        let mut room = CoupledWorkspace::new(&case.model, case.coupling()).unwrap();
        let tau: Vec<f64> = numbers(n, 11);
        let mut acceleration = vec![0.0; n];
        let (model, coupling) = (&case.model, case.coupling());
        coupled_forward_dynamics_into(
            model,
            coupling,
            &case.q,
            &case.rate,
            &tau,
            &mut room,
            &mut acceleration,
        )
        .unwrap();
        let (again, size) = case.forces(&acceleration);
        let tolerance = 8.0 * model.nv() as f64 * f64::EPSILON * size;
        for (found, expected) in again.iter().zip(&tau) {
            assert!((found - expected).abs() <= tolerance, "{found} {expected} {tolerance:e}");
        }
    }
}

#[test]
fn what_does_not_fit_is_named() {
    let case = Case::new(Base::Fixed);
    let (model, coupling, q) = (&case.model, case.coupling(), &case.q);
    let n = coupling.nv();
    let mut room = CoupledWorkspace::new(model, coupling).unwrap();
    let (good, mut out) = (vec![0.0; n], vec![0.0; n]);
    let long = vec![0.0; model.nv()];
    let length = |what, found| InputError::Length { what, expected: n, found };
    let refused = coupled_inverse_dynamics_into(model, coupling, q, &long, &good, &mut room, &mut out);
    assert_eq!(refused, Err(length("v", long.len())));
    let refused = coupled_inverse_dynamics_into(model, coupling, q, &good, &long, &mut room, &mut out);
    assert_eq!(refused, Err(length("vdot", long.len())));
    let refused = coupled_forward_dynamics_into(model, coupling, q, &good, &long, &mut room, &mut out);
    assert_eq!(refused, Err(Error::Input(length("tau", long.len()))));
    let refused = coupled_bias_force_into(model, coupling, q, &good, &mut room, &mut [0.0; 99]);
    assert_eq!(refused, Err(length("C", 99)));
    let bad = vec![f64::NAN; n];
    let refused = coupled_bias_force_into(model, coupling, q, &bad, &mut room, &mut out);
    assert_eq!(refused, Err(InputError::NotFinite { what: "v", index: 0 }));
}

//! dynibo, from the URDF with fixed joints merged.

use std::error::Error;

use dynibo::{BaseState, FloatingRobot, Frame, Twist};
use nalgebra::{DMatrix, Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::Outcome;
use crate::contest::Contestant;
use crate::quantity::Quantity;
use crate::robot::{Robot, Sample};

/// One robot. Its gravity is 9.80665 m/s², so that forces do not compare with ours.
pub struct Dynibo {
    robot: Kind,
    /// Our degrees of freedom in its order.
    dofs: Vec<usize>,
    states: Vec<State>,
    H: Vec<f64>,
    out: Vec<f64>,
}

enum Kind {
    Fixed(dynibo::Robot),
    Floating(FloatingRobot),
}

/// A sample in its terms: base, joints, and all forces.
struct State {
    base: BaseState,
    q: Vec<f64>,
    v: Vec<f64>,
    x: Vec<f64>,
    forces: Vec<f64>,
}

impl Dynibo {
    pub fn new(robot: &Robot) -> Result<Self, Box<dyn Error>> {
        let model = dynibo::RobotModel::from_urdf(&robot.urdf)?;
        let floating = robot.model.has_floating_base();
        let (mut coordinates, mut dofs) = (Vec::new(), Vec::new());
        for index in 0..model.joint_count() {
            let name = model.joint_name(index)?;
            let joint =
                robot.model.joints().iter().find(|joint| joint.name() == name).ok_or("no such joint")?;
            coordinates.push(joint.coordinates().start);
            dofs.push(joint.dofs().start);
        }
        let pick = |from: &[f64], places: &[usize]| places.iter().map(|&k| from[k]).collect::<Vec<_>>();
        let state = |Sample { q, v, x }: &Sample| -> Result<State, Box<dyn Error>> {
            let at = if floating { frame(q) } else { Frame::identity() };
            let twist = |v: &[f64]| {
                let of = |k: usize| at.rotation * Vector3::new(v[k], v[k + 1], v[k + 2]);
                if floating { Twist::new(of(0), of(3)) } else { Twist::zeros() }
            };
            let base = if floating { &x[..6] } else { &[] };
            let x_joints = pick(x, &dofs);
            Ok(State {
                base: BaseState::new(at, twist(v), twist(x))?,
                q: pick(q, &coordinates),
                v: pick(v, &dofs),
                forces: [base, &x_joints].concat(),
                x: x_joints,
            })
        };
        let states = robot.samples.iter().map(state).collect::<Result<_, _>>()?;
        let kind =
            if floating { Kind::Floating(model.floating_robot()?) } else { Kind::Fixed(model.robot()) };
        let n = robot.model.nv();
        Ok(Self { robot: kind, dofs, states, H: vec![0.0; n * n], out: vec![0.0; n] })
    }
}

/// Of the floating base: x, y, z, w, x, y, z.
fn frame(q: &[f64]) -> Frame {
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(q[3], q[4], q[5], q[6]));
    Isometry3::from_parts(Translation3::new(q[0], q[1], q[2]), rotation)
}

impl Contestant for Dynibo {
    fn quantities(&self) -> &'static [Quantity] {
        &[Quantity::Crba, Quantity::Rnea, Quantity::Aba]
    }

    fn compute(&mut self, quantity: Quantity, sample: usize, _: &Sample) -> Outcome {
        let State { base, q, v, x, forces } = &self.states[sample];
        match (&mut self.robot, quantity) {
            (Kind::Fixed(robot), Quantity::Crba) => robot.mass_matrix(q, &mut self.H)?,
            (Kind::Floating(robot), Quantity::Crba) => robot.mass_matrix(base, q, &mut self.H)?,
            (Kind::Fixed(robot), Quantity::Rnea) => robot.inverse_dynamics(q, v, x, &[], &mut self.out)?,
            (Kind::Floating(robot), Quantity::Rnea) => {
                robot.inverse_dynamics(base, q, v, x, &[], &mut self.out)?
            }
            (Kind::Fixed(robot), _) => robot.forward_dynamics(q, v, forces, &[], &mut self.out)?,
            (Kind::Floating(robot), _) => robot.forward_dynamics(base, q, v, forces, &[], &mut self.out)?,
        }
        Ok(())
    }

    /// H with the base's velocity turned into the body's frame.
    fn value(&mut self, quantity: Quantity) -> Vec<f64> {
        if quantity != Quantity::Crba {
            return Vec::new();
        }
        let n = self.out.len();
        let first = n - self.dofs.len();
        let mut T = DMatrix::zeros(n, n);
        let rotation = self.states[0].base.frame().rotation.to_rotation_matrix();
        for block in (0..first).step_by(3) {
            T.fixed_view_mut::<3, 3>(block, block).copy_from(rotation.matrix());
        }
        for (k, &dof) in self.dofs.iter().enumerate() {
            T[(first + k, dof)] = 1.0;
        }
        let H = T.transpose() * DMatrix::from_column_slice(n, n, &self.H) * T;
        H.as_slice().to_vec()
    }
}

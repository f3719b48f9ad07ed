//! How simulators step.

use super::Impedance;
use crate::matrix::Matrix;

/// A way of stepping, by what it takes implicitly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Integrator {
    /// v⁺ from forces at the start of the step, q⁺ from v⁺.
    SemiImplicitEuler,
    /// The same, dampers of joints taken at the end of the step: MuJoCo's `Euler`.
    DampedEuler,
    /// The same, all that depends on velocity linearised and taken at the end of the step: MuJoCo's `implicitfast`.
    ImplicitVelocity,
    /// The classical Runge-Kutta method of order four.
    RungeKutta4,
}

impl Integrator {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::SemiImplicitEuler, Self::DampedEuler, Self::ImplicitVelocity, Self::RungeKutta4];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::SemiImplicitEuler => "semi-implicit Euler",
            Self::DampedEuler => "damped Euler",
            Self::ImplicitVelocity => "implicit in velocity",
            Self::RungeKutta4 => "RK4",
        }
    }

    /// D_i: the damping that is taken at the end of a step; none for a method that is no kind of Euler's.
    pub(super) fn implicit_part(self, impedance: &Impedance) -> Option<Matrix<f64>> {
        match self {
            Self::SemiImplicitEuler => Some(Matrix::zeros(impedance.len(), impedance.len())),
            Self::DampedEuler => Some(impedance.joint_damping.clone()),
            Self::ImplicitVelocity => Some(impedance.damping.clone()),
            Self::RungeKutta4 => None,
        }
    }
}

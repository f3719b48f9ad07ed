//! Rigid-body dynamics: one algorithm a file, each opening with its pseudo-code.
//!
//! Every algorithm has two doors: `f(&model, ..) -> Result<..>` allocates what it needs; `f_into(&model, .., &mut workspace,
//! &mut out)` allocates nothing and writes its output whole.

mod aba;
mod bias;
mod closure;
mod crba;
mod denoc;
mod energy;
mod floating;
mod gradient;
mod inertial;
mod kinematics;
mod momentum;
pub mod plain;
mod posture;
mod reduction;
mod reroot;
mod rnea;
mod rooted;

pub(crate) use aba::Aba;
pub use aba::{AbaWorkspace, forward_dynamics, forward_dynamics_into};
pub use bias::{bias_force, bias_force_into, gravity_force, gravity_force_into};
pub(crate) use closure::closure_sizes;
pub use closure::{Anchor, Closure, Tie, closure_jacobian, closure_residual};
pub(crate) use crba::Crba;
pub use crba::{CrbaWorkspace, mass_matrix, mass_matrix_into, mass_matrix_upper_into};
pub use denoc::{Denoc, Udu};
pub use energy::{Energy, EnergyShares, energy, energy_into, energy_shares};
pub(crate) use floating::BASE;
pub use floating::{FloatingWorkspace, floating_mass_matrix, floating_mass_matrix_into};
pub use gradient::{GradientWorkspace, kinetic_energy_gradient, kinetic_energy_gradient_into};
pub use inertial::{InertialGradient, inertial_gradient};
pub use kinematics::{Kinematics, axes, link_pose, link_poses};
pub use momentum::{Momentum, MomentumWorkspace, momentum, momentum_into};
pub(crate) use posture::{Posture, position, slide};
pub use reduction::Reduction;
pub(crate) use reroot::{Rerooted, TreeBody};
pub(crate) use rnea::Rnea;
pub use rnea::{RneaWorkspace, inverse_dynamics, inverse_dynamics_into};

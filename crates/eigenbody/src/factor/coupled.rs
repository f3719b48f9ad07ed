//! Dynamics of a robot whose mimic joints follow, in its independent degrees of freedom.
//!
//! ```text
//! q = G p + g      v = G ṗ      v̇ = G p̈                 G is constant: no term of its own
//! τ = Gᵀ (H G p̈ + C(q, G ṗ))                            one RNEA, O(N)
//! p̈ = (Gᵀ H G)⁻¹ (τ − Gᵀ C)                              CRBA, RNEA, Cholesky: GᵀHG has no tree
//! ```
//! Explicit constraints v = G ṗ of Featherstone (2008), projected on the motions that they leave.

use super::Cholesky;
use crate::dynamics::{
    CrbaWorkspace, RneaWorkspace, bias_force_into, inverse_dynamics_into, mass_matrix_into,
};
use crate::error::{Error, InputError, check_length};
use crate::matrix::Matrix;
use crate::model::{Coupling, Model, check};
use crate::scalar::Real;

/// Room for [`coupled_inverse_dynamics_into`] and its kin.
#[derive(Debug, Clone)]
pub struct CoupledWorkspace<T> {
    crba: CrbaWorkspace<T>,
    rnea: RneaWorkspace<T>,
    /// nv: G ṗ, G p̈ and the forces on all joints.
    v: Vec<T>,
    vdot: Vec<T>,
    tau: Vec<T>,
    H: Matrix<T>,
    /// GᵀHG, and its factor.
    reduced: Matrix<T>,
    factor: Cholesky<T>,
}

impl<T: Real> CoupledWorkspace<T> {
    /// Room for a model and the map of its mimic joints.
    ///
    /// Errors: [`InputError::TooLargeForDense`].
    pub fn new(model: &Model<T>, coupling: &Coupling<T>) -> Result<Self, InputError> {
        model.check_dense()?;
        let (nv, n) = (model.nv(), coupling.nv());
        let zeros = vec![T::ZERO; nv];
        Ok(Self {
            crba: CrbaWorkspace::new(model),
            rnea: RneaWorkspace::new(model),
            v: zeros.clone(),
            vdot: zeros.clone(),
            tau: zeros,
            H: Matrix::zeros(nv, nv),
            reduced: Matrix::zeros(n, n),
            factor: Cholesky::new(n),
        })
    }
}

/// Forces on the independent joints that give them an acceleration: τ = Gᵀ (H G p̈ + C). Allocates nothing.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq`, all coordinates, G p + g | rad, m, unit quaternion |
/// | `rate`, `acceleration` | `coupling.nv()`: ṗ, p̈ | rad/s, m/s; rad/s², m/s² |
/// | `tau` | `coupling.nv()` | N m, N |
///
/// Method: RNEA of all joints, O(N). Numerics: as [`inverse_dynamics_into`].
///
/// Errors: [`InputError`] if an argument has the wrong length, a number that is not finite, or no unit quaternion;
/// [`InputError::OtherModel`] for the coupling or the workspace.
///
/// ```
/// use eigenbody::factor::{CoupledWorkspace, coupled_inverse_dynamics_into};
/// use eigenbody::model::{JointSpec, MimicSpec};
/// use eigenbody::spatial::{RigidInertia, Sym3, Vec3};
/// use eigenbody::{Base, Joint, ModelBuilder};
/// // Two fingers of 1 kg m² about their axes, the right one turning twice as fast.
/// let mut hand = ModelBuilder::new("hand");
/// hand.gravity(Vec3::ZERO);
/// let palm = hand.link("palm", RigidInertia::ZERO);
/// for name in ["left", "right"] {
///     let finger = hand.link(name, RigidInertia::from_com(1.0, Vec3::ZERO, Sym3::diagonal(1.0, 1.0, 1.0)));
///     let mimic = MimicSpec { joint: "left".into(), multiplier: 2.0, offset: 0.0 };
///     let joint = JointSpec::new(name, Joint::Revolute, palm, finger);
///     hand.joint(JointSpec { mimic: (name == "right").then_some(mimic), ..joint });
/// }
/// let hand = hand.build(Base::Fixed)?;
/// let coupling = hand.coupling().unwrap();
/// let (mut room, mut tau) = (CoupledWorkspace::new(&hand, coupling)?, [0.0]);
/// coupled_inverse_dynamics_into(&hand, coupling, &[0.1, 0.2], &[0.0], &[1.0], &mut room, &mut tau)?;
/// assert_eq!(tau, [5.0]); // 1 + 2²
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn coupled_inverse_dynamics_into<T: Real>(
    model: &Model<T>,
    coupling: &Coupling<T>,
    q: &[T],
    rate: &[T],
    acceleration: &[T],
    workspace: &mut CoupledWorkspace<T>,
    tau: &mut [T],
) -> Result<(), InputError> {
    check_room(model, coupling, workspace)?;
    let CoupledWorkspace { rnea, v, vdot, tau: all, .. } = workspace;
    check("v", rate, coupling.nv())?;
    check("vdot", acceleration, coupling.nv())?;
    check_length("tau", tau.len(), coupling.nv())?;
    coupling.push_forward_into(rate, v);
    coupling.push_forward_into(acceleration, vdot);
    inverse_dynamics_into(model, q, v, vdot, rnea, all)?;
    coupling.pull_back_into(all, tau);
    Ok(())
}

/// Gᵀ C(q, G ṗ): gravity, Coriolis and centrifugal forces on the independent joints. Allocates nothing.
///
/// Shapes and errors: as [`coupled_inverse_dynamics_into`] at p̈ = 0.
pub fn coupled_bias_force_into<T: Real>(
    model: &Model<T>,
    coupling: &Coupling<T>,
    q: &[T],
    rate: &[T],
    workspace: &mut CoupledWorkspace<T>,
    C: &mut [T],
) -> Result<(), InputError> {
    check_room(model, coupling, workspace)?;
    let CoupledWorkspace { rnea, v, tau: all, .. } = workspace;
    check("v", rate, coupling.nv())?;
    check_length("C", C.len(), coupling.nv())?;
    coupling.push_forward_into(rate, v);
    bias_force_into(model, q, v, rnea, all)?;
    coupling.pull_back_into(all, C);
    Ok(())
}

/// Acceleration of the independent joints under forces on them: p̈ = (GᵀHG)⁻¹ (τ − Gᵀ C). Allocates nothing.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq`, all coordinates, G p + g | rad, m, unit quaternion |
/// | `rate`, `tau` | `coupling.nv()` | rad/s, m/s; N m, N |
/// | `acceleration` | `coupling.nv()` | rad/s², m/s² |
///
/// Method: CRBA, RNEA and Cholesky, O(N d + n³). Numerics: a backward stable solve; κ′ of GᵀHG governs the error.
///
/// Errors: [`InputError`] as [`coupled_inverse_dynamics_into`];
/// [`NotPositiveDefinite`](crate::NotPositiveDefinite), by the independent degree of freedom, where GᵀHG is not.
pub fn coupled_forward_dynamics_into<T: Real>(
    model: &Model<T>,
    coupling: &Coupling<T>,
    q: &[T],
    rate: &[T],
    tau: &[T],
    workspace: &mut CoupledWorkspace<T>,
    acceleration: &mut [T],
) -> Result<(), Error> {
    check("tau", tau, coupling.nv())?;
    coupled_bias_force_into(model, coupling, q, rate, workspace, acceleration)?;
    let CoupledWorkspace { crba, H, reduced, factor, .. } = workspace;
    mass_matrix_into(model, q, crba, H)?;
    coupling.reduce_into(H, reduced);
    factor.factor(reduced)?;
    for (x, tau) in acceleration.iter_mut().zip(tau) {
        *x = *tau - *x;
    }
    factor.solve(acceleration)
}

/// Refuses a map or room of another model.
fn check_room<T: Real>(
    model: &Model<T>,
    coupling: &Coupling<T>,
    workspace: &CoupledWorkspace<T>,
) -> Result<(), InputError> {
    let CoupledWorkspace { crba, reduced, .. } = workspace;
    model.check_shape("workspace", crba.shape)?;
    if coupling.of() != model.nv() {
        return Err(InputError::OtherModel { what: "coupling" });
    }
    if reduced.rows() != coupling.nv() {
        return Err(InputError::OtherModel { what: "workspace" });
    }
    Ok(())
}

//! How the kinetic energy of a given velocity changes with the configuration.
//!
//! ```text
//! for i = 1..N:   c_i = X_up v_p               v_i = c_i + S_i q̇_i
//! for i = N..1:   h_i = I_i v_i + Σ X_upᵀ h_j   (over the children j)
//!                 ∂T/∂q_d = −(S_d × c_d) · h_i      c_d = c_i, on a universal joint with the columns before d
//! ```
//! Moving joint i by δ along S_d turns all that it carries: X_up becomes (1 − δ S_d×) X_up, velocities outboard change by −δ S_d × c,
//! and energy by that times the momentum carried. Cost O(N).
//!
//! With q̇ = x, an eigenvector of H with xᵀBx = 1, twice this gradient is ∂λ/∂q (B constant).

use super::kinematics::Kinematics;
use crate::error::{InputError, check_length};
use crate::joint::Joint;
use crate::model::{Model, Shape, check};
use crate::scalar::{Real, Scalar};
use crate::spatial::{Force, Motion};

/// Room for [`kinetic_energy_gradient_into`].
#[derive(Debug, Clone)]
pub struct GradientWorkspace<T> {
    shape: Shape,
    kinematics: Kinematics<T>,
    /// N: velocity handed on by the parent, and momentum of each body with all that it carries.
    c: Vec<Motion<T>>,
    h: Vec<Force<T>>,
    v: Vec<Motion<T>>,
}

impl<T: Scalar> GradientWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T>) -> Self {
        let n = model.bodies.len();
        Self {
            shape: model.shape,
            kinematics: Kinematics::new(model),
            c: vec![Motion::ZERO; n],
            h: vec![Force::ZERO; n],
            v: vec![Motion::ZERO; n],
        }
    }
}

/// ∂T/∂q with v held: one number a DoF, along the motion of that DoF.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
/// | result | `nv` | J/rad, J/m |
///
/// For joints with as many coordinates as DoFs these are the partial derivatives; for others the derivatives along
/// [`Model::integrate`]. Numerics: errors of a few ε of the sum of |h_i||S_d × c_i| over what the joint carries.
///
/// Errors: [`InputError`] if q or v does not fit the model.
///
/// ```
/// use eigenbody::{Family, dynamics::kinetic_energy_gradient};
/// // Two rods of 1 m and 1 kg, the second turned by q: T = (5/3 + cos q) v₁²/2 for v₂ = 0.
/// let arm = Family::slender_chain(2, 1.0, 1.0)?.model::<f64>()?;
/// let gradient = kinetic_energy_gradient(&arm, &[0.3, 0.5], &[2.0, 0.0])?;
/// assert!(gradient[0].abs() < 1e-15 && (gradient[1] + 2.0 * 0.5f64.sin()).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn kinetic_energy_gradient<T: Real>(model: &Model<T>, q: &[T], v: &[T]) -> Result<Vec<T>, InputError> {
    let mut gradient = vec![T::ZERO; model.nv()];
    kinetic_energy_gradient_into(model, q, v, &mut GradientWorkspace::new(model), &mut gradient)?;
    Ok(gradient)
}

/// [`kinetic_energy_gradient`] into `gradient`; allocates nothing.
///
/// Errors: as [`kinetic_energy_gradient`], for a `gradient` of the wrong length, and [`InputError::OtherModel`] for the workspace.
pub fn kinetic_energy_gradient_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    workspace: &mut GradientWorkspace<T>,
    gradient: &mut [T],
) -> Result<(), InputError> {
    model.check_shape("workspace", workspace.shape)?;
    model.check_q(q)?;
    check("v", v, model.nv())?;
    check_length("gradient", gradient.len(), model.nv())?;
    let GradientWorkspace { kinematics, c, h, v: velocity, .. } = workspace;
    kinematics.update(model, q);
    let Kinematics { X_up, S } = kinematics;
    for (i, body) in model.bodies.iter().enumerate() {
        c[i] = body.parent().map_or(Motion::ZERO, |p| X_up[i].motion(velocity[p]));
        velocity[i] = body.dofs().fold(c[i], |sum, d| sum + S[d] * v[d]);
        h[i] = body.I.times(velocity[i]);
    }
    for (i, body) in model.bodies.iter().enumerate().rev() {
        let mut before = c[i];
        for d in body.dofs() {
            gradient[d] = -S[d].cross(before).dot(h[i]);
            if let Joint::Universal { .. } = body.joint {
                before += S[d] * v[d];
            }
        }
        if let Some(p) = body.parent() {
            let carried = X_up[i].transpose_force(h[i]);
            h[p] += carried;
        }
    }
    Ok(())
}

//! The recursive Newton-Euler algorithm.
//!
//! ```text
//! a_0 = −a_g
//! for i = 1..N:   v_i = X_up v_p + S_i q̇_i
//!                 a_i = X_up a_p + S_i q̈_i + S°_i q̇_i + v_i × S_i q̇_i
//!                 f_i = I_i a_i + v_i ×* I_i v_i
//! for i = N..1:   τ_i = S_iᵀ f_i + armature_i q̈_i
//!                 f_p += X_upᵀ f_i
//! ```
//! Featherstone (2008), table 5.1. Cost O(N).

use super::kinematics::Kinematics;
use crate::error::InputError;
use crate::model::Model;
use crate::scalar::{Real, Scalar};
use crate::spatial::{Force, Motion, Vec3};

/// Room for [`inverse_dynamics_into`].
#[derive(Debug, Clone)]
pub struct RneaWorkspace<T> {
    pub(super) kinematics: Kinematics<T>,
    /// N: velocity and acceleration (gravity included) of each body. Written by the forward sweep.
    v: Vec<Motion<T>>,
    a: Vec<Motion<T>>,
    /// N: force transmitted through each joint. Written forwards, accumulated backwards.
    f: Vec<Force<T>>,
    /// nv: zeros, for the callers that need v = 0 or v̇ = 0.
    pub(super) zeros: Vec<T>,
}

impl<T: Scalar> RneaWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T>) -> Self {
        let n = model.bodies.len();
        Self {
            kinematics: Kinematics::new(model),
            v: vec![Motion::ZERO; n],
            a: vec![Motion::ZERO; n],
            f: vec![Force::ZERO; n],
            zeros: vec![T::ZERO; model.nv()],
        }
    }
}

/// Generalised forces that give the acceleration v̇: τ = H(q) v̇ + C(q, v).
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
/// | `vdot` | `nv` | rad/s², m/s² |
/// | τ (returned) | `nv` | N m, N |
///
/// Method: recursive Newton-Euler, Featherstone (2008) table 5.1, in body frames; gravity as an acceleration of the base.
/// O(N); allocates. Numerics: backward stable, error of order ε times the forces that meet in a joint.
///
/// Errors: [`InputError`] if an argument has the wrong length, a number that is not finite, or no unit quaternion.
///
/// ```
/// use eigenbody::{Family, inverse_dynamics};
/// let arm = Family::slender_chain(1, 2.0, 1.0)?.model::<f64>()?;
/// // A horizontal rod of 2 kg and 1 m: holding torque m g l/2.
/// let tau = inverse_dynamics(&arm, &[0.0], &[0.0], &[0.0])?;
/// assert!((tau[0] - 9.81).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "rnea")]
pub fn inverse_dynamics<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    vdot: &[T],
) -> Result<Vec<T>, InputError> {
    let mut tau = vec![T::ZERO; model.nv()];
    inverse_dynamics_into(model, q, v, vdot, &mut RneaWorkspace::new(model), &mut tau)?;
    Ok(tau)
}

/// [`inverse_dynamics`] into the caller's memory; allocates nothing.
///
/// Errors: as [`inverse_dynamics`], and if `tau` has the wrong length.
pub fn inverse_dynamics_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    vdot: &[T],
    workspace: &mut RneaWorkspace<T>,
    tau: &mut [T],
) -> Result<(), InputError> {
    model.check_q(q)?;
    model.check_v("v", v)?;
    model.check_v("vdot", vdot)?;
    check_out("tau", tau.len(), model.nv())?;
    workspace.kinematics.update(model, q);
    rnea(model, model.gravity, v, vdot, workspace, tau);
    Ok(())
}

pub(super) fn check_out(what: &'static str, found: usize, expected: usize) -> Result<(), InputError> {
    if found == expected { Ok(()) } else { Err(InputError::Length { what, expected, found }) }
}

/// The two sweeps; the kinematics stand in the workspace.
#[inline(always)]
pub(super) fn rnea<T: Scalar>(
    model: &Model<T>,
    gravity: Vec3<T>,
    qd: &[T],
    qdd: &[T],
    workspace: &mut RneaWorkspace<T>,
    tau: &mut [T],
) {
    let RneaWorkspace { kinematics: Kinematics { X_up, S }, v, a, f, .. } = workspace;
    let a_0 = Motion::new(Vec3::ZERO, -gravity);
    for (i, body) in model.bodies.iter().enumerate() {
        let (v_p, a_p) = body.parent().map_or((Motion::ZERO, a_0), |p| (v[p], a[p]));
        let dofs = body.dofs();
        let S_i = &S[dofs.clone()];
        let (mut v_J, mut a_J) = (Motion::ZERO, body.joint.bias(S_i, &qd[dofs.clone()]));
        for (k, d) in dofs.enumerate() {
            v_J += S_i[k] * qd[d];
            a_J += S_i[k] * qdd[d];
        }
        v[i] = X_up[i].motion(v_p) + v_J;
        a[i] = X_up[i].motion(a_p) + a_J + v[i].cross(v_J);
        f[i] = body.I.times(a[i]) + v[i].cross_force(body.I.times(v[i]));
    }
    for (i, body) in model.bodies.iter().enumerate().rev() {
        for d in body.dofs() {
            tau[d] = S[d].dot(f[i]) + model.armature[d] * qdd[d];
        }
        if let Some(p) = body.parent() {
            let carried = X_up[i].transpose_force(f[i]);
            f[p] += carried;
        }
    }
}

//! The articulated-body algorithm, one degree of freedom after the other.
//!
//! ```text
//! for i = 1..N:   v_i = X_up v_p + S_i q̇_i      c_i = S°_i q̇_i + v_i × S_i q̇_i
//!                 IA_i = I_i                     pA_i = v_i ×* I_i v_i
//! for i = N..1:   for d of body i, last to first:
//!                     U_d = IA_i S_d      D_d = S_dᵀ U_d + armature_d      u_d = τ_d − S_dᵀ pA_i
//!                     IA_i −= U_d D_d⁻¹ U_dᵀ      pA_i += U_d D_d⁻¹ u_d
//!                 IA_p += X_upᵀ IA_i X_up        pA_p += X_upᵀ (pA_i + IA_i c_i)
//! a_0 = −a_g
//! for i = 1..N:   a = X_up a_p + c_i
//!                 for d of body i, first to last:   q̈_d = D_d⁻¹ (u_d − U_dᵀ a);   a += S_d q̈_d
//! ```
//! Featherstone (2008), table 7.1; a joint of k DoFs is k hinges in the same place with massless links between. Cost O(N).
//! H = L D Lᵀ with these D: they are the pivots of a Cholesky-type elimination of H from the tips inwards.

use super::kinematics::Kinematics;
use super::rnea::check_out;
use crate::error::{Error, NotPositiveDefinite};
use crate::model::Model;
use crate::scalar::{Real, Scalar};
use crate::spatial::{ArticulatedInertia, Force, Motion, Vec3};

/// Room for [`forward_dynamics_into`].
#[derive(Debug, Clone)]
pub struct AbaWorkspace<T> {
    kinematics: Kinematics<T>,
    /// N: velocity and velocity-product acceleration, then acceleration, of each body.
    v: Vec<Motion<T>>,
    c: Vec<Motion<T>>,
    a: Vec<Motion<T>>,
    /// N: articulated inertia and bias force. Accumulated backwards.
    IA: Vec<ArticulatedInertia<T>>,
    pA: Vec<Force<T>>,
    /// nv: U = IA S, hinge inertia D, u = τ − Sᵀ pA. Written by the backward sweep.
    U: Vec<Force<T>>,
    D: Vec<T>,
    u: Vec<T>,
}

impl<T: Scalar> AbaWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T>) -> Self {
        let (n, nv) = (model.bodies.len(), model.nv());
        Self {
            kinematics: Kinematics::new(model),
            v: vec![Motion::ZERO; n],
            c: vec![Motion::ZERO; n],
            a: vec![Motion::ZERO; n],
            IA: vec![ArticulatedInertia::ZERO; n],
            pA: vec![Force::ZERO; n],
            U: vec![Force::ZERO; nv],
            D: vec![T::ZERO; nv],
            u: vec![T::ZERO; nv],
        }
    }
}

/// Acceleration under the generalised forces τ: v̇ = H(q)⁻¹ (τ − C(q, v)), without forming H.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | `v` | `nv` | rad/s, m/s |
/// | `tau` | `nv` | N m, N |
/// | v̇ (returned) | `nv` | rad/s², m/s² |
///
/// Method: articulated bodies, Featherstone (2008) table 7.1. O(N); allocates. Numerics: error governed by κ′, the
/// conditioning with each joint in units of its own inertia.
///
/// Errors: [`InputError`](crate::InputError) as [`inverse_dynamics`](super::inverse_dynamics); [`NotPositiveDefinite`] with the
/// DoF if a hinge inertia is not positive.
///
/// ```
/// use eigenbody::{Family, forward_dynamics};
/// let arm = Family::slender_chain(1, 2.0, 1.0)?.model::<f64>()?;
/// // A rod let go from the horizontal: 3g/2l.
/// let vdot = forward_dynamics(&arm, &[0.0], &[0.0], &[0.0])?;
/// assert!((vdot[0] + 1.5 * 9.81).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "aba")]
pub fn forward_dynamics<T: Real>(model: &Model<T>, q: &[T], v: &[T], tau: &[T]) -> Result<Vec<T>, Error> {
    let mut vdot = vec![T::ZERO; model.nv()];
    forward_dynamics_into(model, q, v, tau, &mut AbaWorkspace::new(model), &mut vdot)?;
    Ok(vdot)
}

/// [`forward_dynamics`] into the caller's memory; allocates nothing.
///
/// Errors: as [`forward_dynamics`], and if `vdot` has the wrong length. After [`NotPositiveDefinite`] `vdot` holds no result.
pub fn forward_dynamics_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    v: &[T],
    tau: &[T],
    workspace: &mut AbaWorkspace<T>,
    vdot: &mut [T],
) -> Result<(), Error> {
    model.check_q(q)?;
    model.check_v("v", v)?;
    model.check_v("tau", tau)?;
    check_out("vdot", vdot.len(), model.nv())?;
    workspace.kinematics.update(model, q);
    aba(model, model.gravity, v, tau, workspace, vdot);
    // Checked from the tips inwards, in the order of elimination: the first bad pivot is the one to name.
    match model.dofs.order().rev().find(|&d| !(workspace.D[d] > T::ZERO && workspace.D[d].is_finite())) {
        Some(dof) => Err(NotPositiveDefinite { dof, pivot: workspace.D[dof].to_f64() }.into()),
        None => Ok(()),
    }
}

/// The three sweeps; the kinematics stand in the workspace.
#[inline(always)]
fn aba<T: Scalar>(
    model: &Model<T>,
    gravity: Vec3<T>,
    qd: &[T],
    tau: &[T],
    workspace: &mut AbaWorkspace<T>,
    qdd: &mut [T],
) {
    let AbaWorkspace { kinematics: Kinematics { X_up, S }, v, c, a, IA, pA, U, D, u } = workspace;
    for (i, body) in model.bodies.iter().enumerate() {
        let dofs = body.dofs();
        let S_i = &S[dofs.clone()];
        let v_p = body.parent().map_or(Motion::ZERO, |p| v[p]);
        let mut v_J = Motion::ZERO;
        for (k, d) in dofs.clone().enumerate() {
            v_J += S_i[k] * qd[d];
        }
        v[i] = X_up[i].motion(v_p) + v_J;
        c[i] = body.joint.bias(S_i, &qd[dofs]) + v[i].cross(v_J);
        IA[i] = body.I.into();
        pA[i] = v[i].cross_force(body.I.times(v[i]));
    }
    for (i, body) in model.bodies.iter().enumerate().rev() {
        let (mut IA_i, mut pA_i) = (IA[i], pA[i]);
        for d in body.dofs().rev() {
            U[d] = IA_i.times(S[d]);
            D[d] = S[d].dot(U[d]) + model.armature[d];
            u[d] = tau[d] - S[d].dot(pA_i);
            let D_inverse = T::ONE / D[d];
            IA_i = IA_i.minus_outer(U[d], D_inverse);
            pA_i += U[d] * (D_inverse * u[d]);
        }
        if let Some(p) = body.parent() {
            IA[p] += X_up[i].transpose_articulated(IA_i);
            pA[p] += X_up[i].transpose_force(pA_i + IA_i.times(c[i]));
        }
    }
    let a_0 = Motion::new(Vec3::ZERO, -gravity);
    for (i, body) in model.bodies.iter().enumerate() {
        let mut a_i = X_up[i].motion(body.parent().map_or(a_0, |p| a[p])) + c[i];
        for d in body.dofs() {
            qdd[d] = (u[d] - a_i.dot(U[d])) / D[d];
            a_i += S[d] * qdd[d];
        }
        a[i] = a_i;
    }
}

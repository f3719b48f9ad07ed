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

use crate::dynamics::kinematics::Kinematics;
use crate::error::InputError;
use crate::model::Model;
use crate::scalar::Real;
use crate::spatial::{Force, Motion, Vec3};

/// [`inverse_dynamics`](crate::inverse_dynamics) as in the book.
///
/// Errors: as there.
pub fn inverse_dynamics<T: Real>(
    model: &Model<T>,
    q: &[T],
    qd: &[T],
    qdd: &[T],
) -> Result<Vec<T>, InputError> {
    model.check_q(q)?;
    model.check_v("v", qd)?;
    model.check_v("vdot", qdd)?;
    let n = model.bodies.len();
    let (mut v, mut a, mut f) = (vec![Motion::ZERO; n], vec![Motion::ZERO; n], vec![Force::ZERO; n]);
    let mut tau = vec![T::ZERO; model.nv()];
    let Kinematics { X_up, S } = Kinematics::at(model, q);
    let a_0 = Motion::new(Vec3::ZERO, -model.gravity);
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
    Ok(tau)
}

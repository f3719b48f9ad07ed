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

use crate::dynamics::kinematics::Kinematics;
use crate::error::Error;
use crate::model::Model;
use crate::scalar::Real;
use crate::spatial::{ArticulatedInertia, Force, Motion, Vec3};

/// [`forward_dynamics`](crate::forward_dynamics) as in the book; pivots are not looked at.
///
/// Errors: [`InputError`](crate::InputError) as there.
pub fn forward_dynamics<T: Real>(model: &Model<T>, q: &[T], qd: &[T], tau: &[T]) -> Result<Vec<T>, Error> {
    model.check_q(q)?;
    model.check_v("v", qd)?;
    model.check_v("tau", tau)?;
    let (n, nv) = (model.bodies.len(), model.nv());
    let (mut v, mut c, mut a) = (vec![Motion::ZERO; n], vec![Motion::ZERO; n], vec![Motion::ZERO; n]);
    let (mut IA, mut pA) = (vec![ArticulatedInertia::ZERO; n], vec![Force::ZERO; n]);
    let (mut U, mut D, mut u) = (vec![Force::ZERO; nv], vec![T::ZERO; nv], vec![T::ZERO; nv]);
    let mut qdd = vec![T::ZERO; nv];
    let Kinematics { X_up, S } = Kinematics::at(model, q);
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
    let a_0 = Motion::new(Vec3::ZERO, -model.gravity);
    for (i, body) in model.bodies.iter().enumerate() {
        let mut a_i = X_up[i].motion(body.parent().map_or(a_0, |p| a[p])) + c[i];
        for d in body.dofs() {
            qdd[d] = (u[d] - a_i.dot(U[d])) / D[d];
            a_i += S[d] * qdd[d];
        }
        a[i] = a_i;
    }
    Ok(qdd)
}

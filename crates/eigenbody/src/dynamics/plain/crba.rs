//! The composite-rigid-body algorithm.
//!
//! ```text
//! H = 0
//! for i = N..1:   Ic_p += X_upᵀ Ic_i X_up                (Ic_i starts as I_i)
//! for each d of body i:
//!     F = Ic_i S_d
//!     H_de = H_ed = F · S_e        for the DoFs e of body i up to d
//!     for j = i, parent(i), ..:    F = X_up_jᵀ F;   H_de = H_ed = F · S_e   for the DoFs e of parent(j)
//! H_dd += armature_d
//! ```
//! Featherstone (2008), table 6.2. Cost O(N·depth).

use crate::dynamics::kinematics::Kinematics;
use crate::dynamics::reroot::TreeBody;
use crate::error::InputError;
use crate::matrix::Matrix;
use crate::model::Model;
use crate::scalar::{Real, Scalar};
use crate::spatial::RigidInertia;

/// [`mass_matrix`](crate::mass_matrix) as in the book.
///
/// Errors: as there.
pub fn mass_matrix<T: Real>(model: &Model<T>, q: &[T]) -> Result<Matrix<T>, InputError> {
    model.check_dense()?;
    model.check_q(q)?;
    let mut H = Matrix::zeros(model.nv(), model.nv());
    let mut Ic = vec![RigidInertia::ZERO; model.bodies.len()];
    crba(&model.bodies, &Kinematics::at(model, q), &model.armature, &mut Ic, &mut H);
    Ok(H)
}

/// Both loops, over any tree of which the kinematics are known.
#[inline(always)]
pub(in crate::dynamics) fn crba<T: Scalar, B: TreeBody<T>>(
    bodies: &[B],
    Kinematics { X_up, S }: &Kinematics<T>,
    armature: &[T],
    Ic: &mut [RigidInertia<T>],
    H: &mut Matrix<T>,
) {
    for (Ic, body) in Ic.iter_mut().zip(bodies) {
        *Ic = body.inertia();
    }
    for (i, body) in bodies.iter().enumerate().rev() {
        if let Some(p) = body.parent() {
            let carried = X_up[i].transpose_rigid(Ic[i]);
            Ic[p] += carried;
        }
    }
    H.fill(T::ZERO);
    for (i, body) in bodies.iter().enumerate() {
        let dofs = body.dofs();
        for d in dofs.clone() {
            let mut F = Ic[i].times(S[d]);
            for e in dofs.start..=d {
                let H_de = S[e].dot(F);
                H[(d, e)] = H_de;
                H[(e, d)] = H_de;
            }
            let mut j = i;
            while let Some(p) = bodies[j].parent() {
                F = X_up[j].transpose_force(F);
                for e in bodies[p].dofs() {
                    let H_de = S[e].dot(F);
                    H[(d, e)] = H_de;
                    H[(e, d)] = H_de;
                }
                j = p;
            }
            H[(d, d)] += armature[d];
        }
    }
}

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

use super::kinematics::Kinematics;
use super::reroot::TreeBody;
use super::rnea::check_out;
use crate::error::InputError;
use crate::matrix::Matrix;
use crate::model::Model;
use crate::scalar::{Real, Scalar};
use crate::spatial::RigidInertia;

/// Room for [`mass_matrix_into`].
#[derive(Debug, Clone)]
pub struct CrbaWorkspace<T> {
    kinematics: Kinematics<T>,
    /// N: inertia of each body with all that it carries, frozen. Accumulated backwards.
    Ic: Vec<RigidInertia<T>>,
}

impl<T: Scalar> CrbaWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T>) -> Self {
        Self { kinematics: Kinematics::new(model), Ic: vec![RigidInertia::ZERO; model.bodies.len()] }
    }
}

/// The joint-space inertia matrix H(q).
///
/// ```text
/// ½ vᵀ H v = kinetic energy      τ = H v̇ + C
/// ```
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | H (returned) | `nv` × `nv`, both triangles | kg m², kg m, kg |
///
/// Method: composite rigid bodies, Featherstone (2008) table 6.2. O(N·depth); allocates. Entries between DoFs on
/// different branches are exactly zero. Numerics: every entry to a few ε of √(H_dd H_ee).
///
/// Errors: [`InputError`] if q does not fit the model, or nv exceeds [`DENSE_LIMIT`](crate::model::DENSE_LIMIT).
///
/// ```
/// use eigenbody::{Family, mass_matrix};
/// let arm = Family::slender_chain(2, 3.0, 1.0)?.model::<f64>()?;
/// // Two rods in line: I₁₁ = (m/3)(2l)³/l, as one rod of twice the length and mass.
/// assert!((mass_matrix(&arm, &[0.0, 0.0])?[(0, 0)] - 8.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "crba")]
#[doc(alias = "jsim")]
pub fn mass_matrix<T: Real>(model: &Model<T>, q: &[T]) -> Result<Matrix<T>, InputError> {
    model.check_dense()?;
    let mut H = Matrix::zeros(model.nv(), model.nv());
    mass_matrix_into(model, q, &mut CrbaWorkspace::new(model), &mut H)?;
    Ok(H)
}

/// [`mass_matrix`] into the caller's memory; allocates nothing.
///
/// Errors: as [`mass_matrix`], and if `H` is not nv × nv.
pub fn mass_matrix_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut CrbaWorkspace<T>,
    H: &mut Matrix<T>,
) -> Result<(), InputError> {
    model.check_q(q)?;
    check_out("rows of H", H.rows(), model.nv())?;
    check_out("columns of H", H.cols(), model.nv())?;
    let CrbaWorkspace { kinematics, Ic } = workspace;
    kinematics.update(model, q);
    crba(&model.bodies, kinematics, &model.armature, Ic, H);
    Ok(())
}

/// Both loops, over any tree of which the kinematics are known.
#[inline(always)]
pub(super) fn crba<T: Scalar, B: TreeBody<T>>(
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

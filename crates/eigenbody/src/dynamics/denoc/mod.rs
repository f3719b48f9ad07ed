//! The decoupled natural orthogonal complement: the mass matrix as Saha writes it, from three kinds of factors.
//!
//! ```text
//! t_i = A_ij t_j + p_i q̇_i                          twists [ω; ȯ] of body i and of j, that carries it
//! A_ij = [1 0; −(o_i − o_j)× 1]                     twist propagation
//! for i = N..1:   M̃_i = M_i + Σ A_ciᵀ M̃_c A_ci      composite masses, over the bodies c that i carries
//! I_ij = I_ji = p_iᵀ M̃_i A_ij p_j                   for j = i and every j that carries i; 0 between branches
//! ```
//! Shah & Saha (2013), Eqs. 11 and 12. All in the world's axes, each body about the origin o_i of its joint, so that A_ij shifts and
//! never turns: nothing here is shared with CRBA but the joints. Cost O(N·depth).

mod udu;

pub use udu::Udu;

use super::kinematics::Kinematics;
use crate::error::{InputError, check_length};
use crate::matrix::Matrix;
use crate::model::Model;
use crate::scalar::{Real, Scalar};
use crate::spatial::{Motion, RigidInertia, Transform};

/// The DeNOC factors of a mechanism in one configuration.
///
/// ```
/// use eigenbody::{Family, dynamics::Denoc, mass_matrix};
/// let chain = Family::slender_chain(4, 2.2, 1.0)?.model::<f64>()?;
/// let q = [0.3, -0.2, 0.5, 0.1];
/// let mut denoc = Denoc::new(&chain);
/// denoc.update(&q)?;
/// assert!((denoc.mass_matrix()?[(2, 0)] - mass_matrix(&chain, &q)?[(2, 0)]).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Denoc<'m, T> {
    model: &'m Model<T>,
    kinematics: Kinematics<T>,
    /// N: pose of each body, from the world's frame to its own. Written by [`update`](Self::update), as all below.
    pose: Vec<Transform<T>>,
    /// nv: motion propagation p, in the world's axes about the body's own origin.
    p: Vec<Motion<T>>,
    /// N: masses of the bodies, and of all that each carries.
    M: Vec<RigidInertia<T>>,
    M_tilde: Vec<RigidInertia<T>>,
}

impl<'m, T: Scalar> Denoc<'m, T> {
    /// Room for a model. Before [`update`](Self::update) every mass is zero.
    pub fn new(model: &'m Model<T>) -> Self {
        let n = model.bodies.len();
        Self {
            model,
            kinematics: Kinematics::new(model),
            pose: vec![Transform::IDENTITY; n],
            p: vec![Motion::ZERO; model.nv()],
            M: vec![RigidInertia::ZERO; n],
            M_tilde: vec![RigidInertia::ZERO; n],
        }
    }

    /// p_d: twist of the body that DoF d moves, for unit velocity of d (rad/s or m/s; world's axes, body's origin).
    pub fn motion_propagation(&self, d: usize) -> Motion<T> {
        self.p[d]
    }

    /// A_ij: the twist of body j, as body i has it if no joint between them moves. A shift by o_i − o_j.
    pub fn twist_propagation(&self, i: usize, j: usize) -> Transform<T> {
        Transform::translation(self.pose[i].r - self.pose[j].r)
    }

    /// M̃_i: mass of body i with all that it carries, frozen (kg, kg m, kg m²; world's axes, origin of i).
    pub fn composite_mass(&self, i: usize) -> RigidInertia<T> {
        self.M_tilde[i]
    }
}

impl<T: Real> Denoc<'_, T> {
    /// Writes p, A and M̃ at q.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `q` | `nq` | rad, m, unit quaternion |
    ///
    /// Cost O(N); allocates nothing. Errors: [`InputError`] if q does not fit the model.
    pub fn update(&mut self, q: &[T]) -> Result<(), InputError> {
        self.model.check_q(q)?;
        self.kinematics.update(self.model, q);
        let Self { model, kinematics: Kinematics { X_up, S }, pose, p, M, M_tilde } = self;
        for (i, body) in model.bodies.iter().enumerate() {
            pose[i] = X_up[i] * body.parent().map_or(Transform::IDENTITY, |parent| pose[parent]);
            let turn = Transform { r: crate::spatial::Vec3::ZERO, ..pose[i] };
            for d in body.dofs() {
                p[d] = turn.inverse_motion(S[d]);
            }
            M[i] = turn.transpose_rigid(body.I);
        }
        M_tilde.copy_from_slice(M);
        for (i, body) in model.bodies.iter().enumerate().rev() {
            if let Some(parent) = body.parent() {
                let A = Transform::translation(pose[i].r - pose[parent].r);
                let carried = A.transpose_rigid(M_tilde[i]);
                M_tilde[parent] += carried;
            }
        }
        Ok(())
    }

    /// The generalised inertia matrix, entry by entry.
    ///
    /// ```text
    /// I_ij = I_ji = p_iᵀ M̃_i A_ij p_j      + armature on the diagonal
    /// ```
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | returned | `nv` × `nv`, both triangles | kg m², kg m, kg |
    ///
    /// Method: Shah & Saha (2013) Eq. 11. O(N·depth); allocates. Numerics: every entry to a few depth·ε of √(I_ii I_jj).
    ///
    /// Errors: [`InputError::TooLargeForDense`]. No other failure.
    #[doc(alias = "gim")]
    pub fn mass_matrix(&self) -> Result<Matrix<T>, InputError> {
        self.model.check_dense()?;
        let mut H = Matrix::zeros(self.model.nv(), self.model.nv());
        self.mass_matrix_into(&mut H)?;
        Ok(H)
    }

    /// [`mass_matrix`](Self::mass_matrix) into the caller's memory; allocates nothing.
    ///
    /// Errors: [`InputError::Length`] if `H` is not nv × nv.
    pub fn mass_matrix_into(&self, H: &mut Matrix<T>) -> Result<(), InputError> {
        let Self { model, p, M_tilde, .. } = self;
        check_length("rows of H", H.rows(), model.nv())?;
        check_length("columns of H", H.cols(), model.nv())?;
        H.fill(T::ZERO);
        for (i, body) in model.bodies.iter().enumerate() {
            for d in body.dofs() {
                let mut j = Some(i);
                while let Some(carrier) = j {
                    let A = self.twist_propagation(i, carrier);
                    for e in model.bodies[carrier].dofs() {
                        let I_de = p[d].dot(M_tilde[i].times(A.motion(p[e])));
                        H[(d, e)] = I_de;
                        H[(e, d)] = I_de;
                    }
                    j = model.bodies[carrier].parent();
                }
                H[(d, d)] += model.armature[d];
            }
        }
        Ok(())
    }
}

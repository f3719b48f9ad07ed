//! The recursive UDUᵀ factorisation of the mass matrix, by reverse Gaussian elimination on the bodies.
//!
//! ```text
//! for i = N..1:   ψ̂_i = M̂_i p_i      m̂_i = p_iᵀ ψ̂_i + armature_i      ψ_i = ψ̂_i / m̂_i       (M̂_i starts as M_i)
//!                 M̂_j += A_ijᵀ (M̂_i − ψ̂_i ψ_iᵀ) A_ij                      j the body that carries i
//! U_ji = p_jᵀ A_ijᵀ ψ_i,  U_ii = 1      D_i = m̂_i
//!
//! solve:
//! for i = N..1:   φ̂_i = φ_i − p_iᵀ η_i        η_j += A_ijᵀ (η_i + ψ_i φ̂_i)
//! for i = 1..N:   μ = A_ij μ_j                q̈_i = φ̂_i / m̂_i − ψ_iᵀ μ        μ_i = μ + p_i q̈_i
//! ```
//! Saha, *A decomposition of the manipulator inertia matrix*, IEEE Trans. Robotics and Automation 13 (1997). Cost O(N). A joint of
//! k DoFs is k joints in the same place with massless bodies between. M̂ are the articulated inertias of ABA, in the world's axes.

use super::Denoc;
use crate::error::{Error, InputError, NotPositiveDefinite, check_length};
use crate::matrix::Matrix;
use crate::model::Shape;
use crate::scalar::{Real, Scalar};
use crate::spatial::{ArticulatedInertia, Force, Motion};

/// U and D of I = U D Uᵀ, U unit upper triangular in the order of the tree, never formed.
///
/// ```
/// use eigenbody::Family;
/// use eigenbody::dynamics::{Denoc, Udu};
/// let chain = Family::slender_chain(4, 2.2, 1.0)?.model::<f64>()?;
/// let mut denoc = Denoc::new(&chain);
/// denoc.update(&[0.3, -0.2, 0.5, 0.1])?;
/// let mut udu = Udu::new(&denoc);
/// udu.factor(&denoc)?;
/// let mut x = denoc.mass_matrix()?.times(&[1.0; 4]);
/// udu.solve(&denoc, &mut x)?;
/// assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-11));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Udu<T> {
    shape: Shape,
    /// N: articulated mass of each body. Accumulated backwards.
    M_hat: Vec<ArticulatedInertia<T>>,
    /// nv: ψ and m̂. Written by [`factor`](Self::factor).
    psi: Vec<Force<T>>,
    D: Vec<T>,
    /// N: force handed down, twist handed up. Written by [`solve`](Self::solve).
    eta: Vec<Force<T>>,
    mu: Vec<Motion<T>>,
}

impl<T: Scalar> Udu<T> {
    /// Room for the factors of a mechanism.
    pub fn new(denoc: &Denoc<'_, T>) -> Self {
        let (n, nv) = (denoc.model.bodies.len(), denoc.model.nv());
        Self {
            shape: denoc.model.shape,
            M_hat: vec![ArticulatedInertia::ZERO; n],
            psi: vec![Force::ZERO; nv],
            D: vec![T::ZERO; nv],
            eta: vec![Force::ZERO; n],
            mu: vec![Motion::ZERO; n],
        }
    }

    /// D: the inertia that each DoF feels if all that it carries hangs loose (kg m², kg).
    pub fn d(&self) -> &[T] {
        &self.D
    }
}

impl<T: Real> Udu<T> {
    /// I = U D Uᵀ, from the tips inwards. O(N); allocates nothing.
    ///
    /// Errors: [`InputError::OtherModel`] if `denoc` is of another model; [`NotPositiveDefinite`] with the DoF of the first pivot that is
    /// not positive, after which the factors must not be used.
    pub fn factor(&mut self, denoc: &Denoc<'_, T>) -> Result<(), Error> {
        let Self { shape, M_hat, psi, D, .. } = self;
        let Denoc { model, p, M, .. } = denoc;
        model.check_shape("denoc", *shape)?;
        for (M_hat, &M) in M_hat.iter_mut().zip(M) {
            *M_hat = M.into();
        }
        for (i, body) in model.bodies.iter().enumerate().rev() {
            let mut M_i = M_hat[i];
            for d in body.dofs().rev() {
                let psi_hat = M_i.times(p[d]);
                D[d] = p[d].dot(psi_hat) + model.armature[d];
                if !(D[d] > T::ZERO && D[d].is_finite()) {
                    return Err(NotPositiveDefinite { dof: d, pivot: D[d].to_f64() }.into());
                }
                psi[d] = psi_hat * (T::ONE / D[d]);
                M_i = M_i.minus_outer(psi_hat, T::ONE / D[d]);
            }
            if let Some(j) = body.parent() {
                M_hat[j] += denoc.twist_propagation(i, j).transpose_articulated(M_i);
            }
        }
        Ok(())
    }

    /// φ ← I⁻¹ φ: accelerations from forces, without forming U. O(N); allocates nothing.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `phi` | `nv` | N m, N in; rad/s², m/s² out |
    ///
    /// Numerics: as ABA, error governed by κ′. `denoc` is the one that was factored. Errors: [`InputError::Length`] for `phi`,
    /// [`InputError::OtherModel`] for `denoc`.
    pub fn solve(&mut self, denoc: &Denoc<'_, T>, phi: &mut [T]) -> Result<(), InputError> {
        let Self { shape, psi, D, eta, mu, .. } = self;
        let Denoc { model, p, .. } = denoc;
        model.check_shape("denoc", *shape)?;
        check_length("phi", phi.len(), model.nv())?;
        eta.fill(Force::ZERO);
        for (i, body) in model.bodies.iter().enumerate().rev() {
            let mut eta_i = eta[i];
            for d in body.dofs().rev() {
                phi[d] -= p[d].dot(eta_i);
                eta_i += psi[d] * phi[d];
            }
            if let Some(j) = body.parent() {
                eta[j] += denoc.twist_propagation(i, j).transpose_force(eta_i);
            }
        }
        for (i, body) in model.bodies.iter().enumerate() {
            let mut mu_i =
                body.parent().map_or(Motion::ZERO, |j| denoc.twist_propagation(i, j).motion(mu[j]));
            for d in body.dofs() {
                phi[d] = phi[d] / D[d] - mu_i.dot(psi[d]);
                mu_i += p[d] * phi[d];
            }
            mu[i] = mu_i;
        }
        Ok(())
    }

    /// U D Uᵀ, both triangles: the matrix again, for checking. O(n·depth²); allocates.
    ///
    /// Errors: [`InputError::TooLargeForDense`]; [`InputError::OtherModel`] if `denoc` is of another model.
    pub fn reconstruct(&self, denoc: &Denoc<'_, T>) -> Result<Matrix<T>, InputError> {
        let model = denoc.model;
        model.check_dense()?;
        model.check_shape("denoc", self.shape)?;
        let mut H = Matrix::zeros(model.nv(), model.nv());
        for (i, body) in model.bodies.iter().enumerate() {
            for d in body.dofs() {
                // Column d of U: one at d, p_eᵀ A_ijᵀ ψ_d at the DoFs e above it.
                let mut column = vec![(d, T::ONE)];
                let mut j = Some(i);
                while let Some(carrier) = j {
                    let A = denoc.twist_propagation(i, carrier);
                    for e in model.bodies[carrier].dofs().rev().filter(|&e| carrier != i || e < d) {
                        column.push((e, A.motion(denoc.p[e]).dot(self.psi[d])));
                    }
                    j = model.bodies[carrier].parent();
                }
                for &(a, U_a) in &column {
                    for &(b, U_b) in &column {
                        H[(a, b)] += U_a * self.D[d] * U_b;
                    }
                }
            }
        }
        Ok(H)
    }
}

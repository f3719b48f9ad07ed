//! The inertia matrix of a free-floating robot: the base's six degrees of freedom removed, momentum kept at zero.
//!
//! ```text
//! H = [H_bb H_bj; H_jb H_jj]       H* = H_jj − H_jb H_bb⁻¹ H_bj
//! ```
//! Featherstone (2004), §4.6. H_bb = C Cᵀ is eliminated column by column, so H* = H_jj − YᵀY with C Y = H_bj.

use super::crba::{CrbaWorkspace, mass_matrix_into};
use super::rnea::check_out;
use crate::error::{Error, InputError, NotPositiveDefinite};
use crate::matrix::Matrix;
use crate::model::Model;
use crate::scalar::Real;

/// Degrees of freedom of a floating base.
pub(super) const BASE: usize = 6;

/// H*(q): the inertia that the joints of a free-floating robot feel.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq`, the base's pose included (H* does not depend on it) | rad, m, unit quaternion |
/// | H* (returned) | (`nv` − 6) × (`nv` − 6) | kg m², kg m, kg |
///
/// Method: Schur complement of the base in H. O(nv²); allocates. Numerics: cancels where the base is light against what it
/// carries; relative error up to ε·max H_jj/H*_jj.
///
/// Errors: [`InputError`] if q does not fit, the base is fixed, or nv is too large; [`NotPositiveDefinite`] if the whole
/// robot has no inertia in some direction.
///
/// ```
/// use eigenbody::{Family, floating_mass_matrix};
/// let robot = Family::hydra(3, 1.0, 0.0, 1.0)?.floating().model::<f64>()?;
/// let q = robot.neutral();
/// assert_eq!(floating_mass_matrix(&robot, &q)?.rows(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn floating_mass_matrix<T: Real>(model: &Model<T>, q: &[T]) -> Result<Matrix<T>, Error> {
    model.check_dense()?;
    let nv = model.nv();
    let mut H = Matrix::zeros(nv, nv);
    let joints = nv.saturating_sub(BASE);
    let mut floating = Matrix::zeros(joints, joints);
    floating_mass_matrix_into(model, q, &mut CrbaWorkspace::new(model), &mut H, &mut floating)?;
    Ok(floating)
}

/// [`floating_mass_matrix`] into the caller's memory, with room for H; allocates nothing.
///
/// Errors: as [`floating_mass_matrix`], and if a matrix has the wrong size. `H` is left partly eliminated.
pub fn floating_mass_matrix_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut CrbaWorkspace<T>,
    H: &mut Matrix<T>,
    floating: &mut Matrix<T>,
) -> Result<(), Error> {
    if !model.has_floating_base() {
        return Err(InputError::NoFloatingBase.into());
    }
    let joints = model.nv() - BASE;
    check_out("rows of H*", floating.rows(), joints)?;
    check_out("columns of H*", floating.cols(), joints)?;
    mass_matrix_into(model, q, workspace, H)?;
    eliminate_base(H)?;
    for d in 0..joints {
        floating.row_mut(d).copy_from_slice(&H.row(BASE + d)[BASE..]);
    }
    Ok(())
}

/// H* of any matrix whose first six DoFs are the base; the matrix is left partly eliminated.
pub(super) fn remove_base<T: Real>(H: &mut Matrix<T>) -> Result<Matrix<T>, NotPositiveDefinite> {
    eliminate_base(H)?;
    let joints = H.rows() - BASE;
    Ok(Matrix::from_fn(joints, joints, |d, e| H[(BASE + d, BASE + e)]))
}

/// Six steps of elimination on a symmetric matrix, both triangles kept.
fn eliminate_base<T: Real>(H: &mut Matrix<T>) -> Result<(), NotPositiveDefinite> {
    let n = H.rows();
    for k in 0..BASE {
        let pivot = H[(k, k)];
        if !(pivot > T::ZERO && pivot.is_finite()) {
            return Err(NotPositiveDefinite { dof: k, pivot: pivot.to_f64() });
        }
        for i in k + 1..n {
            let ratio = H[(i, k)] / pivot;
            for j in i..n {
                let reduced = H[(i, j)] - ratio * H[(k, j)];
                H[(i, j)] = reduced;
                H[(j, i)] = reduced;
            }
        }
    }
    Ok(())
}

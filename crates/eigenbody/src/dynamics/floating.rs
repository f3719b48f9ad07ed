//! The inertia matrix of a free-floating robot: the base's six degrees of freedom removed, momentum kept at zero.
//!
//! ```text
//! H = [H_bb H_bj; H_jb H_jj]       H* = H_jj − H_jb H_bb⁻¹ H_bj
//! ```
//! Featherstone (2004), §4.6. H* does not depend on which body is called the base, but the difference cancels where the base is
//! light against what it carries: it is taken from the central body. H_bb is eliminated column by column.

use super::kinematics::Kinematics;
use super::plain::crba;
use super::reroot::Rerooted;
use crate::error::{Error, InputError, NotPositiveDefinite, check_length};
use crate::matrix::Matrix;
use crate::model::{Coupling, Model, Shape};
use crate::scalar::Real;
use crate::spatial::RigidInertia;

/// Degrees of freedom of a floating base.
pub(crate) const BASE: usize = 6;

/// Room for [`floating_mass_matrix_into`].
///
/// It serves models with other inertias too, but keeps the central body of its own: rounding is then that of the whole robot's
/// inertia about that body.
#[derive(Debug, Clone)]
pub struct FloatingWorkspace<T> {
    shape: Shape,
    /// The tree at q as the model has it, and as seen from the central body.
    kinematics: Kinematics<T>,
    tree: Rerooted<T>,
    /// N: composite inertias of the second tree.
    Ic: Vec<RigidInertia<T>>,
    /// nv × nv: H on the central body, then partly eliminated.
    H: Matrix<T>,
}

impl<T: Real> FloatingWorkspace<T> {
    /// Room for a model with a floating base.
    ///
    /// Errors: [`InputError::NoFloatingBase`]; [`InputError::TooLargeForDense`].
    pub fn new(model: &Model<T>) -> Result<Self, InputError> {
        if !model.has_floating_base() {
            return Err(InputError::NoFloatingBase);
        }
        model.check_dense()?;
        Ok(Self {
            shape: model.shape,
            kinematics: Kinematics::new(model),
            tree: Rerooted::new(model),
            Ic: vec![RigidInertia::ZERO; model.bodies.len()],
            H: Matrix::zeros(model.nv(), model.nv()),
        })
    }

    /// H with the central body as the base: the joints' part is the model's own.
    fn mass_matrix(&mut self, model: &Model<T>, q: &[T]) -> Result<(), InputError> {
        model.check_shape("workspace", self.shape)?;
        model.check_q(q)?;
        let Self { kinematics, tree, Ic, H, .. } = self;
        kinematics.update(model, q);
        tree.weigh(model);
        tree.update(model, kinematics);
        crba(&tree.bodies, &tree.kinematics, &model.armature, Ic, H);
        Ok(())
    }
}

/// H*(q): the inertia that the joints of a free-floating robot feel.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq`, the base's pose included (H* does not depend on it) | rad, m, unit quaternion |
/// | H* (returned) | (`nv` − 6) × (`nv` − 6) | kg m², kg m, kg |
///
/// Method: composite rigid bodies on the tree seen from its central body, then the Schur complement of the base. O(nv²);
/// allocates. Numerics: every entry to a few ε of √(H_dd H_ee) on that base.
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
    let mut workspace = FloatingWorkspace::new(model)?;
    let joints = model.nv() - BASE;
    let mut floating = Matrix::zeros(joints, joints);
    floating_mass_matrix_into(model, q, &mut workspace, &mut floating)?;
    Ok(floating)
}

/// [`floating_mass_matrix`] into the caller's memory; allocates nothing.
///
/// Errors: as [`floating_mass_matrix`], if `floating` has the wrong size, and [`InputError::OtherModel`] for the workspace.
pub fn floating_mass_matrix_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut FloatingWorkspace<T>,
    floating: &mut Matrix<T>,
) -> Result<(), Error> {
    if !model.has_floating_base() {
        return Err(InputError::NoFloatingBase.into());
    }
    let joints = model.nv() - BASE;
    check_length("rows of H*", floating.rows(), joints)?;
    check_length("columns of H*", floating.cols(), joints)?;
    workspace.mass_matrix(model, q)?;
    remove_base(&mut workspace.H, floating)?;
    Ok(())
}

/// H* of the mimic-reduced matrix Gᵀ H G.
pub(super) fn coupled_floating_mass_matrix<T: Real>(
    model: &Model<T>,
    coupling: &Coupling<T>,
    q: &[T],
) -> Result<Matrix<T>, Error> {
    let mut workspace = FloatingWorkspace::new(model)?;
    workspace.mass_matrix(model, q)?;
    let mut H = coupling.reduce(&workspace.H);
    let joints = H.rows() - BASE;
    let mut floating = Matrix::zeros(joints, joints);
    remove_base(&mut H, &mut floating)?;
    Ok(floating)
}

/// Six steps of elimination on a symmetric matrix whose first six DoFs are the base, and what is left of the others.
fn remove_base<T: Real>(H: &mut Matrix<T>, floating: &mut Matrix<T>) -> Result<(), NotPositiveDefinite> {
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
    for d in 0..n - BASE {
        floating.row_mut(d).copy_from_slice(&H.row(BASE + d)[BASE..]);
    }
    Ok(())
}

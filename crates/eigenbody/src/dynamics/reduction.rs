//! The matrix that a study works on: mimic joints folded in, the floating base removed, or neither.
//!
//! ```text
//! H  →  Gᵀ H G  →  H_jj − H_jb H_bb⁻¹ H_bj
//! ```

use super::crba::mass_matrix;
use super::floating::{coupled_floating_mass_matrix, floating_mass_matrix};
use crate::error::Error;
use crate::matrix::Matrix;
use crate::model::Model;
use crate::scalar::Real;

/// Which degrees of freedom a mass matrix has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Reduction {
    /// Mimic joints follow: v = G ṗ.
    pub mimic: bool,
    /// The floating base is removed: H*.
    pub base: bool,
}

impl Reduction {
    /// The mass matrix in these degrees of freedom.
    ///
    /// | name | shape | unit |
    /// |------|-------|------|
    /// | `q` | `nq`, all coordinates | rad, m, unit quaternion |
    /// | returned | one row a DoF of [`dofs`](Self::dofs) | kg m², kg m, kg |
    ///
    /// Errors: as [`mass_matrix`] and [`floating_mass_matrix`](super::floating_mass_matrix).
    ///
    /// ```
    /// use eigenbody::{Family, Reduction};
    /// let robot = Family::hydra(4, 1.0, 0.0, 1.0)?.floating().model::<f64>()?;
    /// let reduction = Reduction { base: true, ..Reduction::default() };
    /// assert_eq!(reduction.mass_matrix(&robot, &robot.neutral())?.rows(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn mass_matrix<T: Real>(&self, model: &Model<T>, q: &[T]) -> Result<Matrix<T>, Error> {
        let coupling = model.coupling().filter(|_| self.mimic);
        match (self.base, coupling) {
            (false, None) => Ok(mass_matrix(model, q)?),
            (false, Some(coupling)) => Ok(coupling.reduce(&mass_matrix(model, q)?)),
            (true, None) => floating_mass_matrix(model, q),
            (true, Some(coupling)) => coupled_floating_mass_matrix(model, coupling, q),
        }
    }

    /// The model's DoF that each row stands for.
    pub fn dofs<T: Real>(&self, model: &Model<T>) -> Vec<usize> {
        let all = match (self.mimic, model.coupling()) {
            (true, Some(coupling)) => coupling.independent_dofs().to_vec(),
            _ => (0..model.nv()).collect(),
        };
        let base = if self.base { model.base_dofs() } else { 0 };
        all[base..].to_vec()
    }
}

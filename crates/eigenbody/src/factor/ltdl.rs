//! H = Lᵀ D L along the tree, L with a unit diagonal.
//!
//! ```text
//! for k, tips first:
//!     D_k = H_kk
//!     for i = parent(k), parent(parent(k)), ..:
//!         a = H_ki / D_k
//!         for j = i, parent(i), ..:    H_ij −= a H_kj
//!         L_ki = a
//! ```
//! Featherstone (2008), table 6.3. Cost O(n·depth²). The D_k are the hinge inertias of the articulated-body algorithm.

use super::ltl::copy_pattern;
use super::{Info, check_square, inverse_by_columns};
use crate::error::{Error, check_length};
use crate::matrix::Matrix;
use crate::model::DofTree;
use crate::scalar::Real;

/// The factors of H = Lᵀ D L, with room for them: D on the diagonal, L below it along the tree.
///
/// ```
/// use eigenbody::{Family, factor::Ltdl, mass_matrix};
/// let robot = Family::onion(4, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let mut factor = Ltdl::new(robot.dofs());
/// let info = factor.factor(&mass_matrix(&robot, &[0.0; 4])?)?;
/// assert_eq!(info.pivot_ratio(), 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Ltdl<'tree, T> {
    tree: &'tree DofTree,
    LD: Matrix<T>,
}

impl<'tree, T: Real> Ltdl<'tree, T> {
    /// Room for the factors.
    pub fn new(tree: &'tree DofTree) -> Self {
        Self { tree, LD: Matrix::zeros(tree.len(), tree.len()) }
    }

    /// D and L in one matrix.
    pub fn ld(&self) -> &Matrix<T> {
        &self.LD
    }

    /// H = Lᵀ D L. Allocates nothing. Entries of H between different branches are taken to be zero.
    ///
    /// Errors: [`InputError::Length`](crate::InputError::Length); [`NotPositiveDefinite`](crate::NotPositiveDefinite) at the first
    /// pivot that is not positive, after which the factors must not be used.
    pub fn factor(&mut self, H: &Matrix<T>) -> Result<Info, Error> {
        let Self { tree, LD } = self;
        check_square("H", H, tree.len())?;
        copy_pattern(tree, H, LD);
        let mut info = Info::EMPTY;
        for k in tree.order().rev() {
            let D_k = LD[(k, k)];
            info.accept(k, D_k)?;
            for i in tree.ancestors(k) {
                let a = LD[(k, i)] / D_k;
                let (row_k, row_i) = LD.row_pair(k, i);
                row_i[i] -= a * row_k[i];
                for j in tree.ancestors(i) {
                    row_i[j] -= a * row_k[j];
                }
                LD[(k, i)] = a;
            }
        }
        Ok(info)
    }

    /// x ← H⁻¹ x. Cost O(n·depth); allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn solve(&self, x: &mut [T]) -> Result<(), Error> {
        check_length("x", x.len(), self.tree.len())?;
        self.solve_in_place(x);
        Ok(())
    }

    fn solve_in_place(&self, x: &mut [T]) {
        let Self { tree, LD } = self;
        for k in tree.order().rev() {
            // Lᵀ y = x
            for i in tree.ancestors(k) {
                x[i] -= LD[(k, i)] * x[k];
            }
        }
        for k in tree.order() {
            // D L x = y
            x[k] = x[k] / LD[(k, k)];
            for i in tree.ancestors(k) {
                x[k] -= LD[(k, i)] * x[i];
            }
        }
    }

    /// H⁻¹, both triangles. Cost O(n²·depth); allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn inverse_into(&self, inverse: &mut Matrix<T>) -> Result<(), Error> {
        check_square("inverse", inverse, self.tree.len())?;
        inverse_by_columns(inverse, |x| self.solve_in_place(x));
        Ok(())
    }

    /// Lᵀ D L, both triangles: H again, for checking. Allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn reconstruct_into(&self, H: &mut Matrix<T>) -> Result<(), Error> {
        check_square("H", H, self.tree.len())?;
        H.fill(T::ZERO);
        let Self { tree, LD } = self;
        for k in tree.order() {
            let D_k = LD[(k, k)];
            let L = |i: usize| if i == k { T::ONE } else { LD[(k, i)] };
            for i in std::iter::once(k).chain(tree.ancestors(k)) {
                for j in std::iter::once(k).chain(tree.ancestors(k)) {
                    H[(i, j)] += L(i) * D_k * L(j);
                }
            }
        }
        Ok(())
    }
}

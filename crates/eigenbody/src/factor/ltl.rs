//! H = Lᵀ L along the tree.
//!
//! ```text
//! for k, tips first:
//!     L_kk = √H_kk
//!     for i = parent(k), parent(parent(k)), ..:    L_ki = H_ki / L_kk
//!     for i = parent(k), ..:  for j = i, parent(i), ..:   H_ij −= L_ki L_kj
//! ```
//! Featherstone (2008), table 6.3. Cost O(n·depth²).

use super::{Info, check_square, inverse_by_columns};
use crate::error::{Error, check_length};
use crate::matrix::Matrix;
use crate::model::DofTree;
use crate::scalar::Real;

/// The factor L of H = Lᵀ L, with room for it; row k has entries at k and its ancestors only.
///
/// ```
/// use eigenbody::{Family, factor::Ltl, mass_matrix};
/// let robot = Family::hydra(5, 1.5, 0.3, 1.0)?.model::<f64>()?;
/// let H = mass_matrix(&robot, &[0.1; 5])?;
/// let mut factor = Ltl::new(robot.dofs());
/// factor.factor(&H)?;
/// let mut x = H.times(&[1.0; 5]);
/// factor.solve(&mut x)?;
/// assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-11));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Ltl<'tree, T> {
    tree: &'tree DofTree,
    L: Matrix<T>,
}

impl<'tree, T: Real> Ltl<'tree, T> {
    /// Room for the factor.
    pub fn new(tree: &'tree DofTree) -> Self {
        Self { tree, L: Matrix::zeros(tree.len(), tree.len()) }
    }

    /// The factor as it stands.
    pub fn l(&self) -> &Matrix<T> {
        &self.L
    }

    /// H = Lᵀ L. Allocates nothing. Entries of H between different branches are taken to be zero.
    ///
    /// Errors: [`InputError::Length`](crate::InputError::Length); [`NotPositiveDefinite`](crate::NotPositiveDefinite) at the first
    /// pivot that is not positive, after which the factor must not be used.
    pub fn factor(&mut self, H: &Matrix<T>) -> Result<Info, Error> {
        let Self { tree, L } = self;
        check_square("H", H, tree.len())?;
        copy_pattern(tree, H, L);
        let mut info = Info::EMPTY;
        for k in tree.order().rev() {
            info.accept(k, L[(k, k)])?;
            let root = L[(k, k)].sqrt();
            L[(k, k)] = root;
            for i in tree.ancestors(k) {
                L[(k, i)] = L[(k, i)] / root;
            }
            for i in tree.ancestors(k) {
                let (row_k, row_i) = L.row_pair(k, i);
                row_i[i] -= row_k[i] * row_k[i];
                for j in tree.ancestors(i) {
                    row_i[j] -= row_k[i] * row_k[j];
                }
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
        let Self { tree, L } = self;
        for k in tree.order().rev() {
            // Lᵀ y = x
            x[k] = x[k] / L[(k, k)];
            for i in tree.ancestors(k) {
                x[i] -= L[(k, i)] * x[k];
            }
        }
        for k in tree.order() {
            // L x = y
            for i in tree.ancestors(k) {
                x[k] -= L[(k, i)] * x[i];
            }
            x[k] = x[k] / L[(k, k)];
        }
    }

    /// H⁻¹, both triangles. Cost O(n²·depth); allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn inverse_into(&self, inverse: &mut Matrix<T>) -> Result<(), Error> {
        check_square("inverse", inverse, self.tree.len())?;
        inverse_by_columns(inverse, |x| self.solve_in_place(x));
        Ok(())
    }

    /// Lᵀ L, both triangles: H again, for checking. Allocates nothing. Errors: [`InputError::Length`](crate::InputError::Length).
    pub fn reconstruct_into(&self, H: &mut Matrix<T>) -> Result<(), Error> {
        check_square("H", H, self.tree.len())?;
        H.fill(T::ZERO);
        let Self { tree, L } = self;
        for k in tree.order() {
            for i in std::iter::once(k).chain(tree.ancestors(k)) {
                for j in std::iter::once(k).chain(tree.ancestors(k)) {
                    H[(i, j)] += L[(k, i)] * L[(k, j)];
                }
            }
        }
        Ok(())
    }
}

/// The entries of H at each DoF and its ancestors; zero elsewhere.
pub(super) fn copy_pattern<T: Real>(tree: &DofTree, H: &Matrix<T>, L: &mut Matrix<T>) {
    L.fill(T::ZERO);
    for k in tree.order() {
        L[(k, k)] = H[(k, k)];
        for i in tree.ancestors(k) {
            L[(k, i)] = H[(k, i)];
        }
    }
}

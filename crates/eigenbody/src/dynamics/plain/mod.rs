//! The book's tables as they stand: what the fast kernels are measured against and tested by, and the place to read first.
//!
//! Every joint by its columns, every transform a full matrix, one loop after another. The functions of the same names in
//! [`crate`] give the same numbers several times faster.

mod aba;
mod crba;
mod rnea;

pub use aba::forward_dynamics;
pub(super) use crba::crba;
pub use crba::mass_matrix;
pub use rnea::inverse_dynamics;

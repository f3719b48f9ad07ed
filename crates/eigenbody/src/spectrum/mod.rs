//! Eigenvalues and eigenvectors of H in a metric: H x = λ B x.

mod eigen;
mod metric;
mod ql;
pub mod sturm;
mod tridiagonal;

pub use eigen::{SymmetricEigen, eigen, eigenvalues};
pub use metric::Metric;

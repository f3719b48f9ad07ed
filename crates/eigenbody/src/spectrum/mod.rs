//! Eigenvalues and eigenvectors of H in a metric: H x = λ B x.

mod abreast;
mod bisect;
mod eigen;
mod ends;
mod ends_at;
mod extremes;
mod metric;
mod null_space;
mod packed;
mod ql;
mod rayleigh;
mod slice;
pub mod sturm;
mod tracker;
mod tridiagonal;

pub use eigen::{SymmetricEigen, eigen, eigenvalues};
pub use ends::{EndsWorkspace, extreme_eigenvalues, extreme_eigenvalues_into};
pub use ends_at::{EndsAtWorkspace, extreme_eigenvalues_at};
pub use extremes::{Extreme, Extremes, Precision, Unresolved, extremes};
pub(crate) use extremes::{check_range, extreme_values, extremes_from};
pub use metric::Metric;
pub use null_space::{NullSpace, null_space};
pub(crate) use packed::Packed;
pub use slice::slice;
pub use tracker::{Reading, Tracker};

//! Sturm counts without the matrix: how many eigenvalues of (H, B) lie below σ, in O(N).
//!
//! ```text
//! for i = N..1, for d of body i, last to first:
//!     U = IA_i S_d      D_d = S_dᵀ U + armature_d − σ B_d      IA_i ← IA_i − U D_d⁻¹ Uᵀ
//!     IA_parent(i) += X_upᵀ IA_i X_up
//! count(σ) = #{ D_d < 0 }                                     log|det(H − σB)| = Σ log|D_d|
//! ```
//! The articulated-body recursion is a congruence, H = L D Lᵀ (Rodriguez & Jain's innovations factorisation); the extra
//! diagonal inertia −σB_d makes it one of H − σB, and Sylvester's law of inertia turns signs into a count. Wittrick & Williams
//! (1971) counted natural frequencies so; what is counted here is the mass matrix itself, in any diagonal metric.
//!
//! A DoF with B_d = 0 takes no part in the pencil: the six columns of a floating base with B = 0 give the counts of the
//! free-floating H*, because Schur's complement of H_bb in H − σB is H* − σB_j.

mod carry;
mod count;
mod diagonal;
mod estimate;
mod hinge;
mod pencil;
mod solve;
mod sweep;

pub use count::{Count, counts};
pub use diagonal::Diagonal;
pub(super) use estimate::{Errors, absolute_errors};
pub use pencil::Pencil;
pub(super) use solve::Factors;

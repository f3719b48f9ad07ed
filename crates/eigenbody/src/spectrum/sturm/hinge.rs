//! One step of the elimination: one degree of freedom.
//!
//! ```text
//! U = IA S      D = SᵀU − β,  β = σB − armature      IA ← IA − U D⁻¹ Uᵀ      and then  IA S = −(β/D) U
//! ```
//! Where S is a unit vector, IA S is a row and a column of IA: they are written from the last formula, which does not cancel.
//!
//! A pivot below 1e-14 of what it is the difference of is rounding. It is moved to that bound, by its sign, and IA S = U (D −
//! SᵀU)/D then holds for the moved pivot: a shift of one hinge inertia within its own rounding error, done consistently.

use crate::joint::Column;
use crate::scalar::Scalar;
use crate::spatial::{ArticulatedInertia, Force, Motion};

/// What eliminating a hinge yields.
pub(super) struct Hinge<T> {
    /// The inertia that is left.
    pub IA: ArticulatedInertia<T>,
    /// IA S before the step.
    pub U: Force<T>,
    /// The pivot, and its inverse.
    pub D: T,
    pub D_inverse: T,
}

/// Eliminates the hinge with column S.
#[inline(always)]
pub(super) fn eliminate<T: Scalar>(
    IA: ArticulatedInertia<T>,
    column: Column,
    S: Motion<T::Constant>,
    beta: T,
) -> Hinge<T> {
    match column {
        Column::AngX => unit::<T, 0>(IA, beta),
        Column::AngY => unit::<T, 1>(IA, beta),
        Column::AngZ => unit::<T, 2>(IA, beta),
        Column::LinX => unit::<T, 3>(IA, beta),
        Column::LinY => unit::<T, 4>(IA, beta),
        Column::LinZ => unit::<T, 5>(IA, beta),
        Column::General => {
            let S = Motion::new(S.ang.map(T::constant), S.lin.map(T::constant));
            let U = IA.times(S);
            let (D, D_inverse, _) = pivot(S.dot(U), beta);
            Hinge { IA: IA.minus_outer(U, D_inverse), U, D, D_inverse }
        }
    }
}

#[inline(always)]
fn unit<T: Scalar, const K: usize>(IA: ArticulatedInertia<T>, beta: T) -> Hinge<T> {
    let U = IA.column::<K>();
    let SU = match K {
        0 => U.ang.x,
        1 => U.ang.y,
        2 => U.ang.z,
        3 => U.lin.x,
        4 => U.lin.y,
        _ => U.lin.z,
    };
    let (D, D_inverse, left) = pivot(SU, beta);
    Hinge { IA: IA.minus_outer(U, D_inverse).with_column::<K>(U * left), U, D, D_inverse }
}

/// The guarded pivot D, its inverse, and the factor of U in IA S.
#[inline(always)]
fn pivot<T: Scalar>(SU: T, beta: T) -> (T, T, T) {
    let D = SU - beta;
    // The smallest floor keeps 1/D and U²/D finite where all of it is zero.
    let floor = (SU.abs() + beta.abs()).mul_add(T::from_f64(1e-14), T::from_f64(1e-290));
    let guarded = D.select_lt(T::ZERO, -floor, floor);
    let small = D.abs();
    let D_kept = small.select_lt(floor, guarded, D);
    let D_inverse = T::ONE / D_kept;
    let left = small.select_lt(floor, guarded - SU, -beta) * D_inverse;
    (D_kept, D_inverse, left)
}

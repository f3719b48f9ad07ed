//! Systems with H − σB, by the factors of one sweep.
//!
//! ```text
//! for i = N..1, d last to first:    u_d = b_d − S_dᵀ p_i      p_i += U_d D_d⁻¹ u_d      then p_parent += X_upᵀ p_i
//! for i = 1..N, d first to last:    x_d = D_d⁻¹ (u_d − U_dᵀ a_i)      a_i += S_d x_d         a_i starts as X_up a_parent
//! ```
//! The articulated-body algorithm on a robot at rest, with −σB in its hinges. Over lanes: as many shifts, each with its own system.

use super::carry::Carry;
use super::hinge::Hinge;
use super::pencil::Pencil;
use super::sweep::{Pivots, sweep};
use crate::joint::Column;
use crate::scalar::Scalar;
use crate::spatial::{ArticulatedInertia, Force, Motion};

/// L and D of H − σB.
#[derive(Debug, Clone)]
pub(crate) struct Factors<T> {
    U: Vec<Force<T>>,
    D_inverse: Vec<T>,
    /// Number of negative pivots: eigenvalues below the shift.
    pub below: T,
    /// N: a.
    a: Vec<Motion<T>>,
    waiting: (Vec<ArticulatedInertia<T>>, Vec<Force<T>>),
}

impl<T: Scalar> Factors<T> {
    pub fn new(pencil: &Pencil<T::Constant>) -> Self {
        let (n, nv) = (pencil.nodes.len(), pencil.S.len());
        Self {
            U: vec![Force::ZERO; nv],
            D_inverse: vec![T::ZERO; nv],
            below: T::ZERO,
            a: vec![Motion::ZERO; n],
            waiting: (Vec::new(), Vec::new()),
        }
    }

    /// Factorises H − σB.
    pub fn factor(&mut self, pencil: &Pencil<T::Constant>, shift: T) {
        let Self { U, D_inverse, waiting, .. } = self;
        let mut keep = Keep { U, D_inverse, below: T::ZERO };
        sweep(pencil, shift, &mut waiting.0, &mut keep);
        self.below = keep.below;
    }

    /// x ← (H − σB)⁻¹ x.
    pub fn solve(&mut self, pencil: &Pencil<T::Constant>, x: &mut [T]) {
        let Pencil { nodes, S, .. } = pencil;
        let Self { U, D_inverse, a, waiting, .. } = self;
        let mut carry = Carry::new(Force::ZERO, &mut waiting.1);
        for node in nodes.iter().rev() {
            let mut p_i = carry.collect(node, Force::ZERO);
            for (d, &column) in node.dofs().zip(node.columns).rev() {
                x[d] -= column.along(S[d].map(T::constant), p_i);
                p_i += U[d] * (D_inverse[d] * x[d]);
            }
            carry.hand_down(node.route, || node.X_up.map(T::constant).transpose_force(p_i));
        }
        for (i, node) in nodes.iter().enumerate() {
            let X_up = node.X_up.map(T::constant);
            let mut a_i = node.parent().map_or(Motion::ZERO, |parent| X_up.motion(a[parent]));
            for (d, &column) in node.dofs().zip(node.columns) {
                x[d] = (x[d] - a_i.dot(U[d])) * D_inverse[d];
                a_i = column.moved(a_i, S[d].map(T::constant), x[d]);
            }
            a[i] = a_i;
        }
    }

    /// Sets the bodies in motion with the rates x.
    pub fn set_moving(&mut self, pencil: &Pencil<T::Constant>, x: &[T]) {
        let Pencil { nodes, S, .. } = pencil;
        for (i, node) in nodes.iter().enumerate() {
            let X_up = node.X_up.map(T::constant);
            let mut a_i = node.parent().map_or(Motion::ZERO, |parent| X_up.motion(self.a[parent]));
            for (d, &column) in node.dofs().zip(node.columns) {
                a_i = column.moved(a_i, S[d].map(T::constant), x[d]);
            }
            self.a[i] = a_i;
        }
    }

    /// xᵀHx of the last solution: twice its kinetic energy. A sum of squares, so that what the factors lost to cancellation is not in it.
    pub fn energy(&self, pencil: &Pencil<T::Constant>, x: &[T]) -> T {
        let bodies = pencil.nodes.iter().zip(&self.a);
        let bodies = bodies.fold(T::ZERO, |sum, (node, &a)| sum + a.dot(node.I.map(T::constant).times(a)));
        let rotors = pencil.armature.iter().zip(x);
        rotors.fold(bodies, |sum, (&armature, &x)| sum + T::constant(armature) * x * x)
    }

    /// Scales what [`motions`](Self::motions) tells.
    pub fn scale_motions(&mut self, s: T) {
        self.a.iter_mut().for_each(|a| *a = *a * s);
    }

    /// The motion of every body under the last solution.
    pub fn motions(&self) -> &[Motion<T>] {
        &self.a
    }
}

struct Keep<'a, T> {
    U: &'a mut [Force<T>],
    D_inverse: &'a mut [T],
    below: T,
}

impl<T: Scalar> Pivots<T> for Keep<'_, T> {
    #[inline(always)]
    fn pivot(&mut self, d: usize, _: Column, hinge: &Hinge<T>) {
        self.U[d] = hinge.U;
        self.D_inverse[d] = hinge.D_inverse;
        self.below += hinge.D.select_lt(T::ZERO, T::ONE, T::ZERO);
    }
    #[inline(always)]
    fn body(&mut self, _: usize, _: &ArticulatedInertia<T>) {}
}

//! Systems with H − σB, by the factors of one sweep.
//!
//! ```text
//! for i = N..1, d last to first:    u_d = b_d − S_dᵀ p_i      p_i += U_d D_d⁻¹ u_d      then p_parent += X_upᵀ p_i
//! for i = 1..N, d first to last:    x_d = D_d⁻¹ (u_d − U_dᵀ a_i)      a_i += S_d x_d         a_i starts as X_up a_parent
//! ```
//! The articulated-body algorithm on a robot at rest, with −σB in its hinges.

use super::hinge::Hinge;
use super::pencil::Pencil;
use super::sweep::{Pivots, sweep};
use crate::scalar::Real;
use crate::spatial::{ArticulatedInertia, Force, Motion};

/// L and D of H − σB.
#[derive(Debug, Clone)]
pub(crate) struct Factors<T> {
    U: Vec<Force<T>>,
    D_inverse: Vec<T>,
    /// Number of negative pivots: eigenvalues below the shift.
    pub below: usize,
    stack: Vec<ArticulatedInertia<T>>,
    /// N: p, then a.
    p: Vec<Force<T>>,
    a: Vec<Motion<T>>,
}

impl<T: Real> Factors<T> {
    pub fn new(pencil: &Pencil<T>) -> Self {
        let (n, nv) = (pencil.nodes.len(), pencil.S.len());
        Self {
            U: vec![Force::ZERO; nv],
            D_inverse: vec![T::ZERO; nv],
            below: 0,
            stack: Vec::new(),
            p: vec![Force::ZERO; n],
            a: vec![Motion::ZERO; n],
        }
    }

    /// Factorises H − σB.
    pub fn factor(&mut self, pencil: &Pencil<T>, shift: T) {
        let Self { U, D_inverse, stack, .. } = self;
        let mut keep = Keep { U, D_inverse, below: 0 };
        sweep(pencil, shift, stack, &mut keep);
        self.below = keep.below;
    }

    /// x ← (H − σB)⁻¹ x.
    pub fn solve(&mut self, pencil: &Pencil<T>, x: &mut [T]) {
        let Pencil { nodes, S, .. } = pencil;
        let Self { U, D_inverse, p, a, .. } = self;
        p.fill(Force::ZERO);
        for (i, node) in nodes.iter().enumerate().rev() {
            let mut p_i = p[i];
            for d in node.dofs().rev() {
                x[d] -= S[d].dot(p_i);
                p_i += U[d] * (D_inverse[d] * x[d]);
            }
            if let Some(parent) = node.parent() {
                let carried = node.X_up.transpose_force(p_i);
                p[parent] += carried;
            }
        }
        for (i, node) in nodes.iter().enumerate() {
            let mut a_i = node.parent().map_or(Motion::ZERO, |parent| node.X_up.motion(a[parent]));
            for d in node.dofs() {
                x[d] = (x[d] - a_i.dot(U[d])) * D_inverse[d];
                a_i += S[d] * x[d];
            }
            a[i] = a_i;
        }
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
    below: usize,
}

impl<T: Real> Pivots<T> for Keep<'_, T> {
    #[inline(always)]
    fn pivot(&mut self, d: usize, hinge: &Hinge<T>) {
        self.U[d] = hinge.U;
        self.D_inverse[d] = hinge.D_inverse;
        self.below += usize::from(hinge.D < T::ZERO);
    }
    #[inline(always)]
    fn body(&mut self, _: usize, _: &ArticulatedInertia<T>) {}
}

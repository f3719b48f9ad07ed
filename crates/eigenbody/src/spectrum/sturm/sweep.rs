//! The backward sweep: every hinge eliminated, tips first.

use super::carry::Carry;
use super::hinge::{Hinge, eliminate};
use super::pencil::Pencil;
use crate::joint::Column;
use crate::scalar::Scalar;
use crate::spatial::ArticulatedInertia;

/// Sees every pivot as it is made.
pub(super) trait Pivots<T> {
    /// DoF d, with this column of S, was eliminated.
    fn pivot(&mut self, d: usize, column: Column, hinge: &Hinge<T>);
    /// Body i is reached, with this articulated inertia before its own hinges are eliminated.
    fn body(&mut self, i: usize, IA: &ArticulatedInertia<T>);
}

/// Factorises H − σB. The stack is empty before and after.
#[inline(always)]
pub(super) fn sweep<T: Scalar, P: Pivots<T>>(
    pencil: &Pencil<'_, T::Constant>,
    shift: T,
    stack: &mut Vec<ArticulatedInertia<T::Stored>>,
    pivots: &mut P,
) {
    let Pencil { nodes, S, .. } = pencil;
    let mut hinges = pencil.hinges.iter().rev();
    let mut carry = Carry::new(ArticulatedInertia::ZERO, stack);
    for (i, node) in nodes.iter().enumerate().rev() {
        let mut IA = carry.collect(node, node.I.map(T::constant).into());
        pivots.body(i, &IA);
        for ((d, &column), &(B, armature)) in node.dofs().zip(node.columns).rev().zip(&mut hinges) {
            let beta = shift.mul_add(T::constant(B), -T::constant(armature));
            let hinge = eliminate(IA, column, S[d], beta);
            pivots.pivot(d, column, &hinge);
            IA = hinge.IA;
        }
        carry.hand_down(
            node.route,
            #[inline(always)]
            || {
                let X_up = node.X_up.map(T::constant);
                let turn = (X_up.E.x.y, X_up.E.x.x);
                let turned = if node.about_z { IA.turned_about_z(turn) } else { IA.turned(X_up.E) };
                turned.shifted(X_up.r)
            },
        );
    }
}

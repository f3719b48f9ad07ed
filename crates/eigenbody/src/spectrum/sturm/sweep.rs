//! The backward sweep: every hinge eliminated, tips first.

use super::hinge::{Hinge, eliminate};
use super::pencil::{Pencil, Route};
use crate::scalar::Scalar;
use crate::spatial::{ArticulatedInertia, RigidInertia};

/// Sees every pivot as it is made.
pub(super) trait Pivots<T> {
    /// DoF d was eliminated.
    fn pivot(&mut self, d: usize, hinge: &Hinge<T>);
    /// Body i is reached, with this articulated inertia before its own hinges are eliminated.
    fn body(&mut self, i: usize, IA: &ArticulatedInertia<T>);
}

/// Factorises H − σB. The stack is empty before and after.
#[inline(always)]
pub(super) fn sweep<T: Scalar, P: Pivots<T>>(
    pencil: &Pencil<T::Constant>,
    shift: T,
    stack: &mut Vec<ArticulatedInertia<T>>,
    pivots: &mut P,
) {
    let Pencil { nodes, S, .. } = pencil;
    let mut hinges = pencil.hinges.iter().rev();
    let mut carried = ArticulatedInertia::ZERO;
    for (i, node) in nodes.iter().enumerate().rev() {
        let I: RigidInertia<T> = node.I.map(T::constant);
        let mut IA = carried + I.into();
        if let (true, Some(others)) = (node.collects, stack.last()) {
            IA += *others;
            stack.pop();
        }
        pivots.body(i, &IA);
        for ((d, &column), &(B, armature)) in node.dofs().zip(node.columns).rev().zip(&mut hinges) {
            let beta = shift.mul_add(T::constant(B), -T::constant(armature));
            let hinge = eliminate(IA, column, S[d], beta);
            pivots.pivot(d, &hinge);
            IA = hinge.IA;
        }
        carried = ArticulatedInertia::ZERO;
        if node.route == Route::World {
            continue;
        }
        let up = node.X_up.map(T::constant).transpose_articulated(IA);
        match (node.route, stack.last_mut()) {
            (Route::Next, _) => carried = up,
            (Route::Add, Some(top)) => *top += up,
            _ => stack.push(up),
        }
    }
}

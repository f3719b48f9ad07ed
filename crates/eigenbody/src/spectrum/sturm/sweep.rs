//! The backward sweep: every hinge eliminated, tips first.

use super::hinge::{Hinge, eliminate};
use super::pencil::{Destination, Pencil};
use crate::scalar::Scalar;
use crate::spatial::{ArticulatedInertia, RigidInertia};

/// Sees every pivot as it is made.
pub(super) trait Pivots<T> {
    /// DoF d of body i was eliminated.
    fn pivot(&mut self, d: usize, hinge: &Hinge<T>);
    /// All of body i's DoFs were eliminated and this is left of its inertia, in its own frame.
    fn body(&mut self, i: usize, IA: &ArticulatedInertia<T>);
}

/// Factorises H − σB. The stack is empty before and after.
#[inline(always)]
pub(super) fn sweep<T: Scalar, P: Pivots<T>>(
    pencil: &Pencil<'_, T::Constant>,
    shift: T,
    stack: &mut Vec<ArticulatedInertia<T>>,
    pivots: &mut P,
) {
    let Pencil { model, kinematics, B, route } = pencil;
    let mut carried = ArticulatedInertia::ZERO;
    for (i, body) in model.bodies.iter().enumerate().rev() {
        let I: RigidInertia<T> = body.I.map(T::constant);
        let mut IA = carried + I.into();
        if route[i].collects {
            if let Some(others) = stack.pop() {
                IA += others;
            }
        }
        for (d, &column) in body.dofs().zip(body.joint.columns()).rev() {
            let beta = shift.mul_add(T::constant(B[d]), -T::constant(model.armature[d]));
            let hinge = eliminate(IA, column, kinematics.S[d], beta);
            pivots.pivot(d, &hinge);
            IA = hinge.IA;
        }
        pivots.body(i, &IA);
        if route[i].to == Destination::World {
            carried = ArticulatedInertia::ZERO;
            continue;
        }
        let X_up = kinematics.X_up[i].map(T::constant);
        let up = X_up.transpose_articulated(IA);
        match route[i].to {
            Destination::Next => carried = up,
            Destination::Push => {
                stack.push(up);
                carried = ArticulatedInertia::ZERO;
            }
            _ => {
                if let Some(top) = stack.last_mut() {
                    *top += up;
                }
                carried = ArticulatedInertia::ZERO;
            }
        }
    }
}

//! How far rounding may have moved an eigenvalue.
//!
//! ```text
//! |δλ| ≲ ε ( Σ_d ( |a_d|ᵀ|IA_d||a_d| + |a'_d|ᵀ|IA'_d||a'_d| ) + Σ_i |f_i|ᵀ (|X_up||a_p| + |S||x|) ) / xᵀBx      a'_d = a_d − S_d x_d
//! ```
//! IA_d and IA'_d: the inertia before and after hinge d is eliminated; a_d and a'_d: the motion, in the mode x, of the body outboard
//! and inboard of it; f_i: the momentum of all that body i carries.
//!
//! Where S_d is no unit vector, |IA'_d| is |IA'_d| + |U_d||U_d|ᵀ/|D_d|, of which IA'_d is what cancels.
//!
//! *Arithmetic.* Rounding in a step perturbs either inertia by E with |E| of order ε|IA|, which perturbs H by JᵀEJ and the
//! eigenvalue by aᵀEa/xᵀBx. A hinge whose pivot nearly vanishes leaves a large IA' behind: the second term sees it.
//! *Geometry.* X_up and S are rounded; that changes a_i = X_up a_p + S x by δa_i and twice the kinetic energy by 2 f_iᵀδa_i.
//!
//! So the error is governed by what cancels inside each 6 × 6 inertia and in each body's motion, weighed by the body's part in
//! the mode; the condition number of H does not enter.

use super::carry::Carry;
use super::hinge::Hinge;
use super::pencil::{Node, Pencil};
use super::sweep::{Pivots, sweep};
use crate::joint::Column;
use crate::scalar::{Array, Scalar};
use crate::spatial::{ArticulatedInertia, Force, Motion, Transform, Vec3};

/// Estimated absolute errors of an eigenvalue.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    /// Of the value that counts give: arithmetic and geometry.
    pub counted: f64,
    /// Of any value: the mechanism's own numbers, X_up, S and I, are rounded.
    pub given: f64,
}

/// Estimated errors of the eigenvalues `shifts`. Their modes `x`, xᵀBx = 1, move the bodies by `motions`; where a base was
/// removed, x holds the motion of the body that stands in for it.
pub(crate) fn absolute_errors<const N: usize>(
    pencil: &Pencil<'_, f64>,
    shifts: [f64; N],
    motions: &[Motion<Array<N>>],
    x: &[Array<N>],
) -> [Errors; N] {
    let (children, a, total) = (children(pencil), Motion::ZERO, Array::ZERO);
    let mut sum = Sum { pencil, motions, x, children, a, total };
    sweep(pencil, Array(shifts), &mut Vec::new(), &mut sum);
    let geometry = geometry(pencil, x, motions);
    let inertia = |node: &Node<f64>, a| size(&node.I.map(Array::from_f64).into(), a);
    let inertia =
        pencil.nodes.iter().zip(motions).fold(Array::ZERO, |sum, (node, &a)| sum + inertia(node, a));
    let (counted, given) = (sum.total + geometry, inertia + geometry);
    let errors = |k| Errors { counted: f64::EPSILON * counted.0[k], given: f64::EPSILON * given.0[k] };
    std::array::from_fn(errors)
}

/// How many bodies each body carries.
fn children(pencil: &Pencil<'_, f64>) -> Vec<u32> {
    let mut children = vec![0; pencil.nodes.len()];
    pencil.nodes.iter().filter_map(Node::parent).for_each(|p| children[p] += 1);
    children
}

/// |a|ᵀ |IA| |a|.
#[inline(always)]
fn size<T: Scalar>(IA: &ArticulatedInertia<T>, a: Motion<T>) -> T {
    let a = Motion::new(absolute(a.ang), absolute(a.lin));
    let IA = ArticulatedInertia { I: IA.I.map(T::abs), H: IA.H.map(T::abs), M: IA.M.map(T::abs) };
    a.dot(IA.times(a))
}

/// Σ |f_i|ᵀ (|X_up||a_p| + |S||x|).
fn geometry<T: Scalar<Constant = f64>>(
    Pencil { nodes, S, .. }: &Pencil<'_, f64>,
    x: &[T],
    motions: &[Motion<T>],
) -> T {
    let (mut total, mut waiting) = (T::ZERO, Vec::new());
    let mut carry = Carry::new(Force::ZERO, &mut waiting);
    for (i, node) in nodes.iter().enumerate().rev() {
        let f = carry.collect(node, node.I.map(T::constant).times(motions[i]));
        let X_up = node.X_up.map(T::constant);
        carry.hand_down(node.route, || X_up.transpose_force(f));
        let Some(p) = node.parent() else { continue };
        let mut size = reach(&X_up, motions[p]);
        for (d, &column) in node.dofs().zip(node.columns) {
            let S = Motion::new(absolute(S[d].ang), absolute(S[d].lin));
            size = column.moved(size, S.map(T::constant), x[d].abs());
        }
        total += size.dot(Force::new(absolute(f.ang), absolute(f.lin)));
    }
    total
}

/// |X||m|: what a motion's coordinates are sums of.
fn reach<T: Scalar>(X: &Transform<T>, m: Motion<T>) -> Motion<T> {
    let (E, r, ang, lin) = (X.E.map(T::abs), absolute(X.r), absolute(m.ang), absolute(m.lin));
    let arm = Vec3::new(r.y * ang.z + r.z * ang.y, r.z * ang.x + r.x * ang.z, r.x * ang.y + r.y * ang.x);
    Motion::new(E * ang, E * (lin + arm))
}

struct Sum<'a, T> {
    pencil: &'a Pencil<'a, f64>,
    motions: &'a [Motion<T>],
    x: &'a [T],
    children: Vec<u32>,
    /// Motion between the hinges of a body: outboard of the next one to be eliminated.
    a: Motion<T>,
    total: T,
}

fn absolute<T: Scalar>(v: Vec3<T>) -> Vec3<T> {
    v.map(T::abs)
}

impl<T: Scalar<Constant = f64>> Pivots<T> for Sum<'_, T> {
    #[inline(always)]
    fn pivot(&mut self, d: usize, column: Column, hinge: &Hinge<T>) {
        self.a = column.moved(self.a, self.pencil.S[d].map(T::constant), -self.x[d]);
        self.total += size(&hinge.IA, self.a);
        if column == Column::General {
            let (a, U) = (self.a, hinge.U);
            let along = Motion::new(absolute(a.ang), absolute(a.lin))
                .dot(Force::new(absolute(U.ang), absolute(U.lin)));
            self.total += along * along * hinge.D_inverse.abs();
        }
    }

    #[inline(always)]
    fn body(&mut self, i: usize, IA: &ArticulatedInertia<T>) {
        self.a = self.motions[i];
        // A sum of as many terms.
        self.total += T::from_f64(f64::from(self.children[i].max(1))) * size(IA, self.a);
    }
}

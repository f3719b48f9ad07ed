//! How far rounding may have moved an eigenvalue.
//!
//! ```text
//! |δλ| ≲ ε ( Σ_d ( |a_d|ᵀ|IA_d||a_d| + |a'_d|ᵀ|IA'_d||a'_d| ) + Σ_i |f_i|ᵀ (|X_up||a_p| + |S||x|) ) / xᵀBx      a'_d = a_d − S_d x_d
//! ```
//! IA_d and IA'_d: the inertia before and after hinge d is eliminated; a_d and a'_d: the motion, in the mode x, of the body outboard
//! and inboard of it; f_i: the momentum of all that body i carries.
//!
//! *Arithmetic.* Rounding in a step perturbs either inertia by E with |E| of order ε|IA|, which perturbs H by JᵀEJ and the
//! eigenvalue by aᵀEa/xᵀBx. A hinge whose pivot nearly vanishes leaves a large IA' behind: the second term sees it.
//! *Geometry.* X_up and S are rounded; that changes a_i = X_up a_p + S x by δa_i and twice the kinetic energy by 2 f_iᵀδa_i.
//!
//! So the error is governed by what cancels inside each 6 × 6 inertia and in each body's motion, weighed by the body's part in
//! the mode; the condition number of H does not enter.

use super::hinge::Hinge;
use super::pencil::{Node, Pencil};
use super::sweep::{Pivots, sweep};
use crate::spatial::{ArticulatedInertia, Force, Motion, Transform, Vec3};

/// Estimated absolute errors of an eigenvalue.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    /// Of the value that counts give: arithmetic and geometry.
    pub counted: f64,
    /// Of any value: the mechanism's own numbers, X_up, S and I, are rounded.
    pub given: f64,
}

/// Estimated errors of the eigenvalue `shift`. Its mode `x`, xᵀBx = 1, moves the bodies by `motions`; where a base was
/// removed, x holds the motion of the body that stands in for it.
pub(crate) fn absolute_errors(
    pencil: &Pencil<f64>,
    shift: f64,
    motions: &[Motion<f64>],
    x: &[f64],
) -> Errors {
    let mut sum = Sum { pencil, motions, x, children: children(pencil), a: Motion::ZERO, total: 0.0 };
    sweep(pencil, shift, &mut Vec::new(), &mut sum);
    let geometry = geometry(pencil, x, motions);
    let inertia: f64 = pencil.nodes.iter().zip(motions).map(|(node, &a)| size(&node.I.into(), a)).sum();
    Errors { counted: f64::EPSILON * (sum.total + geometry), given: f64::EPSILON * (inertia + geometry) }
}

/// How many bodies each body carries.
fn children(pencil: &Pencil<f64>) -> Vec<u32> {
    let mut children = vec![0; pencil.nodes.len()];
    pencil.nodes.iter().filter_map(Node::parent).for_each(|p| children[p] += 1);
    children
}

/// |a|ᵀ |IA| |a|.
fn size(IA: &ArticulatedInertia<f64>, a: Motion<f64>) -> f64 {
    let a = Motion::new(absolute(a.ang), absolute(a.lin));
    let IA = ArticulatedInertia { I: IA.I.map(f64::abs), H: IA.H.map(f64::abs), M: IA.M.map(f64::abs) };
    a.dot(IA.times(a))
}

/// Σ |f_i|ᵀ (|X_up||a_p| + |S||x|).
fn geometry(Pencil { nodes, S, .. }: &Pencil<f64>, x: &[f64], motions: &[Motion<f64>]) -> f64 {
    let mut f = vec![Force::ZERO; nodes.len()];
    let mut total = 0.0;
    for (i, node) in nodes.iter().enumerate().rev() {
        f[i] += node.I.times(motions[i]);
        let Some(p) = node.parent() else { continue };
        let mut size = moved(&node.X_up, motions[p]);
        for d in node.dofs() {
            size += Motion::new(absolute(S[d].ang), absolute(S[d].lin)) * x[d].abs();
        }
        total += size.dot(Force::new(absolute(f[i].ang), absolute(f[i].lin)));
        let carried = node.X_up.transpose_force(f[i]);
        f[p] += carried;
    }
    total
}

/// |X||m|: what a motion's coordinates are sums of.
fn moved(X: &Transform<f64>, m: Motion<f64>) -> Motion<f64> {
    let (E, r, ang, lin) = (X.E.map(f64::abs), absolute(X.r), absolute(m.ang), absolute(m.lin));
    let arm = Vec3::new(r.y * ang.z + r.z * ang.y, r.z * ang.x + r.x * ang.z, r.x * ang.y + r.y * ang.x);
    Motion::new(E * ang, E * (lin + arm))
}

struct Sum<'a> {
    pencil: &'a Pencil<f64>,
    motions: &'a [Motion<f64>],
    x: &'a [f64],
    children: Vec<u32>,
    /// Motion between the hinges of a body: outboard of the next one to be eliminated.
    a: Motion<f64>,
    total: f64,
}

fn absolute(v: Vec3<f64>) -> Vec3<f64> {
    v.map(f64::abs)
}

impl Pivots<f64> for Sum<'_> {
    fn pivot(&mut self, d: usize, hinge: &Hinge<f64>) {
        self.a += -(self.pencil.S[d] * self.x[d]);
        self.total += size(&hinge.IA, self.a);
    }

    fn body(&mut self, i: usize, IA: &ArticulatedInertia<f64>) {
        self.a = self.motions[i];
        // A sum of as many terms.
        self.total += f64::from(self.children[i].max(1)) * size(IA, self.a);
    }
}

//! How far rounding may have moved an eigenvalue.
//!
//! ```text
//! |δλ| ≲ ε Σ_d ( |a_d|ᵀ |IA_d| |a_d| + |a'_d|ᵀ |IA'_d| |a'_d| ) / xᵀBx        a'_d = a_d − S_d x_d
//! ```
//! IA_d and IA'_d: the inertia before and after hinge d is eliminated; a_d and a'_d: the motion, in the mode x, of the body outboard
//! and inboard of it. Rounding in a step perturbs either inertia by E with |E| of order ε|IA|, which perturbs H by JᵀEJ and the
//! eigenvalue by aᵀEa/xᵀBx. So the error is governed by what cancels inside each 6 × 6 inertia, weighed by the body's part in the
//! mode; the condition number of H does not enter. A hinge whose pivot nearly vanishes leaves a large IA' behind: the second term sees it.

use super::hinge::Hinge;
use super::pencil::Pencil;
use super::sweep::{Pivots, sweep};
use crate::spatial::{ArticulatedInertia, Motion, Vec3};

/// Estimated absolute error of the eigenvalue `shift`. Its mode `x`, xᵀBx = 1, moves the bodies by `motions`; where a base was
/// removed, x holds the motion of the body that stands in for it.
pub(crate) fn absolute_error(pencil: &Pencil<f64>, shift: f64, motions: &[Motion<f64>], x: &[f64]) -> f64 {
    let mut sum = Sum { pencil, motions, x, a: Motion::ZERO, total: 0.0 };
    sweep(pencil, shift, &mut Vec::new(), &mut sum);
    f64::EPSILON * sum.total
}

struct Sum<'a> {
    pencil: &'a Pencil<f64>,
    motions: &'a [Motion<f64>],
    x: &'a [f64],
    /// Motion between the hinges of a body: outboard of the next one to be eliminated.
    a: Motion<f64>,
    total: f64,
}

impl Sum<'_> {
    fn add(&mut self, IA: &ArticulatedInertia<f64>) {
        let a = Motion::new(absolute(self.a.ang), absolute(self.a.lin));
        let IA = ArticulatedInertia { I: IA.I.map(f64::abs), H: IA.H.map(f64::abs), M: IA.M.map(f64::abs) };
        self.total += a.dot(IA.times(a));
    }
}

fn absolute(v: Vec3<f64>) -> Vec3<f64> {
    v.map(f64::abs)
}

impl Pivots<f64> for Sum<'_> {
    fn pivot(&mut self, d: usize, hinge: &Hinge<f64>) {
        self.a += -(self.pencil.S[d] * self.x[d]);
        self.add(&hinge.IA);
    }

    fn body(&mut self, i: usize, IA: &ArticulatedInertia<f64>) {
        self.a = self.motions[i];
        self.add(IA);
    }
}

//! What governs the rounding of an elimination without pivoting: |x|ᵀ|L||D||Lᵀ||x| of H − σB = L D Lᵀ, from the tips inwards.
//!
//! Where a branch has an eigenvalue near σ of its own, its pivot is small and what it leaves behind large. The sum is that of a dense
//! elimination in the order in which the tree is swept, written here without the tree's formulas.

use crate::spectrum::systems::{System, exact_modes};
use eigenbody::Model;
use eigenbody::scalar::{Dd, Scalar};
use eigenbody::spatial::RigidInertia;
use eigenbody::spectrum::sturm::Pencil;

/// A pivot below this part of what it is the difference of is rounding.
const GUARD: f64 = 1e-14;

/// Sums for shifts near eigenvalues of one pencil.
pub struct Growth<'a> {
    system: &'a System,
    pencil: &'a Pencil<'a, f64>,
    /// Modes over all DoFs, xᵀBx = 1.
    modes: Vec<Vec<Dd>>,
    order: Vec<usize>,
}

impl<'a> Growth<'a> {
    pub fn new(system: &'a System, pencil: &'a Pencil<'a, f64>) -> Self {
        let order = elimination_order(&system.model, system.is_free);
        Self { system, pencil, modes: exact_modes(system, pencil).1, order }
    }

    /// Σ_d |D_d| (Σ_e |L_ed||x_e|)² at a shift, x the mode of eigenvalue k.
    pub fn sum(&self, shift: f64, k: usize) -> f64 {
        let (mut A, x) = (self.system.full_matrix(), &self.modes[k]);
        let beta: Vec<Dd> = self.pencil.metric().iter().map(|&b| Dd::from_product(shift, b)).collect();
        let mut sum = 0.0;
        for (place, &d) in self.order.iter().enumerate() {
            let least = (A[(d, d)].abs() + beta[d].abs()) * Dd::from_f64(GUARD);
            let D = A[(d, d)] - beta[d];
            let D = if D.abs() < least { least } else { D };
            let mut reach = x[d].abs().hi();
            for &i in &self.order[place + 1..] {
                let ratio = A[(i, d)] / D;
                reach += (ratio * x[i]).abs().hi();
                for &j in &self.order[place + 1..] {
                    let product = ratio * A[(d, j)];
                    A[(i, j)] -= product;
                }
            }
            sum += D.abs().hi() * reach * reach;
        }
        sum
    }
}

/// DoFs, tips first: a joint counts by how far its outer body is from the root, which is the central body of a free robot. Branches do
/// not meet before their root, so their order does not matter.
fn elimination_order(model: &Model<f64>, is_free: bool) -> Vec<usize> {
    let bodies = model.bodies();
    let root = if is_free { central_body(model) } else { 0 };
    let path: Vec<usize> = std::iter::successors(Some(root), |&i| bodies[i].parent()).collect();
    let mut distance = vec![0; bodies.len()];
    let mut joints: Vec<(usize, usize)> = Vec::new();
    for (i, body) in bodies.iter().enumerate() {
        let place = path.iter().position(|&p| p == i);
        distance[i] = place.or(body.parent().map(|p| distance[p] + 1)).unwrap_or(0);
        // The joint of a body on the path is walked the other way: it carries the parent. The base's own comes last.
        let outer = match place {
            Some(_) if i == 0 => 0,
            Some(place) => place + 1,
            None => distance[i],
        };
        joints.push((outer, i));
    }
    joints.sort_by_key(|&(outer, _)| std::cmp::Reverse(outer));
    joints.iter().flat_map(|&(_, i)| bodies[i].dofs().rev()).collect()
}

/// The body from which no branch has more than half of the robot, weighed by tr I + m R² with m R² = Σ tr I in all.
fn central_body(model: &Model<f64>) -> usize {
    let bodies = model.bodies();
    let turning: Vec<f64> = bodies
        .iter()
        .map(|body| {
            let RigidInertia { m, h, I } = *body.inertia();
            I.xx + I.yy + I.zz - 2.0 * h.dot(h) / m
        })
        .collect();
    let radius = turning.iter().sum::<f64>() / bodies.iter().map(|body| body.inertia().m).sum::<f64>();
    let mut weight: Vec<f64> =
        bodies.iter().zip(&turning).map(|(body, I)| I + body.inertia().m * radius).collect();
    for i in (1..bodies.len()).rev() {
        if let Some(p) = bodies[i].parent() {
            weight[p] += weight[i];
        }
    }
    weight.iter().rposition(|&w| w > 0.5 * weight[0]).unwrap()
}

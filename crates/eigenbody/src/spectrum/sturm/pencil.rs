//! The pencil (H(q), B) in the form that sweeps work on: no matrix, only the tree at q.

use crate::dynamics::Kinematics;
use crate::error::InputError;
use crate::model::{Body, Model};
use crate::scalar::Real;

/// H(q) x = λ B x, not yet formed.
#[derive(Debug, Clone)]
pub struct Pencil<'m, T> {
    pub(super) model: &'m Model<T>,
    pub(super) kinematics: Kinematics<T>,
    /// nv: diagonal of B, zero for DoFs that take no part.
    pub(super) B: Vec<T>,
    /// N: where each body's inertia goes.
    pub(super) route: Vec<Route>,
}

/// How a body's articulated inertia reaches its parent when bodies are swept in reverse pre-order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Route {
    pub to: Destination,
    /// The body has more than one child: the others' sum waits on the stack.
    pub collects: bool,
}

/// Where a swept body's inertia is kept until its parent is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Destination {
    /// The parent is next.
    Next,
    /// The first of several siblings to be swept: a new entry on the stack.
    Push,
    /// A later one of them: added to the entry on top.
    Add,
    /// The world.
    World,
}

impl<'m, T: Real> Pencil<'m, T> {
    /// The pencil at q with the diagonal metric B, one number a DoF, zero for those that take no part.
    ///
    /// Errors: [`InputError`] if q or B does not fit the model, or an entry of B is negative.
    pub fn new(model: &'m Model<T>, q: &[T], B: Vec<T>) -> Result<Self, InputError> {
        model.check_q(q)?;
        model.check_v("B", &B)?;
        if let Some(index) = B.iter().position(|&b| b < T::ZERO) {
            return Err(InputError::NotPositive { what: "B", index, value: B[index].to_f64() });
        }
        let mut kinematics = Kinematics::new(model);
        kinematics.update(model, q);
        Ok(Self { model, kinematics, B, route: routes(&model.bodies) })
    }

    /// Number of eigenvalues: DoFs with B > 0.
    pub fn len(&self) -> usize {
        self.B.iter().filter(|&&b| b > T::ZERO).count()
    }

    /// True if no DoF takes part.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The routes of bodies in pre-order. With the largest subtree of siblings last, the stack holds at most log₂ N entries.
fn routes<T: Real>(bodies: &[Body<T>]) -> Vec<Route> {
    let mut children = vec![0u32; bodies.len()];
    let mut last_child = vec![0usize; bodies.len()];
    for (i, body) in bodies.iter().enumerate() {
        if let Some(p) = body.parent() {
            children[p] += 1;
            last_child[p] = i;
        }
    }
    let route = |(i, body): (usize, &Body<T>)| {
        let to = match body.parent() {
            None => Destination::World,
            Some(p) if p + 1 == i => Destination::Next,
            Some(p) if last_child[p] == i => Destination::Push,
            Some(_) => Destination::Add,
        };
        Route { to, collects: children[i] > 1 }
    };
    bodies.iter().enumerate().map(route).collect()
}

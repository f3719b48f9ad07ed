//! The pencil (H(q), B) in the form that sweeps work on: no matrix, only the tree at q.

use super::diagonal::Diagonal;
use crate::dynamics::{Kinematics, Rerooted, TreeBody};
use crate::error::InputError;
use crate::joint::Column;
use crate::model::{Model, check};
use crate::scalar::{Real, Scalar};
use crate::spatial::{Motion, RigidInertia, Transform};
use std::ops::Range;

/// H(q) x = λ B x, not yet formed.
#[derive(Debug, Clone)]
pub struct Pencil<T> {
    /// N: the bodies, each after the one that carries it.
    pub(super) nodes: Vec<Node<T>>,
    /// nv: columns of S, each in its body's frame.
    pub(super) S: Vec<Motion<T>>,
    /// nv: diagonal of B, zero for DoFs that take no part.
    pub(super) B: Vec<T>,
    /// nv: armature.
    pub(super) armature: Vec<T>,
    /// nv: B and armature in the order of the nodes. DoFs of neighbouring bodies may stand far apart in a branched tree, and a
    /// sweep that fetched them one by one would wait for memory.
    pub(super) hinges: Vec<(T, T)>,
    /// The tree seen from its central body, where the base is removed.
    rerooted: Option<Box<Seen<T>>>,
}

/// A tree seen from another body, and the kinematics it is made from.
#[derive(Debug, Clone)]
struct Seen<T> {
    kinematics: Kinematics<T>,
    tree: Rerooted<T>,
}

/// A body at q.
#[derive(Debug, Clone)]
pub(super) struct Node<T> {
    pub I: RigidInertia<T>,
    pub X_up: Transform<T>,
    /// X_up turns about z alone, as where axes are parallel.
    pub about_z: bool,
    pub columns: &'static [Column],
    pub v0: u32,
    pub parent: u32,
    pub route: Route,
    /// More than one child: the others' sum waits on the stack.
    pub collects: bool,
}

/// Where a body's inertia waits until its parent is reached, bodies taken from the last to the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Route {
    /// The parent is next.
    Next,
    /// The first of several siblings to be swept: a new entry on the stack.
    Push,
    /// A later one of them: added to the entry on top.
    Add,
    /// The world.
    World,
}

impl<T: Real> Node<T> {
    #[inline(always)]
    pub fn dofs(&self) -> Range<usize> {
        let v0 = self.v0 as usize;
        v0..v0 + self.columns.len()
    }

    fn place(&mut self, X_up: Transform<T>) {
        self.X_up = X_up;
        self.about_z = X_up.E.about_z().is_some();
    }

    #[inline(always)]
    pub fn parent(&self) -> Option<usize> {
        (self.route != Route::World).then_some(self.parent as usize)
    }
}

impl<T: Real> Pencil<T> {
    /// The pencil at q with the diagonal metric B, one number a DoF, zero for those that take no part.
    ///
    /// Errors: [`InputError`] if q or B does not fit the model, or an entry of B is negative.
    pub fn new(model: &Model<T>, q: &[T], B: Vec<T>) -> Result<Self, InputError> {
        let nodes = nodes(model.bodies(), |i| model.bodies()[i].joint().columns());
        Self::start(model, nodes, None, q, B)
    }

    /// The pencil of the free-floating H*: six columns with B = 0 on the central body.
    ///
    /// The first six numbers of B are ignored. Errors: as [`new`](Self::new), and [`InputError::NoFloatingBase`].
    pub fn free_floating(model: &Model<T>, q: &[T], B: Vec<T>) -> Result<Self, InputError> {
        if !model.has_floating_base() {
            return Err(InputError::NoFloatingBase);
        }
        let tree = Rerooted::new(model);
        let nodes = nodes(&tree.bodies, |place| tree.columns(model, place));
        let seen = Seen { kinematics: Kinematics::new(model), tree };
        Self::start(model, nodes, Some(Box::new(seen)), q, B)
    }

    fn start(
        model: &Model<T>,
        nodes: Vec<Node<T>>,
        rerooted: Option<Box<Seen<T>>>,
        q: &[T],
        B: Vec<T>,
    ) -> Result<Self, InputError> {
        let (S, armature) = (vec![Motion::ZERO; model.nv()], model.armature().to_vec());
        let hinges = Vec::with_capacity(model.nv());
        let mut pencil = Self { nodes, S, B: Vec::new(), armature, hinges, rerooted };
        pencil.update(model, q)?;
        pencil.with_metric(B)
    }

    /// The same pencil at another q; allocates nothing. A unit-diagonal metric stays the one it was.
    ///
    /// Errors: [`InputError`] if q does not fit the model.
    pub fn update(&mut self, model: &Model<T>, q: &[T]) -> Result<(), InputError> {
        model.check_q(q)?;
        let Self { nodes, S, rerooted, .. } = self;
        match rerooted {
            None => {
                for (node, body) in nodes.iter_mut().zip(model.bodies()) {
                    let X_J = body.joint().kinematics(&q[body.coordinates()], &mut S[body.dofs()]);
                    node.place(X_J * *body.tree_transform());
                }
            }
            Some(seen) => {
                let Seen { kinematics, tree } = &mut **seen;
                kinematics.update(model, q);
                tree.update(model, kinematics);
                for (node, X_up) in nodes.iter_mut().zip(&tree.kinematics.X_up) {
                    node.place(*X_up);
                }
                S.copy_from_slice(&tree.kinematics.S);
            }
        }
        Ok(())
    }

    /// The same matrix in another metric, one number a DoF; a removed base keeps B = 0.
    ///
    /// Errors: [`InputError`] for a wrong length or an entry that is negative or not finite.
    pub fn with_metric(mut self, mut B: Vec<T>) -> Result<Self, InputError> {
        check("B", &B, self.S.len())?;
        if let Some(index) = B.iter().position(|&b| b < T::ZERO) {
            return Err(InputError::NotPositive { what: "B", index, value: B[index].to_f64() });
        }
        if self.rerooted.is_some() {
            B[..6].fill(T::ZERO);
        }
        self.B = B;
        self.gather();
        Ok(self)
    }

    /// Brings B and armature into the order of the nodes.
    fn gather(&mut self) {
        let Self { nodes, B, armature, hinges, .. } = self;
        hinges.clear();
        hinges.extend(nodes.iter().flat_map(Node::dofs).map(|d| (B[d], armature[d])));
    }

    /// Number of eigenvalues: DoFs with B > 0.
    pub fn len(&self) -> usize {
        self.B.iter().filter(|&&b| b > T::ZERO).count()
    }

    /// True if no DoF takes part.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Diagonal of B.
    pub fn metric(&self) -> &[T] {
        &self.B
    }

    /// Another metric that has been checked; a removed base keeps B = 0.
    pub(crate) fn set_metric(&mut self, B: &[T]) {
        let removed = if self.rerooted.is_some() { 6 } else { 0 };
        self.B[removed..].copy_from_slice(&B[removed..]);
        self.gather();
    }

    /// True if the base is removed.
    pub(super) fn has_free_base(&self) -> bool {
        self.rerooted.is_some()
    }

    /// Where the base was removed, the six numbers of `x` that are the base's: how it moves along, from all bodies' motions.
    pub(in crate::spectrum) fn fill_base<L: Scalar>(&self, motions: &[Motion<L>], x: &mut [L]) {
        if let Some(seen) = &self.rerooted {
            x[..6].copy_from_slice(&motions[seen.tree.place_of_base()].to_array());
        }
    }

    /// Diagonal of the matrix, B left aside: H_dd from composite inertias, O(N); H*_dd where a base with B = 0 is removed.
    pub fn diagonal(&self) -> Vec<T> {
        Diagonal::new(self).update(self).to_vec()
    }
}

/// Bodies with their routes; where they stand is not known yet.
fn nodes<T: Real, N: TreeBody<T>>(
    bodies: &[N],
    columns: impl Fn(usize) -> &'static [Column],
) -> Vec<Node<T>> {
    let mut children = vec![0u32; bodies.len()];
    let mut last_child = vec![0usize; bodies.len()];
    for (i, body) in bodies.iter().enumerate() {
        if let Some(p) = body.parent() {
            children[p] += 1;
            last_child[p] = i;
        }
    }
    let node = |(i, body): (usize, &N)| Node {
        I: body.inertia(),
        X_up: Transform::IDENTITY,
        about_z: true,
        columns: columns(i),
        v0: body.dofs().start as u32,
        parent: body.parent().unwrap_or(0) as u32,
        route: match body.parent() {
            None => Route::World,
            Some(p) if p + 1 == i => Route::Next,
            Some(p) if last_child[p] == i => Route::Push,
            Some(_) => Route::Add,
        },
        collects: children[i] > 1,
    };
    bodies.iter().enumerate().map(node).collect()
}

//! The pencil (H(q), B) in the form that sweeps work on: no matrix, only the tree at q.

use crate::dynamics::{Kinematics, Rerooted, TreeBody};
use crate::error::InputError;
use crate::joint::Column;
use crate::model::{Model, check};
use crate::scalar::Real;
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
    /// The model's own base among the nodes, where it was removed.
    base: Option<usize>,
}

/// A body at q.
#[derive(Debug, Clone)]
pub(super) struct Node<T> {
    pub I: RigidInertia<T>,
    pub X_up: Transform<T>,
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
        let columns = |i: usize| model.bodies()[i].joint().columns();
        let kinematics = Kinematics::at(model, q)?;
        Self::from_tree(model.bodies(), columns, kinematics, model.armature()).with_metric(B)
    }

    /// The pencil of the free-floating H*: six columns with B = 0 on the heaviest body.
    ///
    /// The first six numbers of B are ignored. Errors: as [`new`](Self::new), and [`InputError::NoFloatingBase`].
    pub fn free_floating(model: &Model<T>, q: &[T], B: Vec<T>) -> Result<Self, InputError> {
        if !model.has_floating_base() {
            return Err(InputError::NoFloatingBase);
        }
        let mut tree = Rerooted::new(model);
        tree.update(model, &Kinematics::at(model, q)?);
        let columns = |i: usize| tree.columns(model, i);
        let pencil = Self::from_tree(&tree.bodies, columns, tree.kinematics.clone(), model.armature());
        Self { base: Some(tree.place_of_base()), ..pencil }.with_metric(B)
    }

    fn from_tree<N: TreeBody<T>>(
        bodies: &[N],
        columns: impl Fn(usize) -> &'static [Column],
        Kinematics { X_up, S }: Kinematics<T>,
        armature: &[T],
    ) -> Self {
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
            X_up: X_up[i],
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
        let nodes = bodies.iter().enumerate().map(node).collect();
        Self { nodes, S, B: vec![T::ZERO; armature.len()], armature: armature.to_vec(), base: None }
    }

    /// Number of eigenvalues: DoFs with B > 0.
    pub fn len(&self) -> usize {
        self.B.iter().filter(|&&b| b > T::ZERO).count()
    }

    /// True if no DoF takes part.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The same matrix in another metric, one number a DoF; a removed base keeps B = 0.
    ///
    /// Errors: [`InputError`] for a wrong length or an entry that is negative or not finite.
    pub fn with_metric(mut self, mut B: Vec<T>) -> Result<Self, InputError> {
        check("B", &B, self.B.len())?;
        if let Some(index) = B.iter().position(|&b| b < T::ZERO) {
            return Err(InputError::NotPositive { what: "B", index, value: B[index].to_f64() });
        }
        if self.base.is_some() {
            B[..6].fill(T::ZERO);
        }
        self.B = B;
        Ok(self)
    }

    /// Diagonal of B.
    pub fn metric(&self) -> &[T] {
        &self.B
    }

    /// Where the base was removed, the six numbers of `x` that are the base's: how it moves along, from all bodies' motions.
    pub(in crate::spectrum) fn fill_base(&self, motions: &[Motion<T>], x: &mut [T]) {
        if let Some(base) = self.base {
            x[..6].copy_from_slice(&motions[base].to_array());
        }
    }

    /// Diagonal of the matrix, B left aside: H_dd from composite inertias, O(N); H*_dd where a base with B = 0 is removed.
    pub fn diagonal(&self) -> Vec<T> {
        super::diagonal::diagonal(self)
    }
}

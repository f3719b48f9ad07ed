//! The pencil (H(q), B) in the form that sweeps work on: no matrix, only the tree at q.

use super::diagonal::Diagonal;
use crate::dynamics::{BASE, Kinematics, Rerooted, TreeBody};
use crate::error::InputError;
use crate::joint::Column;
use crate::model::{Model, check};
use crate::scalar::{Real, Scalar};
use crate::spatial::{Motion, RigidInertia, Transform};
use crate::spectrum::Metric;
use std::ops::Range;

/// H(q) x = λ B x, not yet formed.
///
/// ```
/// use eigenbody::spectrum::sturm::{Pencil, counts};
/// use eigenbody::{Family, Model};
/// let ring: Model<f64> = Family::onion(5, 1.0, 0.0, 1.0)?.model()?;
/// let pencil = Pencil::new(&ring, &[0.0; 5], vec![1.0; 5])?;
/// // Eigenvalues 1/(4 sin²((2k−1)π/22)): 0.27, 0.35, 0.58, 1.45, 12.3.
/// assert_eq!(counts(&pencil, [1.0; 8])[0].below, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Pencil<'m, T> {
    pub(in crate::spectrum) model: &'m Model<T>,
    /// nq.
    pub(in crate::spectrum) q: Vec<T>,
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

impl<'m, T: Real> Pencil<'m, T> {
    /// The pencil at q with the diagonal metric B, one number a DoF, zero for those that take no part.
    ///
    /// Errors: [`InputError`] if q or B does not fit the model, or an entry of B is negative.
    pub fn new(model: &'m Model<T>, q: &[T], B: Vec<T>) -> Result<Self, InputError> {
        let nodes = nodes(model.bodies(), |i| model.bodies()[i].joint().columns());
        Self::start(model, nodes, None, q, B)
    }

    /// The pencil of the free-floating H*: six columns with B = 0 on the central body.
    ///
    /// The first six numbers of B are ignored. Errors: as [`new`](Self::new), and [`InputError::NoFloatingBase`].
    pub fn free_floating(model: &'m Model<T>, q: &[T], B: Vec<T>) -> Result<Self, InputError> {
        if !model.has_floating_base() {
            return Err(InputError::NoFloatingBase);
        }
        let tree = Rerooted::new(model);
        let nodes = nodes(&tree.bodies, |place| tree.columns(model, place));
        let seen = Seen { kinematics: Kinematics::new(model), tree };
        Self::start(model, nodes, Some(Box::new(seen)), q, B)
    }

    /// The pencil of H, or with a floating base removed that of H*, in the Euclidean metric.
    ///
    /// Errors: as [`new`](Self::new) and [`free_floating`](Self::free_floating).
    pub fn euclidean(model: &'m Model<T>, q: &[T], removes_base: bool) -> Result<Self, InputError> {
        let pencil = if removes_base { Self::free_floating } else { Self::new };
        pencil(model, q, vec![T::ONE; model.nv()])
    }

    fn start(
        model: &'m Model<T>,
        nodes: Vec<Node<T>>,
        rerooted: Option<Box<Seen<T>>>,
        q: &[T],
        B: Vec<T>,
    ) -> Result<Self, InputError> {
        let (S, armature) = (vec![Motion::ZERO; model.nv()], model.armature().to_vec());
        let hinges = Vec::with_capacity(model.nv());
        let (q_room, B_room) = (Vec::with_capacity(q.len()), Vec::new());
        let mut pencil = Self { model, q: q_room, nodes, S, B: B_room, armature, hinges, rerooted };
        pencil.update(q)?;
        pencil.with_metric(B)
    }

    /// The same pencil at another q; allocates nothing. A unit-diagonal metric stays the one it was.
    ///
    /// Errors: [`InputError`] if q does not fit the model.
    pub fn update(&mut self, q: &[T]) -> Result<(), InputError> {
        let Self { model, q: now, nodes, S, rerooted, .. } = self;
        model.check_q(q)?;
        now.clear();
        now.extend_from_slice(q);
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
        B[..self.removed()].fill(T::ZERO);
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

    /// B of every DoF in a metric, of the matrix with this [`diagonal`](Self::diagonal); zero for those of a removed base.
    ///
    /// Errors: as [`Metric::weights`].
    pub fn weights(&self, metric: &Metric<T>, diagonal: &[T]) -> Result<Vec<T>, InputError> {
        let removed = self.removed();
        let is_translation = |row| self.model.is_translation(row + removed);
        let weights = metric.weights_for(&diagonal[removed..], is_translation)?;
        let mut B = vec![T::ZERO; removed];
        B.extend(weights);
        Ok(B)
    }

    /// Another metric, positive where DoFs take part; a removed base keeps B = 0. Allocates nothing.
    pub(crate) fn set_metric(&mut self, B: &[T]) -> Result<(), InputError> {
        let removed = self.removed();
        if let Some(index) = B[removed..].iter().position(|&b| !(b > T::ZERO && b.is_finite())) {
            let value = B[removed + index].to_f64();
            return Err(InputError::NotPositive { what: "B", index: removed + index, value });
        }
        self.B[removed..].copy_from_slice(&B[removed..]);
        self.gather();
        Ok(())
    }

    /// DoFs of a base that is removed: six or none, the first ones.
    pub fn removed(&self) -> usize {
        if self.rerooted.is_some() { BASE } else { 0 }
    }

    /// Smallest, largest and sum of H_dd/B_d over the DoFs that take part: λmin ≤ min, max ≤ λmax ≤ sum.
    pub(in crate::spectrum) fn ratios(&self, diagonal: &[T]) -> [T; 3] {
        let taking_part = diagonal.iter().zip(&self.B).filter(|&(_, &b)| b > T::ZERO);
        let start = [T::from_f64(f64::INFINITY), T::ZERO, T::ZERO];
        taking_part.fold(start, |[min, max, sum], (&h, &b)| [min.min(h / b), max.max(h / b), sum + h / b])
    }

    /// Where the base was removed, the six numbers of `x` that are the base's: how it moves along, from all bodies' motions.
    pub(in crate::spectrum) fn fill_base<L: Scalar>(&self, motions: &[Motion<L>], x: &mut [L]) {
        if let Some(seen) = &self.rerooted {
            x[..BASE].copy_from_slice(&motions[seen.tree.place_of_base()].to_array());
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

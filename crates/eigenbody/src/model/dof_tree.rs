//! The tree of degrees of freedom: which entries of H can be non-zero, and in which order to eliminate.

const NONE: u32 = u32::MAX;

/// The expanded parent array, one entry a DoF, with a pre-order of the DoFs.
///
/// H_de can be non-zero only if d = e or one is an ancestor of the other (Featherstone 2008, §6.3).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DofTree {
    parent: Vec<u32>,
    order: Vec<u32>,
}

impl DofTree {
    pub(crate) fn new(parent: Vec<Option<usize>>, order: Vec<u32>) -> Self {
        Self { parent: parent.into_iter().map(|p| p.map_or(NONE, |p| p as u32)).collect(), order }
    }

    /// n DoFs each on the one before: the structure of a full matrix.
    pub fn chain(n: usize) -> Self {
        Self::new((0..n).map(|d| d.checked_sub(1)).collect(), (0..n as u32).collect())
    }

    /// Number of DoFs.
    pub fn len(&self) -> usize {
        self.parent.len()
    }

    /// True for a mechanism that cannot move.
    pub fn is_empty(&self) -> bool {
        self.parent.is_empty()
    }

    /// The DoF before d on the path to the root.
    #[inline(always)]
    pub fn parent(&self, d: usize) -> Option<usize> {
        let p = self.parent[d];
        (p != NONE).then_some(p as usize)
    }

    /// All DoFs, ancestors first.
    pub fn order(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.order.iter().map(|&d| d as usize)
    }

    /// The strict ancestors of d, nearest first.
    #[inline(always)]
    pub fn ancestors(&self, d: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(self.parent(d), |&i| self.parent(i))
    }
}

//! Where the entries of H stand in a group of configurations.

use crate::model::Model;
use crate::scalar::Real;
use std::sync::OnceLock;

/// Degrees of freedom of a free root, and numbers of a column.
pub(super) const SIX: usize = 6;

/// Where the entries of H stand: made once for all calls.
#[derive(Debug)]
pub(super) struct Layout {
    pub nv: usize,
    /// By place in pre-order: the degree of freedom.
    order: Vec<u32>,
    /// Row and column of every entry, by places in pre-order.
    pairs: Vec<(u32, u32)>,
    /// By place in pre-order: the entry on the diagonal.
    diagonal: Vec<u32>,
    /// By body.
    pub subtrees: Vec<Subtree>,
    /// Columns in all, and how many of them stand before those that come to a free root.
    pub columns: usize,
    pub apart: usize,
    /// Whether any degree of freedom has armature.
    pub armed: bool,
    /// How many entries there are, the zero not counted.
    pub entries: usize,
    square: OnceLock<Vec<u32>>,
    triangle: OnceLock<Vec<u32>>,
}

/// What stands where of a body and of all that it carries.
#[derive(Debug, Clone, Copy)]
pub(super) struct Subtree {
    /// The first of its columns, and how many there are; a free root itself has none.
    pub column: u32,
    pub count: u32,
    /// Where its own rows begin.
    pub row: u32,
}

impl Layout {
    pub fn new<T: Real>(model: &Model<T>) -> Self {
        let (nv, members) = (model.nv(), &model.mechanism.members);
        // By body: the first of its degrees of freedom in pre-order, and one more than the last that it carries.
        let mut first = vec![0; members.len()];
        for i in 1..members.len() {
            first[i] = first[i - 1] + members[i - 1].joint.nv();
        }
        let mut end: Vec<usize> = first.iter().zip(members).map(|(&first, m)| first + m.joint.nv()).collect();
        for (i, m) in members.iter().enumerate().rev() {
            if let Some(p) = (m.parent as usize).checked_sub(1) {
                end[p] = end[p].max(end[i]);
            }
        }
        // Columns that come to a free root stand after all others, and are entries.
        let roots = || members.iter().enumerate().filter(|(_, m)| m.parent == 0);
        let apart: usize = roots().filter(|(_, m)| !m.is_free_root()).map(|(i, _)| end[i] - first[i]).sum();
        let mut next = [0, apart];
        let mut column = vec![0; nv];
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (i, m) in roots() {
            let free = m.is_free_root();
            for place in first[i] + if free { SIX } else { 0 }..end[i] {
                column[place] = next[usize::from(free)];
                next[usize::from(free)] += 1;
                if free {
                    pairs.extend((first[i]..).take(SIX).map(|row| (row as u32, place as u32)));
                }
            }
        }
        let columns = next[1];
        let mut diagonal = Vec::with_capacity(nv);
        let mut subtrees = Vec::with_capacity(members.len());
        for (i, m) in members.iter().enumerate() {
            let row = pairs.len() as u32 - SIX as u32 * (columns - apart) as u32;
            let own = first[i]..first[i] + m.joint.nv();
            let carried = if m.is_free_root() { own.end } else { own.start };
            for d in own.clone() {
                if m.is_free_root() {
                    pairs.extend((own.start..=d).map(|column| (d as u32, column as u32)));
                    diagonal.push(pairs.len() as u32 - 1);
                } else {
                    diagonal.push(pairs.len() as u32);
                    pairs.extend((d..end[i]).map(|column| (d as u32, column as u32)));
                }
            }
            subtrees.push(Subtree {
                column: column.get(carried).copied().unwrap_or(0) as u32,
                count: (end[i] - carried) as u32,
                row,
            });
        }
        let order = model.dofs().order().map(|d| d as u32).collect();
        let entries = pairs.len();
        let armed = model.armature.iter().any(|&a| a != T::ZERO);
        let (square, triangle) = Default::default();
        Self { nv, order, pairs, diagonal, subtrees, columns, apart, armed, entries, square, triangle }
    }

    /// nv × nv: which entry stands there. The one after the last is zero.
    pub fn square(&self) -> &[u32] {
        self.square.get_or_init(|| {
            let mut places = vec![self.entries as u32; self.nv * self.nv];
            for (entry, (d, e)) in (0..).zip(self.pairs()) {
                places[d * self.nv + e] = entry;
                places[e * self.nv + d] = entry;
            }
            places
        })
    }

    /// The lower triangle by rows, degrees of freedom in pre-order: which entry stands there. The one after the last is zero.
    pub fn triangle(&self) -> &[u32] {
        self.triangle.get_or_init(|| {
            let mut places = vec![self.entries as u32; self.nv * (self.nv + 1) / 2];
            for (entry, &(row, column)) in (0..).zip(&self.pairs) {
                let (least, most) = (row.min(column) as usize, row.max(column) as usize);
                places[most * (most + 1) / 2 + least] = entry;
            }
            places
        })
    }

    /// The degrees of freedom of every entry, the one further in last.
    pub fn pairs(&self) -> Vec<(usize, usize)> {
        let dof = |place: u32| self.order[place as usize] as usize;
        self.pairs.iter().map(|&(row, column)| (dof(row.max(column)), dof(row.min(column)))).collect()
    }

    /// Degrees of freedom in pre-order.
    pub fn order(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.iter().map(|&d| d as usize)
    }

    /// The entry on the diagonal, by place in pre-order.
    #[inline(always)]
    pub fn diagonal(&self, d: usize) -> usize {
        self.diagonal[d] as usize
    }
}

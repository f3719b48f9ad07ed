//! Where the entries of H stand in a group of configurations, and when they leave it.
//!
//! Bodies come from the tips inwards, and limb by limb where they hang on the world or on a base that moves freely. What is known of some
//! limbs stands side by side:
//!
//! ```text
//! columns F on their way to the world | columns F on their way to a free base, whose S is 1: entries of H | rows of H
//! ```
//! Rows leave as soon as there are enough of them, the other entries with the last of them; then other limbs take the place.

use super::limbs::{Places, SIX};
use crate::model::Model;
use crate::scalar::Real;
use std::ops::Range;
use std::sync::OnceLock;

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
    /// In the order in which they are done.
    pub pieces: Vec<Piece>,
    /// Numbers and degrees of freedom whose armature is added to them.
    pub armature: Vec<(u32, u32)>,
    /// How many numbers stand side by side at most.
    pub numbers: usize,
    square: OnceLock<Vec<u32>>,
    triangle: OnceLock<Vec<u32>>,
}

/// What stands where of a body and of all that it carries.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Subtree {
    /// The first of its columns, and how many there are; a free root itself has none.
    pub column: u32,
    pub count: u32,
    /// Where its own rows begin among those of the piece.
    pub row: u32,
}

/// Entries that leave together.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Those that come to their turn with it.
    pub bodies: Range<usize>,
    /// Where they stand, and where columns end and rows begin.
    pub at: Range<usize>,
    pub rows: usize,
    /// The first of them.
    pub first: usize,
    /// What is added to them.
    pub armature: Range<usize>,
}

impl Layout {
    /// In pieces of at least so many entries, or in one.
    pub fn new<T: Real>(model: &Model<T>, least: usize) -> Self {
        let (nv, places) = (model.nv(), Places::new(model));
        let order: Vec<u32> = model.dofs().order().map(|d| d as u32).collect();
        let (mut pairs, mut pieces): (Vec<(u32, u32)>, Vec<Piece>) = Default::default();
        let (mut diagonal, mut armature) = (vec![0; nv], Vec::new());
        let mut subtrees = vec![Subtree::default(); places.first.len()];
        let entry = |(d, e): (usize, usize)| (d as u32, e as u32);
        for limbs in places.limbs(least) {
            let start = limbs.last().map_or(0, |last| last.start);
            let bodies = start..limbs.first().map_or(0, |first| first.end);
            let (apart, based): (Vec<usize>, Vec<usize>) =
                bodies.filter(|&i| !places.free[i]).partition(|&i| places.base[i].is_none());
            let mut column = vec![0; places.first.len()];
            let (mut columns, mut to_world) = (0, 0);
            for bodies in [&apart, &based] {
                to_world = columns;
                for &i in bodies {
                    column[i] = columns;
                    columns += places.own(i).len();
                }
            }
            for bodies in limbs {
                let (first, armed) = (pairs.len(), armature.len());
                let rows = SIX * columns;
                let mut from = rows;
                if bodies.start == start {
                    from = SIX * to_world;
                    pairs.extend(based.iter().flat_map(|&i| places.of_base(i)).map(entry));
                }
                for i in bodies.clone().rev() {
                    subtrees[i] = Subtree {
                        column: column[i] as u32,
                        count: if places.free[i] { 0 } else { places.end[i] - places.first[i] } as u32,
                        row: (from + pairs.len() - first - rows) as u32,
                    };
                    pairs.extend(places.rows(i).map(entry));
                }
                for (k, &(d, _)) in pairs.iter().enumerate().skip(first).filter(|(_, (d, e))| d == e) {
                    let dof = order[d as usize];
                    diagonal[d as usize] = k as u32;
                    if model.armature[dof as usize] != T::ZERO {
                        armature.push(((from + k - first) as u32, dof));
                    }
                }
                let (at, armature) = (from..from + pairs.len() - first, armed..armature.len());
                pieces.push(Piece { bodies, at, rows, first, armature });
            }
        }
        let numbers = pieces.iter().map(|piece| piece.at.end).max().unwrap_or(0);
        let (square, triangle) = Default::default();
        Self { nv, order, pairs, diagonal, subtrees, pieces, armature, numbers, square, triangle }
    }

    /// How many entries there are.
    pub fn entries(&self) -> usize {
        self.pairs.len()
    }

    /// nv × nv: which entry stands there. The one after the last is zero.
    pub fn square(&self) -> &[u32] {
        self.square.get_or_init(|| {
            let mut places = vec![self.entries() as u32; self.nv * self.nv];
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
            let mut places = vec![self.entries() as u32; self.nv * (self.nv + 1) / 2];
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

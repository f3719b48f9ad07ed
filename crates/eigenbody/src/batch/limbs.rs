//! Which entries of H come with which body, and which bodies make a limb.

use crate::model::{Member, Model};
use crate::scalar::Real;
use std::ops::Range;

/// Degrees of freedom of a free root, and numbers of a column.
pub(super) const SIX: usize = 6;

/// Bodies by degrees of freedom in pre-order.
pub(super) struct Places {
    /// The first of its own, and one more than the last that it carries.
    pub first: Vec<usize>,
    pub end: Vec<usize>,
    /// Whether it moves freely in the world; where the free base begins that carries it.
    pub free: Vec<bool>,
    pub base: Vec<Option<usize>>,
    /// Whether it hangs on the world or on a free base, and whether its parent carries others as well.
    limb: Vec<bool>,
    branch: Vec<bool>,
}

impl Places {
    pub fn new<T: Real>(model: &Model<T>) -> Self {
        let members = &model.mechanism().members;
        let parent = |i: usize| (members[i].parent as usize).checked_sub(1);
        let mut first = vec![0; members.len()];
        for i in 1..members.len() {
            first[i] = first[i - 1] + members[i - 1].joint.nv();
        }
        let mut end: Vec<usize> = first.iter().zip(members).map(|(&first, m)| first + m.joint.nv()).collect();
        for i in (0..members.len()).rev() {
            if let Some(p) = parent(i) {
                end[p] = end[p].max(end[i]);
            }
        }
        let free: Vec<bool> = members.iter().map(Member::is_free_root).collect();
        let mut base = vec![None; members.len()];
        for i in 0..members.len() {
            base[i] = parent(i).and_then(|p| if free[p] { Some(first[p]) } else { base[p] });
        }
        let branch: Vec<bool> = members.iter().map(|m| !m.place.alone()).collect();
        let limb = (0..members.len()).map(|i| parent(i).is_none_or(|p| free[p] && branch[i])).collect();
        Self { first, end, free, base, limb, branch }
    }

    /// Degrees of freedom of body i.
    pub fn own(&self, i: usize) -> Range<usize> {
        self.first[i]..self.first.get(i + 1).copied().unwrap_or(self.end[i])
    }

    /// Row and column of the entries that body i holds: its own block up to the diagonal or from there on, and those of what it carries.
    pub fn rows(&self, i: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let row = move |d: usize| if self.free[i] { self.first[i]..d + 1 } else { d..self.end[i] };
        self.own(i).flat_map(move |d| row(d).map(move |e| (d, e)))
    }

    /// Those that a free base has of it.
    pub fn of_base(&self, i: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let base = move || self.base[i].into_iter().flat_map(|first| first..first + SIX);
        self.own(i).flat_map(move |d| base().map(move |row| (row, d)))
    }

    /// Entries that come with body i.
    fn entries(&self, i: usize) -> usize {
        self.rows(i).count() + self.of_base(i).count()
    }

    /// Bodies from the last to the first: limbs that have so many entries, and pieces of them.
    pub fn limbs(&self, least: usize) -> Vec<Vec<Range<usize>>> {
        let mut limbs: Vec<Range<usize>> = Vec::new();
        let (mut end, mut entries) = (self.first.len(), 0);
        for i in (0..end).rev() {
            entries += self.entries(i);
            if self.limb[i] && entries >= least {
                limbs.push(i..end);
                (end, entries) = (i, 0);
            }
        }
        // What is left is not worth a place of its own.
        match limbs.last_mut() {
            Some(last) => last.start = 0,
            None => limbs.push(0..end),
        }
        limbs.into_iter().map(|bodies| self.pieces(bodies, least)).collect()
    }

    /// Pieces that end where a body hangs beside others; the last one has what the base has of all.
    fn pieces(&self, bodies: Range<usize>, least: usize) -> Vec<Range<usize>> {
        let mut left: usize = bodies.clone().map(|i| self.entries(i)).sum();
        let (mut pieces, mut end, mut done) = (Vec::new(), bodies.end, 0);
        for i in (bodies.start + 1..bodies.end).rev() {
            done += self.rows(i).count();
            if self.branch[i] && done >= least && left - done >= least {
                pieces.push(i..end);
                (left, end, done) = (left - done, i, 0);
            }
        }
        pieces.push(bodies.start..end);
        pieces
    }
}

//! The model as the kernels of `dynamics` see it: in frames between which little is left to compute.

use super::Model;
use super::body::{Body, WORLD};
use super::finding::principal_moments;
use super::frames::{Frames, Standing, Twist};
use crate::joint::Joint;
use crate::scalar::{MOST_COLUMNS, Real};
use crate::spatial::{Mat3, PseudoInertia, Vec3};
use std::ops::Range;
use std::sync::OnceLock;

/// A mechanism from when it is first asked for: eigenvalues of long chains are counted without one.
#[derive(Debug, Clone)]
pub(crate) struct Deferred<T>(OnceLock<Mechanism<T>>);

impl<T> Default for Deferred<T> {
    fn default() -> Self {
        Self(OnceLock::new())
    }
}

/// It follows from the rest of the model.
impl<T> PartialEq for Deferred<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T: Real> Model<T> {
    /// The model as the kernels see it.
    #[inline(always)]
    pub(crate) fn mechanism(&self) -> &Mechanism<T> {
        self.mechanism.0.get_or_init(|| Mechanism::new(&self.bodies))
    }
}

/// The bodies in pre-order, and what their joints' angles are counted from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mechanism<T> {
    pub members: Vec<Member<T>>,
    /// Where each hinge's angle stands in q, and anything else for other joints; rounded up to whole columns.
    pub angles: Vec<u32>,
    /// Sine and cosine of γ, and of a prismatic joint's turn as a whole; rounded up to whole columns.
    pub sin_offset: Vec<T>,
    pub cos_offset: Vec<T>,
    /// The degree of freedom in each slot, or [`EMPTY`]. Subtrees have contiguous slots, and no block of [`COLUMNS`] holds two
    /// neighbouring ones: a block can be moved as one with any subtree of which it has a part.
    pub slots: Vec<u32>,
    /// The same slots by blocks.
    pub blocks: Vec<Block>,
    /// Whether every entry of H is one of two degrees of freedom on one path.
    pub full: bool,
    /// By four rows of H: one more than the last degree of freedom that any of them has an entry with.
    pub reach: Vec<u32>,
    /// Where blocks of H begin that hold all zeros of the upper triangle, and other numbers besides.
    pub zeros: Vec<u32>,
    /// Nobody's degrees of freedom come before those of the body that carries it.
    pub ascending: bool,
    /// The longest path from the world, in bodies.
    pub depth: usize,
    /// What moments of inertia may lose in other axes than their bodies' own is not worth speaking of.
    pub stout: bool,
}

/// Slots of a block.
pub(crate) const COLUMNS: usize = MOST_COLUMNS;
/// Slots of a mechanism up to which rows of H are laid out in blocks. In longer chains, the axes of a root collect what every joint rounds.
pub(crate) const SMALL: usize = 64;
/// In a stout mechanism, no Σ m ρ² about a hinge is so many times the least moment of inertia that the hinge can feel.
const STOUT: f64 = 4096.0;
/// A slot without a degree of freedom.
pub(crate) const EMPTY: u32 = u32::MAX;

/// Slots side by side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Block {
    /// The degree of freedom in each slot; in a slot without one, that of the first.
    pub dofs: [u32; COLUMNS],
    /// How many numbers may go into a row of H as one, if degrees of freedom follow one another; else 0. All [`COLUMNS`] where the row
    /// goes on, and what stands there is zero or still to be written.
    pub run: u32,
}

/// A body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Member<T> {
    /// Slots of its subtree, its own first.
    pub slots: Range<u32>,
    /// Blocks of these slots, and where its own stand in the first.
    pub blocks: Range<u32>,
    pub lane: u32,
    /// Whether no slot after its own is taken in the last block of its own.
    pub last: bool,
    /// One more than the body that carries it, 0 for the world.
    pub parent: u32,
    /// Bodies on the path from the world, itself included. In pre-order, what stands in a row for a level is the ancestor's.
    pub level: u32,
    pub q0: u32,
    pub v0: u32,
    pub motion: MotionKind,
    pub twist: Twist,
    /// C, and the position of the joint, in the frame of the body that carries it.
    pub C: Mat3<T>,
    pub r: Vec3<T>,
    pub I: PseudoInertia<T>,
    /// Mass of the body with all that it carries.
    pub carried: T,
    pub place: Place,
    pub joint: Joint<T>,
}

impl<T> Member<T> {
    /// Where what this body carries is summed up, tips first: by level, but in the world's place where there is but one child, which comes
    /// just before. What is used next then stays close.
    #[inline(always)]
    pub fn own_sum(&self) -> usize {
        if self.place.branches { self.level as usize } else { 0 }
    }

    /// [`own_sum`](Self::own_sum) of the body that carries it.
    #[inline(always)]
    pub fn carrier_sum(&self) -> usize {
        if self.place.alone() { 0 } else { self.level as usize - 1 }
    }

    /// Whether it moves freely in the world.
    #[inline(always)]
    pub fn is_free_root(&self) -> bool {
        self.parent == 0 && matches!(self.joint, Joint::Floating)
    }
}

/// Where a body stands among those that its parent carries, and what it carries itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Place {
    /// Carries nothing.
    pub leaf: bool,
    /// Carries several bodies.
    pub branches: bool,
    /// Comes right after its parent.
    pub first: bool,
    /// No other child of its parent comes later.
    pub last: bool,
}

impl Place {
    /// Whether its parent carries nothing else.
    #[inline(always)]
    pub fn alone(self) -> bool {
        self.first && self.last
    }
}

/// How a body moves against the one that carries it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MotionKind {
    /// E = Rz(q + γ) C.
    Hinge,
    /// E = Rz(γ) C, then q along z.
    Slide,
    /// As its joint says, after C and r.
    Other,
}

impl<T: Real> Mechanism<T> {
    fn new(bodies: &[Body<T>]) -> Self {
        let mut frames = Frames::new(bodies);
        let nv: usize = bodies.iter().map(|body| body.joint.nv()).sum();
        let mut mechanism = Self {
            slots: Vec::new(),
            blocks: Vec::new(),
            reach: vec![0; nv.div_ceil(COLUMNS)],
            zeros: Vec::new(),
            full: false,
            ascending: true,
            depth: 0,
            stout: true,
            members: Vec::with_capacity(bodies.len()),
            angles: Vec::with_capacity(bodies.len()),
            sin_offset: Vec::with_capacity(bodies.len()),
            cos_offset: Vec::with_capacity(bodies.len()),
        };
        let chains = chains(bodies);
        for (i, body) in bodies.iter().enumerate() {
            let Standing { motion, offset, twist, C, r, I } = frames.place(bodies, i);
            let slots = &mut mechanism.slots;
            // A block is also left where what follows then takes no more of them: its rows have fewer.
            let (taken, rest) = (slots.len() % COLUMNS, chains[i]);
            let spare = (taken + rest).div_ceil(COLUMNS) > rest.div_ceil(COLUMNS);
            if spare || (i > 0 && body.parent() != Some(i - 1)) {
                slots.resize(slots.len().next_multiple_of(COLUMNS), EMPTY);
            }
            let first = slots.len() as u32;
            slots.extend(body.dofs().map(|d| d as u32));
            let level = 1 + body.parent().map_or(0, |p| mechanism.members[p].level);
            mechanism.depth = mechanism.depth.max(level as usize);
            mechanism.members.push(Member {
                slots: first..slots.len() as u32,
                blocks: 0..0,
                lane: first % COLUMNS as u32,
                last: true,
                parent: if body.parent == WORLD { 0 } else { body.parent + 1 },
                level,
                q0: body.q0,
                v0: body.v0,
                motion,
                twist,
                C,
                r,
                I,
                carried: body.I.m,
                place: Place {
                    leaf: true,
                    branches: false,
                    first: body.parent() == i.checked_sub(1),
                    last: true,
                },
                joint: body.joint,
            });
            let hinge = if motion == MotionKind::Hinge { Some(body.q0) } else { None };
            mechanism.angles.push(hinge.or(mechanism.angles.last().copied()).unwrap_or(0));
            mechanism.sin_offset.push(offset.0);
            mechanism.cos_offset.push(offset.1);
        }
        for i in (0..bodies.len()).rev() {
            if let Some(p) = bodies[i].parent() {
                let (end, carried) = (mechanism.members[i].slots.end, mechanism.members[i].carried);
                let parent = &mut mechanism.members[p];
                parent.slots.end = end.max(parent.slots.end);
                parent.carried += carried;
                // Seen from the end, the first child to come is the last.
                let last = parent.place.leaf;
                parent.place.branches = !parent.place.leaf;
                parent.place.leaf = false;
                mechanism.members[i].place.last = last;
            }
        }
        mechanism.slots.resize(mechanism.slots.len().next_multiple_of(COLUMNS), EMPTY);
        let whole = bodies.len().next_multiple_of(COLUMNS);
        mechanism.angles.resize(whole, mechanism.angles.last().copied().unwrap_or(0));
        mechanism.sin_offset.resize(whole, T::ZERO);
        mechanism.cos_offset.resize(whole, T::ONE);
        if mechanism.slots.len() <= SMALL {
            mechanism.lay_out_rows(nv);
            mechanism.stout = mechanism.thinness() <= STOUT;
        }
        mechanism
    }

    /// How many times what a hinge carries may outweigh, far out along its axis, what the hinge feels of it: the largest
    ///
    /// ```text
    /// Σ m ρ² / (I_zz + Σ λmin(I))        over what body i carries: ρ no less than the way there, I about each centre of mass
    /// ```
    /// H_dd is the difference of numbers as large as the one, where axes are not the body's own, and no less than the other.
    fn thinness(&self) -> f64 {
        /// Σ m, Σ m ρ and Σ m ρ² about a body's origin, and what its hinge feels at least.
        #[derive(Clone, Copy, Default)]
        struct Carried {
            m: f64,
            first: f64,
            second: f64,
            felt: f64,
        }
        let mut carried = vec![Carried::default(); self.members.len()];
        let mut worst = 0.0f64;
        for (i, member) in self.members.iter().enumerate().rev() {
            let (m, P) = (member.I.m.to_f64(), member.I.P.map(T::to_f64));
            let (second, least) = (P.xx + P.yy + P.zz, principal_moments(&member.I.rigid())[0].max(0.0));
            let all = &mut carried[i];
            (all.m, all.second) = (all.m + m, all.second + second);
            all.first += (m * second).max(0.0).sqrt();
            let own = if member.motion == MotionKind::Hinge { P.xx + P.yy } else { least };
            if !(member.motion == MotionKind::Slide || member.is_free_root() || all.second == 0.0) {
                worst = worst.max(all.second / (all.felt + own));
            }
            all.felt += least;
            let (all, way) = (*all, member.r.norm().to_f64());
            if let Some(parent) = (member.parent as usize).checked_sub(1) {
                let parent = &mut carried[parent];
                parent.m += all.m;
                parent.first += all.first + way * all.m;
                parent.second += all.second + way * (2.0 * all.first + way * all.m);
                parent.felt += all.felt;
            }
        }
        worst
    }

    /// Where the rows of H go.
    fn lay_out_rows(&mut self, nv: usize) {
        self.blocks = blocks(&self.slots, nv);
        let mut zero = vec![true; nv * nv];
        for m in &mut self.members {
            m.blocks = m.slots.start / COLUMNS as u32..m.slots.end.div_ceil(COLUMNS as u32);
            let subtree = &self.slots[m.slots.start as usize..m.slots.end as usize];
            let dofs = subtree.iter().filter(|&&dof| dof != EMPTY);
            let (v0, own) = (m.v0 as usize, m.joint.nv());
            self.ascending &= dofs.clone().all(|&dof| dof as usize >= v0);
            let after = m.slots.start as usize + own;
            m.last = after.is_multiple_of(COLUMNS) || self.slots[after] == EMPTY;
            for row in v0..v0 + own {
                dofs.clone().for_each(|&dof| zero[row * nv + dof as usize] = false);
            }
            let last = dofs.max().map_or(0, |&dof| dof + 1);
            for row in v0 / COLUMNS..(v0 + own).div_ceil(COLUMNS) {
                self.reach[row] = last.max(self.reach[row]);
            }
        }
        for row in 0..nv {
            let mut end = row * nv + row;
            for run in zero[end..(row + 1) * nv].chunk_by(|a, b| a == b) {
                let start = end;
                end += run.len();
                if run[0] {
                    // A mechanism with two branches has more than a block of entries.
                    let last = nv * nv - COLUMNS;
                    self.zeros.extend((start..end).step_by(COLUMNS).map(|start| start.min(last) as u32));
                }
            }
        }
        self.full = self.ascending && self.zeros.is_empty();
    }
}

/// Degrees of freedom of each body and of those that come right after it, one on the other.
fn chains<T: Real>(bodies: &[Body<T>]) -> Vec<usize> {
    let mut chains = vec![0; bodies.len()];
    for (i, body) in bodies.iter().enumerate().rev() {
        let next = bodies.get(i + 1).and_then(Body::parent) == Some(i);
        chains[i] = body.dofs().len() + if next { chains[i + 1] } else { 0 };
    }
    chains
}

fn blocks(slots: &[u32], nv: usize) -> Vec<Block> {
    let block = |(k, dofs): (usize, &[u32])| {
        let (first, count) = (dofs[0], dofs.iter().filter(|&&dof| dof != EMPTY).count());
        let consecutive = (first..).zip(&dofs[..count]).all(|(expected, &dof)| dof == expected);
        let written = &slots[..k * COLUMNS];
        let covered = (0..COLUMNS as u32).skip(count).any(|l| written.contains(&(first + l)));
        let fits = first as usize + COLUMNS <= nv;
        let run = match fits && !covered {
            _ if !consecutive => 0,
            true => COLUMNS,
            false => count,
        };
        let dof = |slot: usize| if slot < count { dofs[slot] } else { first };
        Block { dofs: [first, dof(1), dof(2), dof(3)], run: run as u32 }
    };
    slots.chunks_exact(COLUMNS).enumerate().map(block).collect()
}

#[cfg(test)]
mod tests {
    use super::{COLUMNS, EMPTY};
    use crate::joint::Joint;
    use crate::model::{Base, JointSpec, Model, ModelBuilder};
    use crate::spatial::{RigidInertia, Sym3, Vec3};

    /// `n` hinges one after the other.
    fn chain(n: usize, base: Base) -> Model<f64> {
        let rod = RigidInertia::from_com(1.0, Vec3::X, Sym3::ZERO);
        let mut robot = ModelBuilder::new("chain");
        let mut carrier = robot.link("base", rod);
        for k in 0..n {
            let link = robot.link(format!("link {k}"), rod);
            let hinge = JointSpec::new(format!("hinge {k}"), Joint::Revolute, carrier, link);
            robot.joint(hinge.about(Vec3::Z));
            carrier = link;
        }
        robot.build(base).unwrap()
    }

    /// No more blocks than there must be, and the last ones full: then the fewest rows reach into several.
    #[test]
    fn blocks_end_where_chains_end() {
        const E: u32 = EMPTY;
        for (n, base, slots) in [
            (3, Base::Fixed, vec![0, 1, 2, E]),
            (6, Base::Fixed, vec![0, 1, E, E, 2, 3, 4, 5]),
            (7, Base::Fixed, vec![0, 1, 2, E, 3, 4, 5, 6]),
            (8, Base::Fixed, vec![0, 1, 2, 3, 4, 5, 6, 7]),
            (3, Base::Floating, vec![0, 1, 2, 3, 4, 5, E, E, 6, 7, 8, E]),
            (6, Base::Floating, (0..12).collect()),
        ] {
            let mechanism = chain(n, base).mechanism().clone();
            assert_eq!(mechanism.slots, slots, "{n}, {base:?}");
            assert_eq!(mechanism.blocks.len(), slots.len() / COLUMNS);
        }
    }
}

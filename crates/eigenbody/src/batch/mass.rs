//! H of a group of configurations, one a lane.
//!
//! ```text
//! for i = N..1:   for each d of body i:     F_d = Ic_i S_d;   H_de = F_d · S_e   for the DoFs e of body i up to d
//!                 for each d of its subtree:   F_d = X_upᵀ F_d;  H_de = F_d · S_e   for the DoFs e of parent(i)
//! ```
//! As in [`dynamics`](crate::dynamics); but H is kept by columns that hold the subtree of their degree of freedom and nothing
//! else, in lanes, so that all of it stays close. Whole rows of the caller's matrices come of it at last, or it is used as it is.

use crate::dynamics::{Posture, position, slide};
use crate::joint::Column;
use crate::model::{Member, Model, MotionKind, with_twist};
use crate::scalar::{Real, Scalar, Wide};
use crate::spatial::{Force, Placed, PseudoInertia, Rotation, ThenZ};

/// Where the entries of H stand: made once for a batch.
#[derive(Debug)]
pub(super) struct Layout {
    pub nv: usize,
    /// By degree of freedom: its place in pre-order.
    rank: Vec<u32>,
    /// By body.
    subtree: Vec<Subtree>,
    /// By place in pre-order: where the column begins, with its entry on the diagonal.
    start: Vec<u32>,
    /// nv × nv: which entry stands there. The last one is zero.
    pub places: Vec<u32>,
    /// The lower triangle by rows, degrees of freedom in pre-order: which entry stands there.
    pub packed: Vec<u32>,
    /// By place in pre-order: the degree of freedom.
    order: Vec<u32>,
    /// How many entries all columns have, the zero not counted.
    pub entries: usize,
}

/// A body with all that it carries.
#[derive(Debug, Clone, Copy)]
struct Subtree {
    /// Places of its degrees of freedom in pre-order.
    first: u32,
    end: u32,
    /// The entry of the first of them with the first of its carrier's.
    row: u32,
}

impl Layout {
    pub fn new<T: Real>(model: &Model<T>) -> Self {
        let (nv, members) = (model.nv(), &model.mechanism.members);
        let order: Vec<usize> = model.dofs().order().collect();
        let mut rank = vec![0; nv];
        for (place, &d) in order.iter().enumerate() {
            rank[d] = place as u32;
        }
        let mut subtree: Vec<Subtree> = Vec::with_capacity(members.len());
        for m in members {
            let first = subtree.last().map_or(0, |last| last.end);
            subtree.push(Subtree { first, end: first + m.joint.nv() as u32, row: 0 });
        }
        let mut start = vec![0; nv];
        let mut ends = vec![0; nv];
        for (i, m) in members.iter().enumerate().rev() {
            let Subtree { first, end, .. } = subtree[i];
            let own = first as usize..first as usize + m.joint.nv();
            ends[own].fill(end);
            if let Some(p) = (m.parent as usize).checked_sub(1) {
                subtree[p].end = subtree[p].end.max(end);
            }
        }
        let mut entries = 0;
        for (place, start) in start.iter_mut().enumerate() {
            *start = entries;
            entries += ends[place] - place as u32;
        }
        for (i, m) in members.iter().enumerate() {
            if let Some(p) = (m.parent as usize).checked_sub(1) {
                let carrier = subtree[p].first;
                subtree[i].row =
                    start.get(carrier as usize).copied().unwrap_or(0) + subtree[i].first - carrier;
            }
        }
        let mut packed = vec![entries; nv * (nv + 1) / 2];
        let mut places = vec![entries; nv * nv];
        for (e, &end) in ends.iter().enumerate() {
            for d in e..end as usize {
                let entry = start[e] + (d - e) as u32;
                packed[d * (d + 1) / 2 + e] = entry;
                places[order[d] * nv + order[e]] = entry;
                places[order[e] * nv + order[d]] = entry;
            }
        }
        let order = order.into_iter().map(|d| d as u32).collect();
        Self { nv, rank, subtree, start, places, packed, order, entries: entries as usize }
    }

    /// Row and column of every entry.
    pub fn pairs(&self) -> Vec<(usize, usize)> {
        let ends = self.start.iter().skip(1).copied().chain([self.entries as u32]);
        let columns = self.start.iter().zip(ends).enumerate();
        let column =
            |(e, (&start, end)): (usize, (&u32, u32))| (0..(end - start) as usize).map(move |k| (e + k, e));
        let of = |(d, e): (usize, usize)| (self.order[d] as usize, self.order[e] as usize);
        columns.flat_map(column).map(of).collect()
    }

    /// Degrees of freedom in pre-order.
    pub fn order(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.iter().map(|&d| d as usize)
    }

    /// The entry on the diagonal, by place in pre-order.
    #[inline(always)]
    pub fn diagonal(&self, d: usize) -> usize {
        self.start[d] as usize
    }

    /// Entry H_de, d the later of the two in pre-order and in the subtree of e, by their places.
    #[inline(always)]
    fn entry(&self, d: usize, e: usize) -> usize {
        self.start[e] as usize + d - e
    }
}

/// Room for one group.
pub(super) struct Columns<W> {
    posture: Posture<W>,
    /// By level: inertia of all that a body carries, frozen.
    Ic: Vec<PseudoInertia<W>>,
    /// By place in pre-order: F, in the frame of the body that it has been carried to.
    F: Vec<Force<W>>,
    /// The entries, and a zero.
    pub H: Vec<W>,
}

impl<W: Wide> Columns<W> {
    pub fn new(model: &Model<W::Constant>, layout: &Layout) -> Self {
        Self {
            posture: Posture::new(&model.mechanism),
            Ic: vec![PseudoInertia::ZERO; model.mechanism.depth + 1],
            F: vec![Force::ZERO; layout.nv],
            H: vec![W::ZERO; (layout.entries + 1).max(W::WIDTH)],
        }
    }

    /// H at q.
    #[inline(always)]
    pub fn update(&mut self, model: &Model<W::Constant>, layout: &Layout, q: &[W]) {
        self.posture.update_shape::<W>(&model.mechanism, q);
        let members = &model.mechanism.members;
        for (i, m) in members.iter().enumerate().rev() {
            let mut Ic = m.I.map(W::constant);
            if !m.place.leaf {
                Ic += self.Ic[m.level as usize];
            }
            let subtree = layout.subtree[i];
            let (first, end) = (subtree.first as usize, subtree.end as usize);
            self.own_block(model, layout, m, Ic, first);
            let Some(p) = (m.parent as usize).checked_sub(1) else { continue };
            let (carrier, F) = (&members[p], &mut self.F[first..end]);
            // Where the carrier has one degree of freedom, its row of H is written on the way.
            let row = match carrier.motion {
                MotionKind::Other => None,
                motion => {
                    Some((motion == MotionKind::Slide, &mut self.H[subtree.row as usize..][..end - first]))
                }
            };
            let mut up = match m.motion {
                MotionKind::Hinge => {
                    let (turn, r) = (self.posture.turn::<W>(i), position::<W>(m));
                    with_twist!(m, C: W => carry(Placed { E: ThenZ { turn, first: C }, r }, Ic, F, row))
                }
                MotionKind::Slide => carry(slide::<W>(m, q), Ic, F, row),
                MotionKind::Other => carry(self.posture.placed::<W>(i), Ic, F, row),
            };
            if carrier.motion == MotionKind::Other {
                self.put_rows(layout, carrier, first, end);
            }
            let sum = &mut self.Ic[m.level as usize - 1];
            if !m.place.last {
                up += *sum;
            }
            *sum = up;
        }
    }

    /// The entries among a body's own degrees of freedom; each F = Ic S_d.
    #[inline(always)]
    fn own_block(
        &mut self,
        model: &Model<W::Constant>,
        layout: &Layout,
        m: &Member<W::Constant>,
        Ic: PseudoInertia<W>,
        first: usize,
    ) {
        let d = m.v0 as usize;
        let armature = W::constant(model.armature[d]);
        match m.motion {
            MotionKind::Hinge => {
                let F_d = Ic.times_ang_z();
                (self.H[layout.entry(first, first)], self.F[first]) = (F_d.ang.z + armature, F_d);
            }
            MotionKind::Slide => {
                let F_d = Ic.times_lin_z();
                (self.H[layout.entry(first, first)], self.F[first]) = (F_d.lin.z + armature, F_d);
            }
            MotionKind::Other => {
                let Ic = Ic.rigid();
                for (k, &column) in m.joint.columns().iter().enumerate() {
                    let S_d = self.posture.S[d + k];
                    let F_d = Ic.times(S_d);
                    for (l, &before) in m.joint.columns()[..k].iter().enumerate() {
                        let S_e = self.posture.S[d + l];
                        self.H[layout.entry(first + k, first + l)] = before.along(S_e, F_d);
                    }
                    let armature = W::constant(model.armature[d + k]);
                    self.H[layout.entry(first + k, first + k)] = column.along(S_d, F_d) + armature;
                    self.F[first + k] = F_d;
                }
            }
        }
    }

    /// The entries of a subtree's columns at the degrees of freedom of the body that carries it.
    #[inline(always)]
    fn put_rows(&mut self, layout: &Layout, carrier: &Member<W::Constant>, first: usize, end: usize) {
        let F = &self.F[first..end];
        for (e, &column) in (carrier.v0 as usize..).zip(carrier.joint.columns()) {
            let entry = layout.entry(first, layout.rank[e] as usize);
            let H = &mut self.H[entry..][..end - first];
            match column {
                Column::AngX => put::<0, W>(F, H),
                Column::AngY => put::<1, W>(F, H),
                Column::AngZ => put::<2, W>(F, H),
                Column::LinX => put::<3, W>(F, H),
                Column::LinY => put::<4, W>(F, H),
                Column::LinZ => put::<5, W>(F, H),
                Column::General => {
                    let S_e = self.posture.S[e];
                    for (H, &F) in H.iter_mut().zip(F) {
                        *H = S_e.dot(F);
                    }
                }
            }
        }
    }
}

/// Component K of every force.
#[inline(always)]
fn put<const K: usize, W: Scalar>(F: &[Force<W>], H: &mut [W]) {
    for (H, F) in H.iter_mut().zip(F) {
        *H = F.component::<K>();
    }
}

/// F = X_upᵀ F of every column of a subtree, and the row of H of a hinge or, if said so, a slide; returns the inertia as the body inwards
/// has it.
#[inline(always)]
fn carry<W: Scalar, R: Rotation<W>>(
    X_up: Placed<W, R>,
    Ic: PseudoInertia<W>,
    F: &mut [Force<W>],
    row: Option<(bool, &mut [W])>,
) -> PseudoInertia<W> {
    match row {
        Some((slide, H)) => {
            for (F, H) in F.iter_mut().zip(H) {
                *F = X_up.transpose_force(*F);
                *H = if slide { F.lin.z } else { F.ang.z };
            }
        }
        None => {
            for F in F {
                *F = X_up.transpose_force(*F);
            }
        }
    }
    X_up.transpose_pseudo(Ic)
}

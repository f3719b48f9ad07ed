//! H of a group of configurations, one a lane.
//!
//! ```text
//! for i = N..1:   for each d of body i, the last first:     F = Ic_i S_d;   H_de = F · S_e   for the DoFs e of body i up to d
//!                 for j = i, its carrier, and so on:        F = X_upᵀ F;    H_de = F · S_e   for the DoFs e of parent(j)
//! ```
//! Featherstone (2008), table 6.2, column by column: F stays in registers all the way to the root. What it leaves behind are rows of the
//! lower triangle without the zeros between branches, written from the end to the beginning. Whole rows of the caller's matrices come of
//! it at last, or it is used as it is.

use crate::dynamics::{Posture, position, slide};
use crate::joint::Column;
use crate::model::{Member, Model, MotionKind, with_turn, with_twist};
use crate::scalar::{Real, Wide};
use crate::spatial::{Force, Placed, PseudoInertia, ThenZ};

/// Where the entries of H stand: made once for a batch.
#[derive(Debug)]
pub(super) struct Layout {
    pub nv: usize,
    /// By place in pre-order: the degree of freedom.
    order: Vec<u32>,
    /// Row and column of every entry, by places in pre-order: row after row, each from the root to the diagonal.
    pairs: Vec<(u32, u32)>,
    /// By place in pre-order: the entry on the diagonal.
    diagonal: Vec<u32>,
    /// nv × nv: which entry stands there. The last one is zero.
    pub places: Vec<u32>,
    /// The lower triangle by rows, degrees of freedom in pre-order: which entry stands there.
    pub packed: Vec<u32>,
    /// How many entries there are, the zero not counted.
    pub entries: usize,
}

impl Layout {
    pub fn new<T: Real>(model: &Model<T>) -> Self {
        let (nv, members) = (model.nv(), &model.mechanism.members);
        let order: Vec<usize> = model.dofs().order().collect();
        // The columns of a body's last row, by level: those of its carrier, and its own.
        let mut paths: Vec<Vec<u32>> = vec![Vec::new()];
        let (mut pairs, mut diagonal) = (Vec::new(), Vec::new());
        for m in members {
            paths.truncate(m.level as usize);
            let mut path = paths.last().cloned().unwrap_or_default();
            for _ in 0..m.joint.nv() {
                let row = diagonal.len() as u32;
                path.push(row);
                pairs.extend(path.iter().map(|&column| (row, column)));
                diagonal.push(pairs.len() as u32 - 1);
            }
            paths.push(path);
        }
        let entries = pairs.len();
        let mut packed = vec![entries as u32; nv * (nv + 1) / 2];
        let mut places = vec![entries as u32; nv * nv];
        for (entry, &(row, column)) in (0..).zip(&pairs) {
            let (row, column) = (row as usize, column as usize);
            packed[row * (row + 1) / 2 + column] = entry;
            let (d, e) = (order[row], order[column]);
            places[d * nv + e] = entry;
            places[e * nv + d] = entry;
        }
        let order = order.into_iter().map(|d| d as u32).collect();
        Self { nv, order, pairs, diagonal, places, packed, entries }
    }

    /// Row and column of every entry.
    pub fn pairs(&self) -> Vec<(usize, usize)> {
        let dof = |place: u32| self.order[place as usize] as usize;
        self.pairs.iter().map(|&(row, column)| (dof(row), dof(column))).collect()
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

/// Room for one group.
pub(super) struct Rows<W: Wide> {
    posture: Posture<W>,
    /// By level: inertia of all that a body carries, frozen.
    Ic: Vec<PseudoInertia<W>>,
    /// The entries, and a zero.
    pub H: Vec<W>,
}

impl<W: Wide> Rows<W> {
    pub fn new(model: &Model<W::Constant>, layout: &Layout) -> Self {
        Self {
            posture: Posture::new(&model.mechanism),
            Ic: vec![PseudoInertia::ZERO; model.mechanism.depth + 1],
            H: vec![W::ZERO; (layout.entries + 1).max(W::WIDTH)],
        }
    }

    /// H at q.
    #[inline(always)]
    pub fn update(&mut self, model: &Model<W::Constant>, layout: &Layout, q: &[W]) {
        let Self { posture, Ic, H } = self;
        posture.update_shape::<W>(&model.mechanism, q);
        let (members, armature) = (model.mechanism.members.as_slice(), model.armature.as_slice());
        let (sin, cos) = (&posture.sin[..members.len()], &posture.cos[..members.len()]);
        let (Ic, H) = (&mut Ic[..model.mechanism.depth + 1], &mut H[..layout.entries]);
        let walk = Walk { members, posture, sin, cos, q };
        let mut end = H.len();
        for (i, m) in members.iter().enumerate().rev() {
            let mut Ic_i = m.I.map(W::constant);
            if !m.place.leaf {
                Ic_i += Ic[m.own_sum()];
            }
            let d = m.v0 as usize;
            match m.motion {
                MotionKind::Hinge | MotionKind::Slide => {
                    let slide = m.motion == MotionKind::Slide;
                    let F = if slide { Ic_i.times_lin_z() } else { Ic_i.times_ang_z() };
                    let diagonal = end - 1;
                    end = walk.from(i, F, H, end);
                    H[diagonal] += W::constant(armature[d]);
                }
                MotionKind::Other => {
                    let (Ic_i, columns) = (Ic_i.rigid(), m.joint.columns());
                    for (k, &column) in columns.iter().enumerate().rev() {
                        let S_d = posture.S[d + k];
                        let F = Ic_i.times(S_d);
                        end -= 1;
                        H[end] = column.along(S_d, F) + W::constant(armature[d + k]);
                        end = walk.along(d, &columns[..k], F, H, end);
                        end = walk.inwards(i, F, H, end);
                    }
                }
            }
            if m.parent == 0 {
                continue;
            }
            let mut up = match m.motion {
                MotionKind::Hinge => {
                    let (turn, r) = ((sin[i], cos[i]), position::<W>(m));
                    with_twist!(m, C: W => Placed { E: ThenZ { turn, first: C }, r }.transpose_pseudo(Ic_i))
                }
                MotionKind::Slide => {
                    with_turn!(m, C: W => slide::<W, _>(m, C, q).transpose_pseudo(Ic_i))
                }
                MotionKind::Other => posture.placed::<W>(i).transpose_pseudo(Ic_i),
            };
            let sum = &mut Ic[m.carrier_sum()];
            if !m.place.last {
                up += *sum;
            }
            *sum = up;
        }
    }
}

/// The ways of columns to the root. Entries are written before `end`, and where the next one ends is returned.
struct Walk<'a, W: Wide> {
    members: &'a [Member<W::Constant>],
    posture: &'a Posture<W>,
    sin: &'a [W],
    cos: &'a [W],
    q: &'a [W],
}

impl<W: Wide> Walk<'_, W> {
    /// The entries at body i and at all that carry it, of a column that has come to its frame.
    #[inline(always)]
    fn from(&self, mut i: usize, mut F: Force<W>, H: &mut [W], mut end: usize) -> usize {
        let Self { members, sin, cos, .. } = *self;
        loop {
            let m = &members[i];
            match m.motion {
                MotionKind::Hinge => {
                    end -= 1;
                    H[end] = F.ang.z;
                    if m.parent == 0 {
                        return end;
                    }
                    let (turn, r) = ((sin[i], cos[i]), position::<W>(m));
                    F = with_twist!(m, C: W => Placed { E: ThenZ { turn, first: C }, r }.transpose_force(F));
                }
                MotionKind::Slide => {
                    end -= 1;
                    H[end] = F.lin.z;
                    if m.parent == 0 {
                        return end;
                    }
                    F = with_turn!(m, C: W => slide::<W, _>(m, C, self.q).transpose_force(F));
                }
                MotionKind::Other => {
                    end = self.along(m.v0 as usize, m.joint.columns(), F, H, end);
                    if m.parent == 0 {
                        return end;
                    }
                    F = self.posture.placed::<W>(i).transpose_force(F);
                }
            }
            i = m.parent as usize - 1;
        }
    }

    /// The same without body i itself.
    #[inline(always)]
    fn inwards(&self, i: usize, F: Force<W>, H: &mut [W], end: usize) -> usize {
        match self.members[i].parent {
            0 => end,
            p => self.from(p as usize - 1, self.posture.placed::<W>(i).transpose_force(F), H, end),
        }
    }

    /// The entries at some degrees of freedom of a body, from d on.
    #[inline(always)]
    fn along(&self, d: usize, columns: &[Column], F: Force<W>, H: &mut [W], end: usize) -> usize {
        if columns.len() == 6 {
            let Force { ang, lin } = F;
            H[end - 6..end].copy_from_slice(&[ang.x, ang.y, ang.z, lin.x, lin.y, lin.z]);
            return end - 6;
        }
        let first = end - columns.len();
        for ((H_de, &column), &S_e) in H[first..end].iter_mut().zip(columns).zip(&self.posture.S[d..]) {
            *H_de = column.along(S_e, F);
        }
        first
    }
}

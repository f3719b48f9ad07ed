//! H of a group of configurations, one a lane.
//!
//! ```text
//! for i = N..1:   for each d of body i:         F_d = Ic_i S_d
//!                 for each d of its subtree:    H_de = F_d · S_e   for the DoFs e of body i up to d;   F_d = X_upᵀ F_d
//! ```
//! Featherstone (2008), table 6.2, all columns of a subtree at once: what is known of a joint is looked at once for all of them. H is kept
//! by rows of the upper triangle that hold the subtree of their degree of freedom and nothing else; and those of a free root, whose S is
//! 1, are the columns F that have come to it. What is done can leave piece by piece ([`Layout`]).

use super::layout::{Layout, Piece};
use super::limbs::SIX;
use crate::dynamics::{Posture, position, slide};
use crate::model::{Member, Model, MotionKind, with_turn, with_twist};
use crate::scalar::Wide;
use crate::spatial::{Force, Placed, PseudoInertia, Rotation, ThenZ, Vec3};

/// Room for one group.
pub(super) struct Columns<W: Wide> {
    posture: Posture<W>,
    /// By level: inertia of all that a body carries, frozen; of bodies that carry several.
    Ic: Vec<PseudoInertia<W>>,
    /// Six numbers for every column, F in the frame of the body that it has come to; then the rows, and a zero.
    numbers: Vec<W>,
}

impl<W: Wide> Columns<W> {
    pub fn new(model: &Model<W::Constant>, layout: &Layout) -> Self {
        Self {
            posture: Posture::new(model.mechanism()),
            Ic: vec![PseudoInertia::ZERO; model.mechanism().depth + 1],
            numbers: vec![W::ZERO; layout.numbers + W::WIDTH],
        }
    }

    /// All entries of H at q and a zero, of a layout of one piece.
    #[inline(always)]
    pub fn update(&mut self, model: &Model<W::Constant>, layout: &Layout, q: &[W]) -> &[W] {
        self.bend(model, q);
        match layout.pieces.first() {
            Some(all) => self.piece(model, layout, all, q),
            None => &self.numbers,
        }
    }

    /// To q.
    #[inline(always)]
    pub fn bend(&mut self, model: &Model<W::Constant>, q: &[W]) {
        self.posture.update_shape::<W>(model.mechanism(), q);
    }

    /// Entries of H where it has been bent to, all pieces before them done.
    #[inline(always)]
    pub fn piece(&mut self, model: &Model<W::Constant>, layout: &Layout, piece: &Piece, q: &[W]) -> &[W] {
        let Self { posture, Ic, numbers } = self;
        let (start, n) = (piece.bodies.start, piece.bodies.len());
        let members = &model.mechanism().members[start..][..n];
        let subtrees = &layout.subtrees[start..][..n];
        let (sin, cos) = (&posture.sin[start..][..n], &posture.cos[start..][..n]);
        let Ic = &mut Ic[..model.mechanism().depth + 1];
        let (columns, rows) = numbers.split_at_mut(piece.rows);
        let (columns, _) = columns.as_chunks_mut::<SIX>();
        // What the body just done hands down, if it is the only one on the next.
        let mut carried = PseudoInertia::ZERO;
        for k in (0..n).rev() {
            let (m, subtree) = (&members[k], &subtrees[k]);
            let mut Ic_i = m.I.map(W::constant);
            if m.place.branches {
                Ic_i += Ic[m.level as usize];
            } else if !m.place.leaf {
                Ic_i += carried;
            }
            let count = subtree.count as usize;
            let columns = &mut columns[subtree.column as usize..][..count];
            let rows = &mut rows[subtree.row as usize..];
            let mut up = match m.motion {
                MotionKind::Hinge => {
                    let H = &mut rows[..count];
                    let F_i = Ic_i.times_ang_z();
                    H[0] = F_i.ang.z;
                    if m.parent == 0 {
                        for d in 1..count {
                            H[d] = columns[d][2];
                        }
                        continue;
                    }
                    let (turn, r) = ((sin[k], cos[k]), position::<W>(m));
                    with_twist!(m, C: W => {
                        let X = Placed { E: ThenZ { turn, first: C }, r };
                        columns[0] = X.transpose_force(F_i).to_array();
                        for d in 1..count {
                            H[d] = columns[d][2];
                            columns[d] = X.transpose_force(force(&columns[d])).to_array();
                        }
                        X.transpose_pseudo(Ic_i)
                    })
                }
                MotionKind::Slide => {
                    columns[0] = Ic_i.times_lin_z().to_array();
                    for (H, F) in rows.iter_mut().zip(&*columns) {
                        *H = F[5];
                    }
                    if m.parent == 0 {
                        continue;
                    }
                    with_turn!(m, C: W => inwards(slide::<W, _>(m, C, q), columns, Ic_i))
                }
                MotionKind::Other if m.is_free_root() => {
                    let lower = Ic_i.articulated().rows();
                    let mut rows = rows.iter_mut();
                    for (d, row) in lower.iter().enumerate() {
                        for (&x, H) in row[..=d].iter().zip(rows.by_ref()) {
                            *H = x;
                        }
                    }
                    continue;
                }
                MotionKind::Other => {
                    own_rows(posture, m, Ic_i, columns, rows);
                    if m.parent == 0 {
                        continue;
                    }
                    inwards(posture.placed::<W>(start + k), columns, Ic_i)
                }
            };
            if m.place.alone() {
                carried = up;
                continue;
            }
            let sum = &mut Ic[m.level as usize - 1];
            if !m.place.last {
                up += *sum;
            }
            *sum = up;
        }
        for &(at, d) in &layout.armature[piece.armature.clone()] {
            numbers[at as usize] += W::constant(model.armature[d as usize]);
        }
        &numbers[piece.at.start..]
    }
}

#[inline(always)]
fn force<W: Wide>(&[nx, ny, nz, x, y, z]: &[W; SIX]) -> Force<W> {
    Force::new(Vec3::new(nx, ny, nz), Vec3::new(x, y, z))
}

/// Columns and inertia as the body inwards has them.
#[inline(always)]
fn inwards<W: Wide, R: Rotation<W>>(
    X: Placed<W, R>,
    columns: &mut [[W; SIX]],
    Ic: PseudoInertia<W>,
) -> PseudoInertia<W> {
    for F in columns {
        *F = X.transpose_force(force(F)).to_array();
    }
    X.transpose_pseudo(Ic)
}

/// Columns and rows of a body on a joint that is neither hinge nor slide.
#[inline(always)]
fn own_rows<W: Wide>(
    posture: &Posture<W>,
    m: &Member<W::Constant>,
    Ic: PseudoInertia<W>,
    columns: &mut [[W; SIX]],
    rows: &mut [W],
) {
    let Ic = Ic.rigid();
    let S = &posture.S[m.v0 as usize..][..m.joint.nv()];
    for (F, &S) in columns.iter_mut().zip(S) {
        *F = Ic.times(S).to_array();
    }
    let mut rows = rows.iter_mut();
    for (k, (&S, &column)) in S.iter().zip(m.joint.columns()).enumerate() {
        for (F, H) in columns[k..].iter().zip(rows.by_ref()) {
            *H = column.along(S, force(F));
        }
    }
}

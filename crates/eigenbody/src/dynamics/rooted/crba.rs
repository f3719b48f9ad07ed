//! Composite rigid bodies in the root's axes.
//!
//! ```text
//! for i = N..1:   F_d = Ic_i S_d                            into the columns that body i carries
//!                 H_de = S_d · F_e                          for d of body i and e of its subtree: a row of H
//!                 F_e: n += r × f                           for e of its subtree: to the parent's origin
//!                 Ic_p += Ic_i shifted by r
//! ```
//! Columns stand four in a block, and a row of H is written block by block. The lower triangle is the upper one, four by four.

use super::moments::Moments;
use super::{Stand, columns, combined, components, fits, stand};
use crate::dynamics::posture::Posture;
use crate::matrix::Rows;
use crate::model::{Block, Mechanism, Member, Model, MotionKind};
use crate::scalar::{Line, Quad, Real, Scalar};
use crate::spatial::Vec3;

/// Slots of a block.
const WIDTH: usize = 4;

/// Moment and force of four columns.
type Columns<T> = [[T; WIDTH]; 6];

/// Room for [`crba`]; empty for a mechanism that it does not suit.
#[derive(Debug, Clone)]
pub(in crate::dynamics) struct CrbaRoom<T> {
    /// N.
    stands: Vec<Stand<T>>,
    /// N: moments of what a body with several children carries, h first.
    waiting: Vec<Line<[[T; 4]; 4]>>,
    /// Columns of F by slot, each about the origin of the body that it has come to.
    F: Vec<Line<Columns<T>>>,
}

impl<T: Scalar> CrbaRoom<T> {
    pub fn new(mechanism: &Mechanism<T::Constant>) -> Self {
        let (n, blocks) = match fits::<T>(mechanism) {
            true => (mechanism.members.len(), mechanism.blocks.len()),
            false => (0, 0),
        };
        Self {
            stands: vec![Stand::ROOT; n],
            waiting: vec![Line([[T::ZERO; 4]; 4]); n],
            F: vec![Line([[T::ZERO; WIDTH]; 6]); blocks],
        }
    }
}

/// H of a mechanism whose degrees of freedom ascend: both triangles, or the upper one and something below it.
#[inline(always)]
pub(in crate::dynamics) fn crba<T: Real, Q: Quad<T>>(
    model: &Model<T>,
    posture: &Posture<T>,
    q: &[T],
    CrbaRoom { stands, waiting, F }: &mut CrbaRoom<T>,
    Rows { numbers: H, stride }: Rows<'_, T>,
    both: bool,
) {
    let Mechanism { members, blocks, reach, zeros, full, .. } = model.mechanism();
    match both {
        true if *full => (),
        true => H.fill(T::ZERO),
        false => clear::<T, Q>(zeros, H),
    }
    let (members, blocks, armature) = (members.as_slice(), blocks.as_slice(), model.armature.as_slice());
    let n = members.len();
    stand::<T, Q>(model.mechanism(), posture, q, stands);
    let (stands, waiting) = (&stands[..n], &mut waiting[..n]);
    let F = &mut F[..blocks.len()];
    let mut next = Moments { h: Q::ZERO, P: Vec3::ZERO };
    for (i, (m, at)) in members.iter().zip(stands).enumerate().rev() {
        let mut Ic = Moments::<Q>::own(m, at);
        if !m.place.leaf {
            Ic = Ic.plus(next);
            if m.place.branches {
                Ic = Ic.plus(load(&waiting[i].0));
            }
        }
        match m.motion {
            MotionKind::Hinge => {
                let (n, f) = (Ic.moment(&at.z), Q::from_slice(&at.z).cross(Ic.h));
                row::<T, Q, true>(m, at, n, f, armature, (F, blocks), (&mut *H, stride));
            }
            MotionKind::Slide => {
                let axis = Q::from_slice(&at.z);
                let (n, f) = (Ic.h.cross(axis), axis * Q::constant(m.carried));
                row::<T, Q, false>(m, at, n, f, armature, (F, blocks), (&mut *H, stride));
            }
            MotionKind::Other => {
                let (start, end) = (m.blocks.start as usize, m.blocks.end as usize);
                let (F, blocks) = (&mut F[start..end], &blocks[start..end]);
                if m.is_free_root() {
                    free_root::<T, Q>(m, &Ic, armature, (F, blocks), (&mut *H, stride));
                    continue;
                }
                let (S, r) = (columns(m, posture, at), components(&at.r));
                several::<T, Q>((model, m), S, &Ic, (F, blocks), (&mut *H, stride), r);
            }
        }
        if m.parent > 0 {
            let up = Ic.shifted(m.carried, &at.r);
            let p = m.parent as usize - 1;
            if m.place.first {
                next = up;
            } else {
                let up = if m.place.last { up } else { up.plus(load(&waiting[p].0)) };
                let Vec3 { x, y, z } = up.P;
                waiting[p].0 = [up.h.numbers(), x.numbers(), y.numbers(), z.numbers()];
            }
        }
    }
    if both {
        mirror::<T, Q>(H, stride, reach);
    }
}

/// The row of a hinge or a slide, and its column [n; f] with all that it carries, on to the parent.
#[inline(always)]
fn row<T: Real, Q: Quad<T>, const HINGE: bool>(
    m: &Member<T>,
    at: &Stand<T>,
    n: Q,
    f: Q,
    armature: &[T],
    (F, blocks): (&mut [Line<Columns<T>>], &[Block]),
    (H, stride): (&mut [T], usize),
) {
    let (d, start, end) = (m.v0 as usize, m.blocks.start as usize, m.blocks.end as usize);
    let (F, blocks, H) = (&mut F[..end], &blocks[..end], &mut H[d * stride..][..stride]);
    let (place, z, r) = (unit::<T, Q>(m.lane as usize), components(&at.z), components(&at.r));
    if start < end {
        let (n, f) = put(&mut F[start].0, m, place, n, f);
        write(
            &blocks[start],
            place.mul_add(Q::constant(armature[d]), combined(if HINGE { n } else { f }, z)),
            H,
        );
        carry(&mut F[start].0, n, f, r);
    }
    for k in start + 1..end {
        let (n, f) = load_columns::<T, Q>(&F[k].0);
        write(&blocks[k], combined(if HINGE { n } else { f }, z), H);
        carry(&mut F[k].0, n, f, r);
    }
}

/// The rows of a body with a joint of several degrees of freedom, or of an uncommon one.
#[inline(always)]
fn several<T: Real, Q: Quad<T>>(
    (model, m): (&Model<T>, &Member<T>),
    (S, count): ([(Q, Q); 6], usize),
    Ic: &Moments<Q>,
    (F, blocks): (&mut [Line<Columns<T>>], &[Block]),
    (H, stride): (&mut [T], usize),
    r: Vec3<Q>,
) {
    let (I, d, lane) = (Ic.rotational(), m.v0 as usize, m.lane as usize);
    let mut own = [(Q::ZERO, Q::ZERO); 3 * WIDTH];
    for (column, &(w, v)) in own[lane..].iter_mut().zip(&S[..count]) {
        let [wx, wy, wz, _] = w.each();
        let n = combined(I, Vec3::new(wx, wy, wz)) + Ic.h.cross(v);
        let f = v.mul_add(Q::constant(m.carried), w.cross(Ic.h));
        *column = (n, f);
    }
    put_all(F, m, &own);
    for (k, &(w, v)) in S[..count].iter().enumerate() {
        let (first, place) = ((lane + k) / WIDTH, (lane + k) % WIDTH);
        let H = &mut H[(d + k) * stride..][..stride];
        let mut armature = unit::<T, Q>(place) * Q::constant(model.armature[d + k]);
        let ([wx, wy, wz, _], [vx, vy, vz, _]) = (w.each(), v.each());
        let (w, v) = (Vec3::new(wx, wy, wz), Vec3::new(vx, vy, vz));
        for (Line(F), block) in F[first..].iter().zip(&blocks[first..]) {
            let (n, f) = load_columns::<T, Q>(F);
            write(block, combined(n, w) + combined(f, v) + armature, H);
            armature = Q::ZERO;
        }
    }
    if m.parent > 0 {
        for Line(F) in F {
            let (n, f) = load_columns::<T, Q>(F);
            carry(F, n, f, r);
        }
    }
}

/// The axes of a root are its own: where it moves freely, its columns are those of its inertia, and rows of H are rows of F.
#[inline(always)]
fn free_root<T: Real, Q: Quad<T>>(
    m: &Member<T>,
    Ic: &Moments<Q>,
    armature: &[T],
    (F, blocks): (&mut [Line<Columns<T>>], &[Block]),
    (H, stride): (&mut [T], usize),
) {
    let d = m.v0 as usize;
    let ([Line(first), Line(second), ..], &[a, b, c, d0, d1, d2]) = (&mut *F, &armature[d..][..6]) else {
        return;
    };
    let (I, mass, o) = (Ic.rotational(), m.carried, T::ZERO);
    let ([hx, hy, hz, _], [nx, ny, nz, _]) = (Ic.h.numbers(), (-Ic.h).numbers());
    *first = [
        unit::<T, Q>(0).mul_add(Q::constant(a), I.x).numbers(),
        (I.y + Q::of([o, b, o, hz])).numbers(),
        (I.z + Q::of([o, o, c, ny])).numbers(),
        [o, hz, ny, mass + d0],
        [nz, o, hx, o],
        [hy, nx, o, o],
    ];
    let (y, z) = (unit::<T, Q>(0), unit::<T, Q>(1));
    let own = [
        Q::of([nz, hy, o, o]),
        z * Q::constant(nx),
        y * Q::constant(hx),
        Q::ZERO,
        y * Q::constant(mass + d1),
        z * Q::constant(mass + d2),
    ];
    for (row, own) in second.iter_mut().zip(own) {
        let others = if m.last { Q::ZERO } else { Q::from_slice(row) };
        *row = (others + own).numbers();
    }
    let (row_0, H) = H[d * stride..].split_at_mut(stride);
    let (row_1, H) = H.split_at_mut(stride);
    let (row_2, H) = H.split_at_mut(stride);
    let (row_3, H) = H.split_at_mut(stride);
    let (row_4, H) = H.split_at_mut(stride);
    let row_5 = &mut H[..stride];
    for (Line([x0, x1, x2, x3, x4, x5]), block) in F.iter().zip(blocks) {
        write(block, Q::from_slice(x0), row_0);
        write(block, Q::from_slice(x1), row_1);
        write(block, Q::from_slice(x2), row_2);
        write(block, Q::from_slice(x3), row_3);
        write(block, Q::from_slice(x4), row_4);
        write(block, Q::from_slice(x5), row_5);
    }
}

/// The entries of a row of H at the slots of a block. Whatever it writes below the diagonal is written over later, or of no meaning.
#[inline(always)]
fn write<T: Real, Q: Quad<T>>(block: &Block, x: Q, H: &mut [T]) {
    let (first, run) = (block.dofs[0] as usize, block.run);
    if run == WIDTH as u32 {
        return x.to_slice(&mut H[first..first + WIDTH]);
    }
    let x = x.numbers();
    match run {
        3 => H[first..first + 3].copy_from_slice(&x[..3]),
        2 => H[first..first + 2].copy_from_slice(&x[..2]),
        1 => H[first] = x[0],
        _ => {
            // The first comes last: it stands in the place of those that are none.
            let [a, b, c, d] = block.dofs;
            H[d as usize] = x[3];
            H[c as usize] = x[2];
            H[b as usize] = x[1];
            H[a as usize] = x[0];
        }
    }
}

/// Zeros where there are any, and around them: all else is still to be written.
#[inline(always)]
fn clear<T: Real, Q: Quad<T>>(zeros: &[u32], H: &mut [T]) {
    for &start in zeros {
        Q::ZERO.to_slice(&mut H[start as usize..][..WIDTH]);
    }
}

/// The lower triangle from the upper. The last four by four may meet the one before: it writes the same there.
#[inline(always)]
fn mirror<T: Real, Q: Quad<T>>(H: &mut [T], n: usize, reach: &[u32]) {
    let Some(last) = n.checked_sub(WIDTH) else {
        for d in 0..n {
            for e in d + 1..n {
                H[e * n + d] = H[d * n + e];
            }
        }
        return;
    };
    for (d, &reach) in (0..n).step_by(WIDTH).zip(reach) {
        let d = d.min(last);
        let tile = symmetric(four::<T, Q>(&H[d * n + d..], n));
        put_four(tile, &mut H[d * n + d..], n);
        let (mut right, mut below) = (d * n + d, d * n + d);
        let end = d * n + last;
        for _ in (d + WIDTH..reach as usize).step_by(WIDTH) {
            // The last tile may overlap the one before it.
            let step = WIDTH.min(end - right);
            (right, below) = (right + step, below + step * n);
            let tile = Q::transpose(four(&H[right..], n));
            put_four(tile, &mut H[below..], n);
        }
    }
}

#[inline(always)]
fn put_four<T: Real, Q: Quad<T>>([x, y, z, w]: [Q; 4], H: &mut [T], n: usize) {
    let H = &mut H[..3 * n + WIDTH];
    x.to_slice(H);
    y.to_slice(&mut H[n..]);
    z.to_slice(&mut H[2 * n..]);
    w.to_slice(&mut H[3 * n..]);
}

#[inline(always)]
fn load<T: Real, Q: Quad<T>>([h, x, y, z]: &[[T; 4]; 4]) -> Moments<Q> {
    Moments { h: Q::from_slice(h), P: Vec3::new(Q::from_slice(x), Q::from_slice(y), Q::from_slice(z)) }
}

/// The first block with a column in its place, of which the forces are kept. Places of bodies further in are zero until they are reached.
#[inline(always)]
fn put<T: Real, Q: Quad<T>>(F: &mut Columns<T>, m: &Member<T>, here: Q, n: Q, f: Q) -> (Vec3<Q>, Vec3<Q>) {
    let ([nx, ny, nz, _], [fx, fy, fz, _]) = (n.each(), f.each());
    let (mut n, mut f) =
        (Vec3::new(here * nx, here * ny, here * nz), Vec3::new(here * fx, here * fy, here * fz));
    if !m.last {
        let (n0, f0) = load_columns::<T, Q>(F);
        (n, f) = (n + n0, f + f0);
    }
    [F[3], F[4], F[5]] = [f.x.numbers(), f.y.numbers(), f.z.numbers()];
    (n, f)
}

/// Columns from the first block on, from their places in it; all others are zero.
#[inline(always)]
fn put_all<T: Real, Q: Quad<T>>(F: &mut [Line<Columns<T>>], m: &Member<T>, columns: &[(Q, Q); 3 * WIDTH]) {
    let end = m.lane as usize + m.joint.nv();
    for (j, (Line(F), columns)) in
        F[..end.div_ceil(WIDTH)].iter_mut().zip(columns.chunks_exact(WIDTH)).enumerate()
    {
        let [a, b, c, d] = [columns[0], columns[1], columns[2], columns[3]];
        let [nx, ny, nz, _] = Q::transpose([a.0, b.0, c.0, d.0]);
        let [fx, fy, fz, _] = Q::transpose([a.1, b.1, c.1, d.1]);
        let alone = m.last || (j + 1) * WIDTH <= end;
        for (row, x) in F.iter_mut().zip([nx, ny, nz, fx, fy, fz]) {
            *row = if alone { x } else { x + Q::from_slice(row) }.numbers();
        }
    }
}

/// One in one place.
#[inline(always)]
fn unit<T: Real, Q: Quad<T>>(place: usize) -> Q {
    Q::from_slice(&Stand::<T>::UNITS[place % WIDTH])
}

/// Moments and forces, component by component.
#[inline(always)]
fn load_columns<T: Real, Q: Quad<T>>([nx, ny, nz, fx, fy, fz]: &Columns<T>) -> (Vec3<Q>, Vec3<Q>) {
    let n = Vec3::new(Q::from_slice(nx), Q::from_slice(ny), Q::from_slice(nz));
    (n, Vec3::new(Q::from_slice(fx), Q::from_slice(fy), Q::from_slice(fz)))
}

/// n + r × f.
#[inline(always)]
fn carry<T: Real, Q: Quad<T>>(F: &mut Columns<T>, n: Vec3<Q>, f: Vec3<Q>, r: Vec3<Q>) {
    F[0] = r.y.mul_add(f.z, r.z.mul_add(-f.y, n.x)).numbers();
    F[1] = r.z.mul_add(f.x, r.x.mul_add(-f.z, n.y)).numbers();
    F[2] = r.x.mul_add(f.y, r.y.mul_add(-f.x, n.z)).numbers();
}

/// Four numbers of each of four rows.
#[inline(always)]
fn four<T: Real, Q: Quad<T>>(U: &[T], stride: usize) -> [Q; 4] {
    let U = &U[..3 * stride + WIDTH];
    [
        Q::from_slice(U),
        Q::from_slice(&U[stride..]),
        Q::from_slice(&U[2 * stride..]),
        Q::from_slice(&U[3 * stride..]),
    ]
}

/// The upper triangle twice.
#[inline(always)]
fn symmetric<T: Real, Q: Quad<T>>([a, b, c, d]: [Q; 4]) -> [Q; 4] {
    let (x, y, z, w) = (a.numbers(), b.numbers(), c.numbers(), d.numbers());
    [a, Q::of([x[1], y[1], y[2], y[3]]), Q::of([x[2], y[2], z[2], z[3]]), Q::of([x[3], y[3], z[3], w[3]])]
}

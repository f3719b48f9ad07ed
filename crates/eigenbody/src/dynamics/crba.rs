//! The composite-rigid-body algorithm.
//!
//! ```text
//! H = 0
//! for i = N..1:   for each d of body i:     F_d = Ic_i S_d;   H_de = H_ed = F_d · S_e   for the DoFs e of body i up to d
//!                 for each d of its subtree:   F_d = X_upᵀ F_d;  H_de = H_ed = F_d · S_e   for the DoFs e of parent(i)
//!                 Ic_p += X_upᵀ Ic_i X_up                                           (Ic_i starts as I_i)
//! H_dd += armature_d
//! ```
//! Featherstone (2008), table 6.2, with all columns of a subtree carried inwards together, several at a time where the processor has
//! room for them side by side. Cost O(N·depth). Inertias are carried as moments of mass.

use super::posture::{Posture, position, slide};
use super::rooted;
use crate::error::{InputError, check_length};
use crate::matrix::{Matrix, Rows};
use crate::model::{EMPTY, Mechanism, Member, Model, MotionKind, Shape, with_twist};
use crate::scalar::{Algorithm, Quad, Real, Scalar, Unit, dispatch_one};
use crate::spatial::{Force, Motion, Placed, PseudoInertia, Rotation, Straight, ThenZ, Vec3};
use std::ops::Range;

/// Rows of F.
const ROWS: usize = 7;

/// Room for [`mass_matrix_into`].
#[derive(Debug, Clone)]
pub struct CrbaWorkspace<T> {
    pub(crate) shape: Shape,
    posture: Posture<T>,
    /// By level: inertia of all that a body carries, frozen. Written and read by the sweep.
    Ic: Vec<PseudoInertia<T>>,
    /// Seven rows, one number a slot: F of every degree of freedom, in the frame of the body that it has been carried to, and its product
    /// with a column of S.
    F: [Vec<T>; ROWS],
    rooted: rooted::CrbaRoom<T>,
}

impl<T: Scalar> CrbaWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T::Constant>) -> Self {
        Self {
            shape: model.shape,
            posture: Posture::new(model.mechanism()),
            Ic: vec![PseudoInertia::ZERO; model.mechanism().depth + 1],
            F: [0; ROWS].map(|_| vec![T::ZERO; model.mechanism().slots.len()]),
            rooted: rooted::CrbaRoom::new(model.mechanism()),
        }
    }
}

/// The joint-space inertia matrix H(q).
///
/// ```text
/// ½ vᵀ H v = kinetic energy      τ = H v̇ + C
/// ```
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq` | rad, m, unit quaternion |
/// | H (returned) | `nv` × `nv`, both triangles | kg m², kg m, kg |
///
/// Method: composite rigid bodies, Featherstone (2008) table 6.2. O(N·depth); allocates. Entries between DoFs on
/// different branches are exactly zero. Numerics: every entry to a few ε of √(H_dd H_ee). What overflows is
/// infinite or NaN, as IEEE 754 has it.
///
/// Errors: [`InputError`] if q does not fit the model, or nv exceeds [`DENSE_LIMIT`](crate::model::DENSE_LIMIT).
///
/// ```
/// use eigenbody::{Family, mass_matrix};
/// let arm = Family::slender_chain(2, 3.0, 1.0)?.model::<f64>()?;
/// // Two rods in line: I₁₁ = (m/3)(2l)³/l, as one rod of twice the length and mass.
/// assert!((mass_matrix(&arm, &[0.0, 0.0])?[(0, 0)] - 8.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "crba")]
#[doc(alias = "jsim")]
pub fn mass_matrix<T: Real>(model: &Model<T>, q: &[T]) -> Result<Matrix<T>, InputError> {
    model.check_dense()?;
    let mut H = Matrix::zeros(model.nv(), model.nv());
    mass_matrix_into(model, q, &mut CrbaWorkspace::new(model), &mut H)?;
    Ok(H)
}

/// [`mass_matrix`] into the caller's memory; allocates nothing.
///
/// Errors: [`InputError`] if q does not fit the model, or `H` is not nv × nv; [`InputError::OtherModel`] for the workspace.
pub fn mass_matrix_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut CrbaWorkspace<T>,
    H: &mut Matrix<T>,
) -> Result<(), InputError> {
    triangles(model, q, workspace, H, true)
}

/// The upper triangle of [`mass_matrix`] into the caller's memory, diagonal included; allocates nothing.
///
/// What comes to stand below the diagonal has no meaning. This is what a factorisation needs, and takes about a tenth less time.
///
/// Errors: as [`mass_matrix_into`].
///
/// ```
/// use eigenbody::dynamics::{CrbaWorkspace, mass_matrix_upper_into};
/// use eigenbody::{Family, Matrix, mass_matrix};
/// let arm = Family::hydra(3, 1.0, 0.4, 1.0)?.model::<f64>()?;
/// let mut U = Matrix::zeros(3, 3);
/// mass_matrix_upper_into(&arm, &[0.1, 0.2, 0.3], &mut CrbaWorkspace::new(&arm), &mut U)?;
/// assert_eq!(U[(0, 2)], mass_matrix(&arm, &[0.1, 0.2, 0.3])?[(2, 0)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn mass_matrix_upper_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut CrbaWorkspace<T>,
    H: &mut Matrix<T>,
) -> Result<(), InputError> {
    triangles(model, q, workspace, H, false)
}

/// Both triangles or the upper one, after a look at what is given.
#[inline]
fn triangles<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut CrbaWorkspace<T>,
    H: &mut Matrix<T>,
    both: bool,
) -> Result<(), InputError> {
    model.check_shape("workspace", workspace.shape)?;
    model.check_q(q)?;
    check_length("rows of H", H.rows(), model.nv())?;
    check_length("columns of H", H.cols(), model.nv())?;
    dispatch_one(Crba { model, q, workspace, H: H.as_rows(), both });
    Ok(())
}

/// The algorithm with its arguments, which have been checked.
pub(crate) struct Crba<'a, T> {
    pub model: &'a Model<T>,
    pub q: &'a [T],
    pub workspace: &'a mut CrbaWorkspace<T>,
    /// Rows of nv numbers or of as many rounded up to whole blocks, zero beyond nv.
    pub H: Rows<'a, T>,
    /// Both triangles, or the upper one alone.
    pub both: bool,
}

impl<T: Real> Algorithm<T> for Crba<'_, T> {
    type Output = ();
    const UNIT: Unit = Unit::Avx512;
    #[inline(always)]
    fn run<S: Scalar<Constant = T, Stored = T>>(self) {
        let Self { model, q, workspace, mut H, .. } = self;
        H.numbers.fill(T::ZERO);
        crba::<T, S>(model, q, workspace, &mut H);
    }
    #[inline(always)]
    fn run_in_fours<S: Scalar<Constant = T, Stored = T, Columns: Quad<T>>>(self) {
        if !(rooted::suits::<T>(self.model.mechanism()) && self.model.mechanism().ascending) {
            return self.run::<S>();
        }
        let Self { model, q, workspace: CrbaWorkspace { posture, rooted, .. }, H, both } = self;
        posture.update_shape::<S>(model.mechanism(), q);
        rooted::crba::<T, S::Columns>(model, posture, q, rooted, H, both);
    }
}

/// H_de on both sides of the diagonal.
#[inline(always)]
fn put<T: Real>(H: &mut Rows<'_, T>, d: usize, e: usize, H_de: T) {
    H.numbers[d * H.stride + e] = H_de;
    H.numbers[e * H.stride + d] = H_de;
}

/// Position pass and the loop over bodies. Entries between branches are not put.
#[inline(always)]
fn crba<T: Real, S: Scalar<Constant = T, Stored = T>>(
    model: &Model<T>,
    q: &[T],
    CrbaWorkspace { posture, Ic, F, .. }: &mut CrbaWorkspace<T>,
    H: &mut Rows<'_, T>,
) {
    let Mechanism { members, slots, .. } = model.mechanism();
    posture.update_shape::<S>(model.mechanism(), q);
    for (i, m) in members.iter().enumerate().rev() {
        let mut Ic_i = m.I.map(S::constant);
        if !m.place.leaf {
            Ic_i += Ic[m.own_sum()].map(S::load);
        }
        own_block::<T, S>(model, posture, m, Ic_i, F, H);
        if m.parent == 0 {
            continue;
        }
        let mut up = match m.motion {
            MotionKind::Hinge => {
                let (turn, r) = (posture.turn::<S>(i), position::<S>(m));
                let turns = (turn.0.spread(), turn.1.spread());
                with_twist!(m, C: S, Cs: S::Columns => {
                    carry::<S, _>(m, Placed { E: ThenZ { turn: turns, first: Cs }, r: r.map(S::spread) }, F);
                    Placed { E: ThenZ { turn, first: C }, r }.transpose_pseudo(Ic_i)
                })
            }
            MotionKind::Slide | MotionKind::Other => {
                let X = match m.motion {
                    MotionKind::Slide => {
                        Placed { E: m.C.map(S::constant), r: slide::<S, _>(m, Straight, q).r }
                    }
                    _ => posture.placed::<S>(i),
                };
                carry::<S, _>(m, X.spread(), F);
                X.transpose_pseudo(Ic_i)
            }
        };
        put_rows::<T, S>(posture, slots, m, &members[m.parent as usize - 1], F, H);
        let sum = &mut Ic[m.carrier_sum()];
        if !m.place.last {
            up += sum.map(S::load);
        }
        *sum = up.map(S::store);
    }
}

/// The entries among a body's own degrees of freedom; each F = Ic S_d into its slot.
#[inline(always)]
fn own_block<T: Real, S: Scalar<Constant = T, Stored = T>>(
    model: &Model<T>,
    posture: &Posture<T>,
    m: &Member<T>,
    Ic: PseudoInertia<S>,
    F: &mut [Vec<T>; ROWS],
    H: &mut Rows<'_, T>,
) {
    let d = m.v0 as usize;
    let armature = |d: usize| S::constant(model.armature[d]);
    match m.motion {
        MotionKind::Hinge => {
            let F_d = Ic.times_ang_z();
            put(H, d, d, (F_d.ang.z + armature(d)).store());
            put_column::<S>(F, m.slots.start as usize, F_d);
        }
        MotionKind::Slide => {
            let F_d = Ic.times_lin_z();
            put(H, d, d, (F_d.lin.z + armature(d)).store());
            put_column::<S>(F, m.slots.start as usize, F_d);
        }
        MotionKind::Other => {
            let Ic = Ic.rigid();
            for (k, &column) in m.joint.columns().iter().enumerate() {
                let d = d + k;
                let S_d = posture.S[d].map(S::load);
                let F_d = Ic.times(S_d);
                for (e, &before) in (m.v0 as usize..d).zip(m.joint.columns()) {
                    put(H, d, e, before.along(posture.S[e].map(S::load), F_d).store());
                }
                put(H, d, d, (column.along(S_d, F_d) + armature(d)).store());
                put_column::<S>(F, m.slots.start as usize + k, F_d);
            }
        }
    }
}

/// A force into its slot.
#[inline(always)]
fn put_column<S: Scalar>(F: &mut [Vec<S::Stored>; ROWS], slot: usize, F_d: Force<S>) {
    for (row, x) in F.iter_mut().zip(F_d.map(S::store).to_array()) {
        row[slot] = x;
    }
}

/// F = X_upᵀ F of every column of a subtree, block by block.
#[inline(always)]
fn carry<S: Scalar, R: Rotation<S::Columns>>(
    m: &Member<S::Constant>,
    X_up: Placed<S::Columns, R>,
    [nx, ny, nz, fx, fy, fz, _]: &mut [Vec<S::Stored>; ROWS],
) {
    // Whole blocks: a slot of a body further in is not yet written, and comes to no harm.
    let width = S::COLUMNS;
    let (start, end) = (m.slots.start as usize, m.slots.end as usize);
    let blocks = start - start % width..end.next_multiple_of(width);
    let (nx, ny, nz) = (&mut nx[blocks.clone()], &mut ny[blocks.clone()], &mut nz[blocks.clone()]);
    let (fx, fy, fz) = (&mut fx[blocks.clone()], &mut fy[blocks.clone()], &mut fz[blocks]);
    let angular = nx.chunks_exact_mut(width).zip(ny.chunks_exact_mut(width)).zip(nz.chunks_exact_mut(width));
    let linear = fx.chunks_exact_mut(width).zip(fy.chunks_exact_mut(width)).zip(fz.chunks_exact_mut(width));
    for (((nx, ny), nz), ((fx, fy), fz)) in angular.zip(linear) {
        let ang = Vec3::new(S::load_columns(nx), S::load_columns(ny), S::load_columns(nz));
        let lin = Vec3::new(S::load_columns(fx), S::load_columns(fy), S::load_columns(fz));
        let Force { ang, lin } = X_up.transpose_force(Force { ang, lin });
        S::store_columns(ang.x, nx);
        S::store_columns(ang.y, ny);
        S::store_columns(ang.z, nz);
        S::store_columns(lin.x, fx);
        S::store_columns(lin.y, fy);
        S::store_columns(lin.z, fz);
    }
}

/// The entries of a subtree's columns at the degrees of freedom of the body that carries it.
#[inline(always)]
fn put_rows<T: Real, S: Scalar<Constant = T, Stored = T>>(
    posture: &Posture<T>,
    slots: &[u32],
    m: &Member<T>,
    carrier: &Member<T>,
    F: &mut [Vec<T>; ROWS],
    H: &mut Rows<'_, T>,
) {
    let range = m.slots.start as usize..m.slots.end as usize;
    for (e, &column) in (carrier.v0 as usize..).zip(carrier.joint.columns()) {
        let place = column.place().unwrap_or_else(|| {
            product::<S>(F, range.clone(), posture.S[e].map(S::load));
            ROWS - 1
        });
        for (&d, &H_de) in slots[range.clone()].iter().zip(&F[place][range.clone()]) {
            if d != EMPTY {
                put(H, d as usize, e, H_de);
            }
        }
    }
}

/// Sᵀ F of some slots into the last row.
#[inline(always)]
fn product<S: Scalar>(F: &mut [Vec<S::Stored>; ROWS], range: Range<usize>, S_e: Motion<S>) {
    for slot in range {
        let row = |k: usize| S::load(F[k][slot]);
        let (ang, lin) = (Vec3::new(row(0), row(1), row(2)), Vec3::new(row(3), row(4), row(5)));
        F[ROWS - 1][slot] = S_e.dot(Force { ang, lin }).store();
    }
}

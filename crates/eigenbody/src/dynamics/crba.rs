//! The composite-rigid-body algorithm.
//!
//! ```text
//! H = 0
//! for i = N..1:   Ic_p += X_upᵀ Ic_i X_up                (Ic_i starts as I_i)
//! for each d of body i:
//!     F = Ic_i S_d
//!     H_de = H_ed = F · S_e        for the DoFs e of body i up to d
//!     for j = i, parent(i), ..:    F = X_up_jᵀ F;   H_de = H_ed = F · S_e   for the DoFs e of parent(j)
//! H_dd += armature_d
//! ```
//! Featherstone (2008), table 6.2. Cost O(N·depth). Inertias are carried as moments of mass.

use super::posture::{Posture, position, slide};
use super::rnea::check_out;
use crate::error::InputError;
use crate::matrix::Matrix;
use crate::model::{Mechanism, Member, Model, MotionKind, with_twist};
use crate::scalar::{Algorithm, Real, Scalar, dispatch_one};
use crate::spatial::{Force, Placed, PseudoInertia, ThenZ};

/// Room for [`mass_matrix_into`].
#[derive(Debug, Clone)]
pub struct CrbaWorkspace<T> {
    posture: Posture<T>,
    /// N + 1, the world first: inertia of each body with all that it carries, frozen. Accumulated backwards.
    Ic: Vec<PseudoInertia<T>>,
}

impl<T: Scalar> CrbaWorkspace<T> {
    /// Room for a model.
    pub fn new(model: &Model<T::Constant>) -> Self {
        Self {
            posture: Posture::new(&model.mechanism),
            Ic: vec![PseudoInertia::ZERO; model.bodies.len() + 1],
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
/// different branches are exactly zero. Numerics: every entry to a few ε of √(H_dd H_ee).
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
/// Errors: as [`mass_matrix`], and if `H` is not nv × nv.
pub fn mass_matrix_into<T: Real>(
    model: &Model<T>,
    q: &[T],
    workspace: &mut CrbaWorkspace<T>,
    H: &mut Matrix<T>,
) -> Result<(), InputError> {
    model.check_q(q)?;
    check_out("rows of H", H.rows(), model.nv())?;
    check_out("columns of H", H.cols(), model.nv())?;
    H.fill(T::ZERO);
    dispatch_one(Crba { model, q, workspace, H });
    Ok(())
}

struct Crba<'a, T> {
    model: &'a Model<T>,
    q: &'a [T],
    workspace: &'a mut CrbaWorkspace<T>,
    H: &'a mut Matrix<T>,
}

impl<T: Real> Algorithm<T> for Crba<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run<S: Scalar<Constant = T, Stored = T>>(self) {
        let Self { model, q, workspace, H } = self;
        crba::<S, _>(model, q, workspace, H);
    }
}

/// Where the entries of H go, each once, those below the diagonal only.
pub(super) trait Entries<T> {
    /// H_de.
    fn put(&mut self, d: usize, e: usize, H_de: T);
}

impl<T: Real> Entries<T> for Matrix<T> {
    #[inline(always)]
    fn put(&mut self, d: usize, e: usize, H_de: T) {
        self[(d, e)] = H_de;
        self[(e, d)] = H_de;
    }
}

/// Position pass and both loops. Entries between branches are not put.
#[inline(always)]
pub(super) fn crba<S: Scalar, H: Entries<S::Stored>>(
    model: &Model<S::Constant>,
    q: &[S::Stored],
    CrbaWorkspace { posture, Ic }: &mut CrbaWorkspace<S::Stored>,
    H: &mut H,
) {
    let Mechanism { members, .. } = &model.mechanism;
    posture.update::<S>(&model.mechanism, q);
    for (Ic, m) in Ic[1..].iter_mut().zip(members) {
        *Ic = m.I.map(S::Stored::constant);
    }
    for (i, m) in members.iter().enumerate().rev() {
        let Ic_i = Ic[i + 1].map(S::load);
        if m.parent > 0 {
            let up = match m.motion {
                MotionKind::Hinge => {
                    let (turn, r) = (posture.turn::<S>(i), position::<S>(m));
                    with_twist!(m, S, C => Placed { E: ThenZ { turn, first: C }, r }.transpose_pseudo(Ic_i))
                }
                MotionKind::Slide => {
                    slide::<S>(m).transpose_pseudo(Ic_i.shifted_along_z(S::load(q[m.q0 as usize])))
                }
                MotionKind::Other => posture.placed::<S>(i).transpose_pseudo(Ic_i),
            };
            let p = m.parent as usize;
            Ic[p] = (Ic[p].map(S::load) + up).map(S::store);
        }
        let d = m.v0 as usize;
        let armature = S::constant(model.armature[d]);
        match m.motion {
            MotionKind::Hinge => {
                let F = Ic_i.times_ang_z();
                H.put(d, d, (F.ang.z + armature).store());
                ascend::<S, _>(members, posture, q, i, d, F, H);
            }
            MotionKind::Slide => {
                let F = Ic_i.times_lin_z();
                H.put(d, d, (F.lin.z + armature).store());
                ascend::<S, _>(members, posture, q, i, d, F, H);
            }
            MotionKind::Other => {
                for d in d..d + m.joint.nv() {
                    let S_d = posture.S[d].map(S::load);
                    let F = Ic_i.rigid().times(S_d);
                    put_row::<S, _>(posture, m, d, F, H);
                    H.put(d, d, (S_d.dot(F) + S::constant(model.armature[d])).store());
                    ascend::<S, _>(members, posture, q, i, d, F, H);
                }
            }
        }
    }
}

/// F = X_upᵀ F from body i to the root, with the entries of row d on the way.
#[inline(always)]
fn ascend<S: Scalar, H: Entries<S::Stored>>(
    members: &[Member<S::Constant>],
    posture: &Posture<S::Stored>,
    q: &[S::Stored],
    mut i: usize,
    d: usize,
    mut F: Force<S>,
    H: &mut H,
) {
    loop {
        let m = &members[i];
        if m.parent == 0 {
            return;
        }
        F = match m.motion {
            MotionKind::Hinge => {
                let (turn, r) = (posture.turn::<S>(i), position::<S>(m));
                with_twist!(m, S, C => Placed { E: ThenZ { turn, first: C }, r }.transpose_force(F))
            }
            MotionKind::Slide => slide::<S>(m).transpose_force(F.shifted_along_z(S::load(q[m.q0 as usize]))),
            MotionKind::Other => posture.placed::<S>(i).transpose_force(F),
        };
        i = m.parent as usize - 1;
        let p = &members[i];
        match p.motion {
            MotionKind::Hinge => H.put(d, p.v0 as usize, F.ang.z.store()),
            MotionKind::Slide => H.put(d, p.v0 as usize, F.lin.z.store()),
            MotionKind::Other => put_row::<S, _>(posture, p, d, F, H),
        }
    }
}

/// The entries of row d at the DoFs of body m up to d.
#[inline(always)]
fn put_row<S: Scalar, H: Entries<S::Stored>>(
    posture: &Posture<S::Stored>,
    m: &Member<S::Constant>,
    d: usize,
    F: Force<S>,
    H: &mut H,
) {
    for (e, &column) in (m.v0 as usize..).zip(m.joint.columns()) {
        if e == d {
            break;
        }
        H.put(d, e, column.along(posture.S[e].map(S::load), F).store());
    }
}

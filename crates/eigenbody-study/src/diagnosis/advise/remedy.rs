//! What may be changed: unknowns on which H depends linearly.
//!
//! ```text
//! armature    xᵀ∂H x = x_d²                                                  cost 1/median H_dd
//! a link      matter added about its centre of mass: δm ≥ 0, δΣ ≽ 0 (second moment, 3 × 3), δI = tr(δΣ) 1 − δΣ
//!             xᵀ∂H x = |u|² δm + tr(δΣ)|ω|² − ωᵀδΣω                          cost δm/m + tr(δΣ)/tr(Σ)
//! ```
//! With δm ≥ 0 and δΣ ≽ 0 the link's pseudo-inertia stays positive definite (Wensing, Kim & Slotine 2018): what is added is matter.

use super::programme::Cut;
use super::{Found, Judge};
use crate::StudyError;
use eigenbody::dynamics::{energy_shares, inertial_gradient};
use eigenbody::model::Random;
use eigenbody::search::{Domain, Evaluator};
use eigenbody::spatial::{RigidInertia, Sym3};
use eigenbody::spectrum::eigen;
use eigenbody::{Matrix, Metric, Model, Reduction};

/// Second moments of this length squared and a thousandth of the robot's mass are no small change for any link (m).
const LEAST_LENGTH: f64 = 0.01;
const LEAST_MASS: f64 = 1e-3;

/// One kind of change.
pub(super) enum Remedy {
    /// Armature on every DoF of the study: the DoF, and the median of H_dd.
    Armature(Vec<usize>, Vec<f64>),
    /// Matter on one body: mass, then xx, yy, zz, xy, xz, yz of Σ along the link's axes; the mass and tr Σ it is measured against.
    Matter { body: usize, mass: f64, spread: f64 },
}

impl Remedy {
    pub fn armature(model: &Model<f64>, judge: &Judge<'_>) -> Result<Self, StudyError> {
        let reduction = judge.wish.reduction;
        let rows = reduction.dofs(model);
        let domain = Domain::new(model, reduction.mimic);
        let mut diagonals: Vec<Vec<f64>> = vec![Vec::new(); rows.len()];
        let mut random = Random::new(u64::from(judge.effort.seed));
        for _ in 0..33 {
            let u: Vec<f64> = (0..domain.dimensions()).map(|_| random.uniform()).collect();
            let H = reduction.mass_matrix(model, &domain.configuration(&domain.point(&u)))?;
            diagonals.iter_mut().enumerate().for_each(|(d, own)| own.push(H[(d, d)]));
        }
        let largest = diagonals.iter().flatten().fold(0.0f64, |m, &h| m.max(h));
        let median = |mut own: Vec<f64>| {
            own.sort_by(f64::total_cmp);
            // A joint without inertia has no size of its own.
            own[own.len() / 2].max(1e-9 * largest)
        };
        Ok(Self::Armature(rows, diagonals.into_iter().map(median).collect()))
    }

    pub fn matter(model: &Model<f64>, body: usize) -> Self {
        let total: f64 = model.bodies().iter().map(|body| body.inertia().m).sum();
        let (m, _, I) = model.bodies()[body].inertia().central();
        let mass = m.max(LEAST_MASS * total);
        let spread = (0.5 * (I.xx + I.yy + I.zz)).max(mass * LEAST_LENGTH * LEAST_LENGTH);
        Self::Matter { body, mass, spread }
    }

    /// The objective.
    pub fn costs(&self) -> Vec<f64> {
        match self {
            Self::Armature(_, size) => size.iter().map(|size| 1.0 / size).collect(),
            Self::Matter { mass, spread, .. } => {
                let s = 1.0 / spread;
                vec![1.0 / mass, s, s, s, 0.0, 0.0, 0.0]
            }
        }
    }

    /// Units in which unknowns are of the order of one.
    pub fn scales(&self) -> Vec<f64> {
        match self {
            Self::Armature(_, size) => size.clone(),
            Self::Matter { mass, spread, .. } => [&[*mass][..], &[*spread; 6]].concat(),
        }
    }

    /// Whether only one link changes.
    pub fn is_of_one_link(&self) -> bool {
        matches!(self, Self::Matter { .. })
    }

    /// Whether an unknown may be below zero.
    pub fn is_free(&self, k: usize) -> bool {
        self.is_of_one_link() && k >= 4
    }

    /// Rows that hold from the start: Σ_aa + Σ_bb ± 2Σ_ab ≥ 0.
    pub fn first_cuts(&self) -> Vec<Cut> {
        let Self::Matter { .. } = self else { return Vec::new() };
        let pairs = [(1, 2, 4), (1, 3, 5), (2, 3, 6)];
        let row = |(a, b, off): (usize, usize, usize), sign: f64| {
            let mut c = vec![0.0; 7];
            (c[a], c[b], c[off]) = (1.0, 1.0, 2.0 * sign);
            Cut { c, b: 0.0 }
        };
        pairs.into_iter().flat_map(|pair| [row(pair, 1.0), row(pair, -1.0)]).collect()
    }

    /// uᵀδΣu ≥ 0 for the direction in which it is below.
    pub fn cone_cut(&self, z: &[f64]) -> Option<Cut> {
        let Self::Matter { .. } = self else { return None };
        let (least, u) = least_moment(z)?;
        let trace = z[1] + z[2] + z[3];
        if least >= -1e-6 * trace {
            return None;
        }
        let c = vec![
            0.0,
            u[0] * u[0],
            u[1] * u[1],
            u[2] * u[2],
            2.0 * u[0] * u[1],
            2.0 * u[0] * u[2],
            2.0 * u[1] * u[2],
        ];
        Some(Cut { c, b: 0.0 })
    }

    /// xᵀ ∂H x by each unknown.
    pub fn response(
        &self,
        model: &Model<f64>,
        evaluator: &Evaluator<'_>,
        q: &[f64],
        x: &[f64],
    ) -> Result<Vec<f64>, StudyError> {
        match self {
            Self::Armature(..) => Ok(x.iter().map(|x| x * x).collect()),
            Self::Matter { body, .. } => {
                let of = inertial_gradient(model, q, &evaluator.motion(q, x)?)?[*body];
                let w = of.of_I;
                let (a, b, c) = (w.xx, w.yy, w.zz);
                Ok(vec![of.of_m, b + c, a + c, a + b, -w.xy, -w.xz, -w.yz])
            }
        }
    }

    /// The robot with a change.
    pub fn applied(&self, model: &Model<f64>, z: &[f64]) -> Result<Model<f64>, StudyError> {
        match self {
            Self::Armature(rows, _) => {
                let mut armature = model.armature().to_vec();
                rows.iter().zip(z).for_each(|(&d, z)| armature[d] += z);
                Ok(model.clone().with_armature(armature)?)
            }
            Self::Matter { body, .. } => {
                let link = model.bodies()[*body].link();
                let now = own(model, *body);
                let (m, c, I) = now.central();
                let inertia = RigidInertia::from_com(m + z[0], c, I + inertia_of(z));
                Ok(model.clone().with_inertia(link, inertia)?)
            }
        }
    }
}

/// A body's inertia about its link's origin, on its link's axes.
fn own(model: &Model<f64>, body: usize) -> RigidInertia<f64> {
    let body = &model.bodies()[body];
    model.links()[body.link()].link_from_body().inverse().transpose_rigid(*body.inertia())
}

/// δI = tr(δΣ) 1 − δΣ, δΣ lifted to what is no less than zero: the programme is exact to a millionth.
fn inertia_of(z: &[f64]) -> Sym3<f64> {
    let lift = least_moment(z).map_or(0.0, |(least, _)| (-least).max(0.0));
    let (a, b, c) = (z[1] + lift, z[2] + lift, z[3] + lift);
    Sym3 { xx: b + c, yy: a + c, zz: a + b, xy: -z[4], xz: -z[5], yz: -z[6] }
}

/// The least eigenvalue of δΣ and its direction.
fn least_moment(z: &[f64]) -> Option<(f64, Vec<f64>)> {
    let S = [[z[1], z[4], z[5]], [z[4], z[2], z[6]], [z[5], z[6], z[3]]];
    let pairs = eigen(&Matrix::from_fn(3, 3, |i, j| S[i][j]), &[1.0; 3]).ok()?;
    Some((pairs.values[0], pairs.vectors.row(0).to_vec()))
}

/// Bodies by their share of a motion's energy, the largest first, those of a hundredth and more, and what lies between them and the
/// joints of the motion that has no mass.
pub(super) fn carriers(
    model: &Model<f64>,
    reduction: Reduction,
    q: &[f64],
    x: &[f64],
) -> Result<Vec<usize>, StudyError> {
    let evaluator = Evaluator::new(model, reduction, Metric::Euclidean)?;
    let motion = evaluator.motion(q, x)?;
    let shares = energy_shares(model, q, &motion)?.bodies;
    let mut order: Vec<usize> = (0..shares.len()).filter(|&i| shares[i] >= 0.01).collect();
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]));
    // Bodies that turn with the motion and have nothing yet.
    let turning = inertial_gradient(model, q, &motion)?;
    let bare = (0..shares.len()).filter(|i| !order.contains(i));
    let mut bare: Vec<usize> = bare.filter(|&i| turning[i].of_m + trace(turning[i].of_I) > 0.0).collect();
    bare.sort_by(|&a, &b| trace(turning[b].of_I).total_cmp(&trace(turning[a].of_I)));
    order.truncate(2);
    order.extend(bare);
    Ok(order)
}

fn trace(I: Sym3<f64>) -> f64 {
    I.xx + I.yy + I.zz
}

/// More inertia for one link.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkAdvice {
    /// The link, with what is fixed to it.
    pub link: String,
    /// Its position among the model's links.
    pub index: usize,
    /// Mass that it has and that is to be added at its centre (kg).
    pub mass: [f64; 2],
    /// Rotational inertia about its centre of mass on its own axes (kg m²): what it has and what is to be added.
    pub inertia: [Sym3<f64>; 2],
    /// What is added in parts of its own: mass and second moment together.
    pub cost: f64,
    /// The worst value of the goal's measure on the mended robot.
    pub reached: f64,
    /// Configurations in which that was looked for.
    pub checked: usize,
    /// The link's inertia with it, about its origin on its axes.
    pub mended: RigidInertia<f64>,
}

impl LinkAdvice {
    pub(super) fn new(
        model: &Model<f64>,
        remedy: &Remedy,
        body: usize,
        found: &Found,
    ) -> Result<Self, StudyError> {
        let index = model.bodies()[body].link();
        let (m, _, I) = own(model, body).central();
        let z = &found.change;
        let cost = remedy.costs().iter().zip(z).map(|(c, z)| c * z).sum();
        Ok(Self {
            link: model.links()[index].name().to_owned(),
            index,
            mass: [m, z[0]],
            inertia: [I, inertia_of(z)],
            cost,
            reached: found.reached,
            checked: found.checked,
            mended: own(&remedy.applied(model, z)?, body),
        })
    }
}

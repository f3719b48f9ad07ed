//! Who is to blame for a soft motion, and by which mechanism.
//!
//! ```text
//! share of DoF d in a mode       B_dd x_d², xᵀBx = 1
//! share of body i in its energy  v_i·I_i v_i / λ: ∂log λ/∂log(mass and inertia of i)
//! light tip                      one joint has nearly all of the mode: what it carries is light
//! opposition                     two joints, near ±0.71 each in their own units, move the same mass the same way and cancel
//! ```

use crate::StudyError;
use eigenbody::dynamics::{axes, energy_shares};
use eigenbody::search::{Evaluator, Measure, Spread};
use eigenbody::{Metric, Model, Reduction, conditioning_at};

/// Part of one joint above which a mode is its own.
const ALONE: f64 = 0.9;
/// Least part of each of two joints that cancel.
const EITHER: f64 = 0.2;

/// A name and its part in a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// A degree of freedom, or a link.
    pub name: String,
    /// Its component in the mode, with its sign; zero for a link.
    pub rate: f64,
    /// Its part; parts sum to one.
    pub share: f64,
}

/// The softest motion of a configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Soft {
    /// Degrees of freedom, the largest share first.
    pub dofs: Vec<Part>,
    /// Links whose inertia, and joints whose armature, the motion feels; the largest share of its energy first.
    pub carriers: Vec<Part>,
}

/// How a motion comes to be soft.
#[derive(Debug, Clone, PartialEq)]
pub enum Mechanism {
    /// One joint carries little inertia.
    LightTip {
        /// The joint.
        joint: String,
        /// The link that has most of the little.
        link: String,
    },
    /// Two joints on one path move the same mass the same way and cancel: only near some configurations.
    Opposition {
        /// The joints, the one nearer to the base first.
        joints: [String; 2],
        /// Angle between their axes (rad): near zero, they turn about the same line and what is between is light; else what they carry
        /// is nearly a point to them.
        angle: f64,
        /// The links from the first to the last that they move.
        links: Vec<String>,
    },
    /// Many joints together.
    Spread,
}

/// The softest mode and its mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Blame {
    /// The mode.
    pub soft: Soft,
    /// Where its softness comes from.
    pub mechanism: Mechanism,
}

pub(super) fn blame(
    model: &Model<f64>,
    reduction: Reduction,
    metric: &Metric<f64>,
    evaluator: &Evaluator<'_>,
    spread: &Spread,
) -> Result<Option<Blame>, StudyError> {
    let (q, rows) = (&spread.at, reduction.dofs(model));
    // κ′ judges in each joint's own units.
    let metric = if spread.measure == Measure::KappaWeighted { Metric::UnitDiagonal } else { metric.clone() };
    let question = |metric| eigenbody::Question { metric, reduction, ..eigenbody::Question::default() };
    let verdict = conditioning_at(model, q, &question(metric))
        .or_else(|_| conditioning_at(model, q, &question(Metric::Euclidean)));
    let Ok(verdict) = verdict else { return Ok(None) };
    let Some(x) = softest(model, reduction, q, verdict.softest)? else { return Ok(None) };
    let weights = if verdict.weights.len() == x.len() { verdict.weights } else { vec![1.0; x.len()] };
    let total: f64 = x.iter().zip(&weights).map(|(x, b)| b * x * x).sum();
    let part = |k: usize| Part {
        name: model.dof_name(rows[k]),
        rate: x[k],
        share: weights[k] * x[k] * x[k] / total,
    };
    let mut order: Vec<usize> = (0..x.len()).collect();
    let share = |k: usize| weights[k] * x[k] * x[k];
    order.sort_by(|&a, &b| share(b).total_cmp(&share(a)));
    let dofs: Vec<Part> = order.iter().map(|&k| part(k)).collect();
    let motion = evaluator.motion(q, &x)?;
    let carriers = carriers(model, q, &motion)?;
    let places: Vec<usize> = order.iter().map(|&k| rows[k]).collect();
    let mechanism = mechanism(model, q, &dofs, &places, &carriers)?;
    Ok(Some(Blame { soft: Soft { dofs, carriers }, mechanism }))
}

/// The softest mode; where λmin is not resolved, the null motion of the matrix.
pub(crate) fn softest(
    model: &Model<f64>,
    reduction: Reduction,
    q: &[f64],
    found: Option<Vec<f64>>,
) -> Result<Option<Vec<f64>>, StudyError> {
    if found.is_some() {
        return Ok(found);
    }
    let H = reduction.mass_matrix(model, q)?;
    let own = (0..H.rows()).map(|d| if H[(d, d)] > 0.0 { H[(d, d)] } else { 1.0 });
    let pairs = eigenbody::spectrum::eigen(&H, &own.collect::<Vec<_>>())?;
    Ok((H.rows() > 0).then(|| pairs.vectors.row(0).to_vec()))
}

fn carriers(model: &Model<f64>, q: &[f64], motion: &[f64]) -> Result<Vec<Part>, StudyError> {
    let shares = energy_shares(model, q, motion)?;
    let link = |i: usize| model.links()[model.bodies()[i].link()].name().to_owned();
    let bodies = shares.bodies.iter().enumerate().map(|(i, &share)| (link(i), share));
    let rotors = shares.armature.iter().enumerate();
    let rotors = rotors.map(|(d, &share)| (format!("armature of {}", model.dof_name(d)), share));
    let mut parts: Vec<Part> = bodies
        .chain(rotors)
        .filter(|(_, share)| *share > 1e-6)
        .map(|(name, share)| Part { name, rate: 0.0, share })
        .collect();
    parts.sort_by(|a, b| b.share.total_cmp(&a.share));
    Ok(parts)
}

/// `places`: the model's DoFs in the order of `dofs`.
fn mechanism(
    model: &Model<f64>,
    q: &[f64],
    dofs: &[Part],
    places: &[usize],
    carriers: &[Part],
) -> Result<Mechanism, StudyError> {
    let opposed = opposed(model, q, dofs, places)?;
    Ok(match (opposed, dofs) {
        (Some(opposition), _) => opposition,
        (None, [first, ..]) if first.share >= ALONE => Mechanism::LightTip {
            joint: first.name.clone(),
            link: carriers.first().map_or_else(String::new, |part| part.name.clone()),
        },
        _ => Mechanism::Spread,
    })
}

/// The two joints that have the mode between them, if one is on the path of the other.
fn opposed(
    model: &Model<f64>,
    q: &[f64],
    dofs: &[Part],
    places: &[usize],
) -> Result<Option<Mechanism>, StudyError> {
    let [first, second, ..] = dofs else { return Ok(None) };
    if first.share + second.share < ALONE || second.share < EITHER {
        return Ok(None);
    }
    let body_of = |d: usize| model.bodies().iter().position(|body| body.dofs().contains(&d));
    let (Some(a), Some(b)) = (body_of(places[0]), body_of(places[1])) else { return Ok(None) };
    let ((near, near_dof), (far, far_dof)) = if a < b { ((a, 0), (b, 1)) } else { ((b, 1), (a, 0)) };
    let axes = axes(model, q)?;
    let cosine = axes[places[0]].ang.dot(axes[places[1]].ang).abs().min(1.0);
    let mut links = Vec::new();
    let mut body = Some(far);
    while let Some(i) = body {
        links.push(model.links()[model.bodies()[i].link()].name().to_owned());
        if i == near {
            links.reverse();
            let joints = [near_dof, far_dof].map(|k| dofs[k].name.clone());
            return Ok(Some(Mechanism::Opposition { joints, angle: cosine.acos(), links }));
        }
        body = model.bodies()[i].parent();
    }
    Ok(None)
}

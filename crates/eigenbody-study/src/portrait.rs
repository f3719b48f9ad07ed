//! A robot in one configuration, as a picture needs it: where its bodies are, its spectrum, and how two modes move it.

use crate::StudyError;
use crate::diagnosis::{self, Diagnosis, softest};
use eigenbody::dynamics::{axes, link_pose};
use eigenbody::search::{Evaluator, Measure};
use eigenbody::spatial::{Motion, Vec3};
use eigenbody::{Conditioning, Matrix, Metric, Model, Question, Reduction, conditioning_at};

/// Up to so many degrees of freedom the matrix and all eigenvalues are part of the picture.
pub const WHOLE: usize = 1000;

/// Where a moving body is.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyPlace {
    /// Its link.
    pub link: String,
    /// The body that carries it.
    pub parent: Option<usize>,
    /// Its link's origin in the world (m).
    pub origin: [f64; 3],
    /// Its centre of mass in the world (m).
    pub centre: [f64; 3],
    /// Its mass (kg).
    pub mass: f64,
}

/// A degree of freedom in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct DofPlace {
    /// Its name.
    pub name: String,
    /// The body that it moves.
    pub body: usize,
    /// Unit vector: the axis it turns about, or the direction it slides in.
    pub axis: [f64; 3],
    /// True if it slides.
    pub slides: bool,
}

/// One mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ModePlace {
    /// Its eigenvalue, where it is resolved.
    pub eigenvalue: Option<f64>,
    /// Rate of each DoF, xᵀBx = 1.
    pub rates: Vec<f64>,
    /// Part of each DoF; they sum to one.
    pub shares: Vec<f64>,
    /// Velocity of each body's origin and centre of mass (m/s).
    pub velocities: Vec<[[f64; 3]; 2]>,
}

/// Everything about one configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Portrait {
    /// All coordinates.
    pub q: Vec<f64>,
    /// Name of the metric of the modes.
    pub metric: String,
    /// The moving bodies.
    pub bodies: Vec<BodyPlace>,
    /// The degrees of freedom of the study.
    pub dofs: Vec<DofPlace>,
    /// κ, κ′, eigenvalues and error estimates.
    pub verdict: Conditioning<f64>,
    /// H; none for more than [`WHOLE`] degrees of freedom.
    pub H: Option<Matrix<f64>>,
    /// The mode with the least inertia.
    pub softest: Option<ModePlace>,
    /// The mode with the most.
    pub stiffest: Option<ModePlace>,
}

/// The robot where a diagnosis found it at its worst, and by which measures: one portrait a configuration.
///
/// Errors: [`StudyError`] if the diagnosis is of another robot.
pub fn worst_portraits(
    model: &Model<f64>,
    question: &diagnosis::Question,
    found: &Diagnosis,
) -> Result<Vec<(Vec<Measure>, Portrait)>, StudyError> {
    let mut all: Vec<(Vec<Measure>, Portrait)> = Vec::new();
    for worst in &found.worst {
        let (q, measure) = (&worst.spread.at, worst.spread.measure);
        if let Some((measures, _)) = all.iter_mut().find(|(_, portrait)| portrait.q == *q) {
            measures.push(measure);
            continue;
        }
        // κ′ judges in each joint's own units, which a joint without inertia does not have.
        let metric = if measure == Measure::KappaWeighted { &Metric::UnitDiagonal } else { &question.metric };
        let drawn = portrait(model, question.reduction, metric, q)
            .or_else(|_| portrait(model, question.reduction, &Metric::Euclidean, q))?;
        all.push((vec![measure], drawn));
    }
    Ok(all)
}

/// The portrait of a robot at q.
///
/// Method: [`conditioning_at`] with all eigenvalues, the modes' motion of every body from the columns of S in the world.
///
/// Errors: [`StudyError`] if q or the metric does not fit.
pub fn portrait(
    model: &Model<f64>,
    reduction: Reduction,
    metric: &Metric<f64>,
    q: &[f64],
) -> Result<Portrait, StudyError> {
    let rows = reduction.dofs(model);
    let whole = rows.len() <= WHOLE;
    let question = Question { metric: metric.clone(), reduction, all: whole, ..Question::default() };
    let verdict = conditioning_at(model, q, &question)?;
    let bodies = bodies(model, q)?;
    let S = axes(model, q).map_err(eigenbody::Error::from)?;
    let owner = owners(model);
    let dofs = rows.iter().map(|&d| dof(model, d, owner[d], &S[d])).collect();
    let evaluator = Evaluator::new(model, reduction, metric.clone()).map_err(eigenbody::Error::from)?;
    let mode = |x: Option<Vec<f64>>, eigenvalue: Option<f64>| -> Result<Option<ModePlace>, StudyError> {
        let Some(rates) = x else { return Ok(None) };
        let weight = |k: usize| verdict.weights.get(k).copied().unwrap_or(1.0);
        let parts: Vec<f64> = rates.iter().enumerate().map(|(k, x)| weight(k) * x * x).collect();
        let total: f64 = parts.iter().sum();
        let v = evaluator.motion(q, &rates)?;
        Ok(Some(ModePlace {
            eigenvalue,
            shares: parts.iter().map(|part| part / total).collect(),
            velocities: velocities(model, &bodies, &S, &v),
            rates,
        }))
    };
    let soft = softest(model, reduction, q, verdict.softest.clone())?;
    Ok(Portrait {
        q: q.to_vec(),
        metric: metric.to_string(),
        softest: mode(soft, verdict.lambda_min)?,
        stiffest: mode(verdict.stiffest.clone(), verdict.lambda_max)?,
        H: if whole { Some(reduction.mass_matrix(model, q)?) } else { None },
        bodies,
        dofs,
        verdict,
    })
}

fn bodies(model: &Model<f64>, q: &[f64]) -> Result<Vec<BodyPlace>, StudyError> {
    let place = |i: usize| -> Result<BodyPlace, StudyError> {
        let body = &model.bodies()[i];
        let link = &model.links()[body.link()];
        let X = link_pose(model, q, body.link()).map_err(eigenbody::Error::from)?;
        let internal = link.link_from_body().inverse() * X;
        let I = body.inertia();
        let centre = if I.m > 0.0 { internal.inverse_point(I.h * (1.0 / I.m)) } else { X.r };
        Ok(BodyPlace {
            link: link.name().to_owned(),
            parent: body.parent(),
            origin: X.r.to_array(),
            centre: centre.to_array(),
            mass: I.m,
        })
    };
    (0..model.bodies().len()).map(place).collect()
}

/// The body that each DoF moves.
fn owners(model: &Model<f64>) -> Vec<usize> {
    let mut owner = vec![0; model.nv()];
    for (i, body) in model.bodies().iter().enumerate() {
        body.dofs().for_each(|d| owner[d] = i);
    }
    owner
}

fn dof(model: &Model<f64>, d: usize, body: usize, S: &Motion<f64>) -> DofPlace {
    let slides = S.ang.norm() == 0.0;
    let along = if slides { S.lin } else { S.ang };
    let size = along.norm();
    let axis = if size > 0.0 { along * (1.0 / size) } else { Vec3::ZERO };
    DofPlace { name: model.dof_name(d), body, axis: axis.to_array(), slides }
}

/// Velocities of origins and centres while all DoFs move at rates v.
fn velocities(model: &Model<f64>, bodies: &[BodyPlace], S: &[Motion<f64>], v: &[f64]) -> Vec<[[f64; 3]; 2]> {
    let mut twists: Vec<(Vec3<f64>, Vec3<f64>)> = Vec::with_capacity(bodies.len());
    let mut found = Vec::with_capacity(bodies.len());
    for (body, place) in model.bodies().iter().zip(bodies) {
        let (mut ang, mut lin) = body.parent().map_or((Vec3::ZERO, Vec3::ZERO), |p| twists[p]);
        for d in body.dofs() {
            ang += S[d].ang * v[d];
            lin += S[d].lin * v[d];
        }
        twists.push((ang, lin));
        found.push([place.origin, place.centre].map(|p| (lin + ang.cross(Vec3::from_f64(p))).to_array()));
    }
    found
}

//! `POST /api/evaluate`: the robot at q. What is asked twenty times a second.

use super::describe::Pose;
use super::{Answer, ask};
use crate::asked::Asked;
use crate::explorer::Explorer;
use crate::refusal::Refusal;
use crate::robot::{Robot, WHOLE};
use crate::work::Pace;
use axum::extract::State;
use eigenbody::spectrum::Metric;
use eigenbody::{Matrix, Question, conditioning_at};
use eigenbody_report::{ErrorEstimate, SpectrumReport, Subject};
use eigenbody_study::explore::{pose, settled, stance};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Largest side of a pooled matrix.
const POOL: usize = 256;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    id: String,
    q: Vec<f64>,
    metric: Option<String>,
    want: Option<Vec<Want>>,
    pool: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Want {
    Places,
    Numbers,
    Modes,
    Eigenvalues,
    Matrix,
}

#[derive(Serialize)]
struct Reply {
    q: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    places: Option<Vec<Pose>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    axes: Option<Vec<[f32; 6]>>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    numbers: Option<Numbers>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    modes: Option<Modes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    eigenvalues: Option<Option<Vec<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    matrix: Option<Option<Pooled>>,
}

/// As `eigenbody spectrum --json` has them.
#[derive(Serialize)]
struct Numbers {
    metric: String,
    unit: &'static str,
    method: &'static str,
    kappa: Option<f64>,
    kappa_weighted: Option<f64>,
    diagonal_ratio: Option<f64>,
    bracket: Option<[f64; 2]>,
    lambda_min: Option<f64>,
    lambda_max: Option<f64>,
    error_estimate: ErrorEstimate,
    note: Option<String>,
}

#[derive(Serialize)]
struct Modes {
    softest: Option<ModeView>,
    stiffest: Option<ModeView>,
}

#[derive(Serialize)]
struct ModeView {
    vector: Vec<f64>,
    share: Vec<f64>,
}

#[derive(Serialize)]
struct Pooled {
    rows: usize,
    pooled: usize,
    size: usize,
    values: Vec<f32>,
}

pub async fn evaluate(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<Request>) -> Answer {
    let id = request.id.clone();
    ask(&explorer, Pace::Quick, &id, move |robot| reply(robot, &request)).await
}

/// The metric that a text names, or the Euclidean one.
pub fn metric(text: Option<&str>) -> Result<Metric<f64>, Refusal> {
    text.map_or(Ok(Metric::Euclidean), |text| Ok(eigenbody_formats::metric(text)?))
}

fn reply(robot: &Robot, request: &Request) -> Result<Reply, Refusal> {
    let (model, reduction) = (robot.model(), robot.reduction);
    let q = settled(model, reduction, &request.q)?;
    let usual = [Want::Places, Want::Numbers, Want::Modes];
    let want = request.want.as_deref().unwrap_or(&usual);
    let wants = |what| want.contains(&what);
    let stance = if wants(Want::Places) { Some(stance(model, &q)?) } else { None };
    let single = |[p, a]: &[[f64; 3]; 2]| [p[0], p[1], p[2], a[0], a[1], a[2]].map(|x| x as f32);
    let whole = robot.rows.len() <= WHOLE;
    let asks = [Want::Numbers, Want::Modes, Want::Eigenvalues].into_iter().any(wants);
    let spectrum =
        if asks { Some(spectrum(robot, request, &q, whole && wants(Want::Eigenvalues))?) } else { None };
    let matrix = match (wants(Want::Matrix), whole) {
        (false, _) => None,
        (true, false) => Some(None),
        (true, true) => Some(Some(pooled(&reduction.mass_matrix(model, &q)?, request.pool.unwrap_or(128)))),
    };
    let (numbers, modes, eigenvalues) = spectrum.map_or((None, None, None), |found| {
        let SpectrumReport { softest, stiffest, eigenvalues, .. } = found.clone();
        let mode = |mode: eigenbody_report::ModeReport| ModeView { vector: mode.vector, share: mode.share };
        let modes = Modes { softest: softest.map(mode), stiffest: stiffest.map(mode) };
        (Some(Numbers::from(found)), Some(modes), Some(eigenvalues))
    });
    Ok(Reply {
        places: stance
            .as_ref()
            .map(|stance| stance.links.iter().map(|X| pose(X).map(|x| x as f32)).collect()),
        axes: stance.as_ref().map(|stance| stance.axes.iter().map(single).collect()),
        numbers: numbers.filter(|_| wants(Want::Numbers)),
        modes: modes.filter(|_| wants(Want::Modes)),
        eigenvalues: eigenvalues.filter(|_| wants(Want::Eigenvalues)),
        matrix,
        q,
    })
}

fn spectrum(robot: &Robot, request: &Request, q: &[f64], all: bool) -> Result<SpectrumReport, Refusal> {
    let model = robot.model();
    let metric = metric(request.metric.as_deref())?;
    let question = Question { metric, reduction: robot.reduction, all, ..Question::default() };
    let result = conditioning_at(model, q, &question)?;
    let unit = question.metric.unit(robot.rows.iter().map(|&d| model.is_translation(d)));
    let subject = Subject {
        model: String::new(),
        bodies: model.bodies().len(),
        base: String::new(),
        configuration: String::new(),
        q: Vec::new(),
    };
    Ok(SpectrumReport::new(subject, &question.metric, unit, &result, Vec::new()))
}

impl From<SpectrumReport> for Numbers {
    fn from(found: SpectrumReport) -> Self {
        let SpectrumReport { metric, unit, method, kappa, kappa_weighted, diagonal_ratio, bracket, .. } =
            found;
        let SpectrumReport { lambda_min, lambda_max, error_estimate, note, .. } = found;
        Self {
            metric,
            unit,
            method,
            kappa,
            kappa_weighted,
            diagonal_ratio,
            bracket,
            lambda_min,
            lambda_max,
            error_estimate,
            note,
        }
    }
}

/// The matrix on at most `side` rows: of every block the entry of largest magnitude.
fn pooled(H: &Matrix<f64>, side: usize) -> Pooled {
    let rows = H.rows();
    let pooled = rows.div_ceil(side.clamp(1, POOL)).max(1);
    let size = rows.div_ceil(pooled);
    let mut values = vec![0.0f64; size * size];
    for i in 0..rows {
        for (j, &x) in H.row(i).iter().enumerate() {
            let largest = &mut values[i / pooled * size + j / pooled];
            if x.abs() > largest.abs() {
                *largest = x;
            }
        }
    }
    Pooled { rows, pooled, size, values: values.into_iter().map(|x| x as f32).collect() }
}

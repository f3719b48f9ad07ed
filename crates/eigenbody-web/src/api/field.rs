//! `POST /api/path`, `/api/map`: κ along a line, and over two joints.

use super::describe::{Limits, range};
use super::{Answer, ask};
use crate::asked::Asked;
use crate::explorer::Explorer;
use crate::refusal::Refusal;
use crate::robot::Robot;
use crate::work::Pace;
use axum::extract::State;
use eigenbody::conditioning::Values;
use eigenbody_study::explore::{Line, Plane, line, plane};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathRequest {
    id: String,
    from: Vec<f64>,
    to: Vec<f64>,
    points: Option<usize>,
    metric: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapRequest {
    id: String,
    q: Vec<f64>,
    dofs: [usize; 2],
    resolution: Option<usize>,
    metric: Option<String>,
}

#[derive(Serialize)]
struct PathReply {
    t: Vec<f64>,
    kappa: Vec<f64>,
    kappa_weighted: Vec<f64>,
    lambda_min: Vec<f64>,
    lambda_max: Vec<f64>,
}

#[derive(Serialize)]
struct MapReply {
    x: Vec<f64>,
    y: Vec<f64>,
    kappa: Vec<Vec<f32>>,
    kappa_weighted: Vec<Vec<f32>>,
}

pub async fn path(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<PathRequest>) -> Answer {
    let id = request.id.clone();
    ask(&explorer, Pace::Long, &id, move |robot| along(robot, &request)).await
}

pub async fn map(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<MapRequest>) -> Answer {
    let id = request.id.clone();
    ask(&explorer, Pace::Long, &id, move |robot| over(robot, &request)).await
}

/// A number of points that this robot may be asked for.
fn count(asked: Option<usize>, usual: usize, most: usize) -> Result<usize, Refusal> {
    match asked.unwrap_or(usual.min(most)) {
        count if (2..=most).contains(&count) => Ok(count),
        count => Err(Refusal::input(format!("{count} points, expected 2 to {most} for this robot"))),
    }
}

fn along(robot: &Robot, request: &PathRequest) -> Result<PathReply, Refusal> {
    let points = count(request.points, 101, Limits::of(robot).path)?;
    let metric = super::evaluate::metric(request.metric.as_deref())?;
    let ends = [request.from.as_slice(), &request.to];
    let Line { t, values } = line(robot.model(), robot.reduction, &metric, ends, points)?;
    let column = |of: fn(&Values) -> f64| values.iter().map(of).collect();
    Ok(PathReply {
        t,
        kappa: column(Values::kappa),
        kappa_weighted: column(|values| values.kappa_weighted),
        lambda_min: column(|values| values.lambda_min),
        lambda_max: column(|values| values.lambda_max),
    })
}

fn over(robot: &Robot, request: &MapRequest) -> Result<MapReply, Refusal> {
    let points = count(request.resolution, 33, Limits::of(robot).map)?;
    let metric = super::evaluate::metric(request.metric.as_deref())?;
    let [a, b] = request.dofs;
    let joint = |k: usize| {
        let joint = robot.model().joints().get(k).filter(|joint| joint.kind().nq() == 1);
        let joint =
            joint.ok_or_else(|| Refusal::input(format!("joint {k} is no joint of one coordinate")))?;
        let q = joint.coordinates().start;
        if robot.leader(q).is_some() {
            return Err(Refusal::input(format!("joint '{}' follows another", joint.name())));
        }
        Ok((q, range(joint)))
    };
    if a == b {
        return Err(Refusal::input("a map is over two different joints"));
    }
    let joints = [joint(a)?, joint(b)?];
    let Plane { x, y, values } = plane(robot.model(), robot.reduction, &metric, &request.q, joints, points)?;
    let rows = |of: fn(&Values) -> f64| {
        values.chunks(points).map(|row| row.iter().map(|values| of(values) as f32).collect()).collect()
    };
    Ok(MapReply { x, y, kappa: rows(Values::kappa), kappa_weighted: rows(|values| values.kappa_weighted) })
}

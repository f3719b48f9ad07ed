//! `POST /api/pose`, `/api/move`, `/api/swing`: configurations by name, moved, and moving.

use super::describe::{Limits, Pose};
use super::{Answer, ask};
use crate::asked::Asked;
use crate::explorer::Explorer;
use crate::refusal::Refusal;
use crate::robot::Robot;
use crate::work::Pace;
use axum::extract::State;
use eigenbody::{Question, conditioning_at};
use eigenbody_study::explore::{self, settled};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Named {
    id: String,
    at: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Moved {
    id: String,
    q: Vec<f64>,
    v: Option<Vec<f64>>,
    to: Option<Vec<f64>>,
    t: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Swung {
    id: String,
    q: Vec<f64>,
    mode: Mode,
    metric: Option<String>,
    amplitude: Option<f64>,
    frames: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Mode {
    Softest,
    Stiffest,
    Rates(Vec<f64>),
}

#[derive(Serialize)]
struct Configuration {
    q: Vec<f64>,
}

#[derive(Serialize)]
struct Swing {
    amplitude: f64,
    places: Vec<Vec<Pose>>,
}

pub async fn pose(State(explorer): State<Arc<Explorer>>, Asked(Named { id, at }): Asked<Named>) -> Answer {
    let named = move |robot: &Robot| {
        let q = robot.loaded.configuration(&at, robot.reduction.mimic)?;
        Ok(Configuration { q: settled(robot.model(), robot.reduction, &q)? })
    };
    ask(&explorer, Pace::Quick, &id, named).await
}

pub async fn step(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<Moved>) -> Answer {
    let id = request.id.clone();
    let moved = move |robot: &Robot| {
        let (model, reduction) = (robot.model(), robot.reduction);
        let from = settled(model, reduction, &request.q)?;
        let v = match (&request.v, &request.to, request.t) {
            (Some(v), None, None) => v.clone(),
            (None, Some(to), Some(t)) => model.difference(&from, to)?.into_iter().map(|v| t * v).collect(),
            _ => return Err(Refusal::input("a move has v, or to and t")),
        };
        Ok(Configuration { q: settled(model, reduction, &model.integrate(&from, &v)?)? })
    };
    ask(&explorer, Pace::Quick, &id, moved).await
}

pub async fn swing(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<Swung>) -> Answer {
    let id = request.id.clone();
    ask(&explorer, Pace::Quick, &id, move |robot| swung(robot, request)).await
}

fn swung(robot: &Robot, request: Swung) -> Result<Swing, Refusal> {
    let (model, reduction) = (robot.model(), robot.reduction);
    let q = settled(model, reduction, &request.q)?;
    let (amplitude, frames) = (request.amplitude.unwrap_or(0.5), request.frames.unwrap_or(17));
    let most = Limits::of(robot).frames;
    if frames > most {
        return Err(Refusal::input(format!("{frames} frames, at most {most} for this robot")));
    }
    let rates = match request.mode {
        Mode::Rates(rates) => rates,
        mode => {
            let metric = super::evaluate::metric(request.metric.as_deref())?;
            let question = Question { metric, reduction, ..Question::default() };
            let found = conditioning_at(model, &q, &question)?;
            let vector = if matches!(mode, Mode::Softest) { found.softest } else { found.stiffest };
            vector.ok_or_else(|| Refusal::input("this mode is not resolved here"))?
        }
    };
    let swing = explore::swing(model, reduction, &q, &rates, amplitude, frames)?;
    let single = |X: &eigenbody::spatial::Transform<f64>| explore::pose(X).map(|x| x as f32);
    let places = swing.frames.iter().map(|frame| frame.iter().map(single).collect()).collect();
    Ok(Swing { amplitude, places })
}

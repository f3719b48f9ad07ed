//! `POST /api/check`: what `eigenbody check --format json` prints.

use super::{Answer, ask};
use crate::asked::Asked;
use crate::explorer::Explorer;
use crate::refusal::Refusal;
use crate::robot::{EXAMINED, Robot};
use crate::work::Pace;
use axum::extract::State;
use eigenbody::search::Effort;
use eigenbody_report::DiagnosisReport;
use eigenbody_study::diagnosis::{Drive, Question, diagnose};
use serde::Deserialize;
use std::sync::Arc;

/// Most configurations sampled.
const SAMPLES: u32 = 8192;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    id: String,
    metric: Option<String>,
    samples: Option<u32>,
    seed: Option<u32>,
}

pub async fn check(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<Request>) -> Answer {
    let id = request.id.clone();
    ask(&explorer, Pace::Long, &id, move |robot| examined(robot, &request)).await
}

fn examined(robot: &Robot, request: &Request) -> Result<DiagnosisReport, Refusal> {
    let rows = robot.rows.len();
    if rows > EXAMINED {
        let message = format!(
            "{rows} degrees of freedom; the page examines up to {EXAMINED}, `eigenbody check` any number"
        );
        return Err(Refusal::input(message));
    }
    let default = Effort::default();
    let samples = request.samples.unwrap_or(default.samples);
    if !(1..=SAMPLES).contains(&samples) {
        return Err(Refusal::input(format!("{samples} samples, expected 1 to {SAMPLES}")));
    }
    let effort = Effort { samples, seed: request.seed.unwrap_or(default.seed), ..default };
    let metric = super::evaluate::metric(request.metric.as_deref())?;
    let drive = Drive::of(&robot.loaded);
    let question = Question { reduction: robot.reduction, metric, effort, drive, ..Question::default() };
    let found = diagnose(robot.model(), &question, |_| ())?;
    Ok(DiagnosisReport::of(&robot.loaded.name, &robot.loaded, &found))
}

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
use std::ops::ControlFlow;
use std::sync::{Arc, Weak};

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

/// Ends with its asker: who lets go of the connection wants no more.
pub async fn check(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<Request>) -> Answer {
    let id = request.id.clone();
    let asker = Arc::new(());
    let waiting = Arc::downgrade(&asker);
    let answer = ask(&explorer, Pace::Long, &id, move |robot| examined(robot, &request, &waiting)).await;
    drop(asker);
    answer
}

fn examined(robot: &Robot, request: &Request, asker: &Weak<()>) -> Result<DiagnosisReport, Refusal> {
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
    let found = diagnose(robot.model(), &question, |_| match asker.strong_count() {
        0 => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    })?;
    Ok(DiagnosisReport::of(&robot.loaded.name, &robot.loaded, &found))
}

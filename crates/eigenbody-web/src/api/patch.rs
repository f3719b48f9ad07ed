//! `POST /api/patch`: the robot with its edits, as a file to save. The server writes none.

use super::{Answer, ask};
use crate::asked::Asked;
use crate::explorer::Explorer;
use crate::refusal::Refusal;
use crate::robot::Robot;
use crate::work::Pace;
use axum::extract::State;
use eigenbody_formats::{write_mjcf, write_urdf_with_rotors};
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::sync::Arc;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    id: String,
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Format {
    Urdf,
    Mjcf,
}

#[derive(Serialize)]
struct Patched {
    name: String,
    text: String,
    note: Option<&'static str>,
}

pub async fn patch(State(explorer): State<Arc<Explorer>>, Asked(request): Asked<Request>) -> Answer {
    let Request { id, format } = request;
    ask(&explorer, Pace::Quick, &id, move |robot| patched(robot, format)).await
}

fn patched(robot: &Robot, format: Format) -> Result<Patched, Refusal> {
    let model = robot.model();
    let (text, extension) = match format {
        Format::Urdf => (write_urdf_with_rotors(model), "urdf"),
        Format::Mjcf => (write_mjcf(model), "xml"),
    };
    let text = text.map_err(|error| Refusal::input(format!("{}: {error}", robot.loaded.name)))?;
    let has_armature = model.armature().iter().any(|&a| a > 0.0);
    let note = (format == Format::Urdf && has_armature)
        .then_some("URDF has no armature: it is written as rotors of transmissions, which --rotors on adds");
    Ok(Patched { name: format!("{}-edited.{extension}", stem(&robot.loaded.name)), text, note })
}

/// A file's name to offer: letters, digits, dots and dashes of the robot's own.
fn stem(name: &str) -> String {
    let stem = Path::new(name).file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    let kept = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '-' | '_') { c } else { ' ' };
    let words: String = stem.chars().map(kept).collect();
    let joined = words.split_whitespace().collect::<Vec<_>>().join("-");
    if joined.is_empty() { "robot".to_owned() } else { joined }
}

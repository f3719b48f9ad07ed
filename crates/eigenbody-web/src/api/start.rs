//! `GET /api/start`: what there is to look at.

use super::figure::{FIGURES, experiment};
use super::{Answer, json};
use crate::asked::LARGE;
use crate::explorer::Explorer;
use crate::robot::{BUILT_IN, MOST, Options, Source};
use axum::extract::State;
use eigenbody_study::Experiment;
use serde::Serialize;
use std::sync::Arc;

/// A family and its parameters.
#[derive(Serialize)]
struct Family {
    name: &'static str,
    usage: &'static str,
    parameters: &'static [Parameter],
}

/// A slider.
#[derive(Serialize)]
struct Parameter {
    name: &'static str,
    label: &'static str,
    unit: &'static str,
    min: f64,
    max: f64,
    step: f64,
    default: f64,
    integer: bool,
}

const fn slider(
    name: &'static str,
    label: &'static str,
    unit: &'static str,
    [min, max]: [f64; 2],
    step: f64,
    default: f64,
) -> Parameter {
    Parameter { name, label, unit, min, max, step, default, integer: step == 1.0 }
}

const N: Parameter = slider("N", "links", "", [1.0, 1000.0], 1.0, 10.0);
const B: Parameter = slider("B", "branching", "", [1.0, 4.0], 0.125, 1.0);
const SKEW: Parameter = slider("α", "skew", "rad", [0.0, std::f64::consts::PI], 0.01, 0.0);
const TAPER: Parameter = slider("ρ", "taper", "", [0.5, 1.2], 0.005, 1.0);
const MASS: Parameter = slider("m", "mass", "kg", [0.1, 10.0], 0.1, 1.0);
const LENGTH: Parameter = slider("l", "length", "m", [0.1, 5.0], 0.1, 1.0);

static FAMILIES: [Family; 4] = [
    Family { name: "hydra", usage: "hydra(N,B,α,ρ)", parameters: &[N, B, SKEW, TAPER] },
    Family { name: "onion", usage: "onion(N,B,α,ρ)", parameters: &[N, B, SKEW, TAPER] },
    Family { name: "auto_tree", usage: "auto_tree(N,B,α,ρ)", parameters: &[N, B, SKEW, TAPER] },
    Family { name: "chain", usage: "chain(N,m,l)", parameters: &[N, MASS, LENGTH] },
];

#[derive(Serialize)]
struct Start<'a> {
    version: &'static str,
    source: &'a Source,
    options: Options,
    families: &'static [Family],
    builtins: Vec<Titled>,
    figures: Vec<Titled>,
    limits: Limits,
}

#[derive(Serialize)]
struct Titled {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<&'static str>,
    title: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    seen: Option<&'static str>,
}

#[derive(Serialize)]
struct Limits {
    dofs: usize,
    text: usize,
}

fn figure(id: &str) -> Option<Titled> {
    let Experiment { id, title, seen, .. } = *experiment(id)?;
    Some(Titled { name: None, id: Some(id), title, seen: Some(seen) })
}

pub async fn start(State(explorer): State<Arc<Explorer>>) -> Answer {
    let opening = &explorer.opening;
    let builtin = |&(name, title): &(&'static str, &'static str)| Titled {
        name: Some(name),
        id: None,
        title,
        seen: None,
    };
    let start = Start {
        version: env!("CARGO_PKG_VERSION"),
        source: &opening.source,
        options: opening.options,
        families: &FAMILIES,
        builtins: BUILT_IN.iter().map(builtin).collect(),
        figures: FIGURES.iter().filter_map(|id| figure(id)).collect(),
        limits: Limits { dofs: MOST, text: LARGE },
    };
    Ok(json(serde_json::to_vec(&start)?))
}

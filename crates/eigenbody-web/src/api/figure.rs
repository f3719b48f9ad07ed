//! `GET /api/figure/ID`: figures of κ against N, every point with the robot that it is about.

use super::{Answer, json};
use crate::explorer::Explorer;
use crate::refusal::Refusal;
use crate::robot::{Base, Options, Source};
use crate::work::Pace;
use axum::extract::{Path, State};
use axum::http::StatusCode;
use eigenbody_report::figure::{Growth, growth};
use eigenbody_study::{Experiment, Lab, Paper, Subject, Table, select};
use serde::Serialize;
use std::sync::Arc;

/// The figures that are shown live.
pub const FIGURES: [&str; 9] =
    ["F-fig6", "F-fig7", "F-fig8", "F-fig9", "F-fig10", "F-fig16", "F-fig18", "F-fig20", "F-fig21"];

#[derive(Serialize)]
struct Figure {
    id: &'static str,
    title: &'static str,
    seen: &'static str,
    paper: &'static str,
    x: AxisView,
    y: AxisView,
    curves: Vec<Curve>,
}

#[derive(Serialize)]
struct AxisView {
    label: &'static str,
    log: bool,
}

#[derive(Serialize)]
struct Curve {
    name: String,
    points: Vec<Point>,
}

#[derive(Serialize)]
struct Point {
    x: f64,
    y: f64,
    source: Source,
    options: Options,
    at: String,
}

/// The experiment behind a figure that is shown.
pub fn experiment(id: &str) -> Option<&'static Experiment> {
    FIGURES.iter().find(|known| **known == id)?;
    select(&[id]).ok()?.into_iter().find(|experiment| experiment.id == id)
}

pub async fn figure(State(explorer): State<Arc<Explorer>>, Path(id): Path<String>) -> Answer {
    let known = FIGURES.iter().position(|figure| *figure == id).zip(experiment(&id)).zip(growth(&id));
    let Some(((k, experiment), growth)) = known else {
        return Err(Refusal::new(StatusCode::NOT_FOUND, "path", "no such figure"));
    };
    let drawn = match explorer.figures[k].get() {
        Some(drawn) => Arc::clone(drawn),
        None => {
            let waiting = Arc::clone(&explorer);
            let draw = move || {
                // Another may have asked and been first.
                if let Some(drawn) = waiting.figures[k].get() {
                    return Ok(Arc::clone(drawn));
                }
                let table = experiment.run(&Lab::default())?.table;
                let drawn: Arc<[u8]> = serde_json::to_vec(&plotted(experiment, growth, &table))?.into();
                Ok(Arc::clone(waiting.figures[k].get_or_init(|| drawn)))
            };
            explorer.workers.run(Pace::Long, draw).await?
        }
    };
    Ok(json(drawn.to_vec()))
}

fn plotted(experiment: &Experiment, growth: Growth, table: &Table) -> Figure {
    let Growth { x, log, y, columns } = growth;
    let names = table.distinct("curve");
    let curves = names.iter().flat_map(|name| {
        columns.iter().map(move |&(symbol, column)| Curve {
            name: if columns.len() > 1 { format!("{symbol}, {name}") } else { (*name).to_owned() },
            points: points(table, name, column),
        })
    });
    Figure {
        id: experiment.id,
        title: experiment.title,
        seen: experiment.seen,
        paper: match experiment.paper {
            Paper::Featherstone => "Featherstone (2004)",
            Paper::ShahSaha => "Shah and Saha (2013)",
        },
        x: AxisView { label: x, log },
        y: AxisView { label: y, log: true },
        curves: curves.collect(),
    }
}

fn points(table: &Table, curve: &str, column: &str) -> Vec<Point> {
    let (x, y) = (table.number("N"), table.number(column));
    let rows = table.text("curve").iter().enumerate().filter(|(_, name)| *name == curve);
    let point = |(row, _): (usize, &String)| {
        let Subject { robot, posture } = table.subject(row)?;
        let base = match robot.base() {
            eigenbody::Base::Fixed => Base::Fixed,
            eigenbody::Base::Floating => Base::Floating,
        };
        Some(Point {
            x: (*x.get(row)?)?,
            y: (*y.get(row)?)?,
            source: Source::family(&robot.name()),
            options: Options { base, ..Options::default() },
            at: posture.to_string(),
        })
    };
    rows.filter_map(point).collect()
}

//! `eigenbody reproduce`: the figures and numbers of two papers, printed against computed.

use crate::args::ReproduceArgs;
use crate::failure::Failure;
use crate::output::{deliver, folder};
use eigenbody_report::{Shown, claims_json, claims_text, count, figure, gallery, write_table_csv};
use eigenbody_study::{Experiment, Lab, Outcome, Reading, Verdict, select};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::io;
use std::path::Path;
use std::time::Duration;

/// Pixels of a PNG for each of its SVG: 1600 across.
const ZOOM: f32 = 2.0;

/// Writes everything into the folder; false if a claim failed.
pub fn run(args: &ReproduceArgs) -> Result<bool, Failure> {
    let ids: Vec<&str> = args.ids.iter().chain(&args.figure).map(String::as_str).collect();
    let experiments = select(&ids).map_err(|error| Failure::Usage(error.to_string()))?;
    folder(&args.output, args.force, is_own)?;
    let lab = Lab { quick: args.quick, ..Lab::default() };

    let bar = progress(&experiments);
    let mut order: Vec<(usize, &Experiment)> = experiments.iter().copied().enumerate().collect();
    // The longest first, so that no core waits for it at the end.
    order.sort_by_key(|&(place, experiment)| (std::cmp::Reverse(experiment.effort), place));
    let done: Result<Vec<(usize, Done)>, Failure> = order
        .into_par_iter()
        .with_max_len(1)
        .map(|(place, experiment)| {
            let done = perform(experiment, &lab, &args.output)?;
            bar.inc(experiment.effort);
            Ok((place, done))
        })
        .collect();
    bar.finish_and_clear();
    let mut done = done?;
    done.sort_by_key(|&(place, _)| place);

    let pairs = || experiments.iter().zip(&done);
    let shown: Vec<Shown<'_>> = pairs()
        .map(|(experiment, (_, Done { outcome, has_figure }))| Shown {
            experiment,
            outcome,
            has_figure: *has_figure,
        })
        .collect();
    let readings: Vec<&Reading> = done.iter().flat_map(|(_, done)| &done.outcome.readings).collect();
    let json = claims_json(readings.iter().copied()).map_err(|error| Failure::Json(error.to_string()))?;
    write(&args.output, "claims.json", format!("{json}\n").as_bytes())?;
    write(&args.output, "index.html", gallery(&shown).as_bytes())?;

    let figures = shown.iter().filter(|shown| shown.has_figure).count();
    let failed = readings.iter().filter(|reading| reading.verdict == Verdict::Fails).count();
    deliver(None, |out| {
        if !readings.is_empty() {
            write!(out, "{}", claims_text(&readings))?;
        }
        writeln!(
            out,
            "{}, {}, {failed} failed: {}",
            count(figures, "figure", "figures"),
            count(readings.len(), "claim", "claims"),
            args.output.join("index.html").display()
        )
    })?;
    Ok(failed == 0)
}

/// True for the name of a file that a reproduction writes.
fn is_own(name: &str) -> bool {
    let all = select::<&str>(&[]).unwrap_or_default();
    let is_of = |id: &str| name.strip_prefix(id).is_some_and(|rest| [".csv", ".svg", ".png"].contains(&rest));
    ["claims.json", "index.html"].contains(&name) || all.iter().any(|experiment| is_of(experiment.id))
}

/// What is left of an experiment when its files are written.
struct Done {
    outcome: Outcome,
    has_figure: bool,
}

fn perform(experiment: &Experiment, lab: &Lab<'_>, folder: &Path) -> Result<Done, Failure> {
    let id = experiment.id;
    let outcome = experiment.run(lab).map_err(|source| Failure::Study { id, source })?;
    let mut csv = Vec::new();
    write_table_csv(&outcome.table, &mut csv)
        .map_err(|source| Failure::File { path: folder.join(id), source })?;
    write(folder, &format!("{id}.csv"), &csv)?;
    let svg = figure::draw(id, experiment.title, &outcome.table);
    if let Some(svg) = &svg {
        write(folder, &format!("{id}.svg"), svg.as_bytes())?;
        let picture = figure::png(svg, ZOOM).map_err(|error| Failure::File {
            path: folder.join(format!("{id}.png")),
            source: io::Error::other(error.to_string()),
        })?;
        write(folder, &format!("{id}.png"), &picture)?;
    }
    Ok(Done { outcome, has_figure: svg.is_some() })
}

fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), Failure> {
    deliver(Some(&folder.join(name)), |out| out.write_all(bytes))
}

/// A bar on standard error, if a person looks at it.
fn progress(experiments: &[&Experiment]) -> ProgressBar {
    let bar = ProgressBar::new(experiments.iter().map(|experiment| experiment.effort).sum());
    if let Ok(style) = ProgressStyle::with_template("{elapsed_precise} [{bar:40}] {percent:>3}%") {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

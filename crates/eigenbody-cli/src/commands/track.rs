//! `eigenbody track`.

use super::motion::{Ending, Recorder, quantities};
use crate::args::TrackArgs;
use crate::failure::Failure;
use crate::output::{check_model, say};
use crate::system::robot;
use eigenbody_formats::motion::Skipped;
use eigenbody_formats::{Motion, MotionOptions};
use eigenbody_report::count;
use eigenbody_study::simulate::State;
use std::time::Instant;

/// Follows a log row by row.
pub fn run(args: &TrackArgs) -> Result<Ending, Failure> {
    let Some(quantities) = quantities(&args.rows)? else { return Ok(Ending::Whole) };
    let (loaded, reduction) = robot(&args.model)?;
    check_model(&loaded, &args.rows.writes())?;
    let others =
        args.others.as_deref().map(|text| loaded.configuration(text, reduction.mimic)).transpose()?;
    let options =
        MotionOptions { skip_bad: args.skip_bad, others, mimic: reduction.mimic, ..MotionOptions::default() };
    let mut log = Motion::open(&args.log, &loaded.model, options)?;
    let start = Instant::now();
    let has_velocities = log.has_velocities();
    let mut recorder =
        Recorder::new(&loaded.model, &args.model.model, reduction, &quantities, has_velocities, &args.rows)?;
    let mut rows = 0u64;
    loop {
        let row = match log.next_row() {
            Ok(Some(row)) => row,
            Ok(None) => break,
            Err(error) => {
                recorder.discard();
                return Err(error.into());
            }
        };
        let state = State { t: row.t, q: row.q, v: row.v.unwrap_or_default() };
        recorder.record(&state, log.progress())?;
        rows += 1;
        if recorder.is_stopped() {
            recorder.say("interrupted: the rows so far are written");
            recorder.finish(&args.rows, start.elapsed())?;
            return Ok(Ending::Interrupted);
        }
    }
    recorder.finish(&args.rows, start.elapsed())?;
    say_skipped(log.skipped(), rows);
    Ok(Ending::Whole)
}

fn say_skipped(skipped: Skipped, rows: u64) {
    let kinds = [
        (skipped.columns, "with a wrong number of columns"),
        (skipped.numbers, "without a number"),
        (skipped.time, "out of order in time"),
        (skipped.configurations, "with a configuration that cannot be"),
    ];
    let said: Vec<String> =
        kinds.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")).collect();
    if !said.is_empty() {
        let all = count((rows + skipped.rows()) as usize, "row", "rows");
        say(format_args!("skipped {} of {all}: {}", skipped.rows(), said.join(", ")));
    }
    if skipped.gaps > 0 {
        say(format_args!("{} in time", count(skipped.gaps as usize, "gap", "gaps")));
    }
}

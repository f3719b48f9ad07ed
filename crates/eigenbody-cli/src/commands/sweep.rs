//! `eigenbody sweep`.

use crate::args::SweepArgs;
use crate::failure::Failure;
use crate::output::deliver;
use eigenbody_report::{PlanRecord, SweepFolder, chunk_text, count, significant};
use eigenbody_study::sweep::{Plan, Spec, SweepError};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use std::path::Path;
use std::time::{Duration, Instant};

/// Time spent on finding out how long a case takes (s).
const TRIAL: f64 = 1.0;

/// Computes what is missing, and merges it.
pub fn run(args: &SweepArgs) -> Result<(), Failure> {
    let plan = plan(&args.spec)?;
    if args.dry_run {
        return rehearse(&plan);
    }
    let Some(output) = &args.output else {
        return Err(Failure::Usage("-o DIR: where the rows go; or --dry-run".into()));
    };
    let record = PlanRecord::new(&plan, env!("CARGO_PKG_VERSION"));
    let folder = SweepFolder::open(output, record)?;
    if !args.merge {
        let mine = |chunk: &u64| args.shard.is_none_or(|shard| shard.has(*chunk));
        // A chunk that something else has damaged is computed again.
        let is_missing = |chunk: &u64| !folder.is_whole(&plan, *chunk);
        let missing: Vec<u64> = (0..plan.chunks()).filter(mine).filter(is_missing).collect();
        compute(&plan, &folder, &missing)?;
    }
    let left = folder.missing().len();
    if args.shard.is_some() && !args.merge {
        return deliver(None, |out| match left {
            0 => writeln!(out, "{}: every chunk is there; --merge makes the table", output.display()),
            _ => writeln!(out, "{}: {left} of {} chunks are other shards'", output.display(), plan.chunks()),
        });
    }
    let table = folder.merge(&plan)?;
    deliver(None, |out| writeln!(out, "{}: {}", table.display(), count(plan.cases() as usize, "row", "rows")))
}

fn plan(path: &Path) -> Result<Plan, Failure> {
    let text =
        std::fs::read_to_string(path).map_err(|source| Failure::File { path: path.to_owned(), source })?;
    let spec = Spec::parse(&text).map_err(|error| Failure::Usage(format!("{}:{error}", path.display())))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    Plan::new(spec, folder).map_err(|error| {
        Failure::Usage(match error {
            SweepError::Spec(error) => format!("{}:{error}", path.display()),
            error => format!("{}: {error}", path.display()),
        })
    })
}

/// One thread a chunk, as many chunks at a time as there are threads.
fn compute(plan: &Plan, folder: &SweepFolder, missing: &[u64]) -> Result<(), Failure> {
    let cases = |chunk: u64| {
        let cases = plan.cases_of(chunk);
        cases.end - cases.start
    };
    let bar = ProgressBar::new(missing.iter().map(|&chunk| cases(chunk)).sum());
    if let Ok(style) =
        ProgressStyle::with_template("{elapsed_precise} [{bar:40}] {pos}/{len} cases, {per_sec}, {eta} left")
    {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    let one = |&number: &u64| {
        let chunk = plan.compute(number).map_err(|error| Failure::Usage(error.to_string()))?;
        let text = chunk_text(plan, &chunk).map_err(Failure::Stdout)?;
        folder.keep(number, &text)?;
        bar.inc(cases(number));
        Ok(())
    };
    let done = missing.par_iter().with_max_len(1).try_for_each(one);
    bar.finish_and_clear();
    done
}

/// How many cases, how long, how large: by a trial of cases spread over the plan.
fn rehearse(plan: &Plan) -> Result<(), Failure> {
    let (start, mut tried, mut bytes) = (Instant::now(), 0u64, 0usize);
    let mut seconds = 0.0;
    // Evenly spread, by the golden section: whenever time is up, all parts of the plan were seen.
    let mut place = 0.0;
    while tried < plan.cases() && (tried == 0 || seconds < TRIAL) {
        let number = ((place * plan.cases() as f64) as u64).min(plan.cases() - 1);
        place = (place + 0.618_033_988_749_894_8) % 1.0;
        let chunk =
            plan.compute_cases(number..number + 1).map_err(|error| Failure::Usage(error.to_string()))?;
        bytes += chunk_text(plan, &chunk).map_err(Failure::Stdout)?.len();
        tried += 1;
        seconds = start.elapsed().as_secs_f64();
    }
    let cases = plan.cases() as f64;
    let threads = rayon::current_num_threads();
    let total = cases * seconds / tried as f64;
    let megabytes = cases * bytes as f64 / tried as f64 / 1e6;
    deliver(None, |out| {
        let (cases, chunks) = (plan.cases() as usize, plan.chunks() as usize);
        writeln!(out, "{} in {}", count(cases, "case", "cases"), count(chunks, "chunk", "chunks"))?;
        writeln!(
            out,
            "at most {} s on one thread, {} s on {threads} (from {})",
            significant(total, 2),
            significant(total / threads as f64, 2),
            count(tried as usize, "case", "cases")
        )?;
        writeln!(out, "about {} MB of chunks", significant(megabytes, 2))
    })
}

//! The pages docs/estimators.md and docs/cost.md, with their figures: `cargo xtask estimators`, `cargo xtask cost`.
//!
//! `studies estimators|cost DOCS NAME BASE FILE ..`: BASE is fixed or floating.

use eigenbody::Base;
use eigenbody_formats::{LoadOptions, load};
use eigenbody_report::{StudyPage, cost_page, judged_page};
use eigenbody_study::motion::{Group, Subject, cost, judged};
use rayon::prelude::*;
use std::error::Error;
use std::path::Path;

type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [study, docs, robots @ ..] = arguments.as_slice() else {
        return Err("usage: studies estimators|cost DOCS NAME BASE FILE ..".into());
    };
    let robots = robots.chunks_exact(3).map(|robot| read(&robot[0], &robot[1], &robot[2]));
    let robots = robots.collect::<Outcome<Vec<_>>>()?;
    let page = match study.as_str() {
        "estimators" => estimators(robots)?,
        "cost" => costs(robots)?,
        _ => return Err(format!("no study '{study}'").into()),
    };
    let docs = Path::new(docs);
    std::fs::write(docs.join(format!("{study}.md")), page.text)?;
    for (name, svg) in page.figures {
        std::fs::write(docs.join("guide/src/figures").join(name), svg)?;
    }
    Ok(())
}

fn read(name: &str, base: &str, file: &str) -> Outcome<Subject> {
    let base = if base == "floating" { Base::Floating } else { Base::Fixed };
    let loaded = load(file, &LoadOptions { base, ..LoadOptions::default() })?;
    Ok(Subject { name: name.to_owned(), group: Group::Robot, model: loaded.model })
}

fn estimators(robots: Vec<Subject>) -> Outcome<StudyPage> {
    let mut subjects = judged::members()?;
    subjects.extend(robots);
    // One after the other, while nothing else runs.
    let costs = subjects.iter().map(judged::cost).collect::<Result<Vec<_>, _>>()?;
    let runs: Vec<_> =
        subjects.iter().flat_map(|subject| judged::Motion::ALL.map(|motion| (subject, motion))).collect();
    let judge = |&(subject, motion): &(&Subject, judged::Motion)| {
        let found = judged::judge(subject, motion);
        eprintln!("{}, {}", subject.name, motion.name());
        found
    };
    let found = runs.par_iter().map(judge).collect::<Result<Vec<_>, _>>()?;
    Ok(judged_page(&found, &costs))
}

fn costs(robots: Vec<Subject>) -> Outcome<StudyPage> {
    let mut subjects = cost::members()?;
    subjects.extend(robots);
    let digits = subjects.par_iter().map(cost::digits).collect::<Result<Vec<_>, _>>()?.concat();
    let effort = |subject: &Subject| {
        let found = cost::effort(subject);
        eprintln!("{}", subject.name);
        found
    };
    let (efforts, long_runs) = rayon::join(
        || subjects.par_iter().map(effort).collect::<Result<Vec<_>, _>>(),
        || {
            cost::RELEASES
                .par_iter()
                .map(|&release| cost::long_run(release, 1000.0, 1e-3))
                .collect::<Result<Vec<_>, _>>()
        },
    );
    Ok(cost_page(&digits, &efforts?, &long_runs?))
}

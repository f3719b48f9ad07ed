//! `eigenbody spectrum`.

use crate::args::{MethodArg, SpectrumArgs};
use crate::failure::Failure;
use crate::output::{check_model, deliver, page};
use crate::system::System;
use eigenbody::conditioning::conditioning_closed;
use eigenbody::{Metric, Question, conditioning_at, count_below};
use eigenbody_report::{CountReport, SpectrumReport};

/// Prints κ and what belongs to it.
pub fn run(args: &SpectrumArgs) -> Result<(), Failure> {
    let metric = eigenbody_formats::metric(&args.metric)?;
    if let Some(sigma) = args.count_below.filter(|sigma| !sigma.is_finite()) {
        return Err(Failure::Usage(format!("--count-below {sigma}: expected a finite number")));
    }
    let system = System::open(&args.robot)?;
    check_model(&system.loaded, &[args.output.as_deref()])?;
    let report = report(&system, metric, args)?;
    let path = args.output.as_deref();
    if args.json {
        let json = report.to_json().map_err(|error| Failure::Json(error.to_string()))?;
        deliver(path, |out| writeln!(out, "{json}"))
    } else {
        page(path, &report.to_text())
    }
}

fn report(system: &System, metric: Metric<f64>, args: &SpectrumArgs) -> Result<SpectrumReport, Failure> {
    let model = system.model();
    let dofs = system.reduction.dofs(model);
    let question = Question {
        metric,
        reduction: system.reduction,
        method: args.method.into(),
        precision: args.precision.into(),
        all: args.all,
    };
    let (result, loops) = match &system.loops {
        None => (conditioning_at(model, &system.q, &question).map_err(|error| system.failure(error))?, None),
        Some((closures, _)) => {
            if args.method == MethodArg::Sturm || args.count_below.is_some() {
                let text = "--loops closed leaves no tree: it takes neither --method sturm nor --count-below";
                return Err(Failure::Usage(text.into()));
            }
            let closed = conditioning_closed(model, &system.q, closures, &question);
            let (result, allowed) = closed.map_err(|error| system.failure(error))?;
            (result, system.loops_report(&allowed))
        }
    };
    let unit = question.metric.unit(dofs.iter().map(|&d| model.is_translation(d)));
    let report = SpectrumReport::new(system.subject(), &question.metric, unit, &result, system.dof_names());
    let count_below = match args.count_below {
        Some(sigma) => Some(count(system, &question, sigma)?),
        None => None,
    };
    Ok(SpectrumReport { findings: system.findings(), count_below, loops, ..report })
}

fn count(system: &System, question: &Question, sigma: f64) -> Result<CountReport, Failure> {
    let count =
        count_below(system.model(), &system.q, question, sigma).map_err(|error| system.failure(error))?;
    Ok(CountReport { sigma, count })
}

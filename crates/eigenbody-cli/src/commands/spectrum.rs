//! `eigenbody spectrum`.

use crate::args::SpectrumArgs;
use crate::failure::Failure;
use crate::output::deliver;
use crate::system::System;
use eigenbody::{Metric, conditioning};
use eigenbody_report::SpectrumReport;

/// Prints κ and what belongs to it.
pub fn run(args: &SpectrumArgs) -> Result<(), Failure> {
    let metric = eigenbody_formats::metric(&args.metric)?;
    let system = System::open(&args.robot)?;
    let report = report(&system, &metric, args)?;
    let path = args.output.as_deref();
    if args.json {
        let json = report.to_json().map_err(|error| Failure::Json(error.to_string()))?;
        deliver(path, |out| writeln!(out, "{json}"))
    } else {
        deliver(path, |out| write!(out, "{}", report.to_text()))
    }
}

fn report(system: &System, metric: &Metric<f64>, args: &SpectrumArgs) -> Result<SpectrumReport, Failure> {
    let H = system.mass_matrix()?;
    let dofs = system.reduction.dofs(system.model());
    let weights = metric
        .weights_of(&H, |row| system.model().is_translation(dofs[row]))
        .map_err(|error| system.failure(error))?;
    let result = conditioning(&H, &weights).map_err(|error| system.failure(error))?;
    let unit = metric.unit(dofs.iter().map(|&d| system.model().is_translation(d)));
    let report = SpectrumReport::new(system.subject(), metric, unit, &result, &weights, &system.dof_names());
    Ok(SpectrumReport {
        eigenvalues: args.all.then_some(result.spectrum.values),
        findings: system.findings(),
        ..report
    })
}

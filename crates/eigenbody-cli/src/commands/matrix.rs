//! `eigenbody matrix`.

use crate::args::MatrixArgs;
use crate::failure::Failure;
use crate::output::deliver;
use crate::system::System;
use eigenbody_report::MatrixReport;

/// Prints H.
pub fn run(args: &MatrixArgs) -> Result<(), Failure> {
    let system = System::open(&args.robot)?;
    let H = system.mass_matrix()?;
    let report = MatrixReport {
        subject: system.subject(),
        dofs: system.dof_names(),
        rows: (0..H.rows()).map(|i| H.row(i).to_vec()).collect(),
    };
    let path = args.output.as_deref();
    if args.npy {
        deliver(path, |out| report.write_npy(out))
    } else if args.csv {
        deliver(path, |out| report.write_csv(out))
    } else if args.json {
        let json = report.to_json().map_err(|error| Failure::Json(error.to_string()))?;
        deliver(path, |out| writeln!(out, "{json}"))
    } else {
        deliver(path, |out| write!(out, "{}", report.to_text()))
    }
}

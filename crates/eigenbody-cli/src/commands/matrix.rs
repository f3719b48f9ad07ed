//! `eigenbody matrix`.

use crate::args::MatrixArgs;
use crate::failure::Failure;
use crate::output::{check_model, deliver, page};
use crate::system::System;
use eigenbody::conditioning::allowed_motions;
use eigenbody::{Matrix, Metric};
use eigenbody_report::{AmongReport, MatrixReport};

/// Prints H.
pub fn run(args: &MatrixArgs) -> Result<(), Failure> {
    let system = System::open(&args.robot)?;
    check_model(&system.loaded, &[args.output.as_deref()])?;
    let rows = |M: &Matrix<f64>| (0..M.rows()).map(|i| M.row(i).to_vec()).collect();
    let (subject, joints) = (system.subject(), system.dof_names());
    let report = match &system.loops {
        None => MatrixReport { subject, dofs: joints, rows: rows(&system.mass_matrix()?), among: None },
        Some((closures, _)) => {
            let found =
                allowed_motions(system.model(), &system.q, closures, system.reduction, &Metric::Euclidean);
            let allowed = found.map_err(|error| system.failure(error))?;
            MatrixReport {
                subject,
                dofs: (1..=allowed.H.rows()).map(|k| format!("y{k}")).collect(),
                rows: rows(&allowed.H),
                among: system.loops_report(&allowed).map(|loops| AmongReport {
                    joints,
                    basis: rows(&allowed.basis),
                    loops,
                }),
            }
        }
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
        page(path, &report.to_text())
    }
}

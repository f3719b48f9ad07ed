//! `cargo xtask python-bench`: what a call from Python costs beside one from Rust and one of Pinocchio's, into its section of
//! docs/performance.md.

use super::figures::Figures;
use super::report::{self, table, time};
use crate::program::{build_directory, cargo, output, program, root, run};
use crate::{Outcome, oracle, python};

/// Turns that Rust and Python take.
const ROUNDS: usize = 7;
/// Configurations of the batch.
const COUNT: &str = "100000";
const SMALL: &str = "xarm_description/urdf/xarm7.urdf";
const BIG: &str = "g1_description/urdf/g1_29dof_rev_1_0.urdf";

/// Runs both in turn, several times over, and writes medians.
pub fn calls() -> Outcome {
    let directory = build_directory()?;
    python::ready(&directory)?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-formats", "--example", "calls"]))?;
    let share = "cmeel.prefix/share/example-robot-data/robots";
    let packages = output(
        program(oracle::python()).args(["-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]),
    )?;
    let robots = [SMALL, BIG].map(|file| std::path::Path::new(packages.trim()).join(share).join(file));
    let mut figures = Figures::default();
    for round in 1..=ROUNDS {
        println!("calls: round {round} of {ROUNDS}");
        let mut rust = program(directory.join("release/examples/calls"));
        figures.read(&output(rust.args(&robots).arg(COUNT))?)?;
        let mut script = program(oracle::python());
        figures.read(&output(script.arg("oracle/calls.py").args(&robots).arg(COUNT))?)?;
    }
    let text = text(&figures);
    println!("\n{text}");
    report::update(&root().join("docs/performance.md"), "python-bench", &text)
}

fn text(figures: &Figures) -> String {
    let get = |name: &str| figures.get(name);
    let mut rows = Vec::new();
    for (what, ours, rust, pinocchio) in [
        ("`mass_matrix(q)`", "python single", Some("rust single"), "pinocchio single"),
        ("the same, `out=`", "python single out", Some("rust single"), "pinocchio single"),
        ("`rnea(q, v, a)`", "python rnea", None, "pinocchio rnea"),
        ("`aba(q, v, tau)`", "python aba", None, "pinocchio aba"),
    ] {
        rows.push(vec![
            what.to_owned(),
            time(get(ours)),
            rust.map_or_else(|| "–".to_owned(), |rust| time(get(rust))),
            rust.map_or_else(|| "–".to_owned(), |rust| time(get(ours) - get(rust))),
            time(get(pinocchio)),
            format!("{:.2}×", get(pinocchio) / get(ours)),
        ]);
    }
    let head = ["call, n = 7 (xarm7)", "from Python", "from Rust", "more", "Pinocchio from Python", "ratio"];
    let batches =
        [("into memory that is there", "batch"), ("into new memory", "batch new")].map(|(what, name)| {
            let (python, rust) = (get(&format!("python {name}")), get(&format!("rust {name}")));
            vec![what.to_owned(), time(python), time(rust), format!("{:.3}", python / rust)]
        });
    format!(
        "{}\n{}\nMedians of {ROUNDS} rounds in which Rust and Python took turns; within a round each figure is the best of several. Goals: \
         at most 1.5 µs more than Rust and less than Pinocchio; batches at most 1.05 times those of Rust.\n",
        table("Calls from Python", &head, &rows),
        table(
            &format!("H of {COUNT} configurations of a floating G1, n = 35, all cores"),
            &["", "from Python", "from Rust", "ratio"],
            &batches
        )
    )
}

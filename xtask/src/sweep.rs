//! `cargo xtask sweep`: the same 200,000 cases on every engine, killed and resumed, into its section of docs/performance.md.

use crate::bench::figures::Figures;
use crate::bench::report::{self, table};
use crate::program::{build_directory, cargo, output, program, root, run};
use crate::{Outcome, oracle, python};
use std::process::Stdio;

/// Runs `oracle/sweep.py`, which fails if a row is lost, doubled or different.
pub fn sweep() -> Outcome {
    let directory = build_directory()?;
    python::ready(&directory)?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let mut script = program(oracle::python());
    script.arg("oracle/sweep.py").arg(directory.join("release/eigenbody")).arg(directory.join("sweep"));
    let mut figures = Figures::default();
    figures.read(&output(script.stderr(Stdio::inherit()))?)?;
    let text = text(&figures);
    println!("\n{text}");
    report::update(&root().join("docs/performance.md"), "sweep", &text)
}

fn text(figures: &Figures) -> String {
    let get = |name: &str| figures.get(name);
    let row = |name: &str| {
        let cpu = get(&format!("{name} cpu"));
        let cpu = if cpu.is_nan() { "–".to_owned() } else { format!("{cpu:.1} s") };
        vec![name.to_owned(), format!("{:.1} s", get(&format!("{name} wall"))), cpu]
    };
    let runs = [
        "serial",
        "1 process",
        "2 processes",
        "command, 1 thread",
        "command, 2 threads",
        "Dask, 2 workers, one killed",
        "MPI, 2 workers",
        "command, killed 10 times",
        "command, disk full, then resumed",
    ];
    format!(
        "{}\n{:.0} cases in {:.0} chunks of {:.2} s; every table has the same {:.1} MB, byte for byte, and every case once. 2 workers are {:.2} \
         times as fast as 1 by the clock. The machine did other things besides; by processor time, which does not see those, the rows of \
         2 workers cost {:.3} times those of 1, the busier of the two had {:.3} of them, and what one process does alone \
         (planning, merging) takes {:.2} s: {:.2} times as fast. Dask's killed worker had computed {:.0} chunks; the command had \
         {:.0} chunks when it was killed for the first time and {:.0} for the last; the full disk took {:.0}.\n",
        table("A sweep on every engine", &["", "time", "processor time of workers"], &runs.map(row)),
        get("cases"),
        get("chunks"),
        get("1 process cpu") / get("chunks"),
        get("bytes") / 1e6,
        get("1 process wall") / get("2 processes wall"),
        get("2 processes cpu") / get("1 process cpu"),
        get("2 processes busier"),
        get("alone"),
        (get("alone") + get("1 process cpu"))
            / (get("alone") + get("2 processes cpu") * get("2 processes busier")),
        get("dask chunks at kill"),
        get("kill first"),
        get("kill last"),
        get("full chunks"),
    )
}

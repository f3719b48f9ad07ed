//! `cargo xtask tracking`: the tracker beside Pinocchio, LAPACK and faer, into its section of docs/performance.md.

use super::figures::Figures;
use super::report::{self, table, time};
use super::{ROUNDS, peers};
use crate::program::{build_directory, output, program, root, run};
use crate::{Outcome, oracle};

/// Runs all in turn, several times over, and writes medians.
pub fn tracking() -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    let directory = build_directory()?;
    let peers = peers(&directory)?;
    let motions = directory.join("peers/motions");
    run(program(&peers).arg("motions").arg(&motions))?;
    let mut figures = Figures::default();
    for round in 1..=ROUNDS {
        println!("track: round {round} of {ROUNDS}");
        figures.read(&output(program(&peers).arg("track"))?)?;
        let mut pinocchio = program(oracle::python());
        pinocchio.arg("oracle/tracking.py").arg(&motions);
        figures.read(&output(pinocchio.env("OMP_NUM_THREADS", "1").env("OPENBLAS_NUM_THREADS", "1"))?)?;
    }
    let text = text(&figures);
    println!("\n{text}");
    report::update(&root().join("docs/performance.md"), "tracking", &text)
}

fn text(figures: &Figures) -> String {
    let mut rows = Vec::new();
    let mut worst = 0.0f64;
    for skew in ["0", "0.5"] {
        for (n, goal) in [(7, 2), (35, 5), (100, 20), (1000, 200)] {
            let get = |what: &str| figures.get(&format!("{what} {skew}-{n}"));
            let (track, dense, pinocchio) = (get("track"), get("dense"), get("pinocchio"));
            worst = worst.max(get("error track"));
            let ratio = |other: f64| format!("{:.1}×", other / track);
            rows.push(vec![
                n.to_string(),
                if skew == "0" { "parallel" } else { "skew" }.to_owned(),
                time(track),
                time(pinocchio),
                ratio(pinocchio),
                format!("{goal}×"),
                time(dense),
                ratio(dense),
            ]);
        }
    }
    let head = [
        "n",
        "axes",
        "tracker, both ends",
        "Pinocchio CRBA, LAPACK",
        "ratio",
        "goal",
        "own CRBA, faer",
        "ratio",
    ];
    format!(
        "{}\nOne step of 1 ms of a chain that swings, hydra(n, 1, α, 1) with α = 0 or 0.5, one thread. Pinocchio and LAPACK are called from Python, which \
         adds some microseconds a step and decides the figure at n = 7; Pinocchio's workspace does not fit into memory at n = 1000, where the \
         figure is LAPACK's alone; CRBA and faer run in the tracker's own process. Largest difference of \
         either end, of λmax: {worst:.0e}.\n",
        table("Both extremes along a motion", &head, &rows)
    )
}

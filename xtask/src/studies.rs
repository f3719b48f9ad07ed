//! `cargo xtask estimators` and `cargo xtask cost`: two studies along motions, into docs/.

use crate::program::{build_directory, cargo, output, program, root, run};
use crate::{Outcome, oracle};

/// Estimators of κ beside κ itself: docs/estimators.md.
pub fn estimators() -> Outcome {
    study("estimators")
}

/// What ill-conditioning costs: docs/cost.md.
pub fn cost() -> Outcome {
    study("cost")
}

fn study(name: &str) -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    let robots = output(program(oracle::python()).arg("oracle/studies.py"))?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli", "--example", "studies"]))?;
    let mut call = program(build_directory()?.join("release/examples/studies"));
    call.arg(name).arg(root().join("docs"));
    run(call.args(robots.lines().flat_map(|line| line.split('\t'))))
}

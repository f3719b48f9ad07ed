//! `cargo xtask survey`: what `eigenbody check` says of published robots, into docs/survey.md.

use crate::program::{build_directory, cargo, program, root, run};
use crate::{Outcome, oracle};

/// Builds the command in release and hands it to `oracle/survey.py`.
pub fn survey() -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let command = build_directory()?.join("release/eigenbody");
    let page = root().join("docs/survey.md");
    run(program(oracle::python()).arg(root().join("oracle/survey.py")).arg(command).arg(page))
}

//! `cargo xtask survey`: what `eigenbody check` says of published robots, into docs/survey.md.

use crate::program::{build_directory, cargo, program, root, run};
use crate::{Outcome, oracle};

/// Builds the command in release and hands it to `oracle/survey.py`.
pub fn survey() -> Outcome {
    with_command("oracle/survey.py", Some("docs/survey.md"))
}

/// Builds the command in release and hands it to a script, with the page that the script writes.
pub fn with_command(script: &str, page: Option<&str>) -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let command = build_directory()?.join("release/eigenbody");
    let pages = page.map(|page| root().join(page));
    run(program(oracle::python()).arg(root().join(script)).arg(command).args(pages))
}

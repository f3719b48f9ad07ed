//! `cargo xtask conformance`: the released command against Pinocchio and against 300 digits, on real robots.

use crate::program::{build_directory, cargo, program, root, run};
use crate::{Outcome, oracle};

/// Builds the command in release, as users get it, and hands it to `oracle/conformance.py` and `oracle/hard.py`.
pub fn check() -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let command = build_directory()?.join("release").join("eigenbody");
    for script in ["oracle/conformance.py", "oracle/hard.py"] {
        run(program(oracle::python()).arg(root().join(script)).arg(&command))?;
    }
    Ok(())
}

//! `cargo xtask stability`: 0.95 of the largest step is stable, 1.05 is not, in MuJoCo and Pinocchio, on every robot of four packages.

use crate::Outcome;
use crate::survey::with_command;

/// Builds the command in release and hands it to `oracle/stability.py`.
pub fn stability() -> Outcome {
    with_command("oracle/stability.py", None)
}

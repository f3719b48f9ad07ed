//! `cargo xtask newton`: what `eigenbody check` measures on the robots of a report on a simulator, into docs/guide/src/newton.md.

use crate::Outcome;
use crate::survey::with_command;

/// Builds the command in release and hands it to `oracle/newton.py`.
pub fn newton() -> Outcome {
    with_command("oracle/newton.py", Some("docs/guide/src/newton.md"))
}

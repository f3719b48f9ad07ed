//! The tasks that are lists of steps: `test` and `ci`.
//!
//! Artefacts are shared where cargo can: clippy and rustdoc check the same dependencies once, `cargo test` and xtask
//! itself build in the dev profile, and only the command that conformance runs is built in release.

use crate::bench::instructions;
use crate::program::{cargo, run};
use crate::steps::{self, Step};
use crate::{Outcome, conformance, explorer, layers, oracle, python};

const CHECKS: [Step; 4] = [
    Step { name: "fmt", needs: None, run: fmt },
    Step { name: "layers", needs: None, run: layers::check },
    Step { name: "clippy", needs: None, run: clippy },
    Step { name: "doc", needs: None, run: doc },
];

const TESTS: [Step; 5] = [
    Step { name: "cargo test", needs: None, run: cargo_test },
    Step { name: "oracle", needs: None, run: oracle::prepare },
    Step { name: "conformance", needs: Some("oracle"), run: conformance::check },
    Step { name: "python", needs: Some("oracle"), run: python::test },
    Step { name: "explorer", needs: Some("oracle"), run: explorer::test },
];

const COUNTS: [Step; 1] = [Step { name: "instructions", needs: None, run: instructions::check }];

/// Every test there is.
pub fn test() -> Outcome {
    steps::run(&TESTS)
}

/// What a change must pass.
pub fn ci() -> Outcome {
    steps::run(CHECKS.iter().chain(&TESTS).chain(&COUNTS))
}

fn fmt() -> Outcome {
    run(&mut cargo(&["fmt", "--all", "--check"]))
}

fn clippy() -> Outcome {
    run(&mut cargo(&[
        "clippy",
        "--workspace",
        "--all-targets",
        "--all-features",
        "--keep-going",
        "--",
        "-D",
        "warnings",
    ]))
}

fn doc() -> Outcome {
    run(cargo(&["doc", "--workspace", "--all-features", "--no-deps", "--keep-going"])
        .env("RUSTDOCFLAGS", "-D warnings"))
}

fn cargo_test() -> Outcome {
    run(&mut cargo(&["test", "--workspace", "--all-features", "--no-fail-fast"]))
}

//! `cargo xtask conformance`: real robots against the engines that their formats come from, and against 300 digits.

use crate::program::{build_directory, cargo, program, root, run};
use crate::{Outcome, oracle};

/// The released command on some robots, as users get it, and the readers on every file of whole packages.
pub fn check() -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-formats", "--examples"]))?;
    let release = build_directory()?.join("release");
    let compare = |script: &str, with: &str| {
        run(program(oracle::python()).arg(root().join("oracle").join(script)).arg(release.join(with)))
    };
    compare("conformance.py", "eigenbody")?;
    compare("hard.py", "eigenbody")?;
    compare("robots.py", "examples/matrices")?;
    compare("loops.py", "eigenbody")?;
    compare("page.py", "eigenbody")?;
    compare("broken.py", "examples/mutations")
}

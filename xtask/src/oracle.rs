//! `cargo xtask oracle`: the Python reference in a virtual environment of its own, `.oracle/`.

use std::path::PathBuf;

use crate::Outcome;
use crate::program::{output, program, root, run};

const REQUIREMENTS: &str = "oracle/requirements.txt";

/// The environment's interpreter.
pub fn python() -> PathBuf {
    environment().join("bin/python")
}

fn environment() -> PathBuf {
    root().join(".oracle")
}

/// Installs the pinned packages of `oracle/requirements.txt`, unless they already are.
///
/// A stamp, written last, holds what was installed and for which Python: an interrupted or outdated installation is
/// made anew.
pub fn prepare() -> Outcome {
    let version = output(program("python3").arg("--version")).map_err(|error| {
        format!(
            "{error}: the oracle needs python3 and python3-venv (Debian, Ubuntu: apt install python3-venv)"
        )
    })?;
    let requirements = std::fs::read_to_string(root().join(REQUIREMENTS))
        .map_err(|error| format!("cannot read {REQUIREMENTS}: {error}"))?;
    let wanted = format!("# {version}{requirements}");
    let stamp = environment().join("stamp");
    if std::fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) && python().exists() {
        println!("oracle: .oracle/ is up to date");
        return Ok(());
    }
    install()?;
    std::fs::write(&stamp, wanted).map_err(|error| format!("cannot write {}: {error}", stamp.display()))
}

fn install() -> Outcome {
    output(program("python3").args(["-c", "import venv, ensurepip"])).map_err(|_| {
        "python3 cannot make virtual environments: install python3-venv (Debian, Ubuntu: apt install python3-venv)"
    })?;
    run(program("python3").args(["-m", "venv", "--clear"]).arg(environment()))?;
    // Ready-made packages only: building Pinocchio from source would fail late and at length. The list is complete.
    run(program(python())
        .args(["-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check"])
        .args(["--only-binary", ":all:", "--no-deps", "-r", REQUIREMENTS]))
}

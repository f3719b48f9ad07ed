//! `cargo xtask python`: the Python package, built as a wheel, installed and tested beside Pinocchio and MuJoCo.

use std::fs;
use std::path::{Path, PathBuf};

use crate::program::{build_directory, cargo, program, root, run};
use crate::{Outcome, oracle};

const PACKAGE: &str = "crates/eigenbody-py";
/// Largest wheel (bytes).
const LARGEST: u64 = 10_000_000;

/// Builds the wheel and puts it beside the oracle.
pub fn ready(directory: &Path) -> Result<PathBuf, String> {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    let wheel = build(directory)?;
    install(&oracle::python(), &wheel)?;
    Ok(wheel)
}

/// Builds the wheel and runs every test of the package.
pub fn test() -> Outcome {
    let directory = build_directory()?;
    let wheel = ready(&directory)?;
    clean(&directory, &wheel)?;
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let here = |arguments: &[&str]| {
        let mut call = program(oracle::python());
        call.current_dir(root().join(PACKAGE))
            .args(arguments)
            .env("EIGENBODY", directory.join("release/eigenbody"));
        run(&mut call)
    };
    here(&["-m", "pytest"])?;
    here(&["-m", "mypy", "--cache-dir=/dev/null"])?;
    here(&["-m", "mypy.stubtest", "eigenbody", "--mypy-config-file", "pyproject.toml"])
}

fn build(directory: &Path) -> Result<PathBuf, String> {
    let wheels = directory.join("wheels");
    let _ = fs::remove_dir_all(&wheels);
    let mut maturin = program(oracle::python());
    maturin.args(["-m", "maturin", "build", "--quiet", "--release", "--manifest-path"]);
    maturin.arg(format!("{PACKAGE}/Cargo.toml")).arg("--out").arg(&wheels);
    run(maturin.arg("--interpreter").arg(oracle::python()))?;
    let entries = fs::read_dir(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
    let wheel = entries.filter_map(|entry| Some(entry.ok()?.path())).next().ok_or("no wheel was built")?;
    let size = fs::metadata(&wheel).map_err(|error| error.to_string())?.len();
    println!("{}: {:.1} MB", wheel.display(), size as f64 / 1e6);
    if size > LARGEST {
        Err(format!("the wheel has {size} bytes, expected at most {LARGEST}"))
    } else {
        Ok(wheel)
    }
}

fn install(python: &Path, wheel: &Path) -> Outcome {
    let pip = ["-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check"];
    run(program(python).args(pip).args(["--force-reinstall", "--no-deps"]).arg(wheel))
}

/// The package works in an environment that has numpy and nothing else.
fn clean(directory: &Path, wheel: &Path) -> Outcome {
    let environment = directory.join("clean");
    run(program("python3").args(["-m", "venv", "--clear"]).arg(&environment))?;
    let python = environment.join("bin/python");
    let pip = ["-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check"];
    run(program(&python).args(pip).arg(wheel))?;
    run(program(&python).args(["-c", "import eigenbody; print(eigenbody.Model('puma560').conditioning())"]))
}

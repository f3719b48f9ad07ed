//! `cargo xtask bench`: the figures of docs/performance.md, measured in one go.
//!
//! eigenbody and the dense solvers run in turn, several times over, and medians are compared: on a machine that does other
//! things besides, only ratios within one run mean anything.

pub mod calls;
pub mod figures;
pub mod instructions;
pub mod peers;
pub mod report;
mod tracking;

use std::path::{Path, PathBuf};

use crate::program::{build_directory, cargo, output, program, root, run};
use crate::{Outcome, oracle};
use figures::Figures;
pub use tracking::tracking;

/// Turns of each program.
const ROUNDS: usize = 5;
/// Numbers of bodies for which the command's time and memory are measured.
const SIZES: [usize; 4] = [1000, 10_000, 100_000, 1_000_000];
/// Robots of each size.
const SHAPES: [(&str, &str); 2] = [("chain", "1,0,1"), ("tree", "2,0.5,1")];

/// Measures everything, prints it, writes `bench.json` into the build directory and the section of docs/performance.md.
pub fn bench() -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    let directory = build_directory()?;
    let mut figures = Figures::default();
    compare(&directory, &mut figures)?;
    scale(&directory, &mut figures)?;
    let limits = instructions::count(&directory, &mut figures);
    let text = report::text(&figures);
    println!("\n{text}");
    write(&directory.join("bench.json"), &figures.json())?;
    report::update(&root().join("docs/performance.md"), "bench", &text)?;
    limits
}

/// The engine beside faer, in one process, and LAPACK.
fn compare(directory: &Path, figures: &mut Figures) -> Outcome {
    let peers = peers(directory)?;
    let matrices = directory.join("peers/matrices");
    run(program(&peers).arg("matrices").arg(&matrices))?;
    for round in 1..=ROUNDS {
        println!("compare: round {round} of {ROUNDS}");
        figures.read(&output(program(&peers).arg("time"))?)?;
        let mut lapack = program(oracle::python());
        lapack.arg("oracle/lapack.py").arg(&matrices);
        figures.read(&output(lapack.env("OMP_NUM_THREADS", "1").env("OPENBLAS_NUM_THREADS", "1"))?)?;
    }
    Ok(())
}

/// Builds `benches/peers`.
fn peers(directory: &Path) -> Result<PathBuf, String> {
    let target = directory.join("peers");
    run(cargo(&["build", "--release", "--manifest-path", "benches/peers/Cargo.toml", "--target-dir"])
        .arg(&target))?;
    Ok(target.join("release/peers"))
}

/// Time and peak memory of the command, the building of the model included.
fn scale(directory: &Path, figures: &mut Figures) -> Outcome {
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let command = directory.join("release/eigenbody");
    for round in 1..=ROUNDS {
        println!("scale: round {round} of {ROUNDS}");
        for size in SIZES {
            for (name, shape) in SHAPES {
                let mut call = program(oracle::python());
                call.arg("oracle/resources.py").arg(&command);
                call.args(["spectrum", &format!("hydra({size},{shape})"), "--at", "zag(0)"]);
                let answer = output(&mut call)?;
                let (seconds, kilobytes) = answer.split_once(' ').ok_or("resources.py: no answer")?;
                figures
                    .read(&format!("command {name} {size}\t{seconds}\nmemory {name} {size}\t{kilobytes}"))?;
            }
        }
    }
    Ok(())
}

fn write(path: &PathBuf, text: &str) -> Outcome {
    std::fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

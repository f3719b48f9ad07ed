//! Instruction counts of `crates/eigenbody/benches/instructions.rs`, under Valgrind.

use std::path::{Path, PathBuf};

use super::Figures;
use crate::Outcome;
use crate::program::{build_directory, cargo, debian, output, program, run};

/// The library's version in Cargo.lock: the runner must be the same.
const VERSION: &str = "0.20.0";

/// That no count exceeds its limit: a step of `cargo xtask ci`.
pub fn check() -> Outcome {
    if output(program("valgrind").arg("--version")).is_err() {
        debian("valgrind")?;
    }
    count(&build_directory()?, &mut Figures::default())
}

/// Counts, and fails where a count exceeds its limit. Without Valgrind there are no counts, and that is said.
pub fn count(directory: &Path, figures: &mut Figures) -> Outcome {
    if let Err(error) = output(program("valgrind").arg("--version")) {
        println!("instructions: not counted: {error}");
        return Ok(());
    }
    let runner = runner(directory)?;
    let mut bench = cargo(&["bench", "--package", "eigenbody", "--bench", "instructions"]);
    let answer = bench.env("GUNGRAUN_RUNNER", runner).output().map_err(|error| error.to_string())?;
    let text = String::from_utf8_lossy(&answer.stdout);
    print!("{text}");
    figures.read(&lines(&text))?;
    match answer.status.success() {
        true => Ok(()),
        false => Err("instructions: a count exceeds its limit".into()),
    }
}

/// The runner, installed beside the build.
fn runner(directory: &Path) -> Result<PathBuf, String> {
    let tools = directory.join("tools");
    let runner = tools.join("bin/gungraun-runner");
    let found = output(program(&runner).arg("--version")).unwrap_or_default();
    if !found.trim().ends_with(VERSION) {
        let mut install = cargo(&["install", "--quiet", "--locked", "--version", VERSION, "--root"]);
        run(install.arg(&tools).arg("gungraun-runner"))?;
    }
    Ok(runner)
}

/// `instructions::group::sweep chain:..` and then `Instructions: 1168310|..`, as `instructions sweep chain`, tab, number.
fn lines(text: &str) -> String {
    let mut name = "";
    let mut found = String::new();
    for line in text.lines() {
        if let Some((_, title)) = line.strip_prefix("instructions::").and_then(|title| title.split_once("::"))
        {
            name = title.split(':').next().unwrap_or(title);
        } else if let Some(count) = line.trim().strip_prefix("Instructions:") {
            let count = count.trim().split('|').next().unwrap_or_default();
            found += &format!("instructions {name}\t{count}\n");
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::lines;

    #[test]
    fn counts_are_found() {
        let text = "\
instructions::engine::sweep chain:(pencil(1000, 1.0, 0.0))
  Instructions:                                    1168310|1168300              (+0.00086%) [+1.00001x]
  L1 Hits:                                         1873829|N/A                  (*********)
instructions::kernels::inverse arm:(arm())
  Instructions:                                       2994|2987                 (+0.23435%) [+1.00234x]

Regressions:
  instructions::engine::sweep chain:
    Callgrind: Instructions (1168310): 1168310 exceeds limit of 1000000 by 168310
";
        assert_eq!(lines(text), "instructions sweep chain\t1168310\ninstructions inverse arm\t2994\n");
    }
}

//! `cargo xtask conformance`: the released command against Pinocchio, on real robots.

use std::path::{Path, PathBuf};

use crate::program::{cargo, output, program, root, run};
use crate::{Outcome, oracle};

/// Builds the command in release, as users get it, and hands it to `oracle/conformance.py`.
pub fn check() -> Outcome {
    if !oracle::python().exists() {
        return Err("the oracle is not installed: run `cargo xtask oracle` first".into());
    }
    run(&mut cargo(&["build", "--release", "--package", "eigenbody-cli"]))?;
    let command = build_directory()?.join("release").join("eigenbody");
    run(program(oracle::python()).arg(root().join("oracle/conformance.py")).arg(command))
}

/// Where cargo builds: `target/`, unless the environment or a configuration file moved it.
fn build_directory() -> Result<PathBuf, String> {
    let metadata = output(&mut cargo(&["metadata", "--format-version", "1", "--no-deps"]))?;
    let directory =
        text_field(&metadata, "target_directory").ok_or("cargo metadata names no target directory")?;
    Ok(Path::new(directory).to_path_buf())
}

/// The value of a text field that holds nothing escaped.
fn text_field<'a>(json: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = json.split_once(&format!("\"{name}\":\""))?;
    let (value, _) = rest.split_once('"')?;
    (!value.contains('\\')).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::text_field;

    #[test]
    fn a_text_field_is_found_by_its_name() {
        let json = r#"{"packages":[],"target_directory":"/src/robot/target","version":1}"#;
        assert_eq!(text_field(json, "target_directory"), Some("/src/robot/target"));
        assert_eq!(text_field(json, "workspace_root"), None);
    }
}

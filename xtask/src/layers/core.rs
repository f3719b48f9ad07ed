//! The arrows between the modules of the core.

use std::path::Path;

use super::files::{Source, entries};
use super::order::Order;
use super::paths::root_paths;

/// The modules directly under the crate's root.
pub fn modules(root: &Path, folder: &Path) -> Result<Vec<String>, String> {
    let names = entries(root, folder)?;
    Ok(names
        .iter()
        .map(|name| name.trim_end_matches(".rs").to_string())
        .filter(|name| name != "lib")
        .collect())
}

/// What is wrong with one file of the core, `folder` being its root.
pub fn violations(source: &Source, folder: &Path, order: &Order<'_>) -> Vec<String> {
    let Some((module, depth)) = place(source.path.strip_prefix(folder).unwrap_or(&source.path)) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for path in root_paths(&source.text, depth) {
        if let Some(objection) = order.objection(&module, path.name) {
            found.push(format!("{}:{}: {objection}", source.path.display(), path.line));
        }
    }
    found
}

/// The top module to which a file belongs and how deep the file's own module lies; none for the root itself.
fn place(path: &Path) -> Option<(String, usize)> {
    let path = path.with_extension("");
    let mut names: Vec<String> = path.iter().map(|name| name.to_string_lossy().into_owned()).collect();
    names.pop_if(|name| name == "mod");
    let depth = names.len();
    names.into_iter().next().filter(|module| module != "lib").map(|module| (module, depth))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> Vec<String> {
        let source = Source { path: path.into(), text: text.into() };
        violations(&source, Path::new("src"), &Order(&["error", "scalar", "model"]))
    }

    #[test]
    fn arrows_back_are_reported_with_file_and_line() {
        let text = "use crate::error::Error;\nuse crate::{\n    scalar::Dd,\n    model::Model,\n};\n";
        assert_eq!(
            found("src/scalar/dd.rs", text),
            ["src/scalar/dd.rs:4: `scalar` uses `model`, which comes after it"]
        );
        assert!(found("src/model/mod.rs", text).is_empty());
    }

    #[test]
    fn the_short_cut_through_the_root_is_reported() {
        assert_eq!(
            found("src/model.rs", "use crate::Error;"),
            ["src/model.rs:1: `model` uses `Error`, which is not on the list"]
        );
        assert!(found("src/lib.rs", "use crate::Error;").is_empty());
    }

    #[test]
    fn super_is_no_way_round() {
        let text = "use super::super::model::Model;";
        assert_eq!(
            found("src/scalar/dd.rs", text),
            ["src/scalar/dd.rs:1: `scalar` uses `model`, which comes after it"]
        );
        assert_eq!(found("src/scalar/mod.rs", "use super::model;").len(), 1);
        assert!(found("src/scalar/dd.rs", "use super::model;").is_empty());
    }
}

//! `cargo xtask layers`: the one-way arrows of docs/ARCHITECTURE.md.

mod core;
mod document;
mod files;
mod manifest;
mod order;
mod paths;
mod tokens;

use std::path::Path;

use crate::Outcome;
use crate::program::root;
use files::{Source, entries, read, sources};
use order::Order;

/// The crates: each uses only those before it. docs/ARCHITECTURE.md says the same.
const CRATES: [&str; 8] = [
    "crates/eigenbody",
    "crates/eigenbody-formats",
    "crates/eigenbody-study",
    "crates/eigenbody-report",
    "crates/eigenbody-py",
    "crates/eigenbody-web",
    "crates/eigenbody-cli",
    "xtask",
];

const CORE: &str = "crates/eigenbody/src";
const DOCUMENT: &str = "docs/ARCHITECTURE.md";

/// A file longer than this deserves a second thought.
const LONG: usize = 400;

/// Checks crates, core modules and the document against each other; prints every violation.
pub fn check() -> Outcome {
    let root = root();
    let document = read(&root, Path::new(DOCUMENT))?;
    let floors = document::floors(&document).map_err(|error| format!("{DOCUMENT}: {error}"))?;
    let core = sources(&root, Path::new(CORE))?;

    let mut violations = document_violations(&floors);
    violations.extend(crate_violations(&root)?);
    violations.extend(module_violations(&root, &core, &Order(&floors.modules))?);

    for source in sources(&root, Path::new("crates"))?.iter().chain(&sources(&root, Path::new("xtask"))?) {
        let lines = source.text.lines().count();
        if lines > LONG {
            eprintln!("warning: {}: {lines} lines, more than {LONG}", source.path.display());
        }
    }
    for violation in &violations {
        eprintln!("{violation}");
    }
    match violations.len() {
        0 => {
            let (crates, modules) = (CRATES.len(), floors.modules.len());
            println!(
                "layers: {crates} crates, {modules} core modules in {} files, all arrows one way",
                core.len()
            );
            Ok(())
        }
        1 => Err("1 violation of the layers".into()),
        count => Err(format!("{count} violations of the layers")),
    }
}

/// The document's block of crates is `CRATES`, its table of modules follows its line of modules.
fn document_violations(floors: &document::Floors<'_>) -> Vec<String> {
    let mut found = Vec::new();
    if floors.crates != CRATES {
        found.push(format!("{DOCUMENT}: the crates must be {}, in this order", CRATES.join(", ")));
    }
    if floors.table != floors.modules {
        found.push(format!("{DOCUMENT}: the table of modules and the line `core:` differ"));
    }
    found
}

fn crate_violations(root: &Path) -> Result<Vec<String>, String> {
    let mut existing: Vec<String> =
        entries(root, Path::new("crates"))?.iter().map(|name| format!("crates/{name}")).collect();
    existing.push("xtask".into());
    let mut found = Order(&CRATES).differences(&existing);

    let names = CRATES.map(package_name);
    let order = Order(&names);
    for folder in CRATES.iter().filter(|folder| existing.iter().any(|other| other == *folder)) {
        let path = Path::new(folder).join("Cargo.toml");
        let manifest = read(root, &path)?;
        for dependency in manifest::dependencies(&manifest) {
            if !names.contains(&dependency.package) {
                continue;
            }
            if let Some(objection) = order.objection(package_name(folder), dependency.package) {
                found.push(format!("{}:{}: {objection}", path.display(), dependency.line));
            }
        }
    }
    Ok(found)
}

fn module_violations(root: &Path, core: &[Source], order: &Order<'_>) -> Result<Vec<String>, String> {
    let folder = Path::new(CORE);
    let mut found = order.differences(&core::modules(root, folder)?);
    for source in core {
        found.extend(core::violations(source, folder, order));
    }
    Ok(found)
}

/// A package has the name of its folder.
fn package_name(folder: &str) -> &str {
    folder.rsplit('/').next().unwrap_or(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_document_must_agree() {
        let modules = vec!["error", "scalar"];
        let right =
            document::Floors { crates: CRATES.to_vec(), modules: modules.clone(), table: modules.clone() };
        assert!(document_violations(&right).is_empty());
        let wrong =
            document::Floors { crates: CRATES[1..].to_vec(), modules, table: vec!["scalar", "error"] };
        assert_eq!(document_violations(&wrong).len(), 2);
    }
}

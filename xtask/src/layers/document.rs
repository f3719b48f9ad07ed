//! The order that docs/ARCHITECTURE.md states.

/// What the section "Floors" lists, top to bottom.
#[derive(Debug, PartialEq)]
pub struct Floors<'a> {
    /// Folders of crates: a crate uses only those before it.
    pub crates: Vec<&'a str>,
    /// Core modules: a module uses only those before it.
    pub modules: Vec<&'a str>,
    /// The rows of the table of core modules.
    pub table: Vec<&'a str>,
}

/// Reads the block of crates, the line that starts with `core:` and the table of modules.
pub fn floors(document: &str) -> Result<Floors<'_>, String> {
    let (_, rest) = document.split_once("\n## Floors\n").ok_or("there is no section `## Floors`")?;
    let section = rest.split("\n## ").next().unwrap_or(rest);
    let (_, rest) = section.split_once("```text\n").ok_or("section `Floors` has no block of crates")?;
    let (block, after) = rest.split_once("```").ok_or("the block of crates has no end")?;
    let core = block.lines().find_map(|line| line.strip_prefix("core:"));
    let core = core.ok_or("there is no line that starts with `core:`")?;
    let crates = block.lines().take_while(|line| !line.starts_with("core:"));
    Ok(Floors {
        crates: crates.filter_map(|line| line.split_whitespace().next()).collect(),
        modules: core.split('>').map(str::trim).collect(),
        table: after.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next()).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::{Floors, floors};

    const DOCUMENT: &str = "\
# Architecture

## Floors

```text
crates/core   numbers
crates/cli    the command

core: error > scalar > model
```

| module | one line |
|---|---|
| `error` | what can go wrong |
| `scalar` | a `number` |

## Invariants

| `later` | no module |
";

    #[test]
    fn the_section_is_read() {
        let expected = Floors {
            crates: vec!["crates/core", "crates/cli"],
            modules: vec!["error", "scalar", "model"],
            table: vec!["error", "scalar"],
        };
        assert_eq!(floors(DOCUMENT), Ok(expected));
    }

    #[test]
    fn what_is_missing_is_named() {
        assert_eq!(floors("# Architecture\n"), Err("there is no section `## Floors`".into()));
        let without = DOCUMENT.replace("core: ", "modules: ");
        assert_eq!(floors(&without), Err("there is no line that starts with `core:`".into()));
    }
}

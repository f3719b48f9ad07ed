//! The packages that a Cargo.toml depends on.

/// A dependency and its line, from 1.
#[derive(Debug, PartialEq)]
pub struct Dependency<'a> {
    /// Name of the package.
    pub package: &'a str,
    /// Its line, from 1.
    pub line: usize,
}

/// What the package needs to be built; what only its tests need is exempt.
pub fn dependencies(manifest: &str) -> Vec<Dependency<'_>> {
    let mut found = Vec::new();
    let mut is_list = false;
    for (line, text) in (1..).zip(manifest.lines()) {
        let text = text.trim();
        if let Some(section) = text.strip_prefix('[').and_then(|text| text.split(']').next()) {
            let (table, entry) = split_section(section);
            is_list = table && entry.is_none();
            found.extend(entry.filter(|_| table).map(|package| Dependency { package, line }));
        } else if is_list && !text.starts_with('#') {
            found.extend(package(text).map(|package| Dependency { package, line }));
        }
    }
    found
}

/// Whether a section lists dependencies, and the one it is about if it is about one: `[dependencies.NAME]`.
fn split_section(section: &str) -> (bool, Option<&str>) {
    // The condition of `[target.'cfg(..)'.dependencies]` is quoted.
    let section = section.rsplit('\'').next().unwrap_or(section).trim_start_matches('.');
    let (table, entry) =
        section.split_once('.').map_or((section, None), |(table, entry)| (table, Some(entry)));
    (matches!(table, "dependencies" | "build-dependencies"), entry)
}

/// `NAME = ..`, `NAME.workspace = ..`; a renamed one says `package = "NAME"`.
fn package(text: &str) -> Option<&str> {
    if let Some((_, renamed)) = text.split_once("package = \"") {
        return renamed.split('"').next();
    }
    let name = text.split_once('=')?.0.split('.').next()?;
    Some(name.trim().trim_matches('"'))
}

#[cfg(test)]
mod tests {
    use super::dependencies;

    fn names(manifest: &str) -> Vec<(&str, usize)> {
        dependencies(manifest).iter().map(|found| (found.package, found.line)).collect()
    }

    #[test]
    fn every_form_of_a_dependency() {
        let manifest = "\
[package]
name = \"robot\"
[dependencies]
a.workspace = true
# comment = 1
\"b\" = \"1.0\"
c = { path = \"../c\" }
d = { version = \"1\", package = \"real-d\" }
[dependencies.e]
version = \"1\"
[target.'cfg(unix)'.dependencies]
f = \"1\"
[build-dependencies]
g = \"1\"
[lints]
workspace = true
";
        let expected = [("a", 4), ("b", 6), ("c", 7), ("real-d", 8), ("e", 9), ("f", 12), ("g", 14)];
        assert_eq!(names(manifest), expected);
    }

    #[test]
    fn what_only_tests_need_is_exempt() {
        assert_eq!(names("[dev-dependencies]\na = \"1\"\n[dev-dependencies.b]\nversion = \"1\"\n"), []);
    }
}

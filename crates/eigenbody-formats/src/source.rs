//! MODEL: a file, a family's expression or a built-in robot.

use crate::error::FormatError;
use crate::family;
use crate::file::Shelf;
use crate::loaded::{Kind, Loaded, Places};
use crate::mjcf::{self, MjcfOptions, read_mjcf};
use crate::sdf::{self, SdfOptions, read_sdf};
use crate::suggest::did_you_mean;
use crate::urdf::{UrdfOptions, read_urdf, read_urdf_str};
use eigenbody::Base;
use eigenbody::scalar::Dd;
use std::path::Path;

/// How to make a model of a text.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadOptions {
    /// What the root link is fastened to. On a family, floating removes the first joint.
    pub base: Base,
    /// Size of the last link of a hydra, onion or auto_tree against the first: ρ = R^(1/(N−1)).
    pub size_ratio: Option<Dd>,
}

const PUMA560: &str = "puma560";
const EXTENSIONS: [&str; 4] = ["urdf", "xml", "sdf", "xacro"];

/// The model that a text names.
///
/// | text | model |
/// |------|-------|
/// | `robot.urdf`, `robot.xml`, any path to a file | what the file describes: URDF, MJCF or SDF |
/// | `robot.xacro` | the URDF that it expands to, with the feature `xacro` |
/// | `hydra(N,B,α,ρ)`, `onion(N,B,α,ρ)`, `auto_tree(N,B,α,ρ)` | a family's member; left out: B = 1, α = 0, ρ = 1 |
/// | `chain(N, m=2.2, l=1)` | slender rods; left out: m = 1, l = 1 |
/// | `puma560` | a built-in robot |
///
/// A built-in name goes before a file of that name, which is `./puma560`. Errors: [`FormatError`].
pub fn load(text: &str, options: &LoadOptions) -> Result<Loaded, FormatError> {
    load_from(Path::new(""), text, options)
}

/// [`load`], with the paths of files as they are seen from a folder. Errors: [`FormatError`].
pub fn load_from(folder: &Path, text: &str, options: &LoadOptions) -> Result<Loaded, FormatError> {
    let text = text.trim();
    let path = folder.join(text);
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
    if extension.is_some_and(|e| EXTENSIONS.contains(&e.as_str())) {
        return file(&path, options);
    }
    if text == PUMA560 {
        return puma560(options);
    }
    if let Some(family) = family::family(text, options.size_ratio)? {
        let family = if options.base == Base::Floating { family.floating() } else { family };
        let model = family
            .model()
            .map_err(|fault| FormatError::Build { text: text.to_owned(), fault: Box::new(fault) })?;
        let name = family.name();
        return Ok(Loaded::new(model, name, Kind::Family(family), Places::default()));
    }
    match path.exists() {
        true => file(&path, options),
        false => Err(no_model(text)),
    }
}

/// The model that the text of a file describes: URDF, MJCF or SDF, by its root element. `file_name` is what errors call it.
///
/// The text stands alone: included files and meshes that it names are not looked for, and one that is needed is an error. For texts
/// from elsewhere.
///
/// ```
/// use eigenbody_formats::{LoadOptions, load_text};
/// let text = r#"<mujoco><include file="/etc/passwd"/></mujoco>"#;
/// let error = load_text(text, "dropped.xml", &LoadOptions::default()).unwrap_err();
/// assert!(error.to_string().starts_with("dropped.xml:1:18: "));
/// ```
/// Errors: [`FormatError`].
pub fn load_text(text: &str, file_name: &str, options: &LoadOptions) -> Result<Loaded, FormatError> {
    no_size_ratio(file_name, options)?;
    let (path, base) = (Path::new(file_name), options.base);
    match root_tag(text.as_bytes()) {
        b"mujoco" | b"mujocoinclude" => {
            mjcf::read_text(text.to_owned(), path, &MjcfOptions { base }, Shelf::Empty)
        }
        b"sdf" => sdf::read_text(text.to_owned(), path, &SdfOptions { base }, Shelf::Empty),
        _ => read_urdf_str(text, file_name, &UrdfOptions { base }),
    }
}

/// A file, by what its root element says it is: the extension .xml is many formats'.
fn file(path: &Path, options: &LoadOptions) -> Result<Loaded, FormatError> {
    no_size_ratio(&path.to_string_lossy(), options)?;
    #[cfg(feature = "xacro")]
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("xacro")) {
        return crate::read_xacro(path, &UrdfOptions { base: options.base });
    }
    match root_tag(&crate::file::read(path)?) {
        b"mujoco" | b"mujocoinclude" => read_mjcf(path, &MjcfOptions { base: options.base }),
        b"sdf" => read_sdf(path, &SdfOptions { base: options.base }),
        _ => read_urdf(path, &UrdfOptions { base: options.base }),
    }
}

/// The name of the first element, empty if none is found; whether the text is well-formed is for its reader to say.
fn root_tag(bytes: &[u8]) -> &[u8] {
    let mut rest = bytes;
    while let Some(open) = rest.iter().position(|&b| b == b'<') {
        rest = &rest[open + 1..];
        let skip: &[u8] = match rest {
            [b'!', b'-', b'-', ..] => b"-->",
            [b'!' | b'?', ..] => b">",
            _ => {
                let end = rest.iter().position(|b| b.is_ascii_whitespace() || matches!(b, b'>' | b'/'));
                return &rest[..end.unwrap_or(rest.len())];
            }
        };
        match rest.windows(skip.len()).position(|w| w == skip) {
            Some(end) => rest = &rest[end + skip.len()..],
            None => return b"",
        }
    }
    b""
}

fn puma560(options: &LoadOptions) -> Result<Loaded, FormatError> {
    no_size_ratio(PUMA560, options)?;
    if options.base == Base::Floating {
        let problem = "stands on a fixed base only".to_owned();
        return Err(FormatError::Unsuitable { text: PUMA560.to_owned(), problem });
    }
    let model = eigenbody::family::puma560()
        .map_err(|fault| FormatError::Build { text: PUMA560.to_owned(), fault: Box::new(fault) })?;
    Ok(Loaded::new(model, PUMA560.to_owned(), Kind::BuiltIn, Places::default()))
}

fn no_size_ratio(text: &str, options: &LoadOptions) -> Result<(), FormatError> {
    let problem = || "a size ratio is for the families hydra, onion and auto_tree".to_owned();
    match options.size_ratio {
        None => Ok(()),
        Some(_) => Err(FormatError::Unsuitable { text: text.to_owned(), problem: problem() }),
    }
}

/// Says what a model can be.
fn no_model(text: &str) -> FormatError {
    let text = text.to_owned();
    let name = text.split('(').next().unwrap_or_default().trim();
    if let Some(usage) = family::usage(name) {
        let expected = format!("this family has parameters: {usage}");
        return FormatError::NoModel { text, expected };
    }
    let families: Vec<String> = family::names().filter_map(family::usage).collect();
    let suggestion = did_you_mean(name, family::names().chain([PUMA560]));
    let families = families.join(", ");
    let expected = format!("no such file, and none of {families}, {PUMA560}{suggestion}");
    FormatError::NoModel { text, expected }
}

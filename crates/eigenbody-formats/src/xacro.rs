//! Xacro: macros that expand to URDF, by the crate `xurdf`.

use crate::error::FormatError;
use crate::loaded::{Kind, Loaded};
use crate::urdf::{UrdfOptions, read_urdf_str};
use std::path::Path;

/// Reads the URDF that a xacro file expands to. Places in errors and findings are those of the expanded text.
///
/// Errors: [`FormatError::Xacro`] if it does not expand; otherwise as [`read_urdf`](crate::read_urdf).
pub fn read_xacro(path: &Path, options: &UrdfOptions) -> Result<Loaded, FormatError> {
    let text = expanded(path)?;
    let loaded = read_urdf_str(&text, &format!("{} (expanded)", path.display()), options)?;
    Ok(Loaded { kind: Kind::File(path.to_owned()), ..loaded })
}

/// The URDF that a xacro file expands to.
pub(crate) fn expanded(path: &Path) -> Result<String, FormatError> {
    // Says what is wrong with a file that cannot be read.
    crate::file::read(path)?;
    xurdf::parse_xacro_from_file(path).map_err(|error| {
        // The innermost cause says what is wrong.
        FormatError::Xacro { file: path.display().to_string(), problem: error.root_cause().to_string() }
    })
}

//! Xacro: macros that expand to URDF, by the crate `xurdf`, behind the feature `xacro`.

use crate::error::FormatError;
use crate::loaded::Loaded;
use crate::urdf::UrdfOptions;
use std::path::Path;

/// Reads the URDF that a xacro file expands to. Places in errors and findings are those of the expanded text.
///
/// Errors: [`FormatError::Xacro`] if it does not expand, or if the feature `xacro` is not built in; otherwise as
/// [`read_urdf`](crate::read_urdf).
#[cfg(feature = "xacro")]
pub fn read_xacro(path: &Path, options: &UrdfOptions) -> Result<Loaded, FormatError> {
    crate::file::read(path)?;
    let text = xurdf::parse_xacro_from_file(path).map_err(|error| {
        // The innermost cause says what is wrong.
        FormatError::Xacro { file: path.display().to_string(), problem: error.root_cause().to_string() }
    })?;
    crate::read_urdf_str(&text, &format!("{} (expanded)", path.display()), options)
}

/// Says how a xacro file can be read.
///
/// Errors: [`FormatError::Xacro`].
#[cfg(not(feature = "xacro"))]
pub fn read_xacro(path: &Path, _: &UrdfOptions) -> Result<Loaded, FormatError> {
    crate::file::read(path)?;
    let file = path.display().to_string();
    let problem =
        "xacro is not built in: build with `--features xacro`, or expand it by `xacro FILE > robot.urdf`";
    Err(FormatError::Xacro { file, problem: problem.into() })
}

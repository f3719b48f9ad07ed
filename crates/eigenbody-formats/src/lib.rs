//! Text to [`Model`](eigenbody::Model): robot files, family names, configurations.
//!
//! ```
//! use eigenbody_formats::{LoadOptions, configuration, load};
//!
//! let loaded = load("hydra(3, 1, 0, 1)", &LoadOptions::default())?;
//! let q = configuration("zag(pi/2)", &loaded.model, true)?;
//! assert_eq!((loaded.name.as_str(), q.len()), ("hydra(3, 1, 0, 1)", 3));
//! # Ok::<(), eigenbody_formats::FormatError>(())
//! ```
//!
//! Every error is one line. Those about a file begin with `file:line:column: `, those about an expression with the
//! expression and the column.
//!
//! # What this crate does not do
//!
//! Of a URDF file it reads no meshes and resolves no `package://` addresses: nothing of these touches inertia. It expands no
//! xacro.

#![forbid(unsafe_code)]
// E, I and X are the book's symbols.
#![allow(non_snake_case)]

mod configuration;
mod error;
pub mod expression;
mod family;
mod file;
mod gains;
mod inputs;
mod loaded;
mod location;
mod looks;
mod metric;
pub mod mjcf;
pub mod motion;
mod note;
mod patch;
pub mod sdf;
mod shape;
mod slips;
mod source;
mod suggest;
pub mod urdf;
mod velocity;
mod write;
#[cfg(feature = "xacro")]
mod xacro;
mod xml;

pub use configuration::configuration;
pub use error::{FileFault, FormatError};
pub use expression::ExpressionError;
pub use family::family;
pub use gains::gains;
pub use loaded::{Format, Keyframe, Kind, Loaded, Remark, Stepping};
pub use location::Location;
pub use looks::{Form, Look, read_look};
pub use metric::metric;
pub use mjcf::{Mesh, MeshFault, MjcfOptions, read_mjcf, read_mjcf_str};
pub use motion::{Motion, MotionError, MotionOptions};
pub use note::Note;
pub use patch::{PatchError, patched};
pub use sdf::{SdfOptions, read_sdf, read_sdf_str};
pub use shape::Shape;
pub use source::{LoadOptions, load, load_from, load_text};
pub use urdf::{UrdfOptions, read_urdf, read_urdf_str};
pub use velocity::velocity;
pub use write::{WriteError, write_mjcf, write_urdf, write_urdf_with_rotors};
#[cfg(feature = "xacro")]
pub use xacro::read_xacro;
pub use xml::XmlFault;

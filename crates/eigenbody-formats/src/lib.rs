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
//! It reads no meshes, resolves no `package://` addresses and expands no xacro: nothing of these touches inertia. MJCF and
//! SDF files are recognised and refused. It writes nothing.

#![forbid(unsafe_code)]
// E, I and X are the book's symbols.
#![allow(non_snake_case)]

mod configuration;
mod error;
pub mod expression;
mod family;
mod file;
mod loaded;
mod location;
mod metric;
mod source;
mod suggest;
pub mod urdf;

pub use configuration::configuration;
pub use error::{FileFault, FormatError};
pub use expression::ExpressionError;
pub use loaded::{Kind, Loaded};
pub use location::Location;
pub use metric::metric;
pub use source::{LoadOptions, load};
pub use urdf::{UrdfOptions, read_urdf, read_urdf_str};

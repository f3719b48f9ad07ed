//! What can go wrong between a text and a model.

use crate::expression::ExpressionError;
use crate::location::Location;
use crate::mjcf::MjcfFault;
use crate::sdf::SdfFault;
use crate::urdf::UrdfFault;
use std::fmt::{self, Write};
use thiserror::Error;

/// A text that gives no model or no configuration. The message is one line.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FormatError {
    /// A file that cannot be read at all.
    #[error("{}: {fault}", OneLine(file))]
    File {
        /// The file, as it was given.
        file: String,
        /// What is wrong with it.
        fault: FileFault,
    },
    /// Something at one place of a file.
    #[error("{}:{at}: {}", OneLine(file), OneLine(fault))]
    Urdf {
        /// The file, as it was given.
        file: String,
        /// The place.
        at: Location,
        /// What is wrong there.
        fault: Box<UrdfFault>,
    },
    /// Something at one place of an MJCF file, or of a file that it includes.
    #[error("{}:{at}: {}", OneLine(file), OneLine(fault))]
    Mjcf {
        /// The file.
        file: String,
        /// The place.
        at: Location,
        /// What is wrong there.
        fault: Box<MjcfFault>,
    },
    /// Something at one place of an SDF file, or of a file that it includes.
    #[error("{}:{at}: {}", OneLine(file), OneLine(fault))]
    Sdf {
        /// The file.
        file: String,
        /// The place.
        at: Location,
        /// What is wrong there.
        fault: Box<SdfFault>,
    },
    /// A xacro file that does not expand.
    #[cfg(feature = "xacro")]
    #[error("{}: {}", OneLine(file), OneLine(problem))]
    Xacro {
        /// The file.
        file: String,
        /// Why not.
        problem: String,
    },
    /// Something at one column of an expression.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// An option that this model cannot have.
    #[error("{}: {problem}", OneLine(text))]
    Unsuitable {
        /// The model's text.
        text: String,
        /// Which option, and why not.
        problem: String,
    },
    /// A robot that cannot be built from its expression.
    #[error("{}: {fault}", OneLine(text))]
    Build {
        /// The expression.
        text: String,
        /// What is wrong with it.
        fault: Box<eigenbody::BuildError>,
    },
    /// A text that is neither a file nor an expression.
    #[error("no model '{}': {}", shortened(text), OneLine(expected))]
    NoModel {
        /// The text.
        text: String,
        /// What a model can be.
        expected: String,
    },
}

impl FormatError {
    /// The file, the place in it and what is wrong there, if the error is about one place of a file.
    pub fn place(&self) -> Option<(&str, Location, String)> {
        match self {
            Self::Urdf { file, at, fault } => Some((file, *at, OneLine(fault).to_string())),
            Self::Mjcf { file, at, fault } => Some((file, *at, OneLine(fault).to_string())),
            Self::Sdf { file, at, fault } => Some((file, *at, OneLine(fault).to_string())),
            _ => None,
        }
    }
}

/// Why a file cannot be read.
#[derive(Debug, Clone, PartialEq, Error)]
#[allow(missing_docs)] // the messages say it all
pub enum FileFault {
    #[error("no such file")]
    Missing,
    #[error("a directory, expected a file")]
    Directory,
    #[error("larger than {limit} bytes")]
    TooLarge { limit: u64 },
    #[error("not looked for: a text on its own has no files beside it")]
    Alone,
    #[error("{0}")]
    Io(String),
}

/// Writes a text without line breaks or other control characters.
pub(crate) struct OneLine<T>(pub T);

impl<T: fmt::Display> fmt::Display for OneLine<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(Escaping(f), "{}", self.0)
    }
}

struct Escaping<'a, 'b>(&'a mut fmt::Formatter<'b>);

impl fmt::Write for Escaping<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.chars().try_for_each(|c| self.write_char(c))
    }

    fn write_char(&mut self, c: char) -> fmt::Result {
        match steers(c) {
            true => write!(self.0, "{}", c.escape_default()),
            false => self.0.write_char(c),
        }
    }
}

/// True for what a terminal obeys and does not show: control characters, line and paragraph separators, marks of direction.
fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A quotation of at most 60 characters, on one line.
pub(crate) fn shortened(text: &str) -> String {
    const LIMIT: usize = 60;
    match text.char_indices().nth(LIMIT) {
        Some((end, _)) => format!("{}…", OneLine(&text[..end])),
        None => OneLine(text).to_string(),
    }
}

/// `1 number`, `2 numbers`.
pub(crate) fn numbers_of(n: usize) -> String {
    counted(n, "number", "numbers")
}

/// So many of something.
pub(crate) fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

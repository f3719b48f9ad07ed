//! Arithmetic, lists and calls, by recursive descent.
//!
//! ```text
//! sum     = product (("+" | "-") product)*
//! product = factor (("*" | "/") factor)*
//! factor  = ("+" | "-")* (number | "pi" | "(" sum ")")
//! list    = "[" [sum ("," sum)*] "]"
//! call    = name "(" [argument ("," argument)*] ")"        argument = [name "="] (sum | list)
//! ```
//! Every value on the way is finite. Numbers are those of Rust: `2`, `.5`, `1e-3`.

mod arithmetic;
mod call;

use crate::error::shortened;
use eigenbody::scalar::Dd;
use thiserror::Error;

/// Something at one column of an expression.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}, column {column}: {message}", if text.trim().is_empty() { "empty text".into() } else { shortened(text) })]
pub struct ExpressionError {
    /// The whole expression.
    pub text: String,
    /// The column, counted in characters from 1.
    pub column: usize,
    /// What is wrong there.
    pub message: String,
}

impl ExpressionError {
    /// An error at a byte offset of the text.
    pub(crate) fn new(text: &str, offset: usize, message: impl Into<String>) -> Self {
        let column = 1 + text.get(..offset).unwrap_or(text).chars().count();
        Self { text: text.to_owned(), column, message: message.into() }
    }
}

/// A number and where it begins, as a byte offset in the expression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// Its value, finite.
    pub value: f64,
    /// Byte offset of its first character.
    pub offset: usize,
}

/// What a call's argument holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// One number.
    Number(Dd),
    /// Several, in brackets.
    List(Vec<Number>),
}

/// An argument of a call.
#[derive(Debug, Clone, PartialEq)]
pub struct Argument<'a> {
    /// The name before `=`, if there is one.
    pub key: Option<&'a str>,
    /// What it holds.
    pub value: Value,
    /// Byte offset of its first character.
    pub offset: usize,
}

/// A name with arguments.
#[derive(Debug, Clone, PartialEq)]
pub struct Call<'a> {
    /// The name.
    pub name: &'a str,
    /// The arguments, in order.
    pub arguments: Vec<Argument<'a>>,
}

/// The number that a whole text stands for.
///
/// ```
/// use eigenbody_formats::expression::number;
/// assert_eq!(number("-2*(.5e1 - 1)/4")?, -2.0);
/// # Ok::<(), eigenbody_formats::ExpressionError>(())
/// ```
pub fn number(text: &str) -> Result<f64, ExpressionError> {
    let mut reader = Reader::new(text);
    let value = reader.number()?;
    reader.end()?;
    Ok(value)
}

/// The call that a whole text is.
///
/// ```
/// use eigenbody_formats::expression::{Value, call};
/// let chain = call("chain(4, m=2.2)")?;
/// assert_eq!((chain.name, chain.arguments[1].key), ("chain", Some("m")));
/// assert_eq!(chain.arguments[1].value, Value::Number("2.2".parse()?));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn call(text: &str) -> Result<Call<'_>, ExpressionError> {
    let mut reader = Reader::new(text);
    let call = reader.call()?;
    reader.end()?;
    Ok(call)
}

/// A text and how far it has been read.
pub(crate) struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

impl<'a> Reader<'a> {
    /// At the beginning of a text.
    pub fn new(text: &'a str) -> Self {
        Self { text, at: 0, depth: 0 }
    }

    /// What is left, after spaces.
    pub fn rest(&mut self) -> &'a str {
        let rest = self.text[self.at..].trim_start();
        self.at = self.text.len() - rest.len();
        rest
    }

    /// Byte offset of what is left.
    pub fn offset(&mut self) -> usize {
        self.rest();
        self.at
    }

    /// Passes over the next `bytes` bytes.
    pub fn skip(&mut self, bytes: usize) {
        self.at += bytes;
    }

    /// An error at a byte offset.
    pub fn error(&self, offset: usize, message: impl Into<String>) -> ExpressionError {
        ExpressionError::new(self.text, offset, message)
    }

    /// Passes over a character, if it stands next.
    pub fn eat(&mut self, c: char) -> bool {
        let found = self.rest().starts_with(c);
        self.at += if found { c.len_utf8() } else { 0 };
        found
    }

    /// Passes over a character that must stand next.
    pub fn expect(&mut self, c: char) -> Result<(), ExpressionError> {
        match self.eat(c) {
            true => Ok(()),
            false => Err(self.unexpected(&format!("'{c}'"))),
        }
    }

    /// Nothing but spaces may be left.
    pub fn end(&mut self) -> Result<(), ExpressionError> {
        match self.rest() {
            "" => Ok(()),
            _ => Err(self.unexpected("the end")),
        }
    }

    /// Something else stands next than what is expected.
    pub fn unexpected(&mut self, expected: &str) -> ExpressionError {
        let found = self.found();
        self.error(self.at, format!("expected {expected}, found {found}"))
    }

    /// The next word or character, quoted.
    fn found(&mut self) -> String {
        let (word, rest) = (self.word(), self.rest());
        match (word, rest.chars().next()) {
            ("", None) => "the end".into(),
            ("", Some(c)) => format!("'{}'", c.escape_debug()),
            (word, _) => format!("'{}'", shortened(word)),
        }
    }

    /// The name that stands next, not yet passed over; empty if there is none.
    pub fn word(&mut self) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        match rest.starts_with(|c: char| c.is_ascii_digit()) {
            true => "",
            false => &rest[..end],
        }
    }

    /// A whole number without sign.
    pub fn whole(&mut self) -> Result<u64, ExpressionError> {
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let fractional = rest[end..].starts_with(['.', 'e', 'E']);
        match rest[..end].parse() {
            Ok(whole) if !fractional => {
                self.at += end;
                Ok(whole)
            }
            _ => Err(self.error(self.at, format!("expected a whole number from 0 to {}", u64::MAX))),
        }
    }
}

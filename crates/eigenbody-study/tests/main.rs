//! The study, held against its own copy of what the papers print.

// H is the book's symbol.
#![allow(non_snake_case)]
// Helpers stop a test as its own lines would.
#![allow(clippy::unwrap_used)]

mod advise;
mod claims;
mod corrupted;
mod diagnosis;
mod estimators;
mod experiment;
mod fit;
mod motion;
mod sensitivity;
mod simulate;
mod stepping;
mod sweep;

//! The command as a user meets it: what it prints, and how it fails.

// Helpers stop a test as its own lines would.
// H and N are the book's symbols.
#![allow(non_snake_case)]
#![allow(clippy::unwrap_used)]

mod bad_input;
mod check;
mod files;
mod formats;
mod judged;
mod matrix;
mod motion;
mod page;
mod reproduce;
mod run;
#[cfg(feature = "web")]
mod serve;
mod spectrum;
#[cfg(feature = "parquet")]
mod sweep;

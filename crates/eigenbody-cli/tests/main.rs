//! The command as a user meets it: what it prints, and how it fails.

// Helpers stop a test as its own lines would.
#![allow(clippy::unwrap_used)]

mod bad_input;
mod check;
mod formats;
mod matrix;
mod motion;
mod reproduce;
mod run;
mod spectrum;

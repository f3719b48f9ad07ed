//! The command as a user meets it: what it prints, and how it fails.

mod bad_input;
mod matrix;
mod run;
mod spectrum;

//! Figures, tables and pages, without looking at them: what must be in them is.

// Helpers stop a test as its own lines would.
#![allow(clippy::unwrap_used)]

mod figure;
mod reproduction;
mod table;

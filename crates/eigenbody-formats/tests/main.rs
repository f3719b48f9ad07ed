//! Tests, one module a source module.
//!
//! Tolerances read c·ε·(what governs); what governs is named beside each.

// H, S, E, I and R are the book's symbols.
#![allow(non_snake_case)]
// Helpers stop a test as its own lines would.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod configuration;
mod expression;
mod folder;
mod gains;
mod hostile;
mod metric;
mod mjcf;
mod mutation;
mod patch;
mod sdf;
mod source;
mod urdf;
mod write;
mod xacro;

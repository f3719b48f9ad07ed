//! Tests, one module a source module.
//!
//! Tolerances read c·n·ε·(what governs); what governs is named beside each.

// H, S, U, D and X are the book's symbols.
#![allow(non_snake_case)]
// Helpers stop a test as its own lines would.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod family;

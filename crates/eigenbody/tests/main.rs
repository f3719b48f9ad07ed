//! Tests, one module a source module.
//!
//! Tolerances read c·n·ε·(what governs); what governs is named beside each.

// H, S, U, D and X are the book's symbols.
#![allow(non_snake_case)]
// Helpers stop a test as its own lines would.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

/// Runs a check that is generic over the scalar in each of them.
macro_rules! scalars {
    ($($check:ident),* $(,)?) => {
        $(mod $check {
            #[test]
            fn single() {
                super::$check::<f32>();
            }
            #[test]
            fn double() {
                super::$check::<f64>();
            }
            #[test]
            fn double_double() {
                super::$check::<eigenbody::scalar::Dd>();
            }
        })*
    };
}

mod allocation;
mod batch;
mod conditioning;
mod dynamics;
mod error;
mod factor;
mod family;
mod joint;
mod model;
mod reference;
mod robots;
mod scalar;
mod search;
mod spectrum;
mod stability;

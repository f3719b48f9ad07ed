//! How well-conditioned is a robot?
//!
//! eigenbody computes the joint-space inertia matrix H(q) of any kinematic tree, its eigenvalues, eigenvectors and
//! condition number. Symbols and units are those of `docs/NOTATION.md`; spatial vectors are [angular; linear]; SI units.
//!
//! ```
//! use eigenbody::{Family, Metric, Model, Posture, conditioning, mass_matrix};
//!
//! let model: Model<f64> = Family::hydra(10, 1.0, 0.0, 1.0)?.model()?;
//! let q = Posture::Zag(0.0).configuration(&model);
//! let H = mass_matrix(&model, &q)?;
//! let report = conditioning(&H, &Metric::Euclidean.weights(&model, &H)?)?;
//! assert!((report.kappa.unwrap() - 42907.97274937).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What this crate does not do
//!
//! It reads and writes no files (`eigenbody-formats`), draws nothing (`eigenbody-report`) and resolves no contacts. Loops are closed
//! for the mass matrix alone. Bodies are rigid.

// H, S, U, D, I and X are the book's symbols.
#![allow(non_snake_case)]

pub mod batch;
pub mod conditioning;
pub mod dynamics;
pub mod error;
pub mod factor;
pub mod family;
pub mod joint;
pub mod matrix;
pub mod model;
pub mod scalar;
pub mod search;
pub mod spatial;
pub mod spectrum;
pub mod stability;

pub use conditioning::{Conditioning, Method, Question, conditioning, conditioning_at, count_below};
pub use dynamics::{
    Reduction, bias_force, floating_mass_matrix, forward_dynamics, inverse_dynamics, mass_matrix,
};
pub use error::{Error, InputError, NotPositiveDefinite};
pub use family::{Family, Posture};
pub use joint::Joint;
pub use matrix::Matrix;
pub use model::{Base, BuildError, Model, ModelBuilder};
pub use spectrum::{Metric, SymmetricEigen};

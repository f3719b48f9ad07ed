//! What to compute: the figures and claims of two papers, and simulations, as typed tables.
//!
//! An [`Experiment`] is one figure or one set of printed numbers. It yields a [`Table`] with named columns that bear units, and a
//! [`Reading`] for every claim that the paper makes there: what is printed, what is computed, and a [`Verdict`].
//!
//! ```
//! use eigenbody_study::{Lab, Verdict, select};
//! let experiments = select(&["S-eq8"])?;
//! let outcome = experiments[0].run(&Lab::default())?;
//! assert!(outcome.readings.iter().all(|reading| reading.verdict != Verdict::Fails));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What this crate does not do
//!
//! It draws nothing and writes no files (`eigenbody-report`).

#![forbid(unsafe_code)]
// H is the book's symbol.
#![allow(non_snake_case)]

pub mod claim;
pub mod diagnosis;
pub mod estimators;
mod experiment;
pub mod explore;
pub mod featherstone;
pub mod fit;
mod lab;
pub mod monitor;
pub mod motion;
pub mod portrait;
mod precision;
mod row;
pub mod shah_saha;
pub mod simulate;
pub mod sweep;
mod table;

pub use claim::{CLAIMS, Check, Claim, Kind, Reading, Verdict};
pub use experiment::{EXPERIMENTS, Experiment, Outcome, Paper, UnknownId, select};
pub use lab::{Bench, Lab, Robots, StudyError};
pub use row::{Cell, Field, Shape};
pub use table::{Column, Rows, Subject, Table, Values};

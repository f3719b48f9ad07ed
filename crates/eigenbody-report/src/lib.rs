//! How results are shown: a table that a person wants to read, exact JSON, CSV and NPY, figures as SVG and PNG, a gallery.
//!
//! Nothing is computed here: a result comes in, text or bytes go out.

#![forbid(unsafe_code)]
// H is the book's symbol.
#![allow(non_snake_case)]

mod diagnosis;
mod excerpt;
pub mod figure;
pub mod file;
mod info;
mod matrix;
mod motion;
mod number;
mod page;
mod reproduction;
mod rows;
mod rules;
mod spectrum;
mod sweep;
mod table;
mod text;

pub use diagnosis::{
    AddedReport, AdviceReport, Baseline, Change, Comparison, DiagnosisReport, FindingReport, Fixed,
    PlaceReport, RemarkReport, State, WorstReport, advice_text, diagnosis_text,
};
pub use excerpt::excerpt;
pub use info::{BodyRow, DofRow, InfoReport};
pub use matrix::{AmongReport, MatrixReport};
pub use motion::{Page as StudyPage, cost_page, judged_page};
pub use number::significant;
pub use page::{Page, WorstPicture};
pub use reproduction::{CheckReport, ClaimReport, Shown, claims_json, claims_text, gallery};
#[cfg(feature = "parquet")]
pub use rows::{ParquetFailure, write_parquet};
pub use rows::{RowsCsv, read_rows};
pub use rules::{OF_MODELS, OF_ROBOTS, Rule, rules};
pub use spectrum::{CountReport, ErrorEstimate, LoopsReport, ModeReport, SpectrumReport, Subject};
pub use sweep::{PlanRecord, SweepFolder, SweepFolderError, chunk_text};
pub use table::write_table_csv;
pub use text::{Mode, count, modes};

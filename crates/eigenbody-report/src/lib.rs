//! How results are shown: a table that a person wants to read, exact JSON, CSV and NPY, figures as SVG and PNG, a gallery.
//!
//! Nothing is computed here: a result comes in, text or bytes go out.

#![forbid(unsafe_code)]

mod diagnosis;
mod excerpt;
pub mod figure;
mod info;
mod matrix;
mod motion;
mod number;
mod reproduction;
mod rows;
mod spectrum;
mod table;
mod text;

pub use diagnosis::{AddedReport, AdviceReport, DiagnosisReport, advice_text, diagnosis_text};
pub use excerpt::excerpt;
pub use info::{BodyRow, DofRow, InfoReport};
pub use matrix::MatrixReport;
pub use motion::{Page, cost_page, judged_page};
pub use number::significant;
pub use reproduction::{CheckReport, ClaimReport, Shown, claims_json, claims_text, gallery};
#[cfg(feature = "parquet")]
pub use rows::{ParquetFailure, write_parquet};
pub use rows::{RowsCsv, read_rows};
pub use spectrum::{CountReport, ErrorEstimate, ModeReport, SpectrumReport, Subject};
pub use table::write_table_csv;
pub use text::{Mode, count, modes};

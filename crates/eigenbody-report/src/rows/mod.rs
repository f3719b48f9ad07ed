//! Rows as they come, into CSV and Parquet.

mod journal;
#[cfg(feature = "parquet")]
mod parquet;

pub use journal::{RowsCsv, read_rows};
#[cfg(feature = "parquet")]
pub use parquet::{ParquetFailure, write_parquet};

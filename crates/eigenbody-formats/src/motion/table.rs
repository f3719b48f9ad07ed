//! Rows of cells, whatever the file.

use super::fault::MotionError;
use super::lines::Lines;
use crate::error::FileFault;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Cell {
    Number(f64),
    /// What should be a number.
    Text(String),
    Empty,
}

/// An open file.
pub(super) enum Table {
    Csv {
        records: csv::StringRecordsIntoIter<Lines<BufReader<File>>>,
        bytes: u64,
    },
    #[cfg(feature = "parquet")]
    Parquet(super::parquet::ParquetRows),
}

impl Table {
    /// The file and the names of its columns.
    pub fn open(path: &Path, file: &str) -> Result<(Self, Vec<String>), MotionError> {
        let fault = |fault| MotionError::File { file: file.to_owned(), fault };
        let opened = File::open(path).map_err(|error| {
            fault(match error.kind() {
                std::io::ErrorKind::NotFound => FileFault::Missing,
                _ => FileFault::Io(error.to_string()),
            })
        })?;
        if path.extension().is_some_and(|extension| extension == "parquet") {
            #[cfg(feature = "parquet")]
            return super::parquet::ParquetRows::open(opened)
                .map(|(rows, names)| (Self::Parquet(rows), names))
                .map_err(|error| fault(FileFault::Io(error)));
            #[cfg(not(feature = "parquet"))]
            return Err(fault(FileFault::Io("Parquet is not built in (feature parquet)".into())));
        }
        let bytes = opened.metadata().map_or(0, |metadata| metadata.len());
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .comment(Some(b'#'))
            .from_reader(Lines::new(BufReader::new(opened)));
        let names: Vec<String> = match reader.headers() {
            Ok(names) => names.iter().map(str::to_owned).collect(),
            Err(error) => return Err(fault(FileFault::Io(error.to_string()))),
        };
        if names.is_empty() {
            return Err(fault(FileFault::Io("empty, expected a heading".into())));
        }
        Ok((Self::Csv { records: reader.into_records(), bytes }, names))
    }

    /// Where the last row or heading of a CSV file ends.
    pub fn line(&self) -> Option<u64> {
        match self {
            Self::Csv { records, .. } => Some(records.reader().position().line() - 1),
            #[cfg(feature = "parquet")]
            Self::Parquet(_) => None,
        }
    }

    pub fn progress(&self) -> f64 {
        match self {
            Self::Csv { records, bytes } => {
                (records.reader().position().byte() as f64 / (*bytes).max(1) as f64).min(1.0)
            }
            #[cfg(feature = "parquet")]
            Self::Parquet(rows) => rows.progress(),
        }
    }

    /// Place and cells of the next row; a message if the file breaks off.
    pub fn next_row(&mut self) -> Result<Option<(u64, Vec<Cell>)>, String> {
        match self {
            Self::Csv { records, .. } => {
                let Some(record) = records.next() else { return Ok(None) };
                let record = match record {
                    Ok(record) => record,
                    // Bytes that are no text make a row bad, not the file.
                    Err(error) if error.is_io_error() => return Err(error.to_string()),
                    Err(_) => return Ok(Some((records.reader().position().line() - 1, Vec::new()))),
                };
                let breaks: usize = record.iter().map(|cell| cell.matches('\n').count()).sum();
                let line = records.reader().position().line() - 1 - breaks as u64;
                let cell = |text: &str| match text.trim() {
                    "" => Cell::Empty,
                    word => word.parse().map_or_else(|_| Cell::Text(word.to_owned()), Cell::Number),
                };
                Ok(Some((line, record.iter().map(cell).collect())))
            }
            #[cfg(feature = "parquet")]
            Self::Parquet(rows) => rows.next_row(),
        }
    }
}

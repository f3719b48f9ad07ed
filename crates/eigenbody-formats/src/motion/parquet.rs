//! Rows of a Parquet file.

use super::table::Cell;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use parquet::record::reader::RowIter;
use std::fs::File;

/// An open file.
pub(super) struct ParquetRows {
    rows: RowIter<'static>,
    done: u64,
    count: u64,
}

impl ParquetRows {
    pub fn open(file: File) -> Result<(Self, Vec<String>), String> {
        let reader = SerializedFileReader::new(file).map_err(|error| error.to_string())?;
        let metadata = reader.metadata().file_metadata();
        let count = u64::try_from(metadata.num_rows()).unwrap_or(0);
        let names = metadata.schema().get_fields().iter().map(|field| field.name().to_owned()).collect();
        Ok((Self { rows: RowIter::from_file_into(Box::new(reader)), done: 0, count }, names))
    }

    pub fn progress(&self) -> f64 {
        self.done as f64 / self.count.max(1) as f64
    }

    pub fn next_row(&mut self) -> Result<Option<(u64, Vec<Cell>)>, String> {
        let Some(row) = self.rows.next() else { return Ok(None) };
        let row = row.map_err(|error| error.to_string())?;
        self.done += 1;
        let cell = |(_, field): (&String, &Field)| match *field {
            Field::Double(x) => Cell::Number(x),
            Field::Float(x) => Cell::Number(x.into()),
            Field::Int(x) => Cell::Number(x.into()),
            Field::Long(x) => Cell::Number(x as f64),
            Field::UInt(x) => Cell::Number(x.into()),
            Field::Null => Cell::Empty,
            ref other => Cell::Text(other.to_string()),
        };
        Ok(Some((self.done, row.get_column_iter().map(cell).collect())))
    }
}

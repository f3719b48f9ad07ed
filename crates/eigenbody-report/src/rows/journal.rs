//! Rows as CSV, line by line: a heading of plain names, then a row a line. Whatever was written last, what stands is whole lines.

use eigenbody_study::{Cell, Field, Shape};
use std::io::{self, Read, Write};

/// A CSV table that grows by rows. Numbers parse back to the same bits, none is an empty cell, a list is `[1, 2]` in one cell.
///
/// ```
/// use eigenbody_report::RowsCsv;
/// use eigenbody_study::{Cell, Field};
/// let mut rows = RowsCsv::new(Vec::new(), &[Field::number("t", "s"), Field::list("eigenvalues", "kg m^2")])?;
/// rows.push(&[Cell::from(0.5), Cell::List(vec![1.0, 2.5])])?;
/// assert_eq!(String::from_utf8(rows.into_inner()?)?, "t,eigenvalues\n0.5,\"[1, 2.5]\"\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct RowsCsv<W: Write> {
    out: W,
    /// Whole lines that are not written yet.
    waiting: Vec<u8>,
}

/// Lines are written in blocks of this size.
const BLOCK: usize = 1 << 15;

impl<W: Write> RowsCsv<W> {
    /// Writes the heading.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written.
    pub fn new(out: W, fields: &[Field]) -> io::Result<Self> {
        let mut rows = Self { out, waiting: Vec::new() };
        rows.line(fields.iter().map(|field| field.name.clone()))?;
        rows.flush()?;
        Ok(rows)
    }

    /// Adds a row; lines reach the file in blocks, or when [`flush`](Self::flush) says so.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written.
    pub fn push(&mut self, row: &[Cell]) -> io::Result<()> {
        self.line(row.iter().map(|cell| match cell {
            Cell::Number(x) => x.map_or_else(String::new, |x| x.to_string()),
            Cell::List(all) => {
                format!("[{}]", all.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))
            }
            Cell::Text(word) => word.clone(),
        }))?;
        if self.waiting.len() >= BLOCK { self.flush() } else { Ok(()) }
    }

    fn line(&mut self, cells: impl Iterator<Item = String>) -> io::Result<()> {
        let mut writer = csv::WriterBuilder::new().from_writer(&mut self.waiting);
        writer.write_record(cells)?;
        writer.flush()
    }

    /// Writes all lines that wait.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.write_all(&self.waiting)?;
        self.waiting.clear();
        self.out.flush()
    }

    /// Writes what waits, and hands back the writer.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written.
    pub fn into_inner(mut self) -> io::Result<W> {
        self.flush()?;
        Ok(self.out)
    }

    /// What is written to.
    pub fn out(&mut self) -> &mut W {
        &mut self.out
    }
}

/// The rows of a table that [`RowsCsv`] wrote with these fields, one after the other.
///
/// A row that does not fit them, as only another program writes, is an error.
pub fn read_rows(input: impl Read, fields: &[Field]) -> impl Iterator<Item = io::Result<Vec<Cell>>> {
    let reader = csv::ReaderBuilder::new().from_reader(input);
    reader.into_records().map(move |record| {
        let record = record?;
        if record.len() != fields.len() {
            return Err(io::Error::new(io::ErrorKind::InvalidData, "a row of another length"));
        }
        fields.iter().zip(&record).map(|(field, cell)| read_cell(field.shape, cell)).collect()
    })
}

fn read_cell(shape: Shape, cell: &str) -> io::Result<Cell> {
    let number = |text: &str| {
        text.trim().parse::<f64>().map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
    };
    Ok(match shape {
        Shape::Text => Cell::Text(cell.to_owned()),
        Shape::Number if cell.is_empty() => Cell::Number(None),
        Shape::Number => Cell::Number(Some(number(cell)?)),
        Shape::List => {
            let inner = cell.trim_start_matches('[').trim_end_matches(']');
            let words = inner.split(',').filter(|word| !word.trim().is_empty());
            Cell::List(words.map(number).collect::<io::Result<_>>()?)
        }
    })
}

//! Rows as CSV, line by line: a heading of plain names, then a row a line. Whatever was written last, what stands is whole lines.

use eigenbody_study::{Cell, Field, Shape};
use std::io::{self, Read, Write};

/// A CSV table that grows by rows. Numbers parse back to the same bits, none is an empty cell, a list is `[1, 2]` in one cell; words have no line breaks.
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
    /// Bytes and rows of the whole lines that were written.
    written: (u64, u64),
}

impl<W: Write> RowsCsv<W> {
    /// Writes the heading.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written.
    pub fn new(out: W, fields: &[Field]) -> io::Result<Self> {
        let mut rows = Self { out, waiting: Vec::new(), written: (0, 0) };
        rows.line(fields.iter().map(|field| field.name.clone()))?;
        rows.flush()?;
        Ok(rows)
    }

    /// Adds a row, which waits for [`flush`](Self::flush).
    ///
    /// # Errors
    ///
    /// If a cell is no text that CSV can hold.
    pub fn push(&mut self, row: &[Cell]) -> io::Result<()> {
        self.line(row.iter().map(|cell| match cell {
            Cell::Number(x) => x.map_or_else(String::new, |x| x.to_string()),
            Cell::List(all) => {
                format!("[{}]", all.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))
            }
            Cell::Text(word) => word.clone(),
        }))
    }

    fn line(&mut self, cells: impl Iterator<Item = String>) -> io::Result<()> {
        let mut writer = csv::WriterBuilder::new().from_writer(&mut self.waiting);
        writer.write_record(cells).map_err(crate::table::io_of)?;
        writer.flush()
    }

    /// Bytes that wait.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Bytes of all whole lines that were written, and their number without the heading.
    pub fn written(&self) -> (u64, u64) {
        (self.written.0, self.written.1.saturating_sub(1))
    }

    /// Writes all lines that wait.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written; [`written`](Self::written) then tells how far whole lines got.
    pub fn flush(&mut self) -> io::Result<()> {
        let mut done = 0;
        let outcome = loop {
            if done == self.waiting.len() {
                break self.out.flush();
            }
            match self.out.write(&self.waiting[done..]) {
                Ok(0) => break Err(io::ErrorKind::WriteZero.into()),
                Ok(bytes) => done += bytes,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => break Err(error),
            }
        };
        let whole = self.waiting[..done].iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        self.written.0 += whole as u64;
        self.written.1 += self.waiting[..whole].iter().filter(|&&byte| byte == b'\n').count() as u64;
        self.waiting.drain(..whole);
        outcome
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

//! The mass matrix itself, in forms that other programs read.

use crate::spectrum::{LoopsReport, Subject};
use crate::table::io_of;
use crate::text::one_line;
use serde::Serialize;
use std::io::{self, Write};

/// What `eigenbody matrix` answers: H with the names of its rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixReport {
    /// Which robot, where.
    #[serde(flatten)]
    pub subject: Subject,
    /// Name of each row and column.
    pub dofs: Vec<String>,
    /// H, row by row.
    pub rows: Vec<Vec<f64>>,
    /// Among which motions, where loops are closed.
    #[serde(flatten)]
    pub among: Option<AmongReport>,
}

/// The motions that loops allow: v = N y, and H is Nᵀ H N.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AmongReport {
    /// Names of the rows of N.
    pub joints: Vec<String>,
    /// N, row by row: orthonormal columns, a radian as much as a metre.
    pub basis: Vec<Vec<f64>>,
    /// The loops.
    pub loops: LoopsReport,
}

impl MatrixReport {
    /// As JSON; floats parse back to the same bits.
    ///
    /// # Errors
    ///
    /// Only if the serialiser fails, which plain numbers and strings do not make it do.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self)
    }

    /// As CSV: a heading with the DoF names, then a row a DoF.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(&self.dofs).map_err(io_of)?;
        for row in &self.rows {
            writer.write_record(row.iter().map(f64::to_string)).map_err(io_of)?;
        }
        writer.flush()
    }

    /// As a NumPy file: float64, n × n, row-major.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written.
    pub fn write_npy(&self, out: impl Write) -> io::Result<()> {
        use npyz::WriterBuilder;
        let n = self.rows.len() as u64;
        let mut writer = npyz::WriteOptions::new().default_dtype().shape(&[n, n]).writer(out).begin_nd()?;
        for row in &self.rows {
            writer.extend(row.iter().copied())?;
        }
        writer.finish()
    }

    /// For the terminal: aligned columns, four digits.
    pub fn to_text(&self) -> String {
        let cells: Vec<Vec<String>> =
            self.rows.iter().map(|row| row.iter().map(|x| cell(*x)).collect()).collect();
        let width = cells.iter().flatten().map(|c| c.chars().count()).max().unwrap_or(0);
        let dofs: Vec<String> = self.dofs.iter().map(|name| one_line(name)).collect();
        let names = dofs.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        let mut page = format!(
            "{}, {} base, at {}: {}, {n} × {n} (kg m², kg m, kg)\n\n",
            self.subject.model,
            self.subject.base,
            self.subject.configuration,
            if self.among.is_some() { "Nᵀ H N of the closed loops, NᵀN = 1" } else { "H" },
            n = self.rows.len()
        );
        for (name, row) in dofs.iter().zip(&cells) {
            let pad = names - name.chars().count();
            page.push_str(&format!("  {name}{:pad$}", ""));
            for cell in row {
                page.push_str(&format!("  {cell:>width$}"));
            }
            page.push('\n');
        }
        page
    }
}

/// Zero as a dot: the branches show.
fn cell(x: f64) -> String {
    if x == 0.0 { "·".into() } else { crate::number::significant(x, 4) }
}

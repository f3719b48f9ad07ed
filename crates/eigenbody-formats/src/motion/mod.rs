//! Recorded motions: tables of times, configurations, velocities or forces, in CSV or Parquet.
//!
//! | column | holds |
//! |--------|-------|
//! | `t`, `time` | seconds, ascending |
//! | `q0`, `q1`, .. | all coordinates, as everywhere |
//! | `v0`, `v1`, .. | velocities, if there are any |
//! | `tau0`, `tau1`, .. | forces, for a table of forces |
//! | else, without `q0` | a joint of one coordinate, or a degree of freedom in a table of forces |
//!
//! A unit in brackets behind a name, `t [s]`, says nothing. With `q0`, columns with other names are passed over: they are what a monitor
//! wrote. Without it every column is a joint, and a name that no joint has is an error.

mod columns;
mod fault;
mod lines;
#[cfg(feature = "parquet")]
mod parquet;
mod table;

pub use columns::Wanted;
pub use fault::{MotionError, RowFault};

use crate::error::FileFault;
use columns::{Columns, Slot};
use eigenbody::Model;
use std::path::Path;
use table::Table;

/// One row of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Time (s).
    pub t: f64,
    /// All coordinates, or the forces of a table of forces.
    pub q: Vec<f64>,
    /// Velocities, if the log has them.
    pub v: Option<Vec<f64>>,
    /// Line of a CSV file, row of a Parquet file, both from 1.
    pub place: u64,
}

/// How many rows were passed over, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Skipped {
    /// A wrong number of columns.
    pub columns: u64,
    /// Not a number, or nothing at all.
    pub numbers: u64,
    /// A time that does not come after the one before.
    pub time: u64,
    /// A configuration that the robot does not have.
    pub configurations: u64,
    /// Not rows but pauses between them, longer than [`LONGEST_PAUSE`] usual steps.
    pub gaps: u64,
}

impl Skipped {
    /// Rows that were passed over.
    pub fn rows(&self) -> u64 {
        self.columns + self.numbers + self.time + self.configurations
    }
}

/// A pause between rows is a gap if it is longer than this many of the longest step seen before it.
pub const LONGEST_PAUSE: f64 = 10.0;

/// How to read a log.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionOptions {
    /// Bad rows are counted and passed over, not errors.
    pub skip_bad: bool,
    /// Where joints without a column stand; without it they are an error.
    pub others: Option<Vec<f64>>,
    /// Mimic joints follow: they need no column.
    pub mimic: bool,
    /// What the columns without `q0` are.
    pub wanted: Wanted,
}

/// A log as it is read, row by row.
pub struct Motion<'m> {
    model: &'m Model<f64>,
    file: String,
    options: MotionOptions,
    columns: Columns,
    table: Table,
    skipped: Skipped,
    /// Time of the last row, and the longest step so far.
    last: Option<f64>,
    longest: f64,
}

impl<'m> Motion<'m> {
    /// Opens a log: Parquet for files ending in .parquet, CSV for all others.
    ///
    /// Errors: [`MotionError`] if it cannot be read, has no column of times, or a column or joint that fits nothing.
    pub fn open(path: &Path, model: &'m Model<f64>, options: MotionOptions) -> Result<Self, MotionError> {
        let file = path.display().to_string();
        if path.is_dir() {
            return Err(MotionError::File { file, fault: FileFault::Directory });
        }
        let (table, names) = Table::open(path, &file)?;
        let columns = Columns::find(&names, model, &options).map_err(|problem| MotionError::Heading {
            file: file.clone(),
            line: table.line(),
            problem,
        })?;
        Ok(Self {
            model,
            file,
            options,
            columns,
            table,
            skipped: Skipped::default(),
            last: None,
            longest: 0.0,
        })
    }

    /// True if rows have velocities.
    pub fn has_velocities(&self) -> bool {
        self.columns.velocities
    }

    /// What was passed over so far.
    pub fn skipped(&self) -> Skipped {
        self.skipped
    }

    /// Part of the file that is read, from 0 to 1, as far as is known.
    pub fn progress(&self) -> f64 {
        self.table.progress()
    }

    /// The next row; none at the end. Errors: [`MotionError`], at its place.
    pub fn next_row(&mut self) -> Result<Option<Row>, MotionError> {
        loop {
            let Some((place, cells)) = self.table.next_row().map_err(|problem| self.broken(problem))? else {
                return Ok(None);
            };
            let fault = match self.row(place, &cells) {
                Ok(row) => {
                    let gap = self.gap(row.t);
                    self.last = Some(row.t);
                    match gap {
                        Some(fault) if !self.options.skip_bad => fault,
                        gap => {
                            self.skipped.gaps += u64::from(gap.is_some());
                            return Ok(Some(row));
                        }
                    }
                }
                Err(fault) => fault,
            };
            if !self.options.skip_bad {
                return Err(MotionError::Row { file: self.file.clone(), place, fault });
            }
            match fault {
                RowFault::Columns { .. } => self.skipped.columns += 1,
                RowFault::Number { .. } | RowFault::Empty { .. } => self.skipped.numbers += 1,
                RowFault::Time { .. } => self.skipped.time += 1,
                RowFault::Configuration(_) => self.skipped.configurations += 1,
                RowFault::Gap { .. } => {}
            }
        }
    }

    fn broken(&self, problem: String) -> MotionError {
        MotionError::File { file: self.file.clone(), fault: FileFault::Io(problem) }
    }

    fn row(&self, place: u64, cells: &[table::Cell]) -> Result<Row, RowFault> {
        let Columns { names, slots, velocities, template, .. } = &self.columns;
        if cells.len() != names.len() {
            return Err(RowFault::Columns { found: cells.len(), expected: names.len() });
        }
        let mut row = Row { t: 0.0, q: template.clone(), v: None, place };
        let mut v = vec![0.0; if *velocities { self.model.nv() } else { 0 }];
        for ((slot, cell), name) in slots.iter().zip(cells).zip(names) {
            let Some(slot) = slot else { continue };
            let column = || name.clone();
            let x = match cell {
                table::Cell::Number(x) if x.is_finite() => *x,
                table::Cell::Number(x) => {
                    return Err(RowFault::Number { column: column(), found: x.to_string() });
                }
                table::Cell::Text(found) => {
                    return Err(RowFault::Number { column: column(), found: found.clone() });
                }
                table::Cell::Empty => return Err(RowFault::Empty { column: column() }),
            };
            match *slot {
                Slot::Time => row.t = x,
                Slot::Coordinate(k) => row.q[k] = x,
                Slot::Velocity(d) => v[d] = x,
            }
        }
        if self.options.wanted == Wanted::Configurations {
            if let (true, Some(coupling)) = (self.options.mimic, self.model.coupling()) {
                let free: Vec<f64> = coupling.independent_coordinates().iter().map(|&k| row.q[k]).collect();
                row.q = coupling.expand(&free);
            }
            self.model.check_q(&row.q).map_err(|error| RowFault::Configuration(error.to_string()))?;
        }
        if let Some(last) = self.last.filter(|&last| row.t <= last) {
            return Err(RowFault::Time { t: row.t, last });
        }
        row.v = velocities.then_some(v);
        Ok(row)
    }

    /// A pause that is too long for the steps before it.
    fn gap(&mut self, t: f64) -> Option<RowFault> {
        let step = t - self.last?;
        let is_gap = self.longest > 0.0 && step > LONGEST_PAUSE * self.longest;
        let usual = self.longest;
        if !is_gap {
            self.longest = self.longest.max(step);
        }
        is_gap.then_some(RowFault::Gap { t, step, usual })
    }
}

//! Numbers over time, from a table.

use eigenbody::{InputError, Model};
use eigenbody_formats::motion::Wanted;
use eigenbody_formats::{Motion, MotionError, MotionOptions};
use std::path::Path;

/// Rows at ascending times; held at both ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    times: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

impl Trajectory {
    /// One row for all times.
    pub fn constant(row: Vec<f64>) -> Self {
        Self { times: vec![0.0], rows: vec![row] }
    }

    /// Rows of `width` numbers each at ascending times (s).
    ///
    /// Errors: [`InputError`] without rows, for a row of another width, a number that is not finite or times that do not ascend.
    pub fn new(times: Vec<f64>, rows: Vec<Vec<f64>>, width: usize) -> Result<Self, InputError> {
        if times.is_empty() || times.len() != rows.len() {
            let expected = times.len().max(1);
            return Err(InputError::Length { what: "rows of the trajectory", expected, found: rows.len() });
        }
        for row in &rows {
            if row.len() != width {
                let found = row.len();
                return Err(InputError::Length { what: "row of the trajectory", expected: width, found });
            }
            if let Some(index) = row.iter().position(|x| !x.is_finite()) {
                return Err(InputError::NotFinite { what: "row of the trajectory", index });
            }
        }
        if let Some(index) = (1..times.len()).find(|&k| times[k] <= times[k - 1] || times[k].is_nan()) {
            let value = times[index] - times[index - 1];
            return Err(InputError::NotPositive { what: "step of the trajectory's time", index, value });
        }
        Ok(Self { times, rows })
    }

    /// The configurations, or the forces, of a table in a file; mimic joints need no column if they follow.
    ///
    /// Errors: [`MotionError`] if it cannot be read, does not fit the model or has no rows.
    pub fn read(file: &Path, model: &Model<f64>, mimic: bool, wanted: Wanted) -> Result<Self, MotionError> {
        let mut table =
            Motion::open(file, model, MotionOptions { mimic, wanted, ..MotionOptions::default() })?;
        let (mut times, mut rows) = (Vec::new(), Vec::new());
        while let Some(row) = table.next_row()? {
            times.push(row.t);
            rows.push(row.q);
        }
        let width = match wanted {
            Wanted::Configurations => model.nq(),
            Wanted::Forces => model.nv(),
        };
        let failed = |error: InputError| MotionError::Heading {
            file: file.display().to_string(),
            line: None,
            problem: error.to_string(),
        };
        Self::new(times, rows, width).map_err(failed)
    }

    /// Where in the table t is: the row before, the part of the way to the next one, and that way's duration.
    fn place(&self, t: f64) -> (usize, f64, f64) {
        let next = self.times.partition_point(|&time| time <= t);
        match next {
            0 => (0, 0.0, f64::INFINITY),
            next if next == self.times.len() => (next - 1, 0.0, f64::INFINITY),
            next => {
                let span = self.times[next] - self.times[next - 1];
                (next - 1, (t - self.times[next - 1]) / span, span)
            }
        }
    }

    /// Numbers in between on straight lines.
    pub fn numbers(&self, t: f64, out: &mut [f64]) {
        let (k, part, _) = self.place(t);
        let after = &self.rows[(k + 1).min(self.rows.len() - 1)];
        for ((out, a), b) in out.iter_mut().zip(&self.rows[k]).zip(after) {
            *out = a + part * (b - a);
        }
    }

    /// Configurations in between at constant velocity, and that velocity.
    pub fn configuration(&self, model: &Model<f64>, t: f64, q: &mut [f64], v: &mut [f64]) {
        let (k, part, span) = self.place(t);
        let after = &self.rows[(k + 1).min(self.rows.len() - 1)];
        model.difference_into(&self.rows[k], after, v);
        v.iter_mut().for_each(|v| *v *= part);
        model.integrate_into(&self.rows[k], v, q);
        model.difference_into(&self.rows[k], after, v);
        v.iter_mut().for_each(|v| *v /= span);
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }
}

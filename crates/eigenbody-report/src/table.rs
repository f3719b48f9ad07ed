//! Tables as CSV: a heading of names with units, then a row a line.

use eigenbody_study::{Column, Table, Values};
use std::io::{self, Write};

/// Writes a table. Units stand in brackets behind the names; numbers parse back to the same bits; an empty cell is no number.
///
/// # Errors
///
/// If `out` cannot be written.
///
/// ```
/// use eigenbody_study::Rows;
/// let mut table = Rows::new(&[("curve", "")], &[("t", "s"), ("kappa", "1")]);
/// table.push(["θ = 0".into()], [Some(0.5), None]);
/// let mut text = Vec::new();
/// eigenbody_report::write_table_csv(&table, &mut text)?;
/// assert_eq!(String::from_utf8(text)?, "curve,t [s],kappa [1]\nθ = 0,0.5,\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_table_csv(table: &Table, out: impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let heading = |column: &Column| match column.unit {
        "" => column.name.to_owned(),
        unit => format!("{} [{unit}]", column.name),
    };
    writer.write_record(table.columns().iter().map(heading)).map_err(io_of)?;
    for row in 0..table.rows() {
        let cell = |column: &Column| match &column.values {
            Values::Text(cells) => cells[row].clone(),
            Values::Number(cells) => cells[row].map_or_else(String::new, |x| x.to_string()),
        };
        writer.write_record(table.columns().iter().map(cell)).map_err(io_of)?;
    }
    writer.flush()
}

/// The system's own error, its kind kept.
pub(crate) fn io_of(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(source) => source,
        other => io::Error::other(format!("{other:?}")),
    }
}

//! Rows as Parquet: one optional double, one list of doubles or one string a column, in row groups.
//!
//! A file is readable once its footer stands at its end, so that it is written in one go, from rows that are kept elsewhere until then.
//! Units and whatever else is to be known stand in the key-value metadata, `unit:NAME` for the unit of column NAME.

use eigenbody_study::{Cell, Field, Shape};
use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};
use std::io::{self, Write};
use std::sync::Arc;
use thiserror::Error;

/// Rows of one group.
const GROUP: usize = 1 << 14;

/// Why there is no Parquet file.
#[derive(Debug, Error)]
pub enum ParquetFailure {
    /// The rows could not be read, or the file not be written.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The format has no place for a row.
    #[error("Parquet: {0}")]
    Format(#[from] ParquetError),
}

impl ParquetFailure {
    /// As whoever writes files has it.
    #[must_use]
    pub fn into_io(self) -> io::Error {
        match self {
            Self::Io(source) => source,
            other => io::Error::other(other.to_string()),
        }
    }
}

/// Writes rows under these fields.
///
/// # Errors
///
/// [`ParquetFailure`], if rows cannot be read, do not fit the fields, or `out` cannot be written.
pub fn write_parquet(
    fields: &[Field],
    metadata: &[(&str, String)],
    rows: impl Iterator<Item = io::Result<Vec<Cell>>>,
    out: impl Write + Send,
) -> Result<(), ParquetFailure> {
    let columns = fields.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    let schema = Arc::new(Type::group_type_builder("rows").with_fields(columns).build()?);
    let units = fields.iter().map(|field| KeyValue::new(format!("unit:{}", field.name), field.unit.clone()));
    let more = metadata.iter().map(|(key, value)| KeyValue::new((*key).to_owned(), value.clone()));
    let known = units.chain(more).collect();
    let properties = WriterProperties::builder().set_key_value_metadata(Some(known)).build();
    let mut writer = SerializedFileWriter::new(out, schema, Arc::new(properties))?;
    let mut group = Vec::new();
    for row in rows {
        group.push(row?);
        if group.len() == GROUP {
            write_group(&mut writer, fields, &group)?;
            group.clear();
        }
    }
    if !group.is_empty() {
        write_group(&mut writer, fields, &group)?;
    }
    writer.close()?;
    Ok(())
}

/// The type of a column.
fn column(field: &Field) -> Result<TypePtr, ParquetError> {
    let double = |name: &str, repetition| {
        Type::primitive_type_builder(name, Physical::DOUBLE).with_repetition(repetition).build().map(Arc::new)
    };
    match field.shape {
        Shape::Number => double(&field.name, Repetition::OPTIONAL),
        Shape::Text => Type::primitive_type_builder(&field.name, Physical::BYTE_ARRAY)
            .with_repetition(Repetition::REQUIRED)
            .with_converted_type(ConvertedType::UTF8)
            .build()
            .map(Arc::new),
        Shape::List => {
            let element = double("element", Repetition::REQUIRED)?;
            let list = Type::group_type_builder("list")
                .with_repetition(Repetition::REPEATED)
                .with_fields(vec![element])
                .build()?;
            Type::group_type_builder(&field.name)
                .with_repetition(Repetition::REQUIRED)
                .with_converted_type(ConvertedType::LIST)
                .with_fields(vec![Arc::new(list)])
                .build()
                .map(Arc::new)
        }
    }
}

fn write_group<W: Write + Send>(
    writer: &mut SerializedFileWriter<W>,
    fields: &[Field],
    rows: &[Vec<Cell>],
) -> Result<(), ParquetFailure> {
    let mut group = writer.next_row_group()?;
    for (place, field) in fields.iter().enumerate() {
        let Some(mut column) = group.next_column()? else { break };
        let cells = rows.iter().map(|row| row.get(place));
        match field.shape {
            Shape::Number => {
                let numbers: Vec<Option<f64>> = cells
                    .map(|cell| match cell {
                        Some(Cell::Number(x)) => *x,
                        _ => None,
                    })
                    .collect();
                let levels: Vec<i16> = numbers.iter().map(|x| i16::from(x.is_some())).collect();
                let values: Vec<f64> = numbers.into_iter().flatten().collect();
                column.typed::<DoubleType>().write_batch(&values, Some(&levels), None)?;
            }
            Shape::Text => {
                let words: Vec<ByteArray> = cells
                    .map(|cell| match cell {
                        Some(Cell::Text(word)) => word.as_str().into(),
                        _ => "".into(),
                    })
                    .collect();
                column.typed::<ByteArrayType>().write_batch(&words, None, None)?;
            }
            Shape::List => {
                let (mut values, mut defined, mut repeated) = (Vec::new(), Vec::new(), Vec::new());
                for cell in cells {
                    let all = match cell {
                        Some(Cell::List(all)) => all.as_slice(),
                        _ => &[],
                    };
                    // An empty list stands as one place without a value.
                    defined.extend((0..all.len().max(1)).map(|_| i16::from(!all.is_empty())));
                    repeated.extend((0..all.len().max(1)).map(|k| i16::from(k > 0)));
                    values.extend_from_slice(all);
                }
                column.typed::<DoubleType>().write_batch(&values, Some(&defined), Some(&repeated))?;
            }
        }
        column.close()?;
    }
    group.close()?;
    Ok(())
}

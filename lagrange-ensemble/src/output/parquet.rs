//! Parquet: the columns of the CSV file with their types, a row group for each part. A motion without a
//! result has nulls.

use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as Physical};
use parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int32Type, Int64Type,
};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::{Out, Stopped};
use crate::block::Block;
use crate::record::{Cells, Kind, Record};
use crate::table::Rows;

/// Writes a table.
pub(super) fn write(rows: &Rows, out: &mut Out) -> Result<(), Stopped> {
    let columns = &rows.layout().columns;
    let field = |name: &str, physical, converted, repetition| {
        Type::primitive_type_builder(name, physical)
            .with_converted_type(converted)
            .with_repetition(repetition)
            .build()
            .map(Arc::new)
    };
    let none = ConvertedType::NONE;
    let mut fields = vec![put(field("index", Physical::INT64, none, Repetition::REQUIRED))?];
    for column in columns {
        let (physical, converted) = match column.kind {
            Kind::F64 => (Physical::DOUBLE, none),
            Kind::F32 => (Physical::FLOAT, none),
            Kind::I64 => (Physical::INT64, none),
            Kind::I32 => (Physical::INT32, none),
            Kind::U64 => (Physical::INT64, ConvertedType::UINT_64),
            Kind::U32 => (Physical::INT32, ConvertedType::UINT_32),
            Kind::U8 => (Physical::INT32, ConvertedType::UINT_8),
            Kind::Bool => (Physical::BOOLEAN, none),
        };
        fields.push(put(field(&column.name, physical, converted, Repetition::OPTIONAL))?);
    }
    fields.push(put(field("error_time", Physical::DOUBLE, none, Repetition::OPTIONAL))?);
    fields.push(put(field("error", Physical::BYTE_ARRAY, ConvertedType::UTF8, Repetition::OPTIONAL))?);
    let schema = put(Type::group_type_builder("motions").with_fields(fields).build())?;
    let properties = WriterProperties::builder().set_created_by("lagrange-ensemble".to_owned()).build();
    let mut writer = put(SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties)))?;
    rows.each::<Stopped>(|block| {
        let mut group = put(writer.next_row_group())?;
        let size = rows.layout().row();
        let count = block.rows.len() / size;
        let failed = |row: usize| {
            let index = block.first + row as u64;
            block.failures.binary_search_by_key(&index, |(failed, _)| *failed).is_ok()
        };
        let there: Vec<bool> = (0..count).map(|row| !failed(row)).collect();
        column::<Int64Type>(
            &mut group,
            None,
            (block.first..).map(|index| index as i64).take(count).collect(),
        )?;
        let mut offset = 0;
        for described in columns {
            let cells = block.rows.chunks_exact(size).map(|row| row.get(offset..).unwrap_or_default());
            match described.kind {
                Kind::F64 => values::<DoubleType, f64>(&mut group, &there, cells, |x| x)?,
                Kind::F32 => values::<FloatType, f32>(&mut group, &there, cells, |x| x)?,
                Kind::I64 => values::<Int64Type, i64>(&mut group, &there, cells, |x| x)?,
                Kind::I32 => values::<Int32Type, i32>(&mut group, &there, cells, |x| x)?,
                // Without a sign, but of the same bits.
                Kind::U64 => values::<Int64Type, u64>(&mut group, &there, cells, |x| x as i64)?,
                Kind::U32 => values::<Int32Type, u32>(&mut group, &there, cells, |x| x as i32)?,
                Kind::U8 => values::<Int32Type, u8>(&mut group, &there, cells, i32::from)?,
                Kind::Bool => values::<BoolType, bool>(&mut group, &there, cells, |x| x)?,
            }
            offset += described.kind.size();
        }
        reasons(&mut group, block, count)?;
        put(group.close().map(|_| ()))
    })?;
    put(writer.close().map(|_| ()))
}

/// The columns `error_time` and `error`.
fn reasons(group: &mut Group<'_, '_>, block: &Block, count: usize) -> Result<(), Stopped> {
    let (mut timed, mut times) = (vec![false; count], Vec::new());
    let (mut failed, mut causes) = (vec![false; count], Vec::new());
    for (index, failure) in &block.failures {
        let row = (index - block.first) as usize;
        if let (Some(timed), Some(failed)) = (timed.get_mut(row), failed.get_mut(row)) {
            (*timed, *failed) = (failure.t.is_some(), true);
            times.extend(failure.t);
            causes.push(ByteArray::from(failure.cause.as_str()));
        }
    }
    column::<DoubleType>(group, Some(&timed), times)?;
    column::<ByteArrayType>(group, Some(&failed), causes)
}

type Group<'a, 'b> = SerializedRowGroupWriter<'a, &'b mut Out>;

/// A column of values where they are there.
fn values<'a, D: DataType, T: Record>(
    group: &mut Group<'_, '_>,
    there: &[bool],
    cells: impl Iterator<Item = &'a [u8]>,
    convert: impl Fn(T) -> D::T,
) -> Result<(), Stopped> {
    let present = cells.zip(there).filter(|(_, there)| **there);
    column::<D>(group, Some(there), present.map(|(cell, _)| convert(T::load(&mut Cells(cell)))).collect())
}

/// A column: its values, and in which rows they are.
fn column<D: DataType>(
    group: &mut Group<'_, '_>,
    there: Option<&[bool]>,
    values: Vec<D::T>,
) -> Result<(), Stopped> {
    let levels: Option<Vec<i16>> = there.map(|there| there.iter().map(|there| i16::from(*there)).collect());
    let Some(mut writer) = put(group.next_column())? else { return Ok(()) };
    put(writer.typed::<D>().write_batch(&values, levels.as_deref(), None).map(|_| ()))?;
    put(writer.close())
}

fn put<T>(result: Result<T, ParquetError>) -> Result<T, Stopped> {
    result.map_err(|error| match error {
        ParquetError::External(source) => match source.downcast::<std::io::Error>() {
            Ok(error) => Stopped::Writing(*error),
            Err(source) => Stopped::Writing(std::io::Error::other(source)),
        },
        error => Stopped::Writing(std::io::Error::other(error)),
    })
}

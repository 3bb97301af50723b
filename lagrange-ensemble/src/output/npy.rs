//! `.npy`: a plain array of doubles if all columns are doubles, else a structured array with a field `error`.

use std::io::{self, Write};

use npyz::{DType, Field, TypeStr, WriteOptions, WriterBuilder};

use super::{Out, Stopped};
use crate::block::Layout;
use crate::record::Kind;
use crate::table::Rows;

/// The header of an array of rows. `shape` is that of the motions; several plain columns add a dimension.
pub(crate) fn header(layout: &Layout, shape: &[u64]) -> io::Result<Vec<u8>> {
    let mut shape = shape.to_vec();
    let plain = layout.is_plain();
    if plain && layout.columns.len() != 1 {
        shape.push(layout.columns.len() as u64);
    }
    let field = |name: &str, kind| Ok(Field { name: name.to_owned(), dtype: DType::Plain(of(kind)?) });
    let dtype = if plain {
        DType::Plain(of(Kind::F64)?)
    } else {
        let columns = layout.columns.iter().map(|column| field(&column.name, column.kind));
        DType::Record(columns.chain([field("error", Kind::Bool)]).collect::<io::Result<_>>()?)
    };
    let mut header = Vec::new();
    WriteOptions::new_header_only().dtype(dtype).shape(&shape).writer(&mut header).write_header_only()?;
    Ok(header)
}

/// NumPy's name of a type.
fn of(kind: Kind) -> io::Result<TypeStr> {
    let name = match kind {
        Kind::F64 => "<f8",
        Kind::F32 => "<f4",
        Kind::I64 => "<i8",
        Kind::I32 => "<i4",
        Kind::U64 => "<u8",
        Kind::U32 => "<u4",
        Kind::U8 => "|u1",
        Kind::Bool => "|b1",
    };
    name.parse().map_err(io::Error::other)
}

/// Writes a table.
pub(super) fn write(rows: &Rows, shape: &[u64], out: &mut Out) -> Result<(), Stopped> {
    out.write_all(&header(rows.layout(), shape)?)?;
    rows.each::<Stopped>(|block| Ok(out.write_all(&block.rows)?))
}

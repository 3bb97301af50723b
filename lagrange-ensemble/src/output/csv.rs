//! CSV: `index`, the columns, `error_time` and `error`, which are empty for motions with a result.

use csv::{Writer, WriterBuilder};

use super::{Out, Stopped};
use crate::failure::Failure;
use crate::record::{Cells, Kind, Record};
use crate::table::Rows;

/// Writes a table. Numbers have as many digits as they need to be read back as they were.
pub(super) fn write(rows: &Rows, out: &mut Out) -> Result<(), Stopped> {
    let mut csv = Writer::from_writer(out);
    let columns = &rows.layout().columns;
    let names = columns.iter().map(|column| column.name.as_str());
    put(csv.write_record(["index"].into_iter().chain(names).chain(["error_time", "error"])))?;
    rows.each::<Stopped>(|block| {
        let mut failures = block.failures.iter().peekable();
        for (index, row) in (block.first..).zip(block.rows.chunks_exact(rows.layout().row())) {
            let failure = failures.next_if(|(failed, _)| *failed == index).map(|(_, failure)| failure);
            put(csv.write_field(index.to_string()))?;
            let mut cells = Cells(row);
            for column in columns {
                let text = text(column.kind, &mut cells);
                put(csv.write_field(if failure.is_some() { "" } else { &text }))?;
            }
            for field in reasons(failure) {
                put(csv.write_field(field))?;
            }
            put(csv.write_record(None::<&[u8]>))?;
        }
        Ok(())
    })?;
    Ok(csv.flush()?)
}

/// Writes the failures of a table alone.
pub(super) fn write_failures(rows: &Rows, out: &mut Out) -> Result<(), Stopped> {
    let mut csv = WriterBuilder::new().from_writer(out);
    put(csv.write_record(["index", "error_time", "error"]))?;
    rows.each::<Stopped>(|block| {
        for (index, failure) in &block.failures {
            let [time, cause] = reasons(Some(failure));
            put(csv.write_record([index.to_string(), time, cause]))?;
        }
        Ok(())
    })?;
    Ok(csv.flush()?)
}

fn reasons(failure: Option<&Failure>) -> [String; 2] {
    let time = failure.and_then(|failure| failure.t).map_or(String::new(), |t| format!("{t:?}"));
    [time, failure.map_or(String::new(), |failure| failure.cause.clone())]
}

/// The text of a value; a missing one is empty.
fn text(kind: Kind, cells: &mut Cells<'_>) -> String {
    match kind {
        Kind::F64 => {
            Some(f64::load(cells)).filter(|x| !x.is_nan()).map_or(String::new(), |x| format!("{x:?}"))
        }
        Kind::F32 => {
            Some(f32::load(cells)).filter(|x| !x.is_nan()).map_or(String::new(), |x| format!("{x:?}"))
        }
        Kind::I64 => i64::load(cells).to_string(),
        Kind::I32 => i32::load(cells).to_string(),
        Kind::U64 => u64::load(cells).to_string(),
        Kind::U32 => u32::load(cells).to_string(),
        Kind::U8 => u8::load(cells).to_string(),
        Kind::Bool => bool::load(cells).to_string(),
    }
}

fn put(result: Result<(), csv::Error>) -> Result<(), Stopped> {
    result.map_err(|error| Stopped::Writing(error.into()))
}

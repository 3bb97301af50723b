//! Tables of all kinds of columns, for `scripts/tables.sh`, which reads them with NumPy, pandas and Polars.

use std::error::Error;
use std::path::PathBuf;

use lagrange_ensemble::{Failure, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("tables FOLDER")?);
    let failed = || Failure::at(0.25, "no \"result\",\nover two lines");
    let plain = |index| if index == 7 { Err(failed()) } else { Ok(index as f64 + 0.5) };
    Study::new("plain", 20, plain).run()?.shaped(&[4, 5])?.write(folder.join("plain.npy"))?;
    let mixed = |index: u64| match index {
        7 => Err(failed()),
        _ => Ok((
            index as f64 / 3.0,
            index as f32 / 3.0,
            -(index as i64),
            index as i32,
            (index as u8, (1 << 50) + index, u32::MAX - index as u32),
            index.is_multiple_of(2),
        )),
    };
    let study = Study::new("mixed", 20, mixed);
    let table =
        study.with_columns(["time", "single", "turns", "small", "byte", "long", "short", "over"]).run()?;
    for name in ["mixed.npy", "mixed.csv", "mixed.parquet"] {
        table.write(folder.join(name))?;
    }
    let stored = Study::new("stored", 30, |index| Ok(index as f64)).with_part_size(10);
    stored.in_folder(&folder).run()?;
    Ok(())
}

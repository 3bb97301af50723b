//! What a study costs besides its motions: time and memory.

use std::error::Error;
use std::fs;
use std::hint::black_box;

use lagrangian::ensemble::Study;

use super::processor_time;

/// Rows of the studies whose overhead is measured, and the square roots in each: about 20 µs.
const ROWS: u64 = 100_000;
const ROOTS: u32 = 4000;

/// Time of a row alone [µs], and what studies need more, as a part of it: in memory, in a folder.
pub struct Overhead {
    pub row: f64,
    pub memory: f64,
    pub folder: f64,
}

/// Rows that need nothing of the library: in a plain loop and as studies, in turn.
pub fn overhead() -> Result<Overhead, Box<dyn Error>> {
    let work = |index: u64| (0..ROOTS).fold(index as f64, |x, _| (x + 1.0).sqrt());
    let study = || Study::new("work", ROWS, |index| Ok(work(index))).with_threads(1);
    let folder = std::env::temp_dir().join(format!("lagrange-many-{}", std::process::id()));
    let timed = |run: &dyn Fn() -> Result<(), Box<dyn Error>>| {
        let begin = processor_time();
        run().map(|()| processor_time() - begin)
    };
    let mut best = [f64::INFINITY; 3];
    for _ in 0..5 {
        let alone = timed(&|| {
            (0..ROWS).for_each(|index| {
                black_box(work(index));
            });
            Ok(())
        })?;
        let memory = timed(&|| {
            black_box(study().run()?);
            Ok(())
        })?;
        let stored = timed(&|| {
            black_box(study().in_folder(&folder).run()?);
            Ok(())
        })?;
        fs::remove_dir_all(&folder)?;
        for (best, time) in best.iter_mut().zip([alone, memory, stored]) {
            *best = best.min(time);
        }
    }
    let [alone, memory, stored] = best;
    let more = |time: f64| time / alone - 1.0;
    Ok(Overhead { row: alone / ROWS as f64 * 1e6, memory: more(memory), folder: more(stored) })
}

/// The most memory of the process so far [kB], after studies in a folder of ten thousand and a million rows,
/// and after the table of the latter is written.
pub fn memory() -> Result<[(String, u64); 4], Box<dyn Error>> {
    let folder = std::env::temp_dir().join(format!("lagrange-memory-{}", std::process::id()));
    let study = |count| {
        let study = Study::new(format!("rows-{count}"), count, |index| Ok([index as f64; 5]));
        study.with_threads(2).with_part_size(5000).in_folder(&folder)
    };
    let before = ("before".to_owned(), most()?);
    study(10_000).run()?;
    let few = ("10⁴ rows of 40 bytes, in parts of 5000".to_owned(), most()?);
    let table = study(1_000_000).run()?.ok_or("the study is complete")?;
    let many = ("10⁶ rows".to_owned(), most()?);
    table.write(folder.join("rows.npy"))?;
    let written = ("their table of 40 MB written".to_owned(), most()?);
    fs::remove_dir_all(&folder)?;
    Ok([before, few, many, written])
}

/// The most memory of this process so far [kB].
fn most() -> Result<u64, Box<dyn Error>> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).ok_or("no VmHWM")?;
    Ok(line.trim().trim_end_matches(" kB").parse()?)
}

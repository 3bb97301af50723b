//! The overhead of a study beside its motions: time and memory.

use std::error::Error;
use std::fs;
use std::hint::black_box;

use lagrangian::ensemble::Study;

use super::processor_time;

/// Rows of the studies whose overhead is measured.
const ROWS: u64 = 100_000;

/// The time of a short motion [s], of which the overhead should be a small part.
const MOTION: f64 = 20e-6;

/// How often each study is measured, in turn.
const TURNS: usize = 25;

/// The processor time of a study beside that of its motions [ms], and as a part of the time of short motions:
/// in memory, and in a folder.
pub struct Overhead {
    pub memory: (f64, f64),
    pub folder: (f64, f64),
}

/// Measures studies whose rows take no time, so that all their time is the library's. (Beside rows that take
/// as long as motions it is lost in the scatter of a machine that others use.)
pub fn overhead() -> Result<Overhead, Box<dyn Error>> {
    let study = || Study::new("work", ROWS, |index| Ok(black_box(index) as f64)).with_threads(1);
    let folder = std::env::temp_dir().join(format!("lagrange-many-{}", std::process::id()));
    let timed = |run: &dyn Fn() -> Result<(), Box<dyn Error>>| {
        let begin = processor_time();
        run().map(|()| processor_time() - begin)
    };
    let mut best = [f64::INFINITY; 2];
    for _ in 0..TURNS {
        let memory = timed(&|| {
            black_box(study().run()?);
            Ok(())
        })?;
        let stored = timed(&|| {
            black_box(study().in_folder(&folder).run()?);
            Ok(())
        })?;
        fs::remove_dir_all(&folder)?;
        for (best, time) in best.iter_mut().zip([memory, stored]) {
            *best = best.min(time);
        }
    }
    let [memory, folder] = best.map(|time| (time * 1e3, time / (ROWS as f64 * MOTION)));
    Ok(Overhead { memory, folder })
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

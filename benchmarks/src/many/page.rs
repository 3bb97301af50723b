//! MANY.md.

use std::fmt::Write as _;

use super::costs::Overhead;
use super::{Extent, ON_THREADS, OURS, SYSTEMS, THREADS_AT};
use crate::record::{self, Record, cheapest};
use crate::report::machine;

/// Errors at which rates are compared.
const ERRORS: [f64; 3] = [1e-6, 1e-9, 1e-12];

/// Sources of heyoka's equations.
const SOURCES: [&str; 2] = ["lagrangian", "expert"];

/// The page.
pub fn of(
    records: &[Record],
    threads: &[(&str, &str, [f64; 2])],
    memory: &[(String, u64)],
    overhead: &Overhead,
    versions: &[String],
    extent: Extent,
) -> String {
    let mut text = format!(
        "# Many motions\n\n\
         Written by `cargo run --release -p benchmarks -- many`; [README.md](README.md#many-motions) says what is \
         measured.\n\n{}\n\
         ## Motions a second\n\n\
         The rates are those of {} motions of a study on one thread, by processor time. The run that counts is the \
         cheapest whose error is at or below the first column in nine of ten of the first {} motions. The figure of \
         heyoka is the best of one motion after the other, 4 lanes and 8 lanes; in parentheses stands its part of our \
         best. `–`: no run is as good. All subjects took turns in {} rounds; the least time counts, because others may \
         have used the machine.\n\n\
         | system | error | alone | 4 lanes | 8 lanes | heyoka, same input | heyoka, equations by hand |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n",
        machine::circumstances(versions),
        extent.motions,
        extent.checked,
        extent.rounds,
    );
    let rate = |record: Option<&Record>| record.map(|record| 1e6 / record.us);
    let number = |rate: Option<f64>| rate.map_or("–".to_owned(), |rate| format!("{rate:.0}"));
    let mut logarithms = [(0.0, 0); SOURCES.len()];
    for system in SYSTEMS {
        for error in ERRORS {
            let of = |subject: &str| rate(cheapest(record::of(records, system, subject), error));
            let ours = OURS.map(of);
            let best = ours.into_iter().flatten().fold(0.0, f64::max);
            let [alone, four, eight] = ours.map(number);
            let _ = write!(text, "| {system} | {error:.0e} | {alone} | {four} | {eight} |");
            for (source, (sum, terms)) in SOURCES.iter().zip(&mut logarithms) {
                let rates = ["", "-batch4", "-batch8"].map(|lanes| of(&format!("heyoka-{source}{lanes}")));
                let _ = match rates.into_iter().flatten().reduce(f64::max) {
                    Some(theirs) if best > 0.0 => {
                        *sum += (best / theirs).ln();
                        *terms += 1;
                        write!(text, " {theirs:.0} ({:.2}) |", theirs / best)
                    }
                    theirs => write!(text, " {} |", number(theirs)),
                };
            }
            text.push('\n');
        }
    }
    let means = logarithms.map(|(sum, terms)| (sum / f64::from(terms.max(1))).exp());
    let _ = write!(
        text,
        "\nOur best makes {:.2} times as many motions as heyoka's best from the same input, and {:.2} times as many as \
         from equations derived by hand (geometric means of the lines with both).\n\n\
         ## Two threads\n\n\
         {ON_THREADS} motions at tolerance {THREADS_AT:.0e}: processor time of a motion on two threads beside one, and how many \
         times as fast the clock says it is. Where others use the machine the clock means little.\n\n\
         | system | motions | processor time, ratio | speed by the clock |\n| --- | --- | --- | --- |\n",
        means[0], means[1]
    );
    for (system, subject, [processor, clock]) in threads {
        let _ = writeln!(text, "| {system} | {subject} | {processor:.3} | {clock:.2} |");
    }
    let Overhead { memory: in_memory, folder } = overhead;
    let _ = write!(
        text,
        "\n## What the library costs\n\n\
         100 000 rows that take no time, on one thread: in memory {:.1} ms, {:.2} % of what as many motions of 20 µs take, \
         in a folder {:.1} ms, {:.2} % (processor time, least of 25 turns).\n\n\
         The most memory of one process so far, in this order:\n\n| after | MB |\n| --- | --- |\n",
        in_memory.0,
        100.0 * in_memory.1,
        folder.0,
        100.0 * folder.1
    );
    for (after, most) in memory {
        let _ = writeln!(text, "| {after} | {:.1} |", *most as f64 / 1e3);
    }
    text
}

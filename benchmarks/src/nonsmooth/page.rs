//! NONSMOOTH.md.

use std::fmt::Write as _;

use super::{BY_HAND, CASES, OURS};
use crate::record::{self, Record, best, cheapest};
use crate::report::machine;

/// The peers in the order of the columns, and whether they integrate modes that were written by hand.
const PEERS: [(&str, bool); 4] =
    [("heyoka", true), ("scipy-dop853", true), ("siconos", false), ("mujoco", false)];

/// The errors of the second table.
const ERRORS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// The page.
pub fn of(records: &[Record], versions: &[String]) -> String {
    format!(
        "# Contacts, dry friction, kinks\n\n\
         Written by `cargo run --release -p benchmarks -- nonsmooth`; [README.md](README.md#contacts) says what the cases \
         are. The errors of `jets`, of modes by hand and of heyoka are medians over 61 starts, those of the \
         others belong to the first start, as all times do. A ratio in brackets is the time of a peer by ours: \
         by that of the modes by hand beside heyoka and SciPy, \
         which know no contacts, where there are any.\n\n{}\n{}\n{}",
        machine::circumstances(versions),
        best_errors(records),
        times(records)
    )
}

/// The name of what the library integrates beside a peer.
fn beside(records: &[Record], case: &str, has_modes: bool) -> &'static str {
    if has_modes && record::of(records, case, BY_HAND).next().is_some() { BY_HAND } else { OURS }
}

/// The heads of the columns after these.
fn columns(first: &str) -> String {
    let names = [first, "jets (ours)", "by hand (ours)"].into_iter().chain(PEERS.map(|(name, _)| name));
    let names: Vec<&str> = names.collect();
    let lines = " --- |".repeat(names.len() + first.matches('|').count());
    format!("| {} |\n|{lines}\n", names.join(" | "))
}

/// The most accurate runs.
fn best_errors(records: &[Record]) -> String {
    let mut text = format!(
        "## Best error\n\n\
         The most accurate run at any tolerance or length of step: its error, its time [µs]; behind it the ratio to our \
         cheapest run that is at least as good. `–`: no run, or none of ours is as good.\n\n{}",
        columns("case")
    );
    for case in CASES {
        let _ = write!(text, "| {case} |");
        for own in [OURS, BY_HAND] {
            let _ = match best(record::of(records, case, own)) {
                None => write!(text, " – |"),
                Some(run) => write!(text, " {:.1e}, {:.1} |", run.error, run.us),
            };
        }
        for (peer, has_modes) in PEERS {
            let own = beside(records, case, has_modes);
            let _ = match best(record::of(records, case, peer)) {
                None => write!(text, " – |"),
                Some(run) => {
                    let as_good = cheapest(record::of(records, case, own), run.error);
                    let ratio = as_good.map_or("–".to_owned(), |ours| format!("{:.1}", run.us / ours.us));
                    write!(text, " {:.1e}, {:.1} ({ratio}) |", run.error, run.us)
                }
            };
        }
        text.push('\n');
    }
    text
}

/// The cheapest runs for some errors.
fn times(records: &[Record]) -> String {
    let mut text = format!(
        "## Time to an error\n\n\
         The time [µs] of the cheapest run whose error is at or below the one of the row. `–`: no run is as good.\n\n{}",
        columns("case | error")
    );
    for (case, error) in CASES.into_iter().flat_map(|case| ERRORS.map(|error| (case, error))) {
        let time = |subject| cheapest(record::of(records, case, subject), error).map(|run| run.us);
        let _ = write!(text, "| {case} | {error:.0e} |");
        for own in [OURS, BY_HAND] {
            let _ = match time(own) {
                None => write!(text, " – |"),
                Some(us) => write!(text, " {us:.1} |"),
            };
        }
        for (peer, has_modes) in PEERS {
            let _ = match (time(peer), time(beside(records, case, has_modes))) {
                (None, _) => write!(text, " – |"),
                (Some(us), None) => write!(text, " {us:.1} |"),
                (Some(us), Some(ours)) => write!(text, " {us:.1} ({:.1}) |", us / ours),
            };
        }
        text.push('\n');
    }
    text
}

//! NONSMOOTH.md.

use std::fmt::Write as _;

use super::{CASES, OURS};
use crate::record::{self, Record, best, cheapest};
use crate::report::machine;

/// The subjects in the order of the columns.
const PEERS: [&str; 4] = ["heyoka", "scipy-dop853", "siconos", "mujoco"];

/// The page.
pub fn of(records: &[Record], versions: &[String]) -> String {
    let mut text = format!(
        "# Contacts, dry friction, kinks\n\n\
         Written by `cargo run --release -p benchmarks -- nonsmooth`; [README.md](README.md#contacts) says what the cases \
         are.\n\n{}\n\
         ## Best error\n\n\
         The most accurate run at any tolerance or length of step: its error, its time [µs]; behind it how many times \
         longer it takes than our cheapest run that is at least as good. `–`: no run, or none of ours is as good.\n\n\
         | case | jets (ours) | {} |\n| --- | --- |{}\n",
        machine::circumstances(versions),
        PEERS.join(" | "),
        " --- |".repeat(PEERS.len()),
    );
    for case in CASES {
        let Some(ours) = best(record::of(records, case, OURS)) else { continue };
        let _ = write!(text, "| {case} | {:.1e}, {:.1} |", ours.error, ours.us);
        for peer in PEERS {
            let _ = match best(record::of(records, case, peer)) {
                None => write!(text, " – |"),
                Some(run) => {
                    let as_good = cheapest(record::of(records, case, OURS), run.error);
                    let ratio = as_good.map_or("–".to_owned(), |ours| format!("{:.1}", run.us / ours.us));
                    write!(text, " {:.1e}, {:.1} ({ratio}) |", run.error, run.us)
                }
            };
        }
        text.push('\n');
    }
    text
}

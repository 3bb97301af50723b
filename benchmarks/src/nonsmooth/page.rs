//! NONSMOOTH.md.

use std::fmt::Write as _;

use super::{BY_HAND, CASES, OURS};
use crate::record::{self, Record, best, cheapest};
use crate::report::machine;

/// The peers in the order of the columns, and whether they integrate modes that were written by hand.
const PEERS: [(&str, bool); 4] =
    [("heyoka", true), ("scipy-dop853", true), ("siconos", false), ("mujoco", false)];

/// The page.
pub fn of(records: &[Record], versions: &[String]) -> String {
    let mut text = format!(
        "# Contacts, dry friction, kinks\n\n\
         Written by `cargo run --release -p benchmarks -- nonsmooth`; [README.md](README.md#contacts) says what the cases \
         are.\n\n{}\n\
         ## Best error\n\n\
         The most accurate run at any tolerance or length of step: its error, its time [µs]; behind it how many times \
         longer it takes than our cheapest run that is at least as good: of the modes by hand beside heyoka and SciPy, \
         which know no contacts, where there are any. `–`: no run, or none of ours is as good.\n\n\
         | case | jets (ours) | by hand (ours) | {} |\n| --- | --- | --- |{}\n",
        machine::circumstances(versions),
        PEERS.map(|(name, _)| name).join(" | "),
        " --- |".repeat(PEERS.len()),
    );
    for case in CASES {
        let Some(ours) = best(record::of(records, case, OURS)) else { continue };
        let _ = write!(text, "| {case} | {:.1e}, {:.1} |", ours.error, ours.us);
        let by_hand = best(record::of(records, case, BY_HAND));
        let _ = match &by_hand {
            None => write!(text, " – |"),
            Some(run) => write!(text, " {:.1e}, {:.1} |", run.error, run.us),
        };
        for (peer, has_modes) in PEERS {
            let own = if has_modes && by_hand.is_some() { BY_HAND } else { OURS };
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

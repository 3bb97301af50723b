//! The tables of the report, as Markdown.

use std::fmt::Write;

use crate::record::{Record, best, cheapest, of, systems};

/// The errors that runs have to reach.
const ACCURACIES: [f64; 3] = [1e-6, 1e-9, 1e-12];
/// What all others are compared with.
const OURS: &str = "jets";
/// Explicit Runge–Kutta methods of peers; the best one counts.
const RUNGE_KUTTA: [&str; 7] = [
    "diffeq-dopri5",
    "diffeq-dop853",
    "diffeq-rkv988e",
    "diffeq-rkv989e",
    "diffsol-tsit45",
    "numbalsoda-dop853",
    "ode_solvers-dop853",
];
/// Several trajectories at once, in the lanes of a processor.
const BATCHES: [&str; 6] = [
    "jets-batch4",
    "jets-batch8",
    "heyoka-lagrangian-batch4",
    "heyoka-lagrangian-batch8",
    "heyoka-expert-batch4",
    "heyoka-expert-batch8",
];

/// All tables.
pub fn all(records: &[Record]) -> String {
    [times(records), errors(records), batches(records)].join("\n")
}

/// The runs of any Runge–Kutta peer.
fn runge_kutta<'a>(records: &'a [Record], system: &'a str) -> impl Iterator<Item = &'a Record> {
    RUNGE_KUTTA.iter().flat_map(move |subject| of(records, system, subject))
}

/// Time to reach an error.
fn times(records: &[Record]) -> String {
    let mut text = String::from(
        "## Time to reach an error\n\n\
         Cheapest run whose error is at or below the bound [µs]; in parentheses the time relative to ours, so above one \
         ours is faster. `–`: not reached at any tolerance.\n\n\
         | system | error | jets (ours) | heyoka-lagrangian | heyoka-expert | best Runge–Kutta of a peer |\n\
         | --- | --- | --- | --- | --- | --- |\n",
    );
    for accuracy in ACCURACIES {
        let mut ratios = [Vec::new(), Vec::new(), Vec::new()];
        for system in systems(records) {
            let ours = cheapest(of(records, system, OURS), accuracy);
            let peers = [
                cheapest(of(records, system, "heyoka-lagrangian"), accuracy),
                cheapest(of(records, system, "heyoka-expert"), accuracy),
                cheapest(runge_kutta(records, system), accuracy),
            ];
            let _ = write!(text, "| {system} | {accuracy:.0e} | {}", time(ours, None));
            for (peer, ratios) in peers.into_iter().zip(&mut ratios) {
                let _ = write!(text, " | {}", time(peer, ours));
                ratios.extend(ours.zip(peer).map(|(ours, peer)| peer.us / ours.us));
            }
            let method = peers[2].map_or(String::new(), |record| format!(" {}", record.subject));
            let _ = writeln!(text, "{method} |");
        }
        let means = ratios.map(|ratios| mean(&ratios));
        let _ = writeln!(text, "| geometric mean | {accuracy:.0e} | | {} |", means.join(" | "));
    }
    text
}

/// A time, and how it compares.
fn time(record: Option<&Record>, ours: Option<&Record>) -> String {
    match (record, ours) {
        (None, _) => "–".to_owned(),
        (Some(record), None) => format!("{:.1}", record.us),
        (Some(record), Some(ours)) => format!("{:.1} ({:.2})", record.us, record.us / ours.us),
    }
}

/// Geometric mean, in the parentheses of a ratio.
fn mean(ratios: &[f64]) -> String {
    if ratios.is_empty() {
        return "–".to_owned();
    }
    let logarithms: f64 = ratios.iter().map(|ratio| ratio.ln()).sum();
    format!("({:.2})", (logarithms / ratios.len() as f64).exp())
}

/// The most accurate run.
fn errors(records: &[Record]) -> String {
    let mut text = String::from(
        "## Best error\n\n\
         The most accurate run at any tolerance, and its time [µs].\n\n\
         | system | jets (ours) | heyoka-lagrangian | heyoka-expert | best Runge–Kutta of a peer |\n\
         | --- | --- | --- | --- | --- |\n",
    );
    for system in systems(records) {
        let cell = |record: Option<&Record>| {
            record.map_or("–".to_owned(), |record| format!("{:.1e} ({:.0})", record.error, record.us))
        };
        let own = |subject| cell(best(of(records, system, subject)));
        let peer = best(runge_kutta(records, system));
        let method = peer.map_or(String::new(), |record| format!(" {}", record.subject));
        let _ = writeln!(
            text,
            "| {system} | {} | {} | {} | {}{method} |",
            own(OURS),
            own("heyoka-lagrangian"),
            own("heyoka-expert"),
            cell(peer)
        );
    }
    text
}

/// Time for each trajectory of a batch.
fn batches(records: &[Record]) -> String {
    let present: Vec<&str> =
        BATCHES.into_iter().filter(|batch| records.iter().any(|record| record.subject == *batch)).collect();
    let mut text = String::from(
        "## Batches\n\n\
         The same trajectory in every lane, cheapest run at or below the error, time for each trajectory [µs].\n\n\
         | system | error |",
    );
    let _ = writeln!(text, " {} |\n| --- | --- |{}", present.join(" | "), " --- |".repeat(present.len()));
    for system in systems(records) {
        for accuracy in ACCURACIES {
            let cells =
                present.iter().map(|batch| time(cheapest(of(records, system, batch), accuracy), None));
            let _ =
                writeln!(text, "| {system} | {accuracy:.0e} | {} |", cells.collect::<Vec<_>>().join(" | "));
        }
    }
    text
}

//! The tables of the report, as Markdown.

use std::fmt::Write;

use crate::record::{Record, best, cheapest, of, systems};

/// The errors that runs have to reach.
const ACCURACIES: [f64; 3] = [1e-6, 1e-9, 1e-12];
/// What all others are compared with.
const OURS: &str = "jets";
/// Peers with a column of their own.
const PEERS: [&str; 4] =
    ["heyoka-lagrangian", "heyoka-lagrangian-fast", "heyoka-expert", "heyoka-expert-fast"];
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
/// Several trajectories at once, in the lanes of a processor: ours, and the peers with as many lanes.
const BATCHES: [(&str, [&str; 2]); 2] = [
    ("jets-batch4", ["heyoka-lagrangian-batch4", "heyoka-expert-batch4"]),
    ("jets-batch8", ["heyoka-lagrangian-batch8", "heyoka-expert-batch8"]),
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
    let mut text = format!(
        "## Time to reach an error\n\n\
         Cheapest run whose error is at or below the bound [µs]; in parentheses the time relative to ours, so above one \
         ours is faster. `–`: not reached at any tolerance.\n\n\
         | system | error | {OURS} (ours) | {} | best Runge–Kutta of a peer |\n| --- | --- | --- |{} --- |\n",
        PEERS.join(" | "),
        " --- |".repeat(PEERS.len())
    );
    for accuracy in ACCURACIES {
        let mut ratios = vec![Vec::new(); PEERS.len() + 1];
        for system in systems(records) {
            let ours = cheapest(of(records, system, OURS), accuracy);
            let method = cheapest(runge_kutta(records, system), accuracy);
            let peers =
                PEERS.iter().map(|peer| cheapest(of(records, system, peer), accuracy)).chain([method]);
            let _ = write!(text, "| {system} | {accuracy:.0e} | {}", time(ours, None));
            for (peer, ratios) in peers.zip(&mut ratios) {
                let _ = write!(text, " | {}", time(peer, ours));
                ratios.extend(ours.zip(peer).map(|(ours, peer)| peer.us / ours.us));
            }
            let _ = writeln!(text, "{} |", name(method));
        }
        let means: Vec<String> = ratios.iter().map(|ratios| mean(ratios)).collect();
        let _ = writeln!(text, "| geometric mean | {accuracy:.0e} | | {} |", means.join(" | "));
    }
    text
}

/// Behind a figure, whose it is.
fn name(record: Option<&Record>) -> String {
    record.map_or(String::new(), |record| format!(" {}", record.subject))
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
    let mut text = format!(
        "## Best error\n\n\
         The most accurate run at any tolerance, and its time [µs].\n\n\
         | system | {OURS} (ours) | {} | best Runge–Kutta of a peer |\n| --- | --- |{} --- |\n",
        PEERS.join(" | "),
        " --- |".repeat(PEERS.len())
    );
    let cell = |record: Option<&Record>| {
        record.map_or("–".to_owned(), |record| format!("{:.1e} ({:.0})", record.error, record.us))
    };
    for system in systems(records) {
        let own = [OURS].into_iter().chain(PEERS).map(|subject| cell(best(of(records, system, subject))));
        let method = best(runge_kutta(records, system));
        let own = own.collect::<Vec<_>>().join(" | ");
        let _ = writeln!(text, "| {system} | {own} | {}{} |", cell(method), name(method));
    }
    text
}

/// Time for each trajectory of a batch.
fn batches(records: &[Record]) -> String {
    let columns = BATCHES.map(|(ours, peers)| format!(" {ours} (ours) | {} |", peers.join(" | ")));
    let mut text = format!(
        "## Batches\n\n\
         The same trajectory in every lane, cheapest run at or below the error, time for each trajectory [µs]; in \
         parentheses the time relative to ours with as many lanes.\n\n\
         | system | error |{}\n| --- | --- |{}\n",
        columns.concat(),
        " --- |".repeat(3 * BATCHES.len())
    );
    for accuracy in ACCURACIES {
        let mut ratios = BATCHES.map(|(_, peers)| peers.map(|_| Vec::new()));
        for system in systems(records) {
            let _ = write!(text, "| {system} | {accuracy:.0e} |");
            for ((ours, peers), ratios) in BATCHES.iter().zip(&mut ratios) {
                let ours = cheapest(of(records, system, ours), accuracy);
                let _ = write!(text, " {} |", time(ours, None));
                for (peer, ratios) in peers.iter().zip(ratios) {
                    let peer = cheapest(of(records, system, peer), accuracy);
                    let _ = write!(text, " {} |", time(peer, ours));
                    ratios.extend(ours.zip(peer).map(|(ours, peer)| peer.us / ours.us));
                }
            }
            text.push('\n');
        }
        let means = ratios.map(|[one, other]| format!(" | {} | {} |", mean(&one), mean(&other)));
        let _ = writeln!(text, "| geometric mean | {accuracy:.0e} |{}", means.concat());
    }
    text
}

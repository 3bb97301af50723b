//! The tables of the report, as Markdown.

use std::fmt::Write;

use crate::problem::CONSTRAINED;
use crate::record::{Record, best, cheapest, of, systems};

/// The errors that runs have to reach.
const ACCURACIES: [f64; 3] = [1e-6, 1e-9, 1e-12];
/// The subject with which all others are compared.
const OURS: &str = "jets";

/// A column of a table: peers of which the best one counts.
struct Column {
    title: &'static str,
    peers: &'static [&'static str],
}

/// Peers with a column of their own, and the explicit Runge–Kutta methods of peers.
const LAGRANGIAN: Column = Column { title: "heyoka-lagrangian", peers: &["heyoka-lagrangian"] };
const LAGRANGIAN_FAST: Column =
    Column { title: "heyoka-lagrangian-fast", peers: &["heyoka-lagrangian-fast"] };
const EXPERT: Column = Column { title: "heyoka-expert", peers: &["heyoka-expert"] };
const EXPERT_FAST: Column = Column { title: "heyoka-expert-fast", peers: &["heyoka-expert-fast"] };
const RUNGE_KUTTA: Column = Column {
    title: "best Runge–Kutta of a peer",
    peers: &[
        "diffeq-dopri5",
        "diffeq-dop853",
        "diffeq-rkv988e",
        "diffeq-rkv989e",
        "diffsol-tsit45",
        "numbalsoda-dop853",
        "ode_solvers-dop853",
    ],
};
/// Solvers that keep the multipliers.
const MULTIPLIERS: Column =
    Column { title: "best with multipliers of a peer", peers: &["diffsol-bdf-dae", "casadi-idas"] };

/// Systems that share a table.
struct Group {
    title: &'static str,
    remark: &'static str,
    columns: &'static [Column],
    constrained: bool,
}

const GROUPS: [Group; 2] = [
    Group {
        title: "Systems of free coordinates",
        remark: "",
        columns: &[LAGRANGIAN, LAGRANGIAN_FAST, EXPERT, EXPERT_FAST, RUNGE_KUTTA],
        constrained: false,
    },
    Group {
        title: "Systems with constraints",
        remark: "Ours keeps coordinates and multipliers as they are described, and so do the solvers in the last \
                 column. heyoka and the Runge–Kutta methods cannot; they run on equations that were reduced by \
                 hand.\n\n",
        columns: &[EXPERT, EXPERT_FAST, RUNGE_KUTTA, MULTIPLIERS],
        constrained: true,
    },
];

/// Several trajectories at once, in the lanes of a processor: ours, and the peers with as many lanes.
const BATCHES: [(&str, [&str; 2]); 2] = [
    ("jets-batch4", ["heyoka-lagrangian-batch4", "heyoka-expert-batch4"]),
    ("jets-batch8", ["heyoka-lagrangian-batch8", "heyoka-expert-batch8"]),
];

/// All tables; a group without a record has none.
pub fn all(records: &[Record]) -> String {
    let measured = GROUPS.iter().filter(|group| group.systems(records).next().is_some());
    let tables = measured.map(|group| {
        format!("## {}\n\n{}{}\n{}", group.title, group.remark, times(group, records), errors(group, records))
    });
    tables.chain([batches(records)]).collect::<Vec<_>>().join("\n")
}

impl Group {
    /// The systems of the group that were measured.
    fn systems<'a>(&'a self, records: &'a [Record]) -> impl Iterator<Item = &'static str> + 'a {
        systems(records).filter(|system| CONSTRAINED.contains(system) == self.constrained)
    }

    /// The head of a table: first columns, ours and those of peers.
    fn head(&self, first: &[&str]) -> String {
        let ours = format!("{OURS} (ours)");
        let peers = self.columns.iter().map(|column| column.title);
        let titles: Vec<&str> = first.iter().copied().chain([ours.as_str()]).chain(peers).collect();
        format!("| {} |\n|{}\n", titles.join(" | "), " --- |".repeat(titles.len()))
    }
}

impl Column {
    /// The runs of any of the peers.
    fn of<'a>(&'a self, records: &'a [Record], system: &'a str) -> impl Iterator<Item = &'a Record> {
        self.peers.iter().flat_map(move |subject| of(records, system, subject))
    }

    /// The name behind a figure, where a column has several peers.
    fn name(&self, record: Option<&Record>) -> String {
        match record {
            Some(record) if self.peers.len() > 1 => format!(" {}", record.subject),
            _ => String::new(),
        }
    }
}

/// Time to reach an error.
fn times(group: &Group, records: &[Record]) -> String {
    let mut text = format!(
        "### Time to reach an error\n\n\
         Cheapest run whose error is at or below the bound [µs]; in parentheses the time relative to ours, so above one \
         ours is faster. `–`: not reached at any tolerance.\n\n{}",
        group.head(&["system", "error"])
    );
    for accuracy in ACCURACIES {
        let mut ratios = vec![Vec::new(); group.columns.len()];
        for system in group.systems(records) {
            let ours = cheapest(of(records, system, OURS), accuracy);
            let _ = write!(text, "| {system} | {accuracy:.0e} | {}", time(ours, None));
            for (column, ratios) in group.columns.iter().zip(&mut ratios) {
                let peer = cheapest(column.of(records, system), accuracy);
                let _ = write!(text, " | {}{}", time(peer, ours), column.name(peer));
                ratios.extend(ours.zip(peer).map(|(ours, peer)| peer.us / ours.us));
            }
            text += " |\n";
        }
        let means: Vec<String> = ratios.iter().map(|ratios| mean(ratios)).collect();
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
fn errors(group: &Group, records: &[Record]) -> String {
    let mut text = format!(
        "### Best error\n\nThe most accurate run at any tolerance, and its time [µs].\n\n{}",
        group.head(&["system"])
    );
    let cell = |record: Option<&Record>| {
        record.map_or("–".to_owned(), |record| format!("{:.1e} ({:.0})", record.error, record.us))
    };
    for system in group.systems(records) {
        let _ = write!(text, "| {system} | {}", cell(best(of(records, system, OURS))));
        for column in group.columns {
            let peer = best(column.of(records, system));
            let _ = write!(text, " | {}{}", cell(peer), column.name(peer));
        }
        text += " |\n";
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
        for system in systems(records).filter(|system| of(records, system, BATCHES[0].0).next().is_some()) {
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

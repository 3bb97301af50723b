//! The page: how to read it, and its tables.

use std::fmt::Write;

use super::cell::{Cell, METHODS, Outcome};
use super::singular::runs::METHODS as PASSES;
use super::singular::table::Row;
use crate::report::machine;

/// The text above the tables.
const GUIDE: &str = include_str!("guide.md");

/// The whole page.
pub fn write(cells: &[Cell], linkages: &[Row]) -> String {
    let built = format!(
        "* Machine: one core of {}\n* Built by {} for any processor of this architecture\n* Date: {}\n",
        machine::processor(),
        machine::compiler(),
        machine::date()
    );
    format!("{}\n\n{built}\n{}", GUIDE.trim_end(), tables(cells, linkages))
}

/// All tables, as far as something was measured.
pub fn tables(cells: &[Cell], linkages: &[Row]) -> String {
    let mut text = String::new();
    if !cells.is_empty() {
        text += "## Errors\n\n";
        text += &table(cells, error);
        text += "\n## Drift\n\nExponent p of the growth |ΔE| ~ tᵖ of the energy error, over the last six octaves of time; `0` where it is \
                 rounding of the energy itself.\n\n";
        text += &table(&conservative(cells), drift);
        text += "\n## Time\n\nTime of the run [ms], and steps in parentheses.\n\n";
        text += &table(cells, cost);
    }
    if !linkages.is_empty() {
        text += "\n## Passing singular positions\n\n";
        text += &passes(linkages, "Of all runs: wrong without an error / ended in a typed error.", |row| {
            let ((energy, place), errors) = (row.wrong(), row.causes().into_values().sum::<usize>());
            match (energy + place, errors) {
                (0, 0) => "0".to_owned(),
                (0, errors) => format!("0 / {errors}"),
                (wrong, errors) => format!("**{wrong}** / {errors}"),
            }
        });
        text += "\n";
        text += &passes(
            linkages,
            "Largest energy error of a run that ended, relative to the kinetic energy at the start.",
            |row| format!("{:.0e}", row.worst(|errors| errors.energy)),
        );
        text += "\n";
        text += &passes(linkages, "Steps of a run, mean.", |row| format!("{:.0}", row.steps()));
        text += "\nCauses of the errors:\n\n";
        for row in linkages.iter().filter(|row| !row.causes().is_empty()) {
            let causes: Vec<String> =
                row.causes().into_iter().map(|(cause, n)| format!("{n} `{cause}`")).collect();
            let _ = writeln!(text, "* {}, {}: {}", row.case, row.method.name(), causes.join(", "));
        }
    }
    text
}

/// The tasks whose energy is conserved, as far as some method shows a drift.
fn conservative(cells: &[Cell]) -> Vec<Cell> {
    let drifts = |task: &str| {
        cells
            .iter()
            .any(|cell| cell.task == task && matches!(cell.outcome, Outcome::Done { drift: Some(_), .. }))
    };
    cells.iter().filter(|cell| drifts(cell.task)).cloned().collect()
}

/// A row for each task, a column for each method.
fn table(cells: &[Cell], show: fn(&Outcome) -> String) -> String {
    let mut text = format!("| task | {} |\n|{}\n", METHODS.join(" | "), " --- |".repeat(METHODS.len() + 1));
    for row in cells.chunk_by(|a, b| a.task == b.task) {
        let shown: Vec<String> = row.iter().map(|cell| show(&cell.outcome)).collect();
        let _ = writeln!(text, "| {} | {} |", row[0].task, shown.join(" | "));
    }
    text
}

/// The error, bold if it is silently wrong; or the cause and the time of an error.
fn error(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Done { error, .. } if outcome.is_silently_wrong() => format!("**{error:.0e}**"),
        Outcome::Done { error, .. } => format!("{error:.0e}"),
        Outcome::Failed { cause, t } => format!("`{cause}` at {t:.1e} s"),
        Outcome::NotOffered => "–".to_owned(),
    }
}

/// The exponent.
fn drift(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Done { drift: Some(drift), .. } => format!("{drift:.1}"),
        Outcome::Done { drift: None, .. } => "0".to_owned(),
        Outcome::Failed { .. } => "error".to_owned(),
        Outcome::NotOffered => "–".to_owned(),
    }
}

/// Time and steps.
fn cost(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Done { us, steps, .. } if *us < 1e4 => format!("{:.2} ({steps})", us * 1e-3),
        Outcome::Done { us, steps, .. } => format!("{:.0} ({steps})", us * 1e-3),
        Outcome::Failed { .. } => "error".to_owned(),
        Outcome::NotOffered => "–".to_owned(),
    }
}

/// A row for each linkage, a column for each method.
fn passes(linkages: &[Row], caption: &str, show: impl Fn(&Row) -> String) -> String {
    let names: Vec<String> = PASSES.iter().map(|method| method.name()).collect();
    let mut text = format!(
        "{caption}\n\n| linkage | runs | {} |\n|{}\n",
        names.join(" | "),
        " --- |".repeat(PASSES.len() + 2)
    );
    for rows in linkages.chunk_by(|a, b| a.case == b.case) {
        let shown: Vec<String> = rows.iter().map(&show).collect();
        let _ = writeln!(text, "| {} | {} | {} |", rows[0].case, rows[0].outcomes.len(), shown.join(" | "));
    }
    text
}

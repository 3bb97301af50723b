//! All integrators on tasks that are hard for integrators: STABILITY.md and its picture.

mod cell;
mod page;
mod picture;
mod singular;
mod systems;
mod tasks;

use std::error::Error;
use std::path::Path;

use serde::Serialize;

use cell::{Cell, METHODS, Outcome};
use singular::table::Row;

/// Starts of a linkage in a usual run, in a full one, and how many times as many of the random linkages.
const STARTS: [usize; 2] = [24, 400];
const RANDOM: [usize; 2] = [4, 3];

/// Everything as it is written to JSON.
#[derive(Serialize)]
struct Records<'a> {
    cells: &'a [Cell],
    linkages: Vec<singular::table::Record>,
}

/// Measures everything, or the one task or linkage that is named; writes the page and its picture if it was
/// everything.
pub fn run(only: Option<&str>, json: Option<&Path>, full: bool) -> Result<(), Box<dyn Error>> {
    let wanted = |name: &str| only.is_none_or(|only| only == name);
    let mut cells = Vec::new();
    for (name, measure) in tasks::rows()?.into_iter().filter(|row| wanted(row.0)) {
        eprintln!("stability: {name}");
        let measured = measure();
        for method in METHODS {
            let found = measured.iter().find(|cell| cell.method == method).cloned();
            let (benchmark, outcome) = ("stability", Outcome::NotOffered);
            cells.push(found.unwrap_or(Cell { benchmark, task: name, method, outcome }));
        }
    }
    let mut linkages = Vec::new();
    for (name, make) in singular::cases::CASES.into_iter().filter(|case| wanted(case.0)) {
        eprintln!("stability: {name}");
        let scale = if name == "random" { RANDOM[usize::from(full)] } else { 1 };
        let case = make(scale * STARTS[usize::from(full)]);
        linkages.extend(singular::runs::METHODS.map(|method| case.measure(method)));
    }
    if cells.is_empty() && linkages.is_empty() {
        return Err("no such task or linkage".into());
    }
    if let Some(path) = json {
        let records = Records { cells: &cells, linkages: linkages.iter().map(Row::record).collect() };
        std::fs::write(path, serde_json::to_string_pretty(&records)?)?;
    }
    if only.is_some() {
        println!("{}", page::tables(&cells, &linkages));
    } else {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        std::fs::write(here.join("STABILITY.md"), page::write(&cells, &linkages))?;
        picture::draw(&cells, &here.join("plots/stability.svg"))?;
    }
    let wrong = cells.iter().filter(|cell| cell.outcome.is_silently_wrong()).count();
    let runs: usize = linkages.iter().map(|row| row.wrong().0 + row.wrong().1).sum();
    match wrong + runs {
        0 => Ok(()),
        _ => Err(format!("wrong without an error: {wrong} cells, {runs} runs of linkages").into()),
    }
}

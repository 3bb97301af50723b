//! The picture: tasks by methods, each cell in the colour of its error.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::cell::{Cell, METHODS, Outcome};

/// Size of a cell, and room for the names [px].
const CELL: (i32, i32) = (56, 26);
const LEFT: i32 = 120;
const TOP: i32 = 112;
/// Room below for the legend [px].
const BELOW: i32 = 56;

/// From 1e-16 (green) through 1e-8 (yellow) to 1 (red).
fn colour(error: f64) -> RGBColor {
    let share = ((error.max(1e-16).log10() + 16.0) / 16.0).clamp(0.0, 1.0);
    let stops = [(84.0, 168.0, 104.0), (250.0, 232.0, 140.0), (214.0, 70.0, 60.0)];
    let (from, to, along) =
        if share < 0.5 { (stops[0], stops[1], 2.0 * share) } else { (stops[1], stops[2], 2.0 * share - 1.0) };
    let mix = |a: f64, b: f64| (a + (b - a) * along) as u8;
    RGBColor(mix(from.0, to.0), mix(from.1, to.1), mix(from.2, to.2))
}

/// Draws all cells into a file.
pub fn draw(cells: &[Cell], path: &Path) -> Result<(), Box<dyn Error>> {
    let mut tasks: Vec<&str> = cells.iter().map(|cell| cell.task).collect();
    tasks.dedup();
    let (columns, rows) = (METHODS.len() as i32, tasks.len() as i32);
    let size = (LEFT + columns * CELL.0 + 12, TOP + rows * CELL.1 + BELOW);
    let area = SVGBackend::new(path, (size.0 as u32, size.1 as u32)).into_drawing_area();
    area.fill(&WHITE)?;
    let text = |size: i32| ("sans-serif", size).into_font().color(&BLACK);
    let middle = text(11).pos(Pos::new(HPos::Center, VPos::Center));
    let right = text(13).pos(Pos::new(HPos::Right, VPos::Center));
    let upright = text(13).transform(FontTransform::Rotate270).pos(Pos::new(HPos::Left, VPos::Center));
    for (i, method) in METHODS.iter().enumerate() {
        let x = LEFT + i as i32 * CELL.0 + CELL.0 / 2;
        area.draw(&Text::new(*method, (x, TOP - 8), upright.clone()))?;
    }
    for (i, task) in tasks.iter().enumerate() {
        let y = TOP + i as i32 * CELL.1;
        area.draw(&Text::new(*task, (LEFT - 8, y + CELL.1 / 2), right.clone()))?;
    }
    for cell in cells {
        let column = METHODS.iter().position(|method| *method == cell.method).unwrap_or(0) as i32;
        let row = tasks.iter().position(|task| *task == cell.task).unwrap_or(0) as i32;
        let (x, y) = (LEFT + column * CELL.0, TOP + row * CELL.1);
        let corners = [(x + 1, y + 1), (x + CELL.0 - 1, y + CELL.1 - 1)];
        let (fill, label) = match &cell.outcome {
            Outcome::Done { error, .. } => (colour(*error), format!("{error:.0e}")),
            Outcome::Failed { .. } => (RGBColor(205, 215, 235), "error".to_owned()),
            Outcome::NotOffered => continue,
        };
        area.draw(&Rectangle::new(corners, fill.filled()))?;
        if cell.outcome.is_silently_wrong() {
            area.draw(&Rectangle::new(corners, BLACK.stroke_width(3)))?;
        }
        area.draw(&Text::new(label, (x + CELL.0 / 2, y + CELL.1 / 2), middle.clone()))?;
    }
    let y = TOP + rows * CELL.1 + 20;
    let legend = "Error of a task (what it is: see the page). Blue: ends in a typed error. Empty: does not compile. Framed: worse than \
                  the tolerance allows, without an error.";
    area.draw(&Text::new(legend, (12, y), text(12)))?;
    area.present()?;
    Ok(())
}

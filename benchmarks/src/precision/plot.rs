//! Work-precision plots: run time against error, both logarithmic, one file for each system.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;

use crate::record::{self, Record};

/// Subjects that are drawn, with their colours; related ones share a hue.
const STYLES: [(&str, RGBColor); 16] = [
    ("jets", RGBColor(0, 0, 0)),
    ("dop853", RGBColor(120, 120, 120)),
    ("heyoka-lagrangian", RGBColor(214, 39, 40)),
    ("heyoka-expert", RGBColor(255, 152, 150)),
    ("diffeq-rkv988e", RGBColor(31, 119, 180)),
    ("diffeq-rkv989e", RGBColor(120, 180, 220)),
    ("diffeq-dop853", RGBColor(23, 190, 207)),
    ("diffeq-dopri5", RGBColor(140, 220, 225)),
    ("ode_solvers-dop853", RGBColor(44, 160, 44)),
    ("numbalsoda-dop853", RGBColor(188, 189, 34)),
    ("numbalsoda-lsoda", RGBColor(255, 187, 90)),
    ("diffsol-tsit45", RGBColor(148, 103, 189)),
    ("diffsol-bdf", RGBColor(197, 176, 213)),
    ("diffsol-bdf-dae", RGBColor(227, 119, 194)),
    ("casadi-idas", RGBColor(140, 86, 75)),
    ("casadi-cvodes", RGBColor(196, 156, 148)),
];

/// The range of errors that are drawn: no failures, and no zeros.
const ERRORS: std::ops::Range<f64> = 1e-16..1.0;

/// One plot for each system that has records.
pub fn draw_all(records: &[Record], directory: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(directory)?;
    for system in record::systems(records) {
        let path = directory.join(format!("{system}.svg"));
        let drawn: Vec<&Record> = records
            .iter()
            .filter(|r| {
                r.system == system && ERRORS.contains(&r.error) && STYLES.iter().any(|s| s.0 == r.subject)
            })
            .collect();
        if !drawn.is_empty() {
            draw(system, records, &drawn, &path)?;
        }
    }
    Ok(())
}

/// One plot.
fn draw(system: &str, records: &[Record], drawn: &[&Record], path: &Path) -> Result<(), Box<dyn Error>> {
    let fold =
        |start: f64, pick: fn(f64, f64) -> f64| drawn.iter().fold(start, |all, record| pick(all, record.us));
    let times = fold(f64::INFINITY, f64::min) * 0.7..fold(0.0, f64::max) * 1.4;
    let area = SVGBackend::new(path, (900, 560)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(format!("{system}: time of a run against the error at its end"), ("sans-serif", 18))
        .margin(12)
        .margin_right(24)
        .x_label_area_size(40)
        .y_label_area_size(64)
        .build_cartesian_2d(ERRORS.log_scale(), times.log_scale())?;
    let power = |value: &f64| format!("{value:.0e}");
    chart
        .configure_mesh()
        .x_desc("error")
        .y_desc("time [µs]")
        .x_label_formatter(&power)
        .y_label_formatter(&|us| format!("{us:.0}"))
        .label_style(("sans-serif", 14))
        .light_line_style(RGBColor(240, 240, 240))
        .bold_line_style(RGBColor(215, 215, 215))
        .draw()?;
    for (subject, color) in STYLES {
        let points: Vec<(f64, f64)> = record::of(records, system, subject)
            .filter(|record| ERRORS.contains(&record.error))
            .map(|record| (record.error, record.us))
            .collect();
        if points.is_empty() {
            continue;
        }
        let width = if subject == "jets" { 4 } else { 2 };
        let style = color.stroke_width(width);
        chart
            .draw_series(LineSeries::new(points.iter().copied(), style))?
            .label(subject)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], style));
        chart.draw_series(points.iter().map(|point| Circle::new(*point, width, color.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.85))
        .border_style(RGBColor(200, 200, 200))
        .label_font(("sans-serif", 13))
        .draw()?;
    area.present()?;
    Ok(())
}

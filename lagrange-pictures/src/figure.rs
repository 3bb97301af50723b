//! [`Figure`]: charts side by side, drawn by `plotters`.

use std::ops::Range;
use std::path::{Path, PathBuf};

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::axis::{Axis, around, extent};
use crate::chart::{Chart, Curve, Stroke};
use crate::colours::GRID;
use crate::error::PictureError;
use crate::file;

/// The backend rounds to whole pixels. Everything is drawn this much larger than it is shown, so that curves
/// are smooth.
const FINE: i32 = 8;

/// Width and height of a plot without its labels, and bounds of both where equal scales decide.
const PLOT: (i32, i32) = (540, 350);
const SMALLEST: (i32, i32) = (300, 220);
const WIDEST: i32 = 760;
/// Space to the right of a plot.
const MARGIN: i32 = 24;
/// Space between the edge of the picture and an axis title.
const EDGE: i32 = 10;
/// Space of the tick labels and the axis title to the left of a plot and below it.
const LEFT: i32 = 72;
const BELOW: i32 = 52;
/// Space of the title and the legend above a plot.
const ABOVE: i32 = 62;

/// Charts side by side.
#[derive(Clone, Debug)]
pub struct Figure {
    charts: Vec<Chart>,
}

impl Figure {
    /// These charts, from left to right.
    pub fn new(charts: impl IntoIterator<Item = Chart>) -> Self {
        Self { charts: charts.into_iter().collect() }
    }

    /// The picture as the text of an SVG file.
    ///
    /// # Errors
    /// [`PictureError::Empty`] if there is no chart or one has no point, [`PictureError::NotFinite`],
    /// [`PictureError::Plot`].
    pub fn svg(&self) -> Result<String, PictureError> {
        let charts = &self.charts;
        charts.iter().try_for_each(Chart::check)?;
        let width: i32 = charts.iter().map(Chart::full_width).sum();
        let plot_height = charts.iter().map(|chart| chart.size().1).max().ok_or(PictureError::Empty)?;
        let height = ABOVE + plot_height + BELOW;
        let (drawn_width, drawn_height) = ((width * FINE) as u32, (height * FINE) as u32);
        let mut svg = String::new();
        {
            let root = SVGBackend::with_string(&mut svg, (drawn_width, drawn_height)).into_drawing_area();
            root.fill(&WHITE).map_err(refused)?;
            let mut rest = root.clone();
            for chart in charts {
                let (area, right) = rest.split_horizontally(chart.full_width() * FINE);
                chart.draw(&area, plot_height).map_err(refused)?;
                rest = right;
            }
            root.present().map_err(refused)?;
        }
        // Only the view box keeps the fine scale.
        let size = |width, height| format!("<svg width=\"{width}\" height=\"{height}\"");
        Ok(svg.replacen(&size(drawn_width as i32, drawn_height as i32), &size(width, height), 1))
    }

    /// Writes the picture as an SVG file and returns where it is. Folders on the way are made.
    ///
    /// # Errors
    /// As [`Figure::svg`], and [`PictureError::Io`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<PathBuf, PictureError> {
        file::write(path.as_ref(), &self.svg()?)
    }
}

/// An error of the plotting library.
fn refused(error: impl std::fmt::Display) -> PictureError {
    PictureError::Plot(error.to_string())
}

impl Chart {
    /// Refuses a chart that cannot be drawn.
    fn check(&self) -> Result<(), PictureError> {
        let mut points = self.curves.iter().flat_map(|curve| &curve.points);
        if let Some(&(x, _)) = points.clone().find(|(x, y)| !(x.is_finite() && y.is_finite())) {
            return Err(PictureError::NotFinite { what: "a point of a curve", at: x });
        }
        points.next().map(|_| ()).ok_or(PictureError::Empty)
    }

    /// The points as they are drawn: logarithms where the axis is logarithmic.
    fn drawn(&self, curve: &Curve) -> Vec<(f64, f64)> {
        let value = |&(x, y): &(f64, f64)| (x, if self.logarithmic { y.abs().log10() } else { y });
        curve.points.iter().map(value).filter(|(x, y)| x.is_finite() && y.is_finite()).collect()
    }

    /// Ranges of the data with some space around them.
    fn ranges(&self) -> (Range<f64>, Range<f64>) {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let drawn = self.curves.iter().flat_map(|curve| self.drawn(curve));
        let x = extent(points().map(|point| point.0), if self.equal { 0.05 } else { 0.0 });
        let y = extent(drawn.map(|point| point.1), 0.05);
        (x, if self.logarithmic { y.start.floor()..y.end.ceil() } else { y })
    }

    /// Width and height of the plot: those of the data where scales are equal.
    fn size(&self) -> (i32, i32) {
        if !self.equal {
            return PLOT;
        }
        let (x, y) = self.ranges();
        let aspect = (x.end - x.start) / (y.end - y.start);
        let width = ((f64::from(PLOT.1) * aspect) as i32).clamp(SMALLEST.0, WIDEST);
        (width, ((f64::from(width) / aspect) as i32).clamp(SMALLEST.1, PLOT.1))
    }

    fn full_width(&self) -> i32 {
        LEFT + self.size().0 + MARGIN
    }

    /// Both axes for a plot of this height, with their ranges widened for equal scales.
    fn axes(&self, height: i32) -> (Axis, Axis) {
        let (mut x, mut y) = self.ranges();
        if self.equal {
            let length = |range: &Range<f64>| range.end - range.start;
            let (wide, high) = (f64::from(self.size().0), f64::from(height));
            let unit = (length(&x) / wide).max(length(&y) / high);
            (x, y) = (around(&x, unit * wide), around(&y, unit * high));
        }
        (Axis::linear(x), if self.logarithmic { Axis::powers_of_ten(y) } else { Axis::linear(y) })
    }

    fn draw(
        &self,
        area: &DrawingArea<SVGBackend<'_>, Shift>,
        height: i32,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let text = |size: i32, horizontal: HPos| {
            ("sans-serif", size * FINE).into_font().color(&BLACK).pos(Pos::new(horizontal, VPos::Center))
        };
        let middle = (LEFT + self.size().0 / 2) * FINE;
        let without_legend = self.curves.iter().all(|curve| curve.label.is_empty());
        let line = if without_legend { 36 } else { 18 };
        area.draw(&Text::new(self.title.clone(), (middle, line * FINE), text(18, HPos::Center)))?;
        self.draw_legend(area, middle)?;

        let (x, y) = self.axes(height);
        let plot = area.margin(ABOVE * FINE, EDGE * FINE, EDGE * FINE, MARGIN * FINE);
        let mut chart = ChartBuilder::on(&plot)
            .x_label_area_size((BELOW - EDGE) * FINE)
            .y_label_area_size((LEFT - EDGE) * FINE)
            .build_cartesian_2d(x, y)?;
        let mut mesh = chart.configure_mesh();
        if self.x.is_empty() && self.y.is_empty() {
            mesh.disable_mesh().disable_axes();
        }
        mesh.bold_line_style(GRID.stroke_width(FINE as u32))
            .light_line_style(TRANSPARENT)
            .axis_style(BLACK.stroke_width(FINE as u32))
            .set_all_tick_mark_size(5 * FINE)
            .x_desc(&self.x)
            .y_desc(&self.y)
            .axis_desc_style(("sans-serif", 15 * FINE))
            .label_style(("sans-serif", 14 * FINE))
            .draw()?;
        for curve in &self.curves {
            let points = self.drawn(curve);
            let width = if curve.stroke == Stroke::Guide { FINE } else { FINE * 7 / 5 };
            let skip = match curve.stroke {
                Stroke::Linkage => 1,
                Stroke::Dots => 0,
                Stroke::Line | Stroke::Guide => points.len(),
            };
            let radius = if curve.stroke == Stroke::Dots { 4 * FINE } else { 5 * FINE / 2 };
            let dots = points.iter().skip(skip).map(|&at| Circle::new(at, radius, curve.colour.filled()));
            chart.draw_series(dots)?;
            if curve.stroke != Stroke::Dots {
                chart.draw_series(LineSeries::new(points, curve.colour.stroke_width(width as u32)))?;
            }
        }
        Ok(())
    }

    /// A row of colours and labels under the title.
    fn draw_legend(
        &self,
        area: &DrawingArea<SVGBackend<'_>, Shift>,
        middle: i32,
    ) -> Result<(), Box<dyn std::error::Error>> {
        const SWATCH: i32 = 30;
        let font = ("sans-serif", 15 * FINE).into_font().color(&BLACK);
        let named: Vec<&Curve> = self.curves.iter().filter(|curve| !curve.label.is_empty()).collect();
        // Without a font file widths are estimates; letters of 15 points are about 7 px wide.
        let width = |curve: &Curve| (SWATCH + 7 * curve.label.chars().count() as i32 + 18) * FINE;
        let mut left = middle - named.iter().map(|curve| width(curve)).sum::<i32>() / 2;
        for curve in named {
            let y = 44 * FINE;
            let swatch = vec![(left, y), (left + 22 * FINE, y)];
            area.draw(&PathElement::new(swatch, curve.colour.stroke_width(2 * FINE as u32)))?;
            let font = font.pos(Pos::new(HPos::Left, VPos::Center));
            area.draw(&Text::new(curve.label.clone(), (left + SWATCH * FINE, y), font))?;
            left += width(curve);
        }
        Ok(())
    }
}

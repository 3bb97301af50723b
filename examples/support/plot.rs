//! Charts of the examples as SVG files: titles, axes with units, a legend above the plot, equal scales for
//! paths.
//!
//! Included by path, `#[path = "support/plot.rs"] mod plot;`, so each example uses what it needs.
#![allow(dead_code)]

use std::error::Error;
use std::fs;
use std::ops::Range;
use std::path::PathBuf;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The backend rounds to whole pixels: everything is drawn this much larger than shown, so that curves are
/// smooth.
const FINE: i32 = 8;

/// Width and height of a plot without its labels, and bounds of both where equal scales decide.
const PLOT: (i32, i32) = (540, 350);
const SMALLEST: (i32, i32) = (300, 220);
const WIDEST: i32 = 760;
/// To the right of a plot.
const MARGIN: i32 = 24;
/// Between the edge of the picture and an axis title.
const EDGE: i32 = 10;
/// Space of the tick labels and the axis title to the left of a plot and below it.
const LEFT: i32 = 72;
const BELOW: i32 = 52;
/// Space of the title and the legend above a plot.
const ABOVE: i32 = 62;

/// Colours of Okabe and Ito, which remain distinct to colour-blind readers.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(90, 90, 90),
];
const GREY: RGBColor = RGBColor(170, 170, 170);
const GRID: RGBColor = RGBColor(236, 236, 236);

/// One plot with its curves.
#[derive(Clone, Debug)]
pub struct Chart {
    title: String,
    x: String,
    y: String,
    curves: Vec<Curve>,
    equal: bool,
    logarithmic: bool,
}

#[derive(Clone, Debug)]
struct Curve {
    label: String,
    points: Vec<(f64, f64)>,
    colour: RGBColor,
    stroke: Stroke,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stroke {
    Line,
    /// A line with a dot at each point but the first.
    Linkage,
    Dots,
    /// A thin grey line, not in the legend.
    Guide,
}

impl Chart {
    /// A chart without curves. The axis titles name quantity and unit, `"time [s]"`; without both there are
    /// no axes.
    pub fn new(title: &str, x: &str, y: &str) -> Self {
        let (title, x, y) = (title.into(), x.into(), y.into());
        Self { title, x, y, curves: Vec::new(), equal: false, logarithmic: false }
    }

    /// One unit is equally long on both axes: for paths in space.
    pub fn equal_scales(mut self) -> Self {
        self.equal = true;
        self
    }

    /// |y| on a logarithmic axis; zeros are left out.
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }

    /// A curve in the next colour; an empty label keeps it out of the legend.
    pub fn line(self, label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let colour = self.next_colour();
        self.curve(label, points, colour, Stroke::Line)
    }

    /// Dots in the colour of the curve before them.
    pub fn dots(self, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let colour = self.curves.last().map_or(COLOURS[0], |curve| curve.colour);
        self.curve("", points, colour, Stroke::Dots)
    }

    /// Links between joints, at an age from 0 (first picture, pale) to 1 (last, dark).
    pub fn linkage(self, label: &str, age: f64, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let blend = |pale: u8, dark: u8| (f64::from(pale) + age * (f64::from(dark) - f64::from(pale))) as u8;
        let colour = RGBColor(blend(245, 0), blend(200, 60), blend(120, 130));
        self.curve(label, points, colour, Stroke::Linkage)
    }

    /// A thin grey line behind the rest, such as the outline of a sphere.
    pub fn guide(self, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.curve("", points, GREY, Stroke::Guide)
    }

    fn next_colour(&self) -> RGBColor {
        let lines = self.curves.iter().filter(|curve| curve.stroke == Stroke::Line).count();
        COLOURS[lines % COLOURS.len()]
    }

    fn curve(
        mut self,
        label: &str,
        points: impl IntoIterator<Item = (f64, f64)>,
        colour: RGBColor,
        stroke: Stroke,
    ) -> Self {
        let points = points.into_iter().collect();
        self.curves.push(Curve { label: label.into(), points, colour, stroke });
        self
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

    fn draw(&self, area: &DrawingArea<SVGBackend<'_>, Shift>, height: i32) -> Result<(), Box<dyn Error>> {
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
    ) -> Result<(), Box<dyn Error>> {
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

/// Writes charts side by side to `target/{name}.svg` and tells where.
///
/// # Errors
/// What stands in the way of writing the file.
pub fn save(name: &str, charts: &[Chart]) -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("target");
    let file = folder.join(name).with_extension("svg");
    let width: i32 = charts.iter().map(Chart::full_width).sum();
    let plot_height = charts.iter().map(|chart| chart.size().1).max().unwrap_or(PLOT.1);
    let height = ABOVE + plot_height + BELOW;
    let (drawn_width, drawn_height) = ((width * FINE) as u32, (height * FINE) as u32);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (drawn_width, drawn_height)).into_drawing_area();
        root.fill(&WHITE)?;
        let mut rest = root.clone();
        for chart in charts {
            let (area, right) = rest.split_horizontally(chart.full_width() * FINE);
            chart.draw(&area, plot_height)?;
            rest = right;
        }
        root.present()?;
    }
    // Only the view box keeps the fine scale.
    let size = |width, height| format!("<svg width=\"{width}\" height=\"{height}\"");
    let svg = svg.replacen(&size(drawn_width as i32, drawn_height as i32), &size(width, height), 1);
    fs::create_dir_all(&folder)?;
    fs::write(&file, svg)?;
    println!("Drawn: {}", file.display());
    Ok(())
}

/// Smallest range of the values, widened by a fraction of its size.
fn extent(values: impl Iterator<Item = f64>, padding: f64) -> Range<f64> {
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return 0.0..1.0;
    }
    let size = if high > low { high - low } else { low.abs().max(1.0) };
    low - padding * size..high + padding * size
}

/// A range of this size about the same middle.
fn around(range: &Range<f64>, size: f64) -> Range<f64> {
    let middle = (range.start + range.end) / 2.0;
    middle - size / 2.0..middle + size / 2.0
}

/// A range with ticks at round values.
struct Axis {
    range: Range<f64>,
    step: f64,
    /// Whether the values are exponents of ten.
    exponents: bool,
}

impl Axis {
    /// At most eight ticks, 1, 2 or 5 times a power of ten apart.
    fn linear(range: Range<f64>) -> Self {
        let rough = (range.end - range.start) / 7.0;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0].map(|factor| factor * power).into_iter().find(|&step| step >= rough);
        Self { range, step: step.unwrap_or(10.0 * power), exponents: false }
    }

    /// Ticks at whole exponents.
    fn powers_of_ten(range: Range<f64>) -> Self {
        let step = ((range.end - range.start) / 8.0).ceil().max(1.0);
        Self { range, step, exponents: true }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (low, high): (i32, i32)) -> i32 {
        let fraction = (value - self.range.start) / (self.range.end - self.range.start);
        low + (fraction * f64::from(high - low)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        let slack = 1e-9;
        let first = (self.range.start / self.step - slack).ceil() as i64;
        let last = (self.range.end / self.step + slack).floor() as i64;
        (first..=last).map(|k| k as f64 * self.step).collect()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        if self.exponents {
            return format!("10{}", format!("{value:.0}").chars().map(superscript).collect::<String>());
        }
        // As many decimals as tell neighbouring ticks apart.
        let decimals = (-(self.step * 1.001).log10().floor()).max(0.0) as usize;
        let negative = *value < -0.5 * self.step;
        format!("{}{:.decimals$}", if negative { "−" } else { "" }, value.abs())
    }
}

fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => digit.to_digit(10).and_then(|digit| char::from_u32('⁰' as u32 + digit)).unwrap_or(digit),
    }
}

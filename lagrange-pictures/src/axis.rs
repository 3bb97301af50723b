//! The axes of a chart: ranges of values with ticks at round ones.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::Ranged;

/// Smallest range of the values, widened by a fraction of its size.
pub(crate) fn extent(values: impl Iterator<Item = f64>, padding: f64) -> Range<f64> {
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return 0.0..1.0;
    }
    let size = if high > low { high - low } else { low.abs().max(1.0) };
    low - padding * size..high + padding * size
}

/// A range of this size about the same middle.
pub(crate) fn around(range: &Range<f64>, size: f64) -> Range<f64> {
    let middle = (range.start + range.end) / 2.0;
    middle - size / 2.0..middle + size / 2.0
}

/// A range with ticks at round values.
pub(crate) struct Axis {
    range: Range<f64>,
    step: f64,
    /// Whether the values are exponents of ten.
    exponents: bool,
}

impl Axis {
    /// At most eight ticks, 1, 2 or 5 times a power of ten apart.
    pub(crate) fn linear(range: Range<f64>) -> Self {
        let rough = (range.end - range.start) / 7.0;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0].map(|factor| factor * power).into_iter().find(|&step| step >= rough);
        Self { range, step: step.unwrap_or(10.0 * power), exponents: false }
    }

    /// Ticks at whole exponents.
    pub(crate) fn powers_of_ten(range: Range<f64>) -> Self {
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

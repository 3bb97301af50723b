//! The tables of fixed steps, as Markdown: errors and times by the length of a step, and errors at equal
//! time.

use std::fmt::Write;

use super::Record;
use super::cases::Case;

/// The method with which the others are compared.
const REFERENCE: &str = "rk4";
/// The largest error of a run of the reference that still resembles the motion.
const USELESS: f64 = 0.1;

/// All tables of a case.
pub fn all(case: &dyn Case, records: &[Record]) -> String {
    let methods = case.methods();
    let head = |first: &str, methods: &[&str]| {
        let columns = " --- |".repeat(methods.len());
        format!("| {first} | {} |\n| --- |{columns}\n", methods.join(" | "))
    };
    let mut text = format!(
        "## {}\n\nError at the end, and time of a step [ns] in parentheses.\n\n{}",
        case.name(),
        head("h [s]", &methods)
    );
    for reference in of(records, REFERENCE) {
        let _ = write!(text, "| {:.5} |", reference.h);
        for method in &methods {
            let record = of(records, method).find(|record| record.steps == reference.steps);
            let cell = record.map_or("–".to_owned(), |r| format!("{:.1e} ({:.0})", r.error, r.ns));
            let _ = write!(text, " {cell} |");
        }
        text.push('\n');
    }
    let others: Vec<&str> = methods.into_iter().filter(|method| *method != REFERENCE).collect();
    let _ = write!(
        text,
        "\nError in the run time of {REFERENCE}; in parentheses how many orders of magnitude it is below.\n\n{}",
        head(&format!("{REFERENCE}: h [s], time [µs], error"), &others)
    );
    for reference in of(records, REFERENCE).filter(|record| record.error < USELESS) {
        let _ = write!(text, "| {:.5}, {:.1}, {:.1e} |", reference.h, reference.us(), reference.error);
        for method in &others {
            let cell = at_time(of(records, method), reference.us()).map_or("–".to_owned(), |error| {
                format!("{error:.1e} ({:.1})", (reference.error / error).log10())
            });
            let _ = write!(text, " {cell} |");
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

/// The records of a method, longest steps first.
fn of<'a>(records: &'a [Record], method: &'a str) -> impl Iterator<Item = &'a Record> + Clone {
    records.iter().filter(move |record| record.method == method)
}

/// The error of runs that take `us`, on straight lines between the logarithms; `None` outside of the measured
/// times.
fn at_time<'a>(records: impl Iterator<Item = &'a Record> + Clone, us: f64) -> Option<f64> {
    let (from, to) = records.clone().zip(records.skip(1)).find(|(a, b)| (a.us()..=b.us()).contains(&us))?;
    let place = (us / from.us()).ln() / (to.us() / from.us()).ln();
    Some(from.error * (to.error / from.error).powf(place))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_lie_on_lines_between_logarithms() {
        let record = |steps: usize, error: f64| {
            let (benchmark, system, method) = ("fixed", "dpend", "rk4");
            Record { benchmark, system, method, h: 1.0 / steps as f64, error, ns: 1e3, steps }
        };
        let records = [record(1, 1.0), record(100, 1e-4)];
        let error = at_time(records.iter(), 10.0).expect("within");
        assert!((error / 1e-2 - 1.0).abs() < 1e-12, "{error}");
        assert!(at_time(records.iter(), 200.0).is_none());
    }
}

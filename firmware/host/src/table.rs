//! Tables in Markdown.

use std::error::Error;
use std::fmt::Write;

use crate::errors::{self, Record};

/// Steps per second of the column of errors beside the costs.
const RATE: u32 = 128;

/// Between these lines of a file stand the figures.
const MARKS: [&str; 2] = ["<!-- figures: scripts/firmware.sh figures -->", "<!-- end of figures -->"];

/// What one measurement says: a line `KIND TARGET SYSTEM METHOD SCALAR NUMBER …`.
struct Line<'a> {
    kind: &'a str,
    /// Target, system, method, scalar.
    of: [&'a str; 4],
    numbers: Vec<u64>,
}

fn parse(text: &str) -> Result<Vec<Line<'_>>, Box<dyn Error>> {
    let line = |text| -> Result<_, Box<dyn Error>> {
        let words: Vec<&str> = str::split_whitespace(text).collect();
        let [kind, target, system, method, scalar, ref numbers @ ..] = words[..] else {
            return Err(format!("not a measurement: {text}").into());
        };
        let numbers = numbers.iter().map(|number| number.parse()).collect::<Result<_, _>>()?;
        Ok(Line { kind, of: [target, system, method, scalar], numbers })
    };
    text.lines().map(line).collect()
}

/// Costs of all programs that were measured, and errors by the length of the step.
pub fn figures(measurements: &str) -> Result<String, Box<dyn Error>> {
    let lines = parse(measurements)?;
    let records = errors::after_a_second(RATE)?;
    let mut text = String::new();
    let mut last = None;
    for size in lines.iter().filter(|line| line.kind == "size") {
        let [target, system, method, scalar] = size.of;
        let step = lines.iter().find(|line| line.kind == "step" && line.of == size.of);
        let [code, constants, data, zeroed, vectors] = size.numbers[..] else {
            return Err(format!("five sizes of {system} {method} {scalar} on {target}").into());
        };
        let [instructions, stack] = step.ok_or("no measurement of a step")?.numbers[..] else {
            return Err(format!("two figures of a step of {system} {method} {scalar} on {target}").into());
        };
        if last != Some((target, scalar)) {
            last = Some((target, scalar));
            let _ = write!(
                text,
                "\n### `{scalar}` on `{target}`\n\nThe vector table, not counted, has {vectors} bytes.\n\n\
                 | system | method | flash: code | constants | RAM: static | stack | instructions a step | error |\n\
                 | --- | --- | --- | --- | --- | --- | --- | --- |\n"
            );
        }
        let error = records
            .iter()
            .find(|Record { system: s, method: m, scalar: r, .. }| [*s, *m, *r] == [system, method, scalar])
            .ok_or("no such run")?
            .error;
        let _ = writeln!(
            text,
            "| {system} | {method} | {code} | {} | {} | {stack} | {instructions} | {error:.1e} |",
            constants + data,
            data + zeroed
        );
    }
    let _ = write!(text, "\n### Errors by the length of the step\n\n{}", errors()?);
    Ok(text)
}

/// Errors after one second by steps of several lengths; those of the jets also as a share of those of RK4.
pub fn errors() -> Result<String, Box<dyn Error>> {
    let mut text = String::from(
        "| system | scalar | h [s] | rk4 | jet4 | jet6 | jet6 / rk4 |\n| --- | --- | --- | --- | --- | --- | --- |\n",
    );
    let runs = [32, 64, 128, 256, 512, 1024]
        .into_iter()
        .map(|rate| Ok((rate, errors::after_a_second(rate)?)))
        .collect::<Result<Vec<_>, Box<dyn Error>>>()?;
    let Some((_, first)) = runs.first() else { return Ok(text) };
    for Record { system, scalar, .. } in first.iter().filter(|record| record.method == "rk4") {
        for (rate, records) in &runs {
            let of = |method| {
                let found = |r: &&Record| r.system == *system && r.scalar == *scalar && r.method == method;
                records.iter().find(found).map_or(f64::NAN, |record| record.error)
            };
            let [rk4, jet4, jet6] = ["rk4", "jet4", "jet6"].map(of);
            let share = jet6 / rk4;
            let _ = writeln!(
                text,
                "| {system} | {scalar} | 1/{rate} | {rk4:.1e} | {jet4:.1e} | {jet6:.1e} | {share:.1e} |"
            );
        }
    }
    Ok(text)
}

/// The text of a file with the figures between its marks.
pub fn into_readme(readme: &str, figures: &str) -> Result<String, Box<dyn Error>> {
    let [begin, end] = MARKS;
    let (before, rest) = readme.split_once(begin).ok_or("the file has no mark where figures begin")?;
    let (_, after) = rest.split_once(end).ok_or("the file has no mark where figures end")?;
    Ok(format!("{before}{begin}\n{figures}\n{end}{after}"))
}

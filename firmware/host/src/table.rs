//! Tables in Markdown.

use std::error::Error;
use std::fmt::Write;

use crate::errors::{self, Record};

/// Steps per second of the column of errors beside the costs.
const RATE: u32 = 128;

/// The target with hardware for `f32`.
const FPU: &str = "thumbv7em-none-eabihf";

/// The lines of a file between which the figures stand.
const MARKS: [&str; 2] = ["<!-- figures: scripts/firmware.sh figures -->", "<!-- end of figures -->"];

/// One measurement: a line `KIND TARGET SYSTEM METHOD SCALAR NUMBER …`.
struct Line<'a> {
    kind: &'a str,
    /// Target, system, method, scalar.
    of: [&'a str; 4],
    numbers: Vec<u64>,
}

/// One system and method on one target.
struct Program<'a> {
    /// Target, system, method, scalar.
    of: [&'a str; 4],
    code: u64,
    constants: u64,
    /// RAM that is reserved before the program runs.
    fixed: u64,
    vectors: u64,
    instructions: u64,
    stack: u64,
    error: f64,
}

/// The measurements of all programs.
pub struct Measurements<'a>(Vec<Program<'a>>);

fn lines(text: &str) -> Result<Vec<Line<'_>>, Box<dyn Error>> {
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

impl<'a> Measurements<'a> {
    /// Sizes and steps from text; errors are computed here.
    pub fn parse(text: &'a str) -> Result<Self, Box<dyn Error>> {
        let lines = lines(text)?;
        let records = errors::after_a_second(RATE)?;
        let program = |size: &Line<'a>| -> Result<_, Box<dyn Error>> {
            let [_, system, method, scalar] = size.of;
            let step = lines.iter().find(|line| line.kind == "step" && line.of == size.of);
            let error = records.iter().find(|r| [r.system, r.method, r.scalar] == [system, method, scalar]);
            let (Some(step), Some(&Record { error, .. })) = (step, error) else {
                return Err(format!("no measurement of a step of {:?}", size.of).into());
            };
            let ([code, rodata, data, zeroed, vectors], [instructions, stack]) =
                (&size.numbers[..], &step.numbers[..])
            else {
                return Err(format!("five sizes and two figures of a step of {:?}", size.of).into());
            };
            Ok(Program {
                of: size.of,
                code: *code,
                constants: rodata + data,
                fixed: data + zeroed,
                vectors: *vectors,
                instructions: *instructions,
                stack: *stack,
                error,
            })
        };
        let sizes = lines.iter().filter(|line| line.kind == "size");
        sizes.map(program).collect::<Result<_, _>>().map(Self)
    }

    /// Everything, and errors by the length of the step.
    pub fn whole(&self) -> Result<String, Box<dyn Error>> {
        let mut text = String::new();
        let mut last = None;
        for program in &self.0 {
            let [target, system, method, scalar] = program.of;
            if last != Some((target, scalar)) {
                last = Some((target, scalar));
                let _ = write!(
                    text,
                    "\n### `{scalar}` on `{target}`\n\nThe vector table, not counted, has {} bytes.\n\n\
                     | system | method | flash: code | constants | RAM: static | stack | instructions a step | error |\n\
                     | --- | --- | --- | --- | --- | --- | --- | --- |\n",
                    program.vectors
                );
            }
            let Program { code, constants, fixed, stack, instructions, error, .. } = program;
            let _ = writeln!(
                text,
                "| {system} | {method} | {code} | {constants} | {fixed} | {stack} | {instructions} | {error:.1e} |"
            );
        }
        let _ = write!(text, "\n### Errors by the length of the step\n\n{}", errors()?);
        Ok(text)
    }

    /// A line for each system and method in `f32`.
    pub fn summary(&self) -> String {
        let mut text = String::from(
            "\n| system | method | M4F: flash | stack | instructions a step | M0: flash | stack | instructions a step | error |\n\
             | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        );
        for program in self.0.iter().filter(|program| program.of[0] == FPU && program.of[3] == "f32") {
            let [_, system, method, scalar] = program.of;
            let costs = |program: &Program<'_>| {
                let Program { code, constants, stack, instructions, .. } = program;
                format!("{} | {stack} | {instructions}", code + constants)
            };
            let soft =
                self.0.iter().find(|other| other.of[0] != FPU && other.of[1..] == [system, method, scalar]);
            let soft = soft.map_or("| |".to_owned(), costs);
            let _ = writeln!(
                text,
                "| {system} | {method} | {} | {soft} | {:.1e} |",
                costs(program),
                program.error
            );
        }
        text
    }
}

/// Errors after one second by steps of several lengths; those of the jet of order 6 also as a share of those
/// of RK4.
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

/// Replaces the figures between the marks in a file.
pub fn write(path: &str, figures: &str) -> Result<(), Box<dyn Error>> {
    let [begin, end] = MARKS;
    let text = std::fs::read_to_string(path)?;
    let (before, rest) = text.split_once(begin).ok_or("the file has no mark where figures begin")?;
    let (_, after) = rest.split_once(end).ok_or("the file has no mark where figures end")?;
    std::fs::write(path, format!("{before}{begin}\n{figures}\n{end}{after}"))?;
    Ok(())
}

//! Contacts, dry friction and kinks: time against error, beside peers.
//!
//! Siconos and MuJoCo model contacts, and step over events. For heyoka and SciPy the modes are written and
//! switched by hand. References are closed forms, quadratures and series by mpmath.

mod page;
mod systems;

use std::error::Error;
use std::path::Path;

use lagrangian::prelude::*;

use crate::precision::server::Server;
use crate::precision::subject::{Function, Outcome, Subject, median};
use crate::precision::{Effort, Plan, series};
use crate::problem::{Problem, chosen};
use crate::record::{self, Record};
use systems as s;

/// The cases in the order of the page.
const CASES: [&str; 9] = ["ball", "wall", "coulomb", "belt", "block", "hoop", "slope", "bilinear", "valley"];

/// The tolerances of every other subject, relative and absolute alike: one more than those of `precision`,
/// since the best errors lie beside the last one.
const TOLERANCES: [f64; 13] =
    [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 2e-15, 1e-15];

/// The lengths of steps [s] of the peers that model contacts.
const STEPS: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// A run that takes longer [s] is not repeated, and no finer one follows it.
const SLOW: f64 = 2.0;

/// The library on a description with contacts, and on modes by hand where those are another description.
const OURS: &str = "jets";
const BY_HAND: &str = "jets-by-hand";

/// The subjects that reach the last digits. Errors are chance there, so theirs are medians over all starts.
const PRECISE: [&str; 3] = [OURS, BY_HAND, "heyoka"];

/// Measures all cases or one. All of them are written to the page.
pub fn run(system: Option<&str>, json: Option<&Path>, effort: Effort) -> Result<(), Box<dyn Error>> {
    let problems = chosen(include_str!("../../nonsmooth.json"), CASES.into_iter(), system)?;
    let servers = [
        ("heyoka, SciPy, MuJoCo", Server::of("python3", "peers/peers.py", "nonsmooth")),
        ("Siconos", Server::of("/usr/bin/python3", "peers/nonsmooth/serve.py", "serve")),
    ];
    let mut running = Vec::new();
    for (peers, server) in servers {
        match server {
            Ok(server) => running.push(server),
            Err(cause) => eprintln!("benchmarks: {peers} are left out: {cause}"),
        }
    }
    let mut records = Vec::new();
    for problem in &problems {
        let mut subjects = vec![ours(problem)];
        subjects.extend(by_hand(problem));
        for peer in running.iter().flat_map(|server| server.subjects(problem.name)) {
            // Subjects that both Pythons have take part once.
            if subjects.iter().all(|subject| subject.name() != peer.name()) {
                subjects.push(peer);
            }
        }
        let plan = Plan { benchmark: "nonsmooth", setting, slow: SLOW };
        let first = records.len();
        series(problem, &mut subjects, &plan, effort, &mut records);
        for record in records[first..].iter_mut().filter(|record| PRECISE.contains(&&*record.subject)) {
            record.error = typical(problem, &mut subjects, record)?;
        }
    }
    if let Some(path) = json {
        record::write(&records, path)?;
    }
    let mut versions: Vec<String> = running
        .iter()
        .flat_map(|server| server.versions())
        .map(|(name, version)| format!("{name} {version}"))
        .collect();
    versions.dedup();
    let page = page::of(&records, &versions);
    if system.is_some() {
        println!("{page}");
        return Ok(());
    }
    Ok(std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("NONSMOOTH.md"), page)?)
}

/// The median of the errors from all starts.
fn typical(
    problem: &Problem,
    subjects: &mut [Box<dyn Subject>],
    record: &Record,
) -> Result<f64, Box<dyn Error>> {
    let mut errors = vec![record.error];
    for other in problem.others() {
        let sample = match &*record.subject {
            OURS => ours(&other).sample(&other, record.tolerance, 0.0)?,
            BY_HAND => by_hand(&other).ok_or("no modes by hand")?.sample(&other, record.tolerance, 0.0)?,
            name => {
                let peer = subjects.iter_mut().find(|peer| peer.name() == name).ok_or("no such peer")?;
                peer.sample(&other, record.tolerance, 0.0)?
            }
        };
        errors.push(sample.error);
    }
    Ok(median(errors))
}

/// The setting of a subject: a tolerance or the length of a step.
fn setting(subject: &str, place: usize) -> Option<f64> {
    let all: &[f64] = if ["siconos", "mujoco"].contains(&subject) { &STEPS } else { &TOLERANCES };
    all.get(place).copied()
}

/// The library on a case.
fn ours(problem: &Problem) -> Box<dyn Subject> {
    let t_end = problem.t_end;
    macro_rules! motion {
        ($system:expr, $start:expr, |$end:ident| $state:expr) => {{
            let start = $start;
            let run = move |tolerance| {
                let system = $system;
                let mut motion = system.simulate(start).with_tolerance(tolerance);
                motion.advance_to(t_end).map_err(|error| error.to_string())?;
                let $end = *motion.state();
                Ok(Outcome { end: $state, steps: motion.steps().accepted })
            };
            Box::new(Function { name: OURS, trajectories: 1, run }) as Box<dyn Subject>
        }};
    }
    let line = || State::new([problem.start[0]], [problem.start[1]]);
    let (angle, speed) = (problem.start[0], problem.start[1]);
    match problem.name {
        "ball" => motion!(s::Ball, line(), |end| end.iter().collect()),
        "wall" => motion!(s::Wall, line(), |end| end.iter().collect()),
        "coulomb" => motion!(s::Coulomb, line(), |end| end.iter().collect()),
        "belt" => motion!(s::Belt { speed }, line(), |end| end.iter().collect()),
        "bilinear" => motion!(s::Bilinear, line(), |end| end.iter().collect()),
        "valley" => motion!(s::Valley, line(), |end| end.iter().collect()),
        "block" => motion!(s::Block, s::Block::tilted(angle), |end| vec![-end.q[2], -end.v[2]]),
        "hoop" => {
            let start = State::at_rest([0.5 * angle.sin(), -0.5 * angle.cos()]);
            motion!(s::Hoop, start, |end| {
                let ([x, y], [u, w]) = (end.q, end.v);
                vec![x.atan2(-y), (x * w - y * u) / (x * x + y * y)]
            })
        }
        _ => motion!(s::Slope, State::new([0.0; 2], [0.0, 2.0]), |end| end.iter().collect()),
    }
}

/// The library on the modes that the peers without contacts integrate.
fn by_hand(problem: &Problem) -> Option<Box<dyn Subject>> {
    let (t_end, start) = (problem.t_end, State::new([problem.start[0]], [problem.start[1]]));
    match problem.name {
        "block" => {
            let run = move |tolerance| {
                let mut motion = s::BlockByHand.simulate(start).with_tolerance(tolerance);
                // To the left for the peers, then to the right.
                let mut side = 1.0;
                while motion.advance_to_switch(t_end).map_err(|error| error.to_string())?.is_some() {
                    side = -side;
                }
                let end = motion.state().iter().map(|x| side * x).collect();
                Ok(Outcome { end, steps: motion.steps().accepted })
            };
            Some(Box::new(Function { name: BY_HAND, trajectories: 1, run }))
        }
        "hoop" => {
            let run = move |tolerance| {
                let mut motion = s::HoopByHand.simulate(start).with_tolerance(tolerance);
                motion.advance_to(t_end).map_err(|error| error.to_string())?;
                Ok(Outcome { end: motion.state().iter().collect(), steps: motion.steps().accepted })
            };
            Some(Box::new(Function { name: BY_HAND, trajectories: 1, run }))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The descriptions are the systems that the references belong to.
    #[test]
    fn descriptions_reach_the_references() {
        let problems = chosen(include_str!("../../nonsmooth.json"), CASES.into_iter(), None);
        let problems = problems.expect("the table of references");
        for problem in problems.iter().flat_map(|first| std::iter::once(first.clone()).chain(first.others()))
        {
            for mut subject in std::iter::once(ours(&problem)).chain(by_hand(&problem)) {
                let sample = subject.sample(&problem, 1e-12, 0.0).expect("a motion");
                assert!(sample.error < 1e-8, "{} by {}: {:e}", problem.name, subject.name(), sample.error);
            }
        }
    }
}

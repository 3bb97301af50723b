//! Studies of many motions: motions a second beside heyoka, threads, and the overhead of the library.
//!
//! All times are processor time, so that other processes on the machine disturb them little. They slow the
//! caches and the other half of a core, and taking turns spreads that over all subjects.

mod costs;
mod page;
mod peer;
mod systems;

use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use lagrangian::ensemble::{Ensemble, Row, Study};
use lagrangian::prelude::*;
use lagrangian::wide::{f64x4, f64x8};
use lagrangian::{DoubleDouble, Lanes};
use rustix::time::{ClockId, clock_gettime};

use crate::record::{self, Record};
use peer::Peer;
use systems as s;

/// The systems in the order of the page.
const SYSTEMS: [&str; 5] = ["dpend", "cart", "kepler", "nlink5", "slider"];

/// The tolerances of every subject.
const TOLERANCES: [f64; 10] = [1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15];

/// The tolerance at which threads are measured.
const THREADS_AT: f64 = 1e-9;

/// The number of motions for it: several parts for each thread, in lanes, too.
const ON_THREADS: u64 = 4096;

/// How much is measured.
#[derive(Clone, Copy)]
pub struct Extent {
    /// Motions of a study.
    motions: u64,
    /// Motions whose errors are known.
    checked: u64,
    /// Times that the subjects take turns.
    rounds: usize,
}

impl Extent {
    pub const FULL: Self = Self { motions: 1000, checked: 200, rounds: 3 };
    pub const QUICK: Self = Self { motions: 200, checked: 50, rounds: 1 };
}

/// Our subjects: one motion after the other, and several in lanes.
const OURS: [&str; 3] = ["alone", "lanes4", "lanes8"];

/// The coordinates and velocities at the end of each motion.
type Ends = Vec<Vec<f64>>;

/// A study of so many motions with one of our subjects, at a tolerance, on so many threads: processor time
/// and time on the clock [s], and the ends.
type Run = Box<dyn Fn(&str, f64, u64, usize) -> Result<(f64, f64, Ends), String>>;

/// A study.
struct Case {
    name: &'static str,
    t_end: f64,
    starts: Ends,
    /// The ends of the first motions, in 31 digits.
    truth: Ends,
    run: Run,
}

/// Measures all systems or one. All of them are written to the page.
pub fn run(system: Option<&str>, json: Option<&Path>, extent: Extent) -> Result<(), Box<dyn Error>> {
    // Memory comes first: that of everything else would hide it.
    let memory = costs::memory()?;
    let mut peer = match Peer::start() {
        Ok(peer) => Some(peer),
        Err(cause) => {
            eprintln!("benchmarks: heyoka is left out: {cause}");
            None
        }
    };
    let (mut records, mut threads) = (Vec::new(), Vec::new());
    for name in SYSTEMS.into_iter().filter(|name| system.is_none_or(|wanted| wanted == *name)) {
        let case = case(name, extent);
        measure(&case, peer.as_mut(), extent, &mut records);
        for subject in OURS {
            threads.extend(on_threads(&case, subject, extent).map(|cost| (name, subject, cost)));
        }
    }
    if let Some(path) = json {
        record::write(&records, path)?;
    }
    let versions = peer.as_ref().map(|peer| peer.versions.clone()).unwrap_or_default();
    let page = page::of(&records, &threads, &memory, &costs::overhead()?, &versions, extent);
    if system.is_some() {
        println!("{page}");
        return Ok(());
    }
    Ok(std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("MANY.md"), page)?)
}

/// Processor time of this process [s].
fn processor_time() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    Duration::new(now.tv_sec.unsigned_abs(), u32::try_from(now.tv_nsec).unwrap_or(0)).as_secs_f64()
}

/// A study of ours.
fn case(name: &'static str, extent: Extent) -> Case {
    macro_rules! case {
        ($start:expr, $t_end:expr) => {
            case!($start, $t_end, |index| precise(&$start(index).1))
        };
        ($start:expr, $t_end:expr, $precise:expr) => {{
            let truth = (0..extent.checked).map(|index| {
                let number = DoubleDouble::from_f64;
                let system = $start(index).0.over(|x, _| number(x));
                let start: State<DoubleDouble, _> = $precise(index);
                let mut motion = system.simulate(start).with_tolerance(number(1e-20));
                let end = motion.advance_to(number($t_end)).expect("the motion goes on");
                end.q.iter().chain(&end.v).map(|x| x.high()).collect()
            });
            let run: Run = Box::new(move |subject, tolerance, motions, threads| {
                let ensemble = || Ensemble::new(motions, $start).with_tolerance(tolerance);
                match subject {
                    "lanes4" => {
                        timed(&ensemble().in_lanes::<Lanes<f64x4>>().ends(name, $t_end).with_threads(threads))
                    }
                    "lanes8" => {
                        timed(&ensemble().in_lanes::<Lanes<f64x8>>().ends(name, $t_end).with_threads(threads))
                    }
                    _ => timed(&ensemble().ends(name, $t_end).with_threads(threads)),
                }
            });
            Case {
                name,
                t_end: $t_end,
                starts: (0..extent.motions).map(|index| flat(&$start(index).1)).collect(),
                truth: truth.collect(),
                run,
            }
        }};
    }
    match name {
        "dpend" => case!(s::double, 10.0),
        "cart" => case!(s::cart, 10.0),
        "kepler" => case!(s::kepler, 60.0),
        "nlink5" => case!(s::five, 5.0),
        _ => case!(s::slider, 5.0, s::crank::<DoubleDouble>),
    }
}

/// The same state in 31 digits.
fn precise<const N: usize>(state: &State<f64, N>) -> State<DoubleDouble, N> {
    let number = DoubleDouble::from_f64;
    State { t: number(state.t), q: state.q.map(number), v: state.v.map(number) }
}

/// Coordinates and velocities.
fn flat<const N: usize>(state: &State<f64, N>) -> Vec<f64> {
    [state.q, state.v].concat()
}

/// Processor time and time on the clock of a study [s], and its ends.
fn timed<F: Row<State<f64, N>>, const N: usize>(
    study: &Study<F, State<f64, N>>,
) -> Result<(f64, f64, Ends), String> {
    let (clock, begin) = (Instant::now(), processor_time());
    let table = black_box(study.run()).map_err(|error| error.to_string())?;
    let (processor, clock) = (processor_time() - begin, clock.elapsed().as_secs_f64());
    let rows = table.to_vec().map_err(|error| error.to_string())?;
    let ends: Result<Ends, _> = rows.into_iter().map(|row| row.map(|end| flat(&end))).collect();
    Ok((processor, clock, ends.map_err(|failure| failure.to_string())?))
}

/// The error that nine of ten motions do not exceed.
fn error(case: &Case, ends: &Ends) -> f64 {
    let mut errors: Vec<f64> = case
        .truth
        .iter()
        .zip(ends)
        .map(|(truth, end)| {
            let apart = truth.iter().zip(end).map(|(truth, y)| (y - truth).abs() / truth.abs().max(1.0));
            // `f64::max` would hide NaN.
            apart.fold(0.0, |worst: f64, error| if error.is_nan() || error > worst { error } else { worst })
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    errors.get(errors.len() * 9 / 10).copied().unwrap_or(f64::NAN)
}

/// All subjects at all tolerances, in turn: where the machine's speed changes within seconds, each run has
/// its chance of the fast ones.
fn measure(case: &Case, mut peer: Option<&mut Peer>, extent: Extent, records: &mut Vec<Record>) {
    let mut subjects: Vec<String> = OURS.map(str::to_owned).into();
    subjects.extend(peer.iter().flat_map(|peer| peer.subjects(case.name)));
    let runs = TOLERANCES.into_iter().flat_map(|tolerance| subjects.iter().map(move |of| (of, tolerance)));
    let mut runs: Vec<_> = runs.map(|(of, at)| (of, at, None::<(f64, f64)>)).collect();
    for _ in 0..extent.rounds {
        for (subject, tolerance, best) in &mut runs {
            let outcome = match (&mut peer, peer::asked(subject)) {
                (Some(peer), Some(asked)) => peer.ask(case.name, asked, *tolerance, &case.starts, case.t_end),
                _ => (case.run)(subject, *tolerance, extent.motions, 1)
                    .map(|(seconds, _, ends)| (seconds, ends)),
            };
            match outcome {
                Ok((seconds, ends)) => {
                    let least = best.map_or(seconds, |(least, _)| seconds.min(least));
                    *best = Some((least, error(case, &ends)));
                }
                Err(cause) => eprintln!("{} by {subject} at {tolerance:e}: {cause}", case.name),
            }
        }
    }
    for (subject, tolerance, best) in runs {
        let Some((seconds, error)) = best else { continue };
        let us = seconds / extent.motions as f64 * 1e6;
        println!("{:<8} {subject:<26} {tolerance:.0e}  error {error:.1e}  {us:9.1} µs", case.name);
        records.push(Record {
            benchmark: "many".to_owned(),
            system: case.name.to_owned(),
            subject: subject.clone(),
            tolerance,
            error,
            us,
            steps: 0,
        });
    }
}

/// Two threads against one: the ratio of their processor times, and how many times as fast two are by the
/// clock.
fn on_threads(case: &Case, subject: &str, extent: Extent) -> Option<[f64; 2]> {
    let mut best = [[f64::INFINITY; 2]; 2];
    for _ in 0..4 * extent.rounds {
        for (best, threads) in best.iter_mut().zip([1, 2]) {
            let (processor, clock, _) = (case.run)(subject, THREADS_AT, ON_THREADS, threads).ok()?;
            *best = [best[0].min(processor), best[1].min(clock)];
        }
    }
    let [one, two] = best;
    Some([two[0] / one[0], one[1] / two[1]])
}

//! Robots from URDF files: generated accelerations and their derivatives beside those of Pinocchio.
//!
//! `peers/robots/robots.py` brings Pinocchio and the files, `cargo-lagrange import` makes a description of
//! each, and `package.rs` a package of each description, built apart. All programs answer the same requests
//! (`program.rs`), so that they can be compared on the same states and timed in turn.

mod motions;
mod package;
mod program;
mod states;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::native;
use crate::precision::subject::median;
use package::{Built, Packages};
use program::Program;
use states::{Order, States};

/// The largest error of ours, relative to the largest value of a state. Accelerations are compared with
/// Pinocchio, derivatives with ours in 31 digits.
const AGREEMENT: f64 = 1e-13;
/// The largest distance of Pinocchio's derivatives from those in 31 digits. A larger one would mean another
/// robot.
const SAME: f64 = 1e-11;
/// Coordinates up to which derivatives are built without `--full`.
const QUICKLY_BUILT: usize = 20;
const SECONDS: f64 = 0.02;

/// The offer of the script in Python.
#[derive(Deserialize)]
struct Offer {
    program: PathBuf,
    versions: std::collections::BTreeMap<String, String>,
    systems: Vec<Robot>,
}

/// The coordinates of a base that floats.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Base {
    /// Three shifts and three angles.
    Angles,
    /// A pose.
    Pose,
}

/// A robot as Pinocchio has it.
#[derive(Deserialize)]
pub struct Robot {
    name: String,
    urdf: PathBuf,
    base: Option<Base>,
    model: PathBuf,
    coordinates: Vec<String>,
}

/// One record of the JSON file.
#[derive(Serialize)]
struct Record {
    benchmark: &'static str,
    system: String,
    subject: String,
    /// Time of an evaluation.
    ns: f64,
    /// The largest error, relative to the largest value of a state: the distance of ours from Pinocchio or,
    /// for derivatives, of either from ours in 31 digits.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<f64>,
    /// The time of expansion and compilation, if they were done in this run [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    build: Option<f64>,
}

/// Which derivatives are wanted, and how often all subjects take turns.
#[derive(Clone, Copy)]
pub struct Extent {
    /// Builds the derivatives of large robots too, which takes minutes.
    pub full: bool,
    /// Repeats less.
    pub quick: bool,
}

impl Extent {
    fn rounds(self) -> usize {
        if self.quick { 5 } else { 25 }
    }
}

/// A quantity that is evaluated, with the names of our subject and of those of Pinocchio.
struct Task {
    /// The word of requests.
    what: &'static str,
    ours: &'static str,
    peers: &'static [&'static str],
}

impl Task {
    fn is_of_derivatives(&self) -> bool {
        self.what == "derivatives"
    }
}

const TASKS: [Task; 2] = [
    Task { what: "accelerations", ours: "generated", peers: &["pinocchio-aba", "pinocchio-aba-world"] },
    Task { what: "derivatives", ours: "generated-derivatives", peers: &["pinocchio-derivatives"] },
];

/// Measures all robots, or the one that is named.
pub fn run(only: Option<&str>, json: Option<&Path>, extent: Extent) -> Result<(), Box<dyn Error>> {
    let folder = native::target().join("robots");
    let offer = prepare(&folder)?;
    let chosen: Vec<&Robot> =
        offer.systems.iter().filter(|robot| only.is_none_or(|only| only == robot.name)).collect();
    if chosen.is_empty() {
        let names: Vec<&str> = offer.systems.iter().map(|robot| robot.name.as_str()).collect();
        return Err(format!("no such robot; there are {}", names.join(", ")).into());
    }
    let packages = Packages::new(&folder)?;
    let mut records = Vec::new();
    let mut failures = Vec::new();
    let versions: Vec<String> =
        offer.versions.iter().map(|(name, version)| format!("{name} {version}")).collect();
    println!("{}", versions.join(", "));
    println!(
        "{:15} {:22} {:>10} {:>10} {:>8} {:>8}",
        "system", "subject", "ns", "/ Pinocchio", "error", "build s"
    );
    // Everything is built before anything is timed, on all cores.
    let mut built = Vec::new();
    let both = motions::both(&offer.systems, &chosen, extent);
    for robot in chosen.iter().copied() {
        for task in &TASKS {
            if task.is_of_derivatives() && !extent.full && robot.coordinates.len() > QUICKLY_BUILT {
                continue;
            }
            match packages.build(robot, task.what) {
                Ok(package) => built.push((robot, task, package)),
                Err(error) => failures.push(format!("{} of {}: {error}", task.ours, robot.name)),
            }
        }
    }
    let both: Vec<_> = both
        .into_iter()
        .filter_map(|robots| match motions::build(&packages, robots) {
            Ok(built) => Some((robots, built)),
            Err(error) => {
                failures.push(format!("motions of {}: {error}", robots[1].name));
                None
            }
        })
        .collect();
    native::pin();
    for (robots, built) in &both {
        match motions::measure(*robots, built, &folder, extent) {
            Ok(measured) => records.extend(measured),
            Err(error) => failures.push(format!("motions of {}: {error}", robots[1].name)),
        }
    }
    for (robot, task, package) in built {
        match measure(&offer, robot, task, &package, &folder, extent) {
            Ok(measured) => {
                show(&measured, task);
                records.extend(measured);
            }
            Err(error) => failures.push(format!("{} of {}: {error}", task.ours, robot.name)),
        }
    }
    if let Some(path) = json {
        std::fs::write(path, serde_json::to_string_pretty(&records)?)?;
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
}

/// Installs and compiles Pinocchio.
fn prepare(folder: &Path) -> Result<Offer, Box<dyn Error>> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/robots/robots.py");
    let output = Command::new("python3")
        .arg(script)
        .arg(folder.join("pinocchio"))
        .stderr(std::process::Stdio::inherit())
        .output()
        .map_err(|error| format!("python3 does not start: {error}"))?;
    if !output.status.success() {
        return Err("Pinocchio could not be installed".into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// Compares the values, then times all in turn.
fn measure(
    offer: &Offer,
    robot: &Robot,
    task: &Task,
    package: &Built,
    folder: &Path,
    extent: Extent,
) -> Result<Vec<Record>, Box<dyn Error>> {
    let states = States::random(robot);
    let files = [("ours", "states of the description"), ("theirs", "states of Pinocchio")];
    let [ours, theirs] = files.map(|(name, _)| folder.join(format!("states-{name}.txt")));
    // The names come first; the states are written in their order.
    states.write(&Order::same(robot), true, &theirs)?;
    states.write(&Order::same(robot), false, &ours)?;
    let names = Program::start(&package.program, &[&ours])?.words("names")?;
    let order = Order::of(robot, &names)?;
    states.write(&order, false, &ours)?;
    let mut generated = Program::start(&package.program, &[&ours])?;
    let mut pinocchio = Program::start(&offer.program, &[&robot.model, &theirs])?;
    let request = format!("evaluate {}", task.what);
    let (found, of_peer) = (generated.numbers(&request)?, pinocchio.numbers(&request)?);
    let errors = if task.is_of_derivatives() {
        let exact = generated.numbers(&format!("refer {}", task.what))?;
        let peer = order.apart(&exact, &of_peer, true)?;
        [Some(Order::same(robot).apart(&found, &exact, true)?), Some(peer)]
    } else {
        [Some(order.apart(&found, &of_peer, false)?), None]
    };
    for (error, bound) in errors.iter().flatten().zip([AGREEMENT, SAME]) {
        if error.is_nan() || *error > bound {
            return Err(format!("errors of {errors:?}, of which the first is ours").into());
        }
    }
    let mut times = vec![Vec::new(); 1 + task.peers.len()];
    for _ in 0..extent.rounds() {
        for (place, times) in times.iter_mut().enumerate() {
            let time = match place.checked_sub(1) {
                None => generated.time(task.ours, SECONDS)?,
                Some(peer) => pinocchio.time(task.peers[peer], SECONDS)?,
            };
            times.push(time);
        }
    }
    let subjects = std::iter::once(&task.ours).chain(task.peers);
    let records = subjects.zip(times).enumerate().map(|(place, (subject, times))| Record {
        benchmark: "robots",
        system: robot.name.clone(),
        subject: (*subject).to_owned(),
        ns: median(times),
        error: errors.get(place).copied().flatten(),
        build: if place == 0 { package.seconds } else { None },
    });
    Ok(records.collect())
}

fn show(measured: &[Record], task: &Task) {
    let best =
        measured.iter().filter(|r| r.subject != task.ours).fold(f64::INFINITY, |best, r| best.min(r.ns));
    for record in measured {
        println!(
            "{:15} {:22} {:10.1} {:11.3} {:>8} {:>8}",
            record.system,
            record.subject,
            record.ns,
            record.ns / best,
            record.error.map_or(String::new(), |error| format!("{error:.0e}")),
            record.build.map_or(String::new(), |seconds| format!("{seconds:.1}"))
        );
    }
}

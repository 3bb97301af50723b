//! A pose as the base beside three shifts and three angles: the same motions of the same robot, timed in
//! turn.

use std::error::Error;
use std::path::Path;

use super::package::{Built, Packages};
use super::program::Program;
use super::states::{Order, States};
use super::{Base, Extent, QUICKLY_BUILT, Record, Robot, SECONDS};
use crate::precision::subject::median;

/// The largest distance of places and joints of both [m, rad], at an error of 1e-12 a step.
const AGREEMENT: f64 = 1e-8;
const SUBJECTS: [&str; 3] = ["accelerations-in-turn", "steps", "motion"];

/// The chosen robots with a pose, each with the same robot with angles before it.
pub fn both<'a>(all: &'a [Robot], chosen: &[&'a Robot], extent: Extent) -> Vec<[&'a Robot; 2]> {
    let poses = chosen.iter().copied().filter(|robot| robot.base == Some(Base::Pose));
    let pairs = poses.filter_map(|pose| {
        let same = |robot: &&Robot| robot.base == Some(Base::Angles) && robot.urdf == pose.urdf;
        all.iter().find(same).map(|angles| [angles, pose])
    });
    pairs.filter(|[_, pose]| extent.full || pose.coordinates.len() <= QUICKLY_BUILT).collect()
}

/// Their programs.
pub fn build(packages: &Packages, robots: [&Robot; 2]) -> Result<[Built; 2], Box<dyn Error>> {
    let [angles, pose] = robots.map(|robot| packages.build(robot, "motions"));
    Ok([angles?, pose?])
}

/// Compares the ends of their motions, then times accelerations, steps and motions in turn.
pub fn measure(
    robots: [&Robot; 2],
    built: &[Built; 2],
    folder: &Path,
    extent: Extent,
) -> Result<Vec<Record>, Box<dyn Error>> {
    let [angles, pose] = [(robots[0], &built[0]), (robots[1], &built[1])].map(|one| start(one, folder));
    let mut programs = [angles?, pose?];
    let mut ends = Vec::new();
    for program in &mut programs {
        ends.push(program.numbers("evaluate motions")?);
    }
    let apart = apart(&ends[0], &ends[1], robots[0].coordinates.len())?;
    if apart.is_nan() || apart > AGREEMENT {
        return Err(format!("{apart:e} from the same motion with angles").into());
    }
    let mut times = [const { Vec::new() }; 2 * SUBJECTS.len()];
    for _ in 0..extent.rounds() {
        for (place, times) in times.iter_mut().enumerate() {
            times.push(programs[place % 2].time(SUBJECTS[place / 2], SECONDS)?);
        }
    }
    let mut records = Vec::new();
    for (subject, pair) in SUBJECTS.iter().zip(times.as_chunks::<2>().0) {
        let [of_angles, of_pose] = pair.clone().map(median);
        for (robot, ns) in robots.iter().zip([of_angles, of_pose]) {
            let (system, ratio) = (&robot.name, ns / of_angles);
            println!("{system:15} {subject:22} {ns:10.1} {ratio:11.3} {apart:>8.0e}  of that with angles");
            records.push(Record {
                benchmark: "robots",
                system: system.clone(),
                subject: (*subject).to_owned(),
                ns,
                error: None,
                build: None,
            });
        }
    }
    Ok(records)
}

/// The program of one, with its states in its order.
fn start((robot, built): (&Robot, &Built), folder: &Path) -> Result<Program, Box<dyn Error>> {
    let states = States::level(robot);
    let file = folder.join(format!("states-{}.txt", robot.name));
    states.write(&Order::same(robot), false, &file)?;
    let names = Program::start(&built.program, &[&file])?.words("names")?;
    states.write(&Order::of(robot, &names)?, false, &file)?;
    Program::start(&built.program, &[&file])
}

/// The largest distance of places and joints.
fn apart(of_angles: &[f64], of_pose: &[f64], count: usize) -> Result<f64, String> {
    if of_angles.len() != of_pose.len() || of_angles.is_empty() {
        return Err(format!("{} and {} values", of_angles.len(), of_pose.len()));
    }
    let mut worst = 0.0_f64;
    for (index, (a, b)) in of_angles.iter().zip(of_pose).enumerate() {
        // The three numbers of the orientation differ by design.
        let apart = if (3..6).contains(&(index % count)) { 0.0 } else { (a - b).abs() };
        if apart.is_nan() || apart > worst {
            worst = apart;
        }
    }
    Ok(worst)
}

//! Random states of a robot, and the orders in which two programs have its coordinates.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use super::Robot;
use crate::rhs::uniform;

const STATES: usize = 100;

/// Coordinates, velocities and torques in the order of Pinocchio.
pub struct States {
    rows: Vec<[Vec<f64>; 3]>,
    /// Coordinates of the base, on which no torque acts.
    base: usize,
}

impl States {
    /// The same in every run.
    pub fn random(robot: &Robot) -> Self {
        let (count, base) = (robot.coordinates.len(), if robot.base.is_some() { 6 } else { 0 });
        let mut next = uniform();
        let mut row = |size: f64| (0..count).map(|_| size * next()).collect::<Vec<f64>>();
        let rows = (0..STATES).map(|_| {
            let (q, v, mut torques) = (row(1.2), row(2.0), row(5.0));
            torques[..base].fill(0.0);
            [q, v, torques]
        });
        Self { rows: rows.collect(), base }
    }

    /// The same states with a level base. They are the same motions whatever coordinates describe the base:
    /// its three numbers are zero there, and their rates are the components of the angular velocity, here all
    /// equal.
    pub fn level(robot: &Robot) -> Self {
        let mut states = Self::random(robot);
        for [q, v, torques] in &mut states.rows {
            if let (Some(turn), Some(rates)) = (q.get_mut(3..states.base), v.get_mut(3..states.base)) {
                turn.fill(0.0);
                let rate = rates[0];
                rates.fill(rate);
            }
            torques.fill(0.0);
        }
        states
    }

    /// Writes them in an order, with torques on the base or without.
    pub fn write(&self, order: &Order, with_base: bool, path: &Path) -> Result<(), Box<dyn Error>> {
        let mut text = format!("{}\n", self.rows.len());
        for row in &self.rows {
            for (kind, entries) in row.iter().enumerate() {
                let absent = if kind == 2 && !with_base { self.base } else { 0 };
                for &place in order.places.iter().filter(|place| **place >= absent) {
                    write!(text, "{:?} ", entries[place])?;
                }
            }
            text.push('\n');
        }
        Ok(std::fs::write(path, text)?)
    }
}

/// For each coordinate of a description, its place in Pinocchio's model.
pub struct Order {
    places: Vec<usize>,
}

impl Order {
    /// Pinocchio's own.
    pub fn same(robot: &Robot) -> Self {
        Self { places: (0..robot.coordinates.len()).collect() }
    }

    /// The order of a description, whose names are those of the file as identifiers.
    pub fn of(robot: &Robot, names: &[String]) -> Result<Self, Box<dyn Error>> {
        let places: Result<Vec<usize>, String> = names
            .iter()
            .map(|name| {
                let same = |other: &&String| plain(other) == plain(name);
                let mut found = robot.coordinates.iter().filter(same);
                match (found.next(), found.next()) {
                    (Some(one), None) => Ok(robot.coordinates.iter().position(|c| c == one).unwrap_or(0)),
                    _ => Err(format!("the coordinate {name} is none, or more than one, of Pinocchio's")),
                }
            })
            .collect();
        let places = places?;
        let mut sorted = places.clone();
        sorted.sort_unstable();
        if sorted != Self::same(robot).places {
            return Err(format!("{} coordinates instead of {}", names.len(), robot.coordinates.len()).into());
        }
        Ok(Self { places })
    }

    /// The largest distance relative to the largest value of a state, of vectors or of pairs of matrices.
    pub fn apart(&self, ours: &[f64], theirs: &[f64], matrices: bool) -> Result<f64, String> {
        let n = self.places.len();
        let size = if matrices { n * n } else { n };
        let blocks = if matrices { 2 * STATES } else { STATES };
        if ours.len() != blocks * size || theirs.len() != blocks * size {
            return Err(format!("{} and {} values instead of {}", ours.len(), theirs.len(), blocks * size));
        }
        let mut worst = 0.0_f64;
        for (ours, theirs) in ours.chunks(size).zip(theirs.chunks(size)) {
            let scale = theirs.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
            for (index, value) in ours.iter().enumerate() {
                let place = if matrices {
                    self.places[index / n] * n + self.places[index % n]
                } else {
                    self.places[index]
                };
                let apart = (value - theirs[place]).abs() / scale;
                // `f64::max` would hide NaN.
                if apart.is_nan() || apart > worst {
                    worst = apart;
                }
            }
        }
        Ok(worst)
    }
}

/// A name without the characters that identifiers lack.
fn plain(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphanumeric).map(|letter| letter.to_ascii_lowercase()).collect()
}

//! [`Problem`]: a system with its start, the time to stop and the true state there.

use std::collections::BTreeMap;
use std::error::Error;

use serde::Deserialize;

/// The systems in the order of all reports: those of free coordinates …
const FREE: [&str; 12] = [
    "dpend", "spring", "hh", "kepler", "pleiades", "top", "sph", "cart", "nlink3", "nlink5", "nlink10",
    "nlink20",
];
/// … and those with constraints.
pub const CONSTRAINED: [&str; 4] = ["pendc", "slider", "andrews", "caraxis"];

/// All systems.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    FREE.into_iter().chain(CONSTRAINED)
}

/// The start of a motion and the state that it has to reach; states are (q, v).
#[derive(Clone, Debug, Deserialize)]
pub struct Problem {
    #[serde(skip)]
    pub name: &'static str,
    /// Zero for the first start, the place among the others from one on.
    #[serde(skip)]
    pub place: usize,
    pub t_end: f64,
    pub start: Vec<f64>,
    pub end: Vec<f64>,
    /// Motions from other starts.
    #[serde(default)]
    pub others: Vec<Motion>,
}

/// Another motion of the same system.
#[derive(Clone, Debug, Deserialize)]
pub struct Motion {
    pub start: Vec<f64>,
    pub end: Vec<f64>,
}

impl Problem {
    /// Largest deviation of a coordinate or velocity at the end, relative where the true one is above one;
    /// that of the worst where several trajectories were found.
    pub fn error(&self, found: &[f64]) -> f64 {
        assert!(!found.is_empty() && found.len().is_multiple_of(self.end.len()), "{}", self.name);
        let deviations =
            found.iter().zip(self.end.iter().cycle()).map(|(y, end)| (y - end).abs() / end.abs().max(1.0));
        // `f64::max` would hide NaN.
        deviations.fold(0.0, |worst, error| if error.is_nan() || error > worst { error } else { worst })
    }

    /// The same system from its other starts.
    pub fn others(&self) -> impl Iterator<Item = Self> {
        self.others.iter().zip(1..).map(|(Motion { start, end }, place)| Self {
            place,
            start: start.clone(),
            end: end.clone(),
            others: Vec::new(),
            ..*self
        })
    }

    /// Coordinates and velocities at the start.
    pub fn start<const N: usize>(&self) -> ([f64; N], [f64; N]) {
        let (q, v) = self.start.split_at(N);
        (q.try_into().expect("N coordinates"), v.try_into().expect("N velocities"))
    }
}

/// All problems, or the one that is named. The peers in Python read the same file.
pub fn problems(only: Option<&str>) -> Result<Vec<Problem>, Box<dyn Error>> {
    chosen(include_str!("../references.json"), names(), only)
}

/// Those of a file, by these names, or the one that is named.
pub fn chosen(
    file: &str,
    names: impl Iterator<Item = &'static str> + Clone,
    only: Option<&str>,
) -> Result<Vec<Problem>, Box<dyn Error>> {
    let mut known: BTreeMap<String, Problem> = serde_json::from_str(file)?;
    let chosen: Vec<Problem> = names
        .clone()
        .filter(|name| only.is_none_or(|only| only == *name))
        .filter_map(|name| known.remove(name).map(|problem| Problem { name, ..problem }))
        .collect();
    if chosen.is_empty() {
        return Err(format!("no such system; there are {}", names.collect::<Vec<_>>().join(", ")).into());
    }
    Ok(chosen)
}

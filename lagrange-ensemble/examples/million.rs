//! A million double pendulums in lanes, in a folder: what a larger study takes, before it is begun.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=native" cargo run --release -p lagrange-ensemble --example million -- FOLDER [MOTIONS]
//! ```
//!
//! Killed and run again, it goes on. It leaves `FOLDER/pendulums.npy`, a row a motion.

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use lagrange_ensemble::{Ensemble, Grid};
use lagrangian::Lanes;
use lagrangian::prelude::*;
use lagrangian::wide::f64x4;

/// Two equal masses on rods of equal lengths.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Gravitational acceleration over the length of a rod \[1/s²].
    pub stiffness: f64,
}

#[lagrangian(coordinates = [theta: [2]], jacobians)]
impl DoublePendulum {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.stiffness * (self.upper(q).y + self.lower(q).y)
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let folder = PathBuf::from(words.next().ok_or("million FOLDER [MOTIONS]")?);
    let motions = words.next().map_or(Ok(1_000_000), |word| word.parse::<u64>())?;
    let side = motions.isqrt();
    let grid = Grid::new([(-3.0, 3.0, side), (-3.0, 3.0, side)])?;
    let begin = Instant::now();
    let study = Ensemble::new(grid.count(), |index| {
        (DoublePendulum { stiffness: 9.81 }, State::at_rest(grid.middle(index)))
    })
    .with_tolerance(1e-9)
    .in_lanes::<Lanes<f64x4>>()
    .ends("pendulums", 10.0)
    .with_key(format!("{grid:?}"))
    .with_progress()
    .in_folder(&folder);
    let Some(table) = study.run()? else { return Ok(()) };
    table.write(folder.join("pendulums.npy"))?;
    println!(
        "{} motions, {:.0} a second in this run",
        grid.count(),
        grid.count() as f64 / begin.elapsed().as_secs_f64()
    );
    Ok(())
}

//! A study for `mpirun`: `mpirun -n 4 target/release/examples/pendulums FOLDER [MOTIONS] [SECONDS]`.

use std::error::Error;
use std::path::PathBuf;

use lagrangian::ensemble::{Ensemble, Grid};
use lagrangian::prelude::*;

/// Two equal masses on rods of equal lengths.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Gravitational acceleration over the length of a rod \[1/s²].
    pub stiffness: f64,
}

#[lagrangian(coordinates = [theta: [2]])]
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
    let folder = PathBuf::from(words.next().ok_or("pendulums FOLDER [MOTIONS] [SECONDS]")?);
    let side = (words.next().map_or(Ok(2500.0), |word| word.parse::<f64>())?).sqrt() as u64;
    let until = words.next().map_or(Ok(10.0), |word| word.parse::<f64>())?;
    let grid = Grid::new([(-3.0, 3.0, side), (-3.0, 3.0, side)])?;
    let start = |index| (DoublePendulum { stiffness: 9.81 }, State::at_rest(grid.middle(index)));
    let study = Ensemble::new(grid.count(), start)
        .with_tolerance(1e-9)
        .ends("pendulums", until)
        .with_key(format!("{grid:?}"))
        .with_threads(1)
        .with_progress()
        .in_folder(&folder);
    if let Some(table) = lagrange_mpi::run(&study)? {
        table.write(folder.join("pendulums.npy"))?;
    }
    Ok(())
}

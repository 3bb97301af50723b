//! When does a double pendulum first flip over? A map over all starts at rest, one motion a pixel.
//!
//! ```sh
//! cargo run --release --features ensemble --example flip_times -- --width 1536 --height 1024 --out flips
//! ```
//!
//! It shows its progress, takes all cores, goes on where it was if it is killed, and leaves
//! `flip_times.npy` and `flip_times.png`. With `--part 1/3`, `--part 2/3`, `--part 3/3`, on one machine or on
//! several with a common folder, whoever ends last leaves the same bytes.

use std::error::Error;
use std::f64::consts::PI;

use lagrangian::ensemble::{Ensemble, Grid};
use lagrangian::prelude::*;

#[path = "support/study.rs"]
mod study;

/// Two equal point masses on massless rods of equal lengths.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Gravitational acceleration over the length of a rod \[1/s²].
    pub stiffness: f64,
}

#[lagrangian(coordinates = [theta: [2]])]
impl DoublePendulum {
    /// Both angles are measured from the downward vertical.
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

/// How long to look \[s].
const UNTIL: f64 = 20.0;

/// Maps the first flip of each start.
pub fn main() -> Result<(), Box<dyn Error>> {
    let options = study::Options::from_command_line("flip_times", 24, 16)?;
    // Rows are angles of the lower rod, columns of the upper one.
    let grid = Grid::new([(-PI, PI, options.height), (-PI, PI, options.width)])?;
    let start = |index| {
        let [lower, upper] = grid.middle(index);
        (DoublePendulum { stiffness: 9.81 }, State::at_rest([upper, lower]))
    };
    let flips = Ensemble::new(grid.count(), start)
        .with_tolerance(1e-9)
        .study("flip_times", |motion| {
            // A rod points upward where the cosine of half its angle is zero.
            let upward = [0, 1].map(|rod| move |state: &State<f64, 2>| (0.5 * state.q[rod]).cos());
            let flip = motion.advance_to_event_of(upward, UNTIL)?;
            Ok(flip.map(|event| event.state.t))
        })
        .with_columns(["flip_time"])
        .with_key(format!("{grid:?}, until {UNTIL}"))
        .with_threads(options.threads)
        .with_progress()
        .in_folder(&options.out);
    let flips = match options.part {
        Some((k, n)) => flips.part(k, n)?,
        None => flips,
    };
    let Some(table) = flips.run()? else {
        println!("this part is done, others are not");
        return Ok(());
    };
    let table = table.shaped(&grid.shape())?;
    table.write(options.out.join("flip_times.npy"))?;

    let (mut pixels, mut flipped, mut wrong) = (Vec::new(), 0, None);
    table.each(|index, result| {
        let [lower, upper] = grid.middle(index);
        // Too little energy to lift the lower rod over the upper one, whatever happens.
        let bound = 2.0 * upper.cos() + lower.cos() > 1.0;
        match result {
            Ok(Some(t)) => {
                flipped += 1;
                if bound {
                    wrong = Some(format!("motion {index} flips at {t} without the energy for it"));
                }
                // From a twentieth of the time to all of it, in equal ratios.
                pixels.push(study::colour(1.0 - (t / UNTIL * 20.0).max(1.0).ln() / 20.0_f64.ln()));
            }
            Ok(None) if bound => pixels.push([255; 3]),
            Ok(None) => pixels.push([0; 3]),
            Err(failure) => wrong = Some(format!("motion {index}: {failure}")),
        }
    })?;
    if let Some(wrong) = wrong {
        return Err(wrong.into());
    }
    study::save(&options.out.join("flip_times.png"), options.width, &pixels)?;
    println!("{flipped} of {} pendulums flip within {UNTIL} s", grid.count());
    assert!(flipped > 0 && flipped < grid.count(), "{flipped} flips");
    Ok(())
}

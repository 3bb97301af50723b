//! Over which of three magnets does a pendulum with friction come to rest? Its basins of attraction, one
//! motion a pixel; options as for `flip_times`.

use std::error::Error;
use std::f64::consts::TAU;

use lagrangian::ensemble::{Ensemble, Failure, Grid};
use lagrangian::prelude::*;

#[path = "support/study.rs"]
mod study;

/// A bob on a long thread over three magnets. The thread is so long that the bob moves in a horizontal plane;
/// the magnets lie in another one below.
#[derive(Clone, Copy, Debug)]
pub struct MagneticPendulum {
    /// Gravity over the length of the thread \[1/s²].
    pub stiffness: f64,
    /// Friction \[1/s].
    pub friction: f64,
    /// Strength of a magnet \[m³/s²].
    pub strength: f64,
    /// Height of the bob over the plane of the magnets \[m].
    pub height: f64,
    /// Where the magnets are \[m].
    pub magnets: [[f64; 2]; 3],
}

#[lagrangian(coordinates = [x, y])]
impl MagneticPendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * self.bob(q).norm_squared()
    }

    #[potential]
    fn attraction(&self, q: &Coordinates) -> f64 {
        let [a, b, c] = self.magnets;
        [a, b, c]
            .iter()
            .map(|magnet| {
                let [x, y] = *magnet;
                -self.strength / ((q.x - x).powi(2) + (q.y - y).powi(2) + self.height.powi(2)).sqrt()
            })
            .sum()
    }

    #[dissipation]
    fn air(&self, v: &Velocities) -> f64 {
        0.5 * self.friction * (v.x.powi(2) + v.y.powi(2))
    }
}

/// Maps where each start ends, and how long that takes.
pub fn main() -> Result<(), Box<dyn Error>> {
    let options = study::Options::from_command_line("magnetic_basins", 24, 24)?;
    let pendulum = MagneticPendulum {
        stiffness: 0.5,
        friction: 0.2,
        strength: 1.0,
        height: 0.3,
        magnets: [0.0, 1.0, 2.0].map(|k: f64| [(TAU * k / 3.0).cos(), (TAU * k / 3.0).sin()]),
    };
    // Energy only falls. Once it is below that of every pass between two magnets, the bob stays with one.
    let energy = |x: f64, y: f64| pendulum.energy(&State::at_rest([x, y]));
    // By symmetry a pass lies opposite to each magnet, on the line from it through the centre. Along this
    // line the energy is lowest in the pass.
    let pass = (1..2000).map(|k| energy(-1e-3 * f64::from(k), 0.0)).fold(f64::INFINITY, f64::min);

    let grid = Grid::new([(-2.0, 2.0, options.height), (-2.0, 2.0, options.width)])?;
    let start = |index| {
        let [y, x] = grid.middle(index);
        (pendulum, State::at_rest([x, y]))
    };
    let basins = Ensemble::new(grid.count(), start)
        .with_tolerance(1e-9)
        .study("magnetic_basins", |motion| {
            let mut caught = None;
            for state in motion.every(0.25).take(40_000) {
                let state = state?;
                if pendulum.energy(&state) < pass {
                    caught = Some(state);
                    break;
                }
            }
            let State { t, q, .. } = caught.ok_or_else(|| Failure::new("not caught after 10 000 s"))?;
            let far = |[x, y]: [f64; 2]| (q[0] - x).hypot(q[1] - y);
            let nearest = (0..3_u8).min_by(|a, b| {
                let [a, b] = [a, b].map(|k| far(pendulum.magnets[usize::from(*k)]));
                a.total_cmp(&b)
            });
            Ok((nearest.unwrap_or_default(), t))
        })
        .with_columns(["magnet", "time"])
        .with_key(format!("{pendulum:?}, {grid:?}"))
        .with_threads(options.threads)
        .with_progress()
        .in_folder(&options.out);
    let basins = match options.part {
        Some((k, n)) => basins.part(k, n)?,
        None => basins,
    };
    let Some(table) = basins.run()? else {
        println!("this part is done, others are not");
        return Ok(());
    };
    let table = table.shaped(&grid.shape())?;
    table.write(options.out.join("magnetic_basins.npy"))?;

    let (mut pixels, mut sizes, mut failed) = (Vec::new(), [0_u64; 3], None);
    table.each(|index, result| match result {
        Ok((magnet, time)) => {
            let magnet = usize::from(magnet).min(2);
            sizes[magnet] += 1;
            let colour: [f64; 3] = [[240.0, 200.0, 70.0], [0.0, 140.0, 190.0], [210.0, 70.0, 40.0]][magnet];
            let light = 1.0 / (1.0 + time / 30.0);
            pixels.push(colour.map(|part| (part * light).round() as u8));
        }
        Err(failure) => failed = Some(format!("motion {index}: {failure}")),
    })?;
    if let Some(failed) = failed {
        return Err(failed.into());
    }
    study::save(&options.out.join("magnetic_basins.png"), options.width, &pixels)?;
    println!("the basins have {sizes:?} of {} starts", grid.count());
    // The second and the third magnet are mirror images of each other.
    let odd = sizes[1].abs_diff(sizes[2]);
    assert!(odd as f64 <= 0.02 * grid.count() as f64, "{sizes:?} are not those of a mirror image");
    assert!(sizes.iter().all(|size| 5 * size > grid.count()), "{sizes:?}");
    Ok(())
}

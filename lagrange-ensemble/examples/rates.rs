//! Motions a second, and what the library costs above the motions themselves:
//! `cargo run --release -p lagrange-ensemble --example rates`.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use lagrange_ensemble::{Ensemble, Failure, Record, Study};
use lagrangian::prelude::*;

/// `LINKS` equal masses on rods of length 1.
macro_rules! chain {
    ($name:ident, $links:literal) => {
        #[derive(Clone, Copy)]
        struct $name {
            g: f64,
        }

        #[lagrangian(coordinates = [theta: [$links]])]
        impl $name {
            #[point(mass = 1.0)]
            fn joints(&self, q: &Coordinates) -> [Vector2<f64>; $links] {
                let mut end = Vector2::zeros();
                q.theta.map(|theta| {
                    end += Vector2::new(theta.sin(), -theta.cos());
                    end
                })
            }

            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 {
                self.joints(q).iter().map(|joint| self.g * joint.y).sum()
            }
        }
    };
}

chain!(Double, 2);
chain!(Five, 5);

#[derive(Clone, Copy)]
struct CartPole {
    g: f64,
}

#[lagrangian(coordinates = [x, theta])]
impl CartPole {
    #[point(mass = 1.0)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = 0.2)]
    fn tip(&self, q: &Coordinates) -> Vector2<f64> {
        self.cart(q) + 0.5 * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.2 * self.g * self.tip(q).y
    }
}

#[derive(Clone, Copy)]
struct Kepler {
    mu: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Kepler {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.mu / self.planet(q).norm()
    }
}

/// A crank and a rocker with a coupler of fixed length between their tips.
#[derive(Clone, Copy)]
struct FourBar {
    g: f64,
}

#[lagrangian(coordinates = [crank, rocker])]
impl FourBar {
    #[point(mass = 1.0)]
    fn crank_tip(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.crank.cos(), q.crank.sin())
    }

    #[point(mass = 2.0)]
    fn rocker_tip(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(4.0 + 3.0 * q.rocker.cos(), 3.0 * q.rocker.sin())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.crank_tip(q).y + 2.0 * self.rocker_tip(q).y)
    }

    #[holonomic]
    fn coupler(&self, q: &Coordinates) -> f64 {
        (self.rocker_tip(q) - self.crank_tip(q)).norm() - 3.5
    }
}

/// Rates with one thread and with two, several times in turn, the best of each: others use the machine.
fn rates<F, T>(study: impl Fn() -> Study<F, T>) -> Result<[f64; 2], Box<dyn Error>>
where
    F: Fn(u64) -> Result<T, Failure> + Sync,
    T: Record,
{
    let mut best = [0.0_f64; 2];
    for _ in 0..5 {
        for (rate, threads) in best.iter_mut().zip([1, 2]) {
            let study = study().with_threads(threads);
            let begin = Instant::now();
            black_box(study.run()?);
            *rate = rate.max(study.count() as f64 / begin.elapsed().as_secs_f64());
        }
    }
    Ok(best)
}

fn main() -> Result<(), Box<dyn Error>> {
    let spread = |index: u64| (index as f64 * 0.618_033_988_749_894_9).fract();
    println!("| motions of 10 s | tolerance | one thread [1/s] | two threads [1/s] | ratio |");
    println!("| --- | --- | --- | --- | --- |");
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let line = |name: &str, [one, two]: [f64; 2]| {
            println!("| {name} | {tolerance:.0e} | {one:.0} | {two:.0} | {:.2} |", two / one);
        };
        macro_rules! measure {
            ($name:literal, $start:expr) => {
                line(
                    $name,
                    rates(|| Ensemble::new(2000, $start).with_tolerance(tolerance).ends("rates", 10.0))?,
                )
            };
        }
        measure!("double pendulum", |i| (Double { g: 9.81 }, State::at_rest([0.5 + spread(i), 1.0])));
        measure!("cart-pole", |i| (CartPole { g: 9.81 }, State::at_rest([0.0, 0.5 + 2.0 * spread(i)])));
        measure!("Kepler, e from 0 to 0.6", |i| {
            let speed = (1.0 - 0.6 * spread(i)).sqrt();
            (Kepler { mu: 1.0 }, State::new([1.0, 0.0], [0.0, speed]))
        });
        measure!("five links", |i| (Five { g: 9.81 }, State::at_rest([0.2 + 0.5 * spread(i); 5])));
        measure!("four-bar, one constraint", |i| {
            let bar = FourBar { g: 9.81 };
            let start = bar.consistent(State::new([0.3 + 0.2 * spread(i), 2.0], [0.0, 0.0]));
            start.map(|start| (bar, start))
        });
    }

    // Rows that take 20 µs and need nothing of the library, in a plain loop and as studies.
    let count = 100_000;
    let work = |index: u64| {
        let mut x = index as f64;
        for _ in 0..1600 {
            x = (x + 1.0).sqrt();
        }
        x
    };
    let folder = std::env::temp_dir().join(format!("lagrange-rates-{}", std::process::id()));
    let (mut alone, mut memory, mut stored) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
    for _ in 0..7 {
        let begin = Instant::now();
        for index in 0..count {
            black_box(work(index));
        }
        alone = alone.min(begin.elapsed().as_secs_f64());
        let study = || Study::new("work", count, |index| Ok(work(index))).with_threads(1);
        let begin = Instant::now();
        black_box(study().run()?);
        memory = memory.min(begin.elapsed().as_secs_f64());
        let begin = Instant::now();
        black_box(study().in_folder(&folder).run()?);
        stored = stored.min(begin.elapsed().as_secs_f64());
        std::fs::remove_dir_all(&folder)?;
    }
    println!(
        "\n{count} rows of {:.1} µs in one thread: in memory {:+.2} %, in a folder {:+.2} % beside a plain loop",
        alone / count as f64 * 1e6,
        100.0 * (memory / alone - 1.0),
        100.0 * (stored / alone - 1.0)
    );
    Ok(())
}

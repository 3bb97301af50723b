//! P03: the Pleiades problem, seven stars in a plane with close encounters.

use lagrangian::prelude::*;

use super::{CLOSED_FORM, MEDIUM};
use crate::support::close::{all_close, between, close};
use crate::support::motion::{TIGHT, drift, follows};
use crate::support::reference::published;
use crate::support::sample::Samples;

/// Positions of particles; pairs by nested loops.
struct ByPoints {
    masses: [f64; 7],
}

#[lagrangian(coordinates = [x: [7], y: [7]])]
impl ByPoints {
    const COUNT: usize = 7;

    #[point(mass = self.masses[..])]
    fn stars(&self, q: &Coordinates) -> [Vector2<f64>; Self::COUNT] {
        let mut stars = [Vector2::zeros(); Self::COUNT];
        for i in 0..Self::COUNT {
            stars[i] = Vector2::new(q.x[i], q.y[i]);
        }
        stars
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let stars = self.stars(q);
        let mut sum = 0.0;
        for i in 0..Self::COUNT {
            for j in 0..i {
                sum -= self.masses[i] * self.masses[j] / (stars[i] - stars[j]).norm();
            }
        }
        sum
    }
}

/// T and V as sums over iterators; the masses are constants of the description.
struct ByEnergies;

#[lagrangian(coordinates = [x: [7], y: [7]])]
impl ByEnergies {
    const MASSES: [f64; 7] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let squares = v.x.iter().zip(v.y.iter()).map(|(vx, vy)| vx * vx + vy * vy);
        squares.zip(Self::MASSES).map(|(square, mass)| 0.5 * mass * square).sum()
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        (0..7).flat_map(|i| (0..i).map(move |j| -self.pair(q, i, j))).sum()
    }

    fn pair(&self, q: &Coordinates, i: usize, j: usize) -> f64 {
        Self::MASSES[i] * Self::MASSES[j] / (q.x[i] - q.x[j]).hypot(q.y[i] - q.y[j])
    }
}

/// The whole Lagrangian; the plane is given as one array of coordinates.
struct ByLagrangian {
    masses: [f64; 7],
}

#[lagrangian(coordinates = [r: [14]])]
impl ByLagrangian {
    fn place(coordinates: &[f64; 14], i: usize) -> Vector2<f64> {
        Vector2::new(coordinates[i], coordinates[7 + i])
    }

    #[lagrangian]
    fn gravitation(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let m: [f64; 7] = self.masses;
        let mut total = 0.0;
        for (i, mass) in m.iter().enumerate() {
            total += 0.5 * mass * Self::place(&v.r, i).norm_squared();
            for j in (i + 1)..7 {
                total += mass * m[j] / (Self::place(&q.r, i) - Self::place(&q.r, j)).norm_squared().sqrt();
            }
        }
        total
    }
}

const MASSES: [f64; 7] = ByEnergies::MASSES;
const POINTS: ByPoints = ByPoints { masses: MASSES };
const LAGRANGIAN: ByLagrangian = ByLagrangian { masses: MASSES };

fn start() -> State<f64, 14> {
    let x = [3.0, 3.0, -1.0, -3.0, 2.0, -2.0, 2.0];
    let y = [3.0, -3.0, 2.0, 0.0, 0.0, -4.0, 4.0];
    let vx = [0.0, 0.0, 0.0, 0.0, 0.0, 1.75, -1.5];
    let vy = [0.0, 0.0, 0.0, -1.25, 1.0, 0.0, 0.0];
    let join =
        |x: [f64; 7], y: [f64; 7]| std::array::from_fn::<f64, 14, _>(|i| if i < 7 { x[i] } else { y[i - 7] });
    State::new(join(x, y), join(vx, vy))
}

fn end() -> (f64, [f64; 28]) {
    let reference = published("pleiades");
    let parts = ["x", "y", "vx", "vy"].map(|key| reference.numbers::<7>(key));
    (3.0, std::array::from_fn(|i| parts[i / 7][i % 7]))
}

#[test]
fn the_states_agree_in_all_forms() {
    follows(&POINTS, start(), [end()], MEDIUM);
    follows(&ByEnergies, start(), [end()], MEDIUM);
    follows(&LAGRANGIAN, start(), [end()], MEDIUM);
}

#[test]
fn energy_momentum_and_angular_momentum_stay() {
    let run = |quantity: &dyn Fn(&State<f64, 14>) -> f64| {
        let mut motion = POINTS.simulate(start()).with_tolerance(TIGHT);
        drift(&mut motion, 0.1, 30, quantity)
    };
    // Both energies are of the size of 100.
    between(-1.0, run(&|s| POINTS.energy(s)), 1e-10);
    between(-1.0, run(&|s| POINTS.momenta(s)[..7].iter().sum()), 1e-11);
    let angular = |s: &State<f64, 14>| {
        let p = POINTS.momenta(s);
        (0..7).map(|i| s.q[i] * p[7 + i] - s.q[7 + i] * p[i]).sum()
    };
    between(-1.0, run(&angular), 1e-10);
}

#[test]
fn all_forms_are_the_same_system() {
    let mut samples = Samples::new(3);
    for _ in 0..5 {
        let state = samples.state(-3.0, 3.0);
        let found = POINTS.accelerations(&state).unwrap();
        all_close(found, ByEnergies.accelerations(&state).unwrap(), CLOSED_FORM);
        all_close(found, LAGRANGIAN.accelerations(&state).unwrap(), CLOSED_FORM);
        close(POINTS.energy(&state), ByEnergies.energy(&state), CLOSED_FORM);
        close(POINTS.energy(&state), LAGRANGIAN.energy(&state), CLOSED_FORM);
        all_close(POINTS.momenta(&state), LAGRANGIAN.momenta(&state), CLOSED_FORM);
    }
}

//! Contacts that move, and bodies on several of them: a ball on a vibrating table, a rocking block.

use lagrangian::Dual;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close_on_largest, close, close_on};
use crate::support::difference::derivative;

/// A ball on a table that moves up and down.
struct Table {
    amplitude: f64,
    restitution: f64,
}

const RATE: f64 = 12.0;

#[lagrangian(coordinates = [y], sensitivities = [self.amplitude])]
impl Table {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(0.0, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral(restitution = self.restitution)]
    fn table(&self, q: &Coordinates, t: f64) -> f64 {
        q.y - self.amplitude * (RATE * t).sin()
    }
}

#[test]
fn the_multipliers_of_a_ball_on_a_vibrating_table_are_those_of_its_impact() {
    // Period one: thrown upwards with g T / 2 it comes back after T with the same speed downwards. The impact
    // is v⁺ = −e v⁻ + (1 + e) ẇ, so the table has the speed ẇ = g T (1 − e) / (2 (1 + e)).
    let (e, g) = (0.6, 9.81);
    let period = std::f64::consts::TAU / RATE;
    let rise = g * period * (1.0 - e) / (2.0 * (1.0 + e));
    for amplitude in [0.06, 0.08, 0.1] {
        let phase = (rise / (amplitude * RATE)).acos();
        let impact = phase / RATE;
        let height = amplitude * phase.sin();
        let (half, speed) = (0.5 * period, 0.5 * g * period);
        // At the highest point.
        let top = height + speed * half - 0.5 * g * half * half;
        let table = Table { amplitude, restitution: e };
        let start = State { t: impact + half, q: [top], v: [0.0] };
        let found = table.variational().monodromy(start, period).unwrap();
        close_on(top, found.transition.state.q[0], top, 1e-12);
        // M = Φ(T/2) S Φ(T/2), Φ = [1 t; 0 1], S = [−e 0; s −e], s = −(1 + e)(g + ẅ) / (v⁻ − ẇ).
        let bends = -amplitude * RATE * RATE * phase.sin();
        let s = (1.0 + e) * (g + bends) / (speed + rise);
        let (trace, determinant) = (period * s - 2.0 * e, e * e);
        let (sum, product) = match found.multipliers[..] {
            [a, b] => ((a + b).re, (a * b).re),
            _ => panic!("two multipliers"),
        };
        close_on(1.0, sum, trace, 1e-11);
        close(product, determinant, 1e-11);
    }
}

#[test]
fn a_body_leaves_a_table_with_the_derivatives_of_its_flight() {
    let (amplitude, g) = (0.1, 9.81);
    let table = Table { amplitude, restitution: 0.0 };
    let varied = table.variational();
    let mut motion = varied.motion(State::new([0.0], [amplitude * RATE])).unwrap().with_tolerance(TIGHT);
    let t = 0.2;
    let found = motion.advance_to(t).unwrap();
    let amplitude = Dual::<f64, 1>::variable(amplitude, 0);
    let rate = Dual::constant(RATE);
    // It leaves where the table falls as fast as it does.
    let leaves = (Dual::constant(g) / (amplitude * rate * rate)).asin() / rate;
    let (sin, cos) = (rate * leaves).sin_cos();
    let s = Dual::constant(t) - leaves;
    let y = amplitude * sin + amplitude * rate * cos * s - Dual::constant(0.5 * g) * s * s;
    close(found.state.q[0], y.value, 1e-13);
    close(found.q_by_p[0], y.slopes[0], 1e-12);
    // On the table it moves as the table does, whatever the start.
    assert_eq!([found.q_by_q[0], found.q_by_v[0]], [0.0; 2]);
}

/// A block that rocks on its corners: N06.
struct Block {
    half_width: f64,
}

#[lagrangian(coordinates = [x, y, theta], sensitivities = [self.half_width])]
impl Block {
    #[body(mass = 1.0, inertia = (self.half_width.powi(2) + 0.25) / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.theta)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn corners(&self, q: &Coordinates) -> [f64; 2] {
        [-1.0, 1.0].map(|side| q.y + side * self.half_width * q.theta.sin() - 0.5 * q.theta.cos())
    }

    #[friction(coefficient = 10.0, normal = corners)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        [-1.0, 1.0].map(|side| v.x - (q.theta.sin() * side * self.half_width - q.theta.cos() * 0.5) * v.theta)
    }
}

/// A block tilted about its right corner.
fn tilted(angle: f64, half_width: f64) -> State<f64, 3> {
    let (sin, cos) = angle.sin_cos();
    State::at_rest([-(cos * half_width - sin * 0.5), sin * half_width + cos * 0.5, -angle])
}

#[test]
fn a_rocking_block_has_the_derivatives_of_differences() {
    let (angle, half_width) = (0.23, 0.2);
    // Before, between and after the impacts.
    for t in [0.3, 0.6, 1.1, 1.4] {
        let run = |angle: f64, half_width: f64| {
            let block = Block { half_width };
            let mut motion = block.simulate(tilted(angle, half_width)).with_tolerance(TIGHT);
            let end = *motion.advance_to(t).unwrap();
            [end.q, end.v].concat().try_into().unwrap()
        };
        let block = Block { half_width };
        let varied = block.variational();
        let mut motion = varied.motion(tilted(angle, half_width)).unwrap().with_tolerance(TIGHT);
        let found = motion.advance_to(t).unwrap();
        // The changes of the start with the angle and with the width, along which it stays in contact.
        let start = |f: &dyn Fn(f64) -> State<f64, 3>| derivative(1e-3, |by| f(by).q);
        let by_angle = start(&|by| tilted(angle + by, half_width));
        let by_width = start(&|by| tilted(angle, half_width + by));
        let along =
            |start: &[f64; 3], row: usize| (0..3).map(|i| found.entry(row, i) * start[i]).sum::<f64>();
        let differences: [f64; 6] = derivative(1e-3, |by| run(angle + by, half_width));
        let columns: [f64; 6] = std::array::from_fn(|row| along(&by_angle, row));
        all_close_on_largest(columns, differences, 1e-8);
        let differences: [f64; 6] = derivative(5e-4, |by| run(angle, half_width + by));
        let by_p = |row: usize| if row < 3 { found.q_by_p[(row, 0)] } else { found.v_by_p[(row - 3, 0)] };
        let columns: [f64; 6] = std::array::from_fn(|row| along(&by_width, row) + by_p(row));
        all_close_on_largest(columns, differences, 1e-8);
    }
}

/// A block that stands on two feet of one coefficient, on a table that moves to and fro.
struct Standing {
    friction: f64,
    rate: f64,
}

const TO_AND_FRO: f64 = 0.08;

#[lagrangian(coordinates = [x, y, phi], sensitivities = [self.friction])]
impl Standing {
    #[body(mass = 1.0, inertia = 0.1 / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    fn feet(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [-0.3, 0.3].map(|x| Rotation2::new(q.phi) * Vector2::new(x, -0.1))
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> [f64; 2] {
        self.feet(q).map(|foot| q.y + foot.y)
    }

    #[friction(coefficient = self.friction, normal = floor)]
    fn slip(&self, q: &Coordinates, v: &Velocities, t: f64) -> [f64; 2] {
        let table = TO_AND_FRO * self.rate * (self.rate * t).cos();
        self.feet(q).map(|foot| v.x - foot.y * v.phi - table)
    }
}

#[test]
fn feet_that_let_go_together_have_derivatives() {
    for k in 0..20 {
        let standing = Standing { friction: 0.2, rate: 6.0 + 0.15 * f64::from(k) };
        let speed = TO_AND_FRO * standing.rate;
        let lets_go = (0.2 * 9.81 / (speed * standing.rate)).asin() / standing.rate;
        let start = State::new([0.0, 0.1, 0.0], [speed, 0.0, 0.0]);
        let varied = standing.variational();
        let mut motion = varied.motion(start).unwrap().with_tolerance(1e-12);
        let found = motion.advance_to(lets_go + 0.05).unwrap();
        // Its velocity is that of the table until it lets go, and then falls by μ g. The time at which it lets
        // go does not count: the acceleration does not jump there.
        close_on(1.0, found.v_by_p[(0, 0)], -9.81 * 0.05, 1e-8);
        close_on(1.0, found.v_by_v[(0, 0)], 0.0, 1e-8);
    }
}

//! Gaps with kinks: a body leaves a convex edge, strikes a concave one, and bounces out of a corner.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close_on};
use crate::support::sample::Samples;

/// A particle over a floor of a description.
macro_rules! over {
    ($name:ident, ($($argument:tt)*) => $gap:expr) => {
        struct $name {
            restitution: f64,
        }

        #[lagrangian(coordinates = [x, y])]
        impl $name {
            #[point(mass = 1.0)]
            fn particle(&self, q: &Coordinates) -> Vector2<f64> {
                Vector2::new(q.x, q.y)
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                q.y
            }

            #[unilateral(restitution = self.restitution)]
            fn floor(&self, $($argument)*) -> f64 {
                $gap
            }
        }
    };
}

over!(ByMax, (q: &Coordinates) => q.y + 0.5 * (q.x - 1.0).max(0.0));
over!(ByAbs, (q: &Coordinates) => q.y + 0.25 * ((q.x - 1.0).abs() + q.x - 1.0));
over!(ByTwo, (q: &Coordinates) => q.y.max(q.y + 0.5 * (q.x - 1.0)));
over!(ByIf, (q: &Coordinates) => if q.x < 1.0 { q.y } else { q.y + 0.5 * (q.x - 1.0) });
over!(Ramp, (q: &Coordinates) => q.y - 0.5 * (q.x - 1.0).max(0.0));
over!(Falling, (q: &Coordinates, t: f64) => q.y + 0.5 * (t - 1.0).max(0.0));
over!(Rising, (q: &Coordinates, t: f64) => q.y - 0.5 * (t - 1.0).max(0.0));

#[test]
fn a_body_leaves_a_convex_edge() {
    for number in 0..64 {
        let speed = 0.3 + 0.047 * f64::from(number);
        let restitution = 0.5 * f64::from(number % 3);
        // Gravity bends the flight less than the slope falls.
        let flight = 0.5 * speed;
        macro_rules! check {
            ($($system:ident),*) => {$({
                let system = $system { restitution };
                let mut motion = system.simulate(State::new([0.0, 0.0], [speed, 0.0]));
                let state = *motion.advance_to(1.0 / speed + flight).unwrap();
                all_close(state.q, [1.0 + speed * flight, -0.5 * flight * flight], 1e-12);
                all_close(state.v, [speed, -flight], 1e-12);
            })*};
        }
        check!(ByMax, ByAbs, ByTwo, ByIf);
    }
}

#[test]
fn a_body_strikes_a_concave_edge() {
    for restitution in [0.5, 1.0] {
        let ramp = Ramp { restitution };
        let state = *ramp.simulate(State::new([0.0, 0.0], [1.0, 0.0])).advance_to(1.1).unwrap();
        // The normal is (−1, 2)/√5, so the velocity against it is 1/√5.
        let normal = (1.0 + restitution) / 5.0;
        all_close(state.v, [1.0 - normal, 2.0 * normal - 0.1], 1e-14);
    }
}

#[test]
fn a_body_leaves_a_table_that_begins_to_fall_and_is_struck_by_one_that_rises() {
    let start = State::at_rest([0.0, 0.0]);
    for restitution in [0.0, 0.5, 1.0] {
        let state = *Falling { restitution }.simulate(start).advance_to(1.2).unwrap();
        all_close([state.q[1], state.v[1]], [-0.02, -0.2], 1e-12);
        let state = *Rising { restitution }.simulate(start).advance_to(1.2).unwrap();
        let weight = if restitution == 0.0 { 0.0 } else { 0.2 };
        close_on(1.0, state.v[1], 0.5 * (1.0 + restitution) - weight, 1e-14);
    }
}

/// A box of one gap: the nearest wall.
struct Walls;

#[lagrangian(coordinates = [x, y])]
impl Walls {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[unilateral(restitution = 1.0)]
    fn walls(&self, q: &Coordinates) -> f64 {
        1.0 - q.x.abs().max(q.y.abs())
    }
}

#[test]
fn a_corner_sends_back() {
    for (q, v) in [([0.1, 0.2], [0.9, 0.8]), ([0.0, 0.5], [1.0, 0.5]), ([0.25, 0.25], [0.5, 0.5])] {
        for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let [q, v] = [q, v].map(|[x, y]: [f64; 2]| [signs[0] * x, signs[1] * y]);
            let hits = (1.0 - q[0].abs()) / v[0].abs();
            let state = *Walls.simulate(State::new(q, v)).advance_to(2.0 * hits).unwrap();
            all_close(state.q, q, 1e-14);
            all_close(state.v, v.map(|v| -v), 1e-14);
        }
    }
}

/// A block on a spring that sticks more firmly than it slips.
struct Sticky;

#[lagrangian(coordinates = [x])]
impl Sticky {
    #[kinetic]
    fn motion(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.x * q.x
    }

    #[friction(limit = 0.5, static_limit = 1.0)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_body_that_is_put_at_rest_sticks_whichever_way_it_slipped() {
    for start in [2.0, -2.0] {
        let mut motion = Sticky.simulate(State::at_rest([start]));
        motion.advance_to(0.5).unwrap();
        motion.set_state(State::at_rest([0.8]).at_time(0.5));
        assert_eq!(motion.advance_to(8.0).unwrap().q, [0.8]);
    }
}

/// A particle on a rough table that ends at x = 0 with a sharp edge: the gap is a distance, which has no
/// gradient on the edge. The table is turned by an angle.
struct Sharp {
    friction: f64,
    restitution: f64,
    angle: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Sharp {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    /// Along the table and above it.
    fn place(&self, q: &Coordinates) -> [f64; 2] {
        let (c, s) = (self.angle.cos(), self.angle.sin());
        [c * q.x + s * q.y, c * q.y - s * q.x]
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.place(q)[1]
    }

    #[unilateral(restitution = self.restitution)]
    fn table(&self, q: &Coordinates) -> f64 {
        let [along, above] = self.place(q);
        if along < 0.0 {
            above
        } else if above < 0.0 {
            along
        } else {
            (along.powi(2) + above.powi(2)).sqrt()
        }
    }

    #[friction(coefficient = self.friction, normal = table)]
    fn slip(&self, v: &Velocities) -> f64 {
        self.angle.cos() * v.x + self.angle.sin() * v.y
    }
}

#[test]
fn a_body_slides_over_a_sharp_edge() {
    let mut samples = Samples::new(7);
    for number in 0..300 {
        let (friction, angle) = (samples.number(0.0, 0.5), samples.number(-0.5, 0.5));
        let angle = if number % 3 == 0 { 0.0 } else { angle };
        let sharp = Sharp { friction, restitution: 0.5 * f64::from(number % 2), angle };
        let (way, speed) = (samples.number(0.1, 1.0), samples.number(0.5, 4.0));
        let (c, s) = (angle.cos(), angle.sin());
        let turned = |along: f64, above: f64| [c * along - s * above, s * along + c * above];
        let mut motion = sharp.simulate(State::new(turned(-way, 0.0), turned(speed, 0.0)));
        let end = *motion.advance_to(1.5).unwrap_or_else(|error| panic!("{number}: {error}"));
        let slows = friction * 9.81;
        let left = speed * speed - 2.0 * slows * way;
        let expected = if left <= 0.0 {
            [speed * speed / (2.0 * slows) - way, 0.0]
        } else {
            let falls = 1.5 - 2.0 * way / (speed + left.sqrt());
            [left.sqrt() * falls, -0.5 * 9.81 * falls * falls]
        };
        all_close(end.q, turned(expected[0], expected[1]), 1e-10);
    }
}

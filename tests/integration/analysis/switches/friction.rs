//! Sticking and slipping: on a belt, a ball that begins to roll, a bead on a hoop.

use lagrangian::prelude::*;
use lagrangian::{Contact, Dual};

use super::TIGHT;
use crate::support::close::{all_close_on_largest, close_on};
use crate::support::difference::derivative;

/// N03: a block on a belt, held by a spring.
struct Belt {
    stiffness: f64,
    speed: f64,
    normal: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.stiffness, self.speed, self.normal])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * q.x * q.x
    }

    #[friction(limit = 0.3 * self.normal, static_limit = 0.5 * self.normal)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - self.speed
    }
}

/// Place and speed of a block that begins sticking.
fn carried<R: Ordered>(start: R, k: R, belt: R, normal: R, t: R) -> [R; 2] {
    let rate = k.sqrt();
    let centre = R::from_f64(0.3) * normal / k;
    let farthest = R::from_f64(0.5) * normal / k;
    let away = farthest - centre;
    let slip = R::from_f64(2.0) * (R::pi() - (away * rate / belt).atan()) / rate;
    let (mut x, mut begun) = (start, R::zero());
    loop {
        let slips = begun + (farthest - x) / belt;
        if t < slips {
            return [x + belt * (t - begun), belt];
        }
        if t < slips + slip {
            let (sin, cos) = (rate * (t - slips)).sin_cos();
            return [centre + away * cos + belt / rate * sin, belt * cos - away * rate * sin];
        }
        (x, begun) = (centre - away, slips + slip);
    }
}

#[test]
fn stick_and_slip_on_a_belt_have_the_derivatives_of_the_closed_form() {
    let belt = Belt { stiffness: 9.0, speed: 0.2, normal: 8.0 };
    let varied = belt.variational();
    let mut motion = varied.motion(State::new([0.0], [0.2])).unwrap().with_tolerance(TIGHT);
    let number = |value, direction| Dual::<f64, 4>::variable(value, direction);
    for t in [1.0, 2.5, 3.0, 4.0, 7.0, 12.0, 31.0] {
        let found = motion.advance_to(t).unwrap();
        let exact =
            carried(number(0.0, 0), number(9.0, 1), number(0.2, 2), number(8.0, 3), Dual::constant(t));
        let rows = [(found.q_by_q[0], found.q_by_p), (found.v_by_q[0], found.v_by_p)];
        for ((by_start, by_p), exact) in rows.into_iter().zip(exact) {
            // The n-th stick phase has shifted n times with a parameter, and the shifts add up. So errors
            // grow with time.
            all_close_on_largest([by_start, by_p[0], by_p[1], by_p[2]], exact.slopes, 1e-12 * (1.0 + t));
        }
        // Sticking, it has the speed of the belt, whatever it had at the start.
        assert_eq!(found.q_by_v[0], 0.0);
    }
}

/// A homogeneous ball on a rough floor: N04.
struct Bowl {
    mu: f64,
}

#[lagrangian(coordinates = [x, y, a, b], sensitivities = [self.mu])]
impl Bowl {
    /// Mass 1.5 kg; a and b are the turns about the axes of x and y, by the law of small turns, which a
    /// homogeneous ball obeys for all.
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.75 * (v.x * v.x + v.y * v.y) + 0.2 * 1.5 * 0.08 * 0.08 * (v.a * v.a + v.b * v.b)
    }

    #[friction(limit = self.mu * 1.5 * 9.81)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x - 0.08 * v.b, v.y + 0.08 * v.a)
    }
}

#[test]
fn a_ball_that_slips_and_then_rolls_forgets_its_friction() {
    let bowl = Bowl { mu: 0.3 };
    let start = State::new([0.0; 4], [2.0, -1.0, -10.0, 10.0]);
    let varied = bowl.variational();
    let mut motion = varied.motion(start).unwrap().with_tolerance(1e-12);
    // It rolls from t = 2 |u| / (7 μ g) on, with (5 v + 2 R ω × e) / 7.
    let found = motion.advance_to(1.0).unwrap();
    let roll = [5.0 / 7.0, 0.16 / 7.0];
    let by = [[roll[0], 0.0], [0.0, roll[0]], [0.0, -roll[1]], [roll[1], 0.0]];
    for (column, exact) in by.iter().enumerate() {
        let found = [found.v_by_v[(0, column)], found.v_by_v[(1, column)]];
        all_close_on_largest(found, exact, 1e-10);
    }
    close_on(1.0, found.v_by_p[(0, 0)], 0.0, 1e-10);
    // The slip costs the ball (2/7) u |u| / (7 μ g) of the way that it would have rolled: x = v_r t + u
    // t_r/7.
    let u: [f64; 2] = [2.0 - 0.8, -1.0 - 0.8];
    let rolls = 2.0 * u[0].hypot(u[1]) / (7.0 * 0.3 * 9.81);
    for (axis, u) in u.iter().enumerate() {
        close_on(1.0, found.q_by_p[(axis, 0)], -u * rolls / 7.0 / 0.3, 1e-10);
    }
}

/// A bead on a rough hoop: N11.
struct Bead {
    mu: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.mu])]
impl Bead {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[holonomic]
    fn hoop(&self, q: &Coordinates) -> f64 {
        q.x * q.x + q.y * q.y - 0.25
    }

    #[friction(coefficient = self.mu, normal = hoop)]
    fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
        2.0 * (v.y * q.x - v.x * q.y)
    }
}

#[test]
fn a_bead_stops_where_its_friction_lets_it() {
    let at = |angle: f64| State::at_rest([0.5 * angle.sin(), -0.5 * angle.cos()]);
    let (angle, mu) = (1.2, 0.2);
    let stops = |angle: f64, mu: f64| {
        let bead = Bead { mu };
        let mut motion = bead.simulate(at(angle)).with_tolerance(TIGHT);
        let end = *motion.advance_to(4.0).unwrap();
        assert_eq!(motion.contacts().slip, Contact::Sticks);
        end.q
    };
    let bead = Bead { mu };
    let found = bead.variational().motion(at(angle)).unwrap().with_tolerance(TIGHT).advance_to(4.0).unwrap();
    let by_angle = derivative(1e-3, |by| stops(angle + by, mu));
    let by_mu = derivative(1e-3, |by| stops(angle, mu + by));
    let turned = [0.5 * angle.cos(), 0.5 * angle.sin()];
    for row in 0..2 {
        let along = found.q_by_q[(row, 0)] * turned[0] + found.q_by_q[(row, 1)] * turned[1];
        close_on(1.0, along, by_angle[row], 1e-8);
        close_on(1.0, found.q_by_p[(row, 0)], by_mu[row], 1e-8);
        close_on(1.0, found.v_by_p[(row, 0)], 0.0, 1e-12);
    }
}

/// A block under a load that has an extremum, with friction that holds more than it gives.
struct Loaded {
    height: f64,
    bend: f64,
    holds: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.height])]
impl Loaded {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[force(on = x)]
    fn load(&self, t: f64) -> f64 {
        self.height + self.bend * (t - 1.0).powi(2)
    }

    #[friction(limit = 0.5, static_limit = self.holds)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_load_that_just_reaches_what_friction_holds_has_no_derivatives() {
    for (height, grazes) in [(1.0, true), (1.0 - 1e-15, true), (1.0 - 1e-9, false), (0.9, false)] {
        let block = Loaded { height, bend: -1.0, holds: 1.0 };
        let variational = block.variational();
        let mut motion = variational.motion(State::at_rest([0.0])).unwrap().with_tolerance(TIGHT);
        let found = motion.advance_to(1.5);
        if grazes {
            let error = found.unwrap_err();
            assert!(matches!(error.cause, Cause::Grazes { name, .. } if name.as_str() == "slip"), "{error}");
            close_on(1.0, error.t, 1.0, 1e-6);
        } else {
            assert_eq!(found.unwrap().q_by_p[(0, 0)], 0.0);
        }
    }
    // Where friction holds no more than it gives, a block that hardly slips goes hardly any way.
    let block = Loaded { height: 0.5, bend: -1.0, holds: 0.5 };
    let variational = block.variational();
    let mut motion = variational.motion(State::at_rest([0.0])).unwrap().with_tolerance(TIGHT);
    close_on(1.0, motion.advance_to(1.5).unwrap().q_by_p[(0, 0)], 0.0, 1e-6);
}

/// A block whose load falls short of its friction, and exceeds it from t = 1 on.
struct Slowed {
    limit: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.limit])]
impl Slowed {
    #[point(mass = 1.0)]
    fn block(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[force(on = x)]
    fn load(&self, t: f64) -> f64 {
        0.75 + 2.0 * (t - 1.0)
    }

    #[friction(limit = self.limit)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

/// Friction and load bring the slip to (t − 1)², which rests for an instant. A slower one rests for a while.
#[test]
fn a_slip_that_just_comes_to_rest_has_no_derivatives() {
    by_speed(1.0).unwrap_err();
    let passes = by_speed(1.1).unwrap();
    close_on(1.0, passes, 1.0, 1e-12);
    let rests = by_speed(0.9).unwrap();
    close_on(1.0, rests, 0.0, 1e-12);
}

/// ∂v/∂v₀ behind the slowest instant of a slip that begins with this speed.
fn by_speed(speed: f64) -> Result<f64, MotionError<f64>> {
    let block = Slowed { limit: 0.75 };
    let variational = block.variational();
    let mut motion = variational.motion(State::new([0.0], [speed]))?.with_tolerance(TIGHT);
    Ok(motion.advance_to(2.5)?.v_by_v[(0, 0)])
}

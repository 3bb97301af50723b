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

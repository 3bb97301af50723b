//! Constraints beside other ways to describe a system: a Lagrangian given as a whole, and constraints that
//! are not affine.

use lagrangian::Cause;
use lagrangian::prelude::*;

use crate::support::close::{all_close, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, both_follow, numbers, state_at};
use crate::support::sample::Samples;

const G: f64 = 9.81;

/// A charge on a sphere in a magnetic field along z, as one function.
struct Whole {
    m: f64,
    b: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Whole {
    #[lagrangian]
    fn lagrangian(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let kinetic = self.m * (v.x.powi(2) + v.y.powi(2) + v.z.powi(2)) / 2.0;
        kinetic + self.b * (q.x * v.y - q.y * v.x) / 2.0 - self.m * G * q.z
    }

    #[holonomic]
    fn sphere(&self, q: &Coordinates) -> f64 {
        (q.x.powi(2) + q.y.powi(2) + q.z.powi(2)).sqrt() - 1.0
    }
}

/// The same by parts, with the magnetic force written down.
struct Parts {
    m: f64,
    b: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Parts {
    #[point(mass = self.m)]
    fn charge(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * q.z
    }

    #[force]
    fn magnetic(&self, v: &Velocities) -> [f64; 3] {
        [self.b * v.y, -self.b * v.x, 0.0]
    }

    #[holonomic]
    fn sphere(&self, q: &Coordinates) -> f64 {
        self.charge(q).norm() - 1.0
    }
}

/// A relativistic particle on a circle: M is no constant and no quadratic form gives it.
struct Relativistic {
    m: f64,
    c: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Relativistic {
    #[lagrangian]
    fn lagrangian(&self, v: &Velocities) -> f64 {
        -self.m * self.c.powi(2) * (1.0 - (v.x.powi(2) + v.y.powi(2)) / self.c.powi(2)).sqrt()
    }

    #[holonomic]
    fn circle(&self, q: &Coordinates) -> f64 {
        (q.x.powi(2) + q.y.powi(2)).sqrt() - 2.0
    }
}

/// A particle that falls at a constant speed, by Chetaev's rule: the constraint is quadratic in the
/// velocities.
struct Constant {
    m: f64,
    speed: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Constant {
    #[point(mass = self.m)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.m * G * q.y
    }

    #[nonholonomic(chetaev)]
    fn pace(&self, v: &Velocities) -> f64 {
        v.x.powi(2) + v.y.powi(2) - self.speed.powi(2)
    }
}

#[test]
fn a_lagrangian_as_a_whole_takes_constraints() {
    let (whole, parts) = (Whole { m: 0.8, b: 2.5 }, Parts { m: 0.8, b: 2.5 });
    let start = State::new([0.6, 0.0, -0.8], [0.4, 1.5, 0.3]);
    let mut jets = whole.simulate(start).with_tolerance(TIGHT);
    let mut dop853 = whole.simulate_with::<Dop853>(start).with_tolerance(TIGHT);
    let mut other = parts.simulate(start).with_tolerance(TIGHT);
    for k in 1..=8 {
        let t = 0.5 * f64::from(k);
        let expected = numbers(other.advance_to(t).unwrap());
        all_close(numbers(jets.advance_to(t).unwrap()), &expected, 1e-11);
        all_close(numbers(dop853.advance_to(t).unwrap()), &expected, 1e-11);
        close(jets.reactions().sphere, other.reactions().sphere, 1e-10);
        close(jets.energy(), whole.energy(&start), 1e-12);
    }
    // Centripetal force, weight and magnetic force along the radius.
    let ([x, y, z], [vx, vy, vz]) = (start.q, start.v);
    let expected = -0.8 * (vx * vx + vy * vy + vz * vz) + 0.8 * G * z - 2.5 * (vy * x - vx * y);
    close(whole.reactions(&start).unwrap().sphere, expected, 1e-13);
    let states = [0.0, 0.7].map(|t| state_at(&whole, start, t));
    bound!(whole, [true]).holds(states);
    bound!(parts, [true], forces).holds(states);
}

#[test]
fn a_relativistic_particle_circles_uniformly() {
    let particle = Relativistic { m: 1.3, c: 3.0 };
    // γ = 5/4 at 3/5 of the speed of light.
    let start = State::new([2.0, 0.0], [0.0, 1.8]);
    let rows = [1.0, 5.0].map(|t| {
        let (sin, cos) = (0.9_f64 * t).sin_cos();
        (t, [2.0 * cos, 2.0 * sin, -1.8 * sin, 1.8 * cos])
    });
    both_follow(&particle, start, rows, 1e-12);
    close(particle.reactions(&start).unwrap().circle, -1.25 * 1.3 * 1.8 * 1.8 / 2.0, 1e-13);
    bound!(particle, [true]).holds([start]);
}

#[test]
fn a_constraint_that_is_not_affine_acts_across_the_allowed_velocities() {
    // The direction ψ turns by ψ′ = −(g/s) cos ψ, so that sin ψ = −tanh(g t/s) from the horizontal.
    let particle = Constant { m: 0.7, speed: 2.0 };
    let start = State::new([0.0, 0.0], [2.0, 0.0]);
    let rows = [0.1, 0.4, 1.0].map(|t| {
        let turn = G * t / 2.0;
        let (sin, cos) = (-turn.tanh(), 1.0 / turn.cosh());
        let x = 4.0 / G * (2.0 * (turn / 2.0).tanh().atan());
        (t, [x, -4.0 / G * turn.cosh().ln(), 2.0 * cos, 2.0 * sin])
    });
    both_follow(&particle, start, rows, 1e-12);
    for t in [0.0, 0.3, 1.0] {
        let state = state_at(&particle, start, t);
        let [vx, vy] = state.v;
        close(vx.hypot(vy), 2.0, 1e-15);
        // λ ∂g/∂v = 2 λ v balances the weight along the path.
        let reactions = particle.reactions(&state).unwrap();
        close_on(1.0, reactions.pace, 0.7 * G * vy / (2.0 * 4.0), 1e-13);
        let power = reactions.pace * 2.0 * 4.0;
        close_on(1.0, particle.reaction_power(&state).unwrap(), power, 1e-13);
        close_on(1.0, particle.energy_rate(&state).unwrap(), power, 1e-13);
    }
    bound!(particle, [false]).holds([start, state_at(&particle, start, 0.3)]);
}

/// Appell's example: x′² + y′² = c z′², with springs across.
struct Cone {
    slope: f64,
    weight: f64,
    stiffness: f64,
}

#[lagrangian(coordinates = [x, y, z])]
impl Cone {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        self.weight * q.z + 0.5 * self.stiffness * (q.x.powi(2) + 2.0 * q.y.powi(2))
    }

    #[nonholonomic(chetaev)]
    fn cone(&self, v: &Velocities) -> f64 {
        v.x.powi(2) + v.y.powi(2) - self.slope * v.z.powi(2)
    }
}

/// A motion that is thrown up comes to rest, all velocities at once. There the constraint has no gradient: one
/// motion after the other leads on from there.
#[test]
fn a_motion_on_a_cone_of_velocities_ends_where_it_stops() {
    let mut samples = Samples::new(6);
    let mut stopped = 0;
    for _ in 0..20 {
        let cone = Cone {
            slope: samples.number(0.5, 3.0),
            weight: samples.number(3.0, 9.81),
            stiffness: samples.number(0.5, 3.0),
        };
        let q = [samples.unit(), samples.unit(), samples.unit()];
        let start = State::new(q, [samples.unit(), samples.number(0.5, 1.0), samples.number(0.5, 1.0)]);
        let start = cone.consistent(start).unwrap();
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let mut motion = cone.simulate(start).with_tolerance(tolerance);
            let Err(error) = motion.advance_to(1.0).copied() else { continue };
            assert_eq!(error.cause, Cause::StepTooSmall);
            let (last, first) = (motion.state().v, start.v);
            let speed = |v: [f64; 3]| Vector3::from(v).norm();
            assert!(speed(last) < 1e-2 * speed(first), "{tolerance:e}: {last:?}");
            stopped += 1;
        }
    }
    assert!(stopped > 40, "{stopped}");
}

//! Where pieces of a motion end: lift-off within a step, loads far from time zero, errors behind the time
//! that is asked for, energies that jump.

use lagrangian::Cause;
use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// Two masses on a spring, the lower one over a floor. A drive pushes them apart in a square wave.
struct Hopper {
    stiffness: f64,
    drive: f64,
}

#[lagrangian(coordinates = [body, foot])]
impl Hopper {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> f64 {
        q.body
    }

    #[point(mass = 0.5)]
    fn lower(&self, q: &Coordinates) -> f64 {
        q.foot
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        9.81 * (q.body + 0.5 * q.foot) + 0.5 * self.stiffness * (q.body - q.foot - 1.0).powi(2)
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * (v.body - v.foot).powi(2)
    }

    #[force]
    fn push(&self, t: f64) -> [f64; 2] {
        let push = if (7.0 * t).sin() > 0.0 { self.drive } else { 0.0 };
        [push, -push]
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.foot
    }
}

#[test]
fn a_hopper_lifts_off_within_any_step() {
    let mut lifted = 0;
    for number in 0..30 {
        let hopper = Hopper { stiffness: 300.0 + 20.0 * f64::from(number), drive: 40.0 };
        let start = State::new([1.0 + 7e-3 * f64::from(number), 0.0], [-0.5, 0.0]);
        let mut motion = hopper.stepper::<Jet<6>>(start);
        for _ in 0..1000 {
            // What stands on the floor is beside it by the rounding errors of its landing.
            let is_up = |state: &State<f64, 2>| state.q[1] > 1e-15;
            let was_up = is_up(motion.state());
            motion.step(1e-3, &[]).unwrap();
            lifted += usize::from(!was_up && is_up(motion.state()));
        }
        let end = *hopper.simulate(start).with_tolerance(1e-12).advance_to(motion.state().t).unwrap();
        close_on(1.0, motion.state().q[0], end.q[0], 1e-8);
        close_on(1.0, motion.state().q[1], end.q[1], 1e-8);
    }
    assert!(lifted > 60, "{lifted}");
}

/// A mass whose brake grips ever harder from some time on.
struct Brake {
    rate: f64,
    begins: f64,
}

#[lagrangian(coordinates = [x])]
impl Brake {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> f64 {
        q.x
    }

    fn grip(&self, t: f64) -> f64 {
        (self.rate * (t - self.begins)).max(0.0)
    }

    #[friction(limit = grip)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_brake_grips_far_from_time_zero() {
    let mut samples = Samples::new(5);
    for number in 0..24 {
        let instant = [0.0, 1e3, 1e5, 1e7][number % 4];
        let (rate, delay, speed) =
            (samples.number(1.0, 5.0), samples.number(0.1, 0.5), samples.number(0.5, 1.0));
        let brake = Brake { rate, begins: instant + delay };
        let start = State::new([0.0], [speed]).at_time(instant);
        // v = v₀ − r τ²/2 until it is zero.
        let lasts = (2.0 * speed / rate).sqrt();
        let way = speed * delay + 2.0 / 3.0 * speed * lasts;
        let error = 1e-12 + 1e-15 * instant;
        let end = *brake.simulate(start).advance_to(instant + 3.0).unwrap();
        close_on(1.0, end.q[0], way, error);
        let mut motion = brake.stepper::<Jet<6>>(start);
        for _ in 0..300 {
            motion.step(0.01, &[]).unwrap();
        }
        close_on(1.0, motion.state().q[0], way, error);
    }
}

/// A pawl on the teeth of a wheel that has only two of them: behind these the gap jumps down.
struct Ratchet {
    torque: f64,
}

#[lagrangian(coordinates = [turn, height])]
impl Ratchet {
    #[kinetic]
    fn wheel(&self, v: &Velocities) -> f64 {
        0.5 * v.turn.powi(2)
    }

    #[point(mass = 0.05)]
    fn pawl(&self, q: &Coordinates) -> f64 {
        q.height
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        100.0 * (q.height + 0.1).powi(2) - self.torque * q.turn
    }

    #[unilateral]
    fn tooth(&self, q: &Coordinates) -> f64 {
        self.pawl(q)
            - 0.3
                * if q.turn < 0.5 {
                    q.turn
                } else if q.turn < 1.0 {
                    q.turn - 0.5
                } else {
                    2.0
                }
    }
}

#[test]
fn an_error_behind_the_time_that_is_asked_for_waits() {
    for torque in [15.0, 20.0, 40.0, 80.0] {
        let ratchet = Ratchet { torque };
        let start = State::new([0.1, 0.03], [2.0, 0.6]);
        let error = ratchet.simulate(start).advance_to(9.0).unwrap_err();
        assert!(matches!(error.cause, Cause::GapJumps { .. }), "{error}");
        for part in [0.2, 0.5, 0.8, 0.95, 0.999] {
            let mut motion = ratchet.simulate(start);
            let t = part * error.t;
            assert_eq!(motion.advance_to(t).map(|state| state.t), Ok(t), "{torque} {part}");
            assert_eq!(motion.advance_to(9.0).unwrap_err().cause, error.cause);
        }
    }
}

/// A step of an energy, which no force makes.
struct Step;

#[lagrangian(coordinates = [x])]
impl Step {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[potential]
    fn step(&self, q: &Coordinates) -> f64 {
        if q.x < 1.0 { 0.0 } else { 1.0 }
    }
}

#[test]
fn an_energy_that_jumps_is_met_by_all_steps() {
    for length in [0.01, 0.3, 5.0] {
        let mut motion = Step.stepper::<Jet<6>>(State::new([0.0], [0.5]));
        let error = (0..500).find_map(|_| motion.step(length, &[]).err()).unwrap();
        assert!(matches!(error.cause, Cause::EnergyJumps { .. }), "{error}");
        assert!(motion.state().q[0] <= 1.0);
    }
}

/// A body that meets a prestressed spring: the force jumps, the energy does not.
struct Spring {
    stiffness: f64,
    force: f64,
}

#[lagrangian(coordinates = [x])]
impl Spring {
    #[point(mass = 1.0)]
    fn body(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let pressed = q.x - 1.0;
        let held = if q.x < 1.0 { 0.0 } else { (0.5 * self.stiffness * pressed + self.force) * pressed };
        held + 0.5 * q.x * q.x
    }
}

/// The error of a motion in steps of a classical method, and how far it has come.
fn by_steps<S, M>(system: &S, start: State<f64, 1>, h: f64) -> (Option<Cause>, f64)
where
    S: System<1, Scalar = f64>,
    M: lagrangian::FixedStep<S, 1, 0>,
{
    let mut motion = system.stepper::<M>(start);
    let error = (0..500).find_map(|_| motion.step(h, &[]).err());
    (error.map(|error| error.cause), motion.state().q[0])
}

#[test]
fn an_energy_that_jumps_is_met_by_methods_that_look_for_no_kinks() {
    let start = State::new([0.0], [0.5]);
    for h in [0.01, 0.3, 5.0] {
        for (cause, reached) in
            [by_steps::<_, Rk4>(&Step, start, h), by_steps::<_, Leapfrog>(&Step, start, h)]
        {
            assert!(matches!(cause, Some(Cause::EnergyJumps { .. })), "{cause:?}");
            assert!(reached < 1.0);
        }
    }
    let mut motion = Step.simulate_with::<Dop853>(start);
    for _ in 0..2 {
        let error = motion.advance_to(5.0).unwrap_err();
        assert!(matches!(error.cause, Cause::EnergyJumps { .. }), "{error}");
        assert!(motion.state().q[0] < 1.0);
    }
}

#[test]
fn a_force_that_jumps_is_passed_by_methods_that_look_for_no_kinks() {
    let mut samples = Samples::new(23);
    for _ in 0..50 {
        let spring = Spring { stiffness: samples.number(0.1, 1e4), force: samples.number(0.0, 10.0) };
        let start = State::new([samples.number(-2.0, 1.0)], [samples.number(-3.0, 3.0)]);
        assert_eq!(by_steps::<_, Rk4>(&spring, start, 1e-3).0, None);
        spring.simulate_with::<Dop853>(start).advance_to(1.0).unwrap();
    }
}

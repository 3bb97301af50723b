//! The errors of derivatives are controlled like those of the motion, whatever the motion does.

use lagrangian::{Dual, Transition, prelude::*};

use crate::support::close::{between, close, close_on};

/// Oscillators without a coupling, a parameter each.
struct Oscillators {
    stiffness: [f64; 2],
}

#[lagrangian(coordinates = [slow, fast], sensitivities = [self.stiffness[1]])]
impl Oscillators {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.slow.powi(2) + v.fast.powi(2))
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (self.stiffness[0] * q.slow.powi(2) + self.stiffness[1] * q.fast.powi(2))
    }
}

/// ∂(q, v)/∂(q₀, v₀) of an oscillator.
fn rotation(omega: f64, t: f64) -> [[f64; 2]; 2] {
    let (sin, cos) = (omega * t).sin_cos();
    [[cos, sin / omega], [-omega * sin, cos]]
}

fn blocks<const N: usize, const P: usize>(found: &Transition<f64, N, P>, i: usize) -> [[f64; 2]; 2] {
    let entry = |row: usize, column: usize| found.entry(row * N + i, column * N + i);
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

#[test]
fn at_rest_the_derivatives_choose_the_step() {
    for (tolerance, error) in [(1e-6, 1e-4), (1e-10, 1e-8), (1e-14, 1e-12), (f64::EPSILON, 1e-13)] {
        let oscillators = Oscillators { stiffness: [1.0, 1.0] };
        let varied = oscillators.variational();
        let mut motion = varied.motion(State::at_rest([0.0; 2])).unwrap().with_tolerance(tolerance);
        for t in [10.0, 100.0] {
            let found = motion.advance_to(t).unwrap();
            for (found, expected) in blocks(&found, 0).iter().flatten().zip(rotation(1.0, t).iter().flatten())
            {
                close_on(1.0, *found, *expected, error);
            }
        }
        // The step of an oscillator in motion, not the whole way at once.
        let mut plain = oscillators.simulate(State::at_rest([0.1, 0.2])).with_tolerance(tolerance);
        plain.advance_to(100.0).unwrap();
        let (with, without) = (motion.steps().accepted as f64, plain.steps().accepted as f64);
        between(0.5, with / without, 2.0);
    }
}

#[test]
fn a_slow_coordinate_does_not_hide_a_fast_one_at_rest() {
    let oscillators = Oscillators { stiffness: [1e-4, 1e4] };
    let varied = oscillators.variational();
    let mut motion = varied.motion(State::at_rest([1.0, 0.0])).unwrap().with_tolerance(f64::EPSILON);
    let found = motion.advance_to(100.0).unwrap();
    for (i, omega) in [0.01, 100.0].into_iter().enumerate() {
        // Relative to the largest entry of each 2 × 2 matrix.
        for (found, expected) in
            blocks(&found, i).iter().flatten().zip(rotation(omega, 100.0).iter().flatten())
        {
            close_on(100.0, *found, *expected, 1e-12);
        }
    }
    assert_eq!((found.q_by_q[(0, 1)], found.q_by_q[(1, 0)]), (0.0, 0.0));
    // At rest nothing depends on the stiffness; in motion q = cos ωt does: −t sin ωt / 2ω.
    assert_eq!(found.q_by_p[1], 0.0);
    let mut motion = varied.motion(State::at_rest([0.0, 1.0])).unwrap().with_tolerance(f64::EPSILON);
    let found = motion.advance_to(10.0).unwrap();
    close_on(0.05, found.q_by_p[1], -10.0 * 1000.0_f64.sin() / 200.0, 1e-12);
}

/// A spring with a kink.
struct Kinked;

#[lagrangian(coordinates = [x], jacobians)]
impl Kinked {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[force(on = x)]
    fn spring(&self, q: &Coordinates) -> f64 {
        1.0 - (q.x + 1.0).abs()
    }
}

#[test]
fn derivatives_go_through_a_kink() {
    let varied = Kinked.variational();
    for (tolerance, error) in [(1e-6, 1e-4), (1e-10, 1e-8), (1e-13, 1e-11)] {
        let mut motion = varied.motion(State::at_rest([0.0])).unwrap().with_tolerance(tolerance);
        let found = motion.advance_to(100.0).unwrap();
        for (found, expected) in blocks(&found, 0).iter().flatten().zip(rotation(1.0, 100.0).iter().flatten())
        {
            close_on(1.0, *found, *expected, error);
        }
    }
    // Across the kink the force changes from −x to 2 + x.
    let mut motion = varied.motion(State::new([-0.5], [-0.4])).unwrap().with_tolerance(1e-13);
    let found = motion.advance_to(2.0).unwrap();
    let flow = |x: f64| {
        *Kinked.simulate(State::new([-0.5 + x], [-0.4])).with_tolerance(1e-13).advance_to(2.0).unwrap()
    };
    let h = 1e-5;
    close((flow(h).q[0] - flow(-h).q[0]) / (2.0 * h), found.q_by_q[0], 1e-8);
}

#[test]
fn limits_hold_for_motions_with_derivatives() {
    let oscillators = Oscillators { stiffness: [1.0, 4.0] };
    let varied = oscillators.variational();
    let motion = || varied.motion(State::at_rest([0.0; 2])).unwrap();
    let mut limited = motion().with_step_limit(0.01);
    limited.advance_to(1.0).unwrap();
    between(99.0, limited.steps().accepted as f64, 103.0);
    let few = motion().with_max_steps(2).advance_to(100.0);
    assert!(matches!(few, Err(MotionError { cause: lagrangian::Cause::TooManySteps, .. })));
    let wrong = motion().with_tolerance(-1.0).advance_to(1.0);
    assert!(matches!(wrong, Err(MotionError { cause: lagrangian::Cause::InvalidTolerance, .. })));
    // An absolute tolerance of a derivative is relative to its column. So the steps are the same in other
    // units of a parameter.
    let steps = |stiffness: f64| {
        let oscillators = Oscillators { stiffness: [1.0 * stiffness, 4.0 * stiffness] };
        let varied = oscillators.variational();
        let (end, start) = (10.0 / stiffness.sqrt(), State::new([0.3, 0.4], [0.0; 2]));
        let mut motion = varied.motion(start).unwrap().with_tolerances(1e-10, 1e-10);
        motion.advance_to(end).unwrap();
        motion.steps()
    };
    assert_eq!(steps(1.0), steps(2.0_f64.powi(-40)));
}

/// A wall that the series at the start does not show.
struct Wall;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Wall {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn walls(&self, q: &Coordinates) -> f64 {
        (50.0 * (q.x - 3.0)).exp() + (-50.0 * (q.x + 3.0)).exp() + 0.5 * q.y.powi(2) + 0.1 * q.x * q.y
    }
}

#[test]
fn walls_far_away_are_met_by_the_derivatives() {
    let start = |x: f64| State::new([x, 0.3], [1.0, 0.1]);
    let found = Wall.variational().motion(start(0.0)).unwrap().with_tolerance(1e-13).advance_to(9.0).unwrap();
    let flow = |x: f64| Wall.simulate(start(x)).with_tolerance(1e-14).advance_to(9.0).unwrap().q;
    let expected = crate::support::difference::derivative(1e-3, flow);
    for (found, expected) in found.q_by_q.column(0).iter().zip(expected) {
        close_on(10.0, *found, expected, 1e-10);
    }
}

/// A pendulum by its angle, and in Cartesian coordinates on a rod.
struct Angle {
    length: f64,
    g: f64,
}

#[lagrangian(coordinates = [phi], sensitivities = [self.g])]
impl Angle {
    #[point(mass = 1.3)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.phi.sin(), -q.phi.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        1.3 * self.g * self.bob(q).y
    }
}

struct Rod {
    length: f64,
    g: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.g])]
impl Rod {
    #[point(mass = 1.3)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        1.3 * self.g * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

/// Place and velocity of the bob, and their derivatives by the angle and by its rate.
fn embedded(length: f64, phi: f64, omega: f64) -> ([f64; 4], [[f64; 4]; 2]) {
    let (s, c) = (length * phi.sin(), length * phi.cos());
    ([s, -c, c * omega, s * omega], [[c, s, -s * omega, c * omega], [0.0, 0.0, c, s]])
}

#[test]
fn on_a_rod_and_by_an_angle_the_derivatives_agree() {
    let (angle, rod) = (Angle { length: 0.7, g: 9.81 }, Rod { length: 0.7, g: 9.81 });
    for (phi, omega) in [(1.1, 2.3), (0.0, 0.0), (-2.0, 7.5)] {
        let (place, by) = embedded(0.7, phi, omega);
        let by_angle = angle
            .variational()
            .motion(State::new([phi], [omega]))
            .unwrap()
            .with_tolerance(1e-14)
            .advance_to(5.0)
            .unwrap();
        let start = State::new([place[0], place[1]], [place[2], place[3]]);
        let on_rod = rod.variational().motion(start).unwrap().with_tolerance(1e-14).advance_to(5.0).unwrap();
        let (_, [by_phi, by_omega]) = embedded(0.7, by_angle.state.q[0], by_angle.state.v[0]);
        let mapped = |dq: f64, dv: f64| std::array::from_fn::<_, 4, _>(|i| by_phi[i] * dq + by_omega[i] * dv);
        let entries = on_rod.q_by_q.iter().chain(&on_rod.v_by_q).chain(&on_rod.q_by_v).chain(&on_rod.v_by_v);
        let size = entries.fold(0.0_f64, |most, x| most.max(x.abs()));
        for (direction, seed) in by.iter().enumerate() {
            let expected = mapped(by_angle.entry(0, direction), by_angle.entry(1, direction));
            for (row, expected) in expected.into_iter().enumerate() {
                let found = (0..4).map(|column| on_rod.entry(row, column) * seed[column]).sum();
                close_on(size, found, expected, 1e-12);
            }
        }
        // By gravity, and across the rod: nothing.
        let expected = mapped(by_angle.q_by_p[0], by_angle.v_by_p[0]);
        for (found, expected) in on_rod.q_by_p.iter().chain(&on_rod.v_by_p).zip(expected) {
            close_on(size, *found, expected, 1e-12);
        }
        for row in 0..4 {
            close_on(size, on_rod.entry(row, 2) * start.q[0] + on_rod.entry(row, 3) * start.q[1], 0.0, 1e-12);
        }
    }
}

/// A skate that pushes itself: a constraint on velocities.
struct Skate {
    push: f64,
}

#[lagrangian(coordinates = [x, y, phi], sensitivities = [self.push])]
impl Skate {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2)) + 0.1 * v.phi.powi(2)
    }

    #[force(on = phi)]
    fn turn(&self, q: &Coordinates, t: f64) -> f64 {
        self.push * (t + 0.3 * q.x).cos()
    }

    #[potential]
    fn slope(&self, q: &Coordinates) -> f64 {
        0.5 * q.y
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x * q.phi.sin() - v.y * q.phi.cos()
    }
}

#[test]
fn columns_of_a_nonholonomic_system_are_those_of_consistent_starts() {
    let skate = Skate { push: 0.4 };
    let start = skate.consistent(State::new([0.1, 0.2, 0.7], [1.0, 0.9, -0.3])).unwrap();
    let found = skate.variational().motion(start).unwrap().with_tolerance(1e-14).advance_to(2.0).unwrap();
    let flow = |push: f64, start: State<f64, 3>| {
        let skate = Skate { push };
        let start = skate.consistent(start).unwrap();
        let State { q, v, .. } = *skate.simulate(start).with_tolerance(1e-14).advance_to(2.0).unwrap();
        [q[0], q[1], q[2], v[0], v[1], v[2]]
    };
    use crate::support::difference::{STEP, derivative, moved};
    for column in 0..6 {
        let expected = derivative(STEP, |x| flow(0.4, moved(&start, column, x)));
        for (row, expected) in expected.into_iter().enumerate() {
            close_on(10.0, found.entry(row, column), expected, 1e-11);
        }
    }
    let expected = derivative(STEP, |x| flow(0.4 + x, start));
    for (found, expected) in found.q_by_p.iter().chain(&found.v_by_p).zip(expected) {
        close_on(10.0, *found, expected, 1e-11);
    }
}

#[test]
fn duals_of_duals_have_second_derivatives() {
    type Second = Dual<Dual<f64, 1>, 1>;
    let angle = Angle { length: 0.7, g: 9.81 };
    let number = |x: f64| Second::constant(Dual::constant(x));
    let over = angle.over(|x, _| number(x));
    let phi = Second { value: Dual::variable(1.1, 0), slopes: [Dual::constant(1.0)] };
    let mut motion = over.simulate(State::new([phi], [number(2.3)])).with_tolerance(number(1e-14));
    let found = motion.advance_to(number(2.0)).unwrap().q[0];
    let varied = angle.variational();
    let first = |phi: f64| {
        let mut motion = varied.motion(State::new([phi], [2.3])).unwrap().with_tolerance(1e-14);
        motion.advance_to(2.0).unwrap().q_by_q[0]
    };
    close(found.value.slopes[0], first(1.1), 1e-13);
    close(found.slopes[0].value, first(1.1), 1e-13);
    let second = crate::support::difference::slope(0.005, |x| first(1.1 + x));
    close(found.slopes[0].slopes[0], second, 1e-10);
}

#[test]
fn fixed_steps_carry_derivatives() {
    let angle = Angle { length: 0.7, g: 9.81 };
    let over = angle.over(|x, _| Dual::<f64, 2>::constant(x));
    let start = State::new([Dual::variable(1.1, 0)], [Dual::variable(2.3, 1)]);
    let exact = angle
        .variational()
        .motion(State::new([1.1], [2.3]))
        .unwrap()
        .with_tolerance(1e-14)
        .advance_to(1.0)
        .unwrap();
    let error = |steps: u32, found: f64| {
        assert!(steps > 0);
        (found - exact.q_by_q[0]).abs()
    };
    let step = |steps: u32| Dual::constant(1.0 / f64::from(steps));
    let rk4 = |steps: u32| {
        let mut stepper = over.stepper::<Rk4>(start);
        (0..steps).for_each(|_| {
            stepper.step(step(steps), &[]).unwrap();
        });
        error(steps, stepper.state().q[0].slopes[0])
    };
    between(3.8, (rk4(64) / rk4(128)).log2(), 4.2);
    let mut jet = over.stepper::<Jet<8>>(start);
    (0..64).for_each(|_| {
        jet.step(step(64), &[]).unwrap();
    });
    assert!(error(64, jet.state().q[0].slopes[0]) < 1e-12);
}

/// A charge at nearly the speed of light in a magnetic field that is not uniform.
#[derive(Clone, Copy)]
struct Charge;

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Charge {
    #[lagrangian]
    fn action(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        let field = 1.0 + 0.2 * (q.x * q.x + q.y * q.y);
        let potential = 0.5 * field * (v.y * q.x - v.x * q.y) + 0.3 * (0.7 * t).sin() * q.x * v.z;
        -(1.0 - v.x * v.x - v.y * v.y - v.z * v.z).sqrt() + potential - 1.0 / (1.0 + q.z * q.z).sqrt()
    }
}

/// Some derivatives begin as rounding errors of others in their column, so that they have no size of their
/// own.
#[test]
fn roundings_in_a_column_do_not_hold_a_motion_up() {
    let start = State::new([0.3, 0.0, 0.4], [0.5, 0.5, 0.3]);
    let end = |start: State<f64, 3>| Charge.simulate(start).with_tolerance(1e-14).advance_to(6.0).unwrap().q;
    for tolerance in [1e-8, 1e-9, 1e-10, 1e-12] {
        let variational = Charge.variational();
        let mut motion = variational.motion(start).unwrap().with_tolerance(tolerance).with_max_steps(300);
        let found = motion.advance_to(6.0).unwrap().q_by_q;
        for (j, &place) in start.q.iter().enumerate() {
            let beside = |x: f64| {
                let mut start = start;
                start.q[j] = place + x;
                end(start)
            };
            let h = 1e-3;
            let [far, near] = [[beside(-2.0 * h), beside(2.0 * h)], [beside(-h), beside(h)]];
            for i in 0..3 {
                // A difference of fourth order.
                let slope = (8.0 * (near[1][i] - near[0][i]) - (far[1][i] - far[0][i])) / (12.0 * h);
                assert!((found[(i, j)] - slope).abs() < 1e-7 + 1e2 * tolerance, "{tolerance}: {i} by {j}");
            }
        }
    }
}

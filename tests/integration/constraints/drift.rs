//! No drift: constraints hold to rounding after every step, at every sample, and on the way back.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between, close_on};
use crate::support::motion::numbers;

const G: f64 = 9.81;

/// Three masses on rods, the lowest on a floor that tilts to and fro: holonomic, rheonomic, and a mass matrix
/// that is diagonal.
struct Chain {
    tilt: f64,
}

#[lagrangian(coordinates = [x: [3], y: [3]])]
impl Chain {
    #[point(mass = [1.0, 2.0, 0.5])]
    fn masses(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        [Vector2::new(q.x[0], q.y[0]), Vector2::new(q.x[1], q.y[1]), Vector2::new(q.x[2], q.y[2])]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (q.y[0] + 2.0 * q.y[1] + 0.5 * q.y[2])
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 3] {
        let [a, b, c] = self.masses(q);
        [a.norm() - 1.0, (b - a).norm() - 1.0, (c - b).norm_squared() - 1.0]
    }

    #[holonomic]
    fn floor(&self, q: &Coordinates, t: f64) -> f64 {
        q.y[2] + 1.5 - self.tilt * (2.0 * t).sin() * q.x[2]
    }
}

/// A sleigh that is towed on a string: nonholonomic and holonomic together, and a mass matrix that moves.
struct Sleigh;

#[lagrangian(coordinates = [x, y, heading, tug])]
impl Sleigh {
    #[body(mass = 2.0, inertia = 0.3)]
    fn sleigh(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        // The blade stands behind the centre.
        (Vector2::new(q.x + 0.2 * q.heading.cos(), q.y + 0.2 * q.heading.sin()), q.heading)
    }

    #[point(mass = 1.0)]
    fn tug(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(3.0 * q.tug.cos(), 2.0 * q.tug.sin())
    }

    #[nonholonomic]
    fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x * q.heading.sin() - v.y * q.heading.cos()
    }

    #[holonomic]
    fn string(&self, q: &Coordinates) -> f64 {
        (self.tug(q) - Vector2::new(q.x, q.y)).norm() - 1.5
    }
}

fn chain() -> (Chain, State<f64, 6>) {
    let chain = Chain { tilt: 0.2 };
    let rough = State::new([0.8, 1.3, 0.6, -0.6, -1.4, -1.5], [0.4, 0.2, -0.3, 0.5, 0.1, 0.2]);
    let start = chain.consistent(rough).expect("a chain that reaches the floor");
    (chain, start)
}

fn sleigh() -> State<f64, 4> {
    let rough = State::new([1.5, 0.0, 0.3, 0.0], [1.0, 0.5, 0.7, 0.6]);
    Sleigh.consistent(rough).expect("a string that reaches the tug")
}

/// The largest violation of a state, relative to Σ |∂f/∂q| times its largest coordinate or velocity. That is
/// the scale of rounding errors.
macro_rules! violation {
    ($system:expr, $state:expr) => {{
        let (system, state): (_, &State<f64, _>) = (&$system, $state);
        let rows = system.constraint_jacobian(state).abs();
        let slopes = rows.column_sum();
        let (places, speeds) = (slopes * state.coordinates().amax(), slopes * state.velocities().amax());
        let (residuals, rates) = (system.constraint_residuals(state), system.constraint_rates(state));
        let relative = |c: usize| (residuals[c] / places[c]).abs().max((rates[c] / speeds[c]).abs());
        (0..residuals.len()).map(relative).fold(0.0, larger)
    }};
}

/// The larger number, or NaN, which `f64::max` would hide.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

#[test]
fn ten_thousand_fixed_steps_leave_roundings() {
    fn run<M, const N: usize, S>(
        system: &S,
        start: State<f64, N>,
        h: f64,
        violation: impl Fn(&State<f64, N>) -> f64,
    ) where
        S: System<N, Scalar = f64>,
        M: lagrangian::FixedStep<S, N, 0>,
    {
        let mut motion = system.stepper::<M>(start);
        let mut largest = 0.0;
        for _ in 0..10_000 {
            largest = larger(largest, violation(motion.step(h, &[]).expect("motion: no obstacle")));
        }
        close_on(1.0, largest, 0.0, 1e-14);
        // It did move.
        between(0.1, (motion.state().coordinates() - start.coordinates()).norm(), 1e3);
    }
    let (chain, start) = chain();
    let of_chain = |state: &State<f64, 6>| violation!(chain, state);
    run::<Jet<2>, 6, _>(&chain, start, 0.001, of_chain);
    run::<Jet<6>, 6, _>(&chain, start, 0.001, of_chain);
    run::<Jet<15>, 6, _>(&chain, start, 0.001, of_chain);
    run::<Rk4, 6, _>(&chain, start, 0.001, of_chain);
    let of_sleigh = |state: &State<f64, 4>| violation!(Sleigh, state);
    run::<Jet<3>, 4, _>(&Sleigh, sleigh(), 0.002, of_sleigh);
    run::<Jet<8>, 4, _>(&Sleigh, sleigh(), 0.002, of_sleigh);
    run::<Rk4, 4, _>(&Sleigh, sleigh(), 0.002, of_sleigh);
}

#[test]
fn every_sample_lies_on_the_constraints() {
    let (chain, start) = chain();
    for tolerance in [1e-4, 1e-8, 1e-13] {
        let mut jets = chain.simulate(start).with_tolerance(tolerance);
        let samples = jets.every(0.0137).take(150);
        close_on(1.0, samples.map(|state| violation!(chain, &state.unwrap())).fold(0.0, larger), 0.0, 1e-14);
        let mut dop853 = chain.simulate_with::<Dop853>(start).with_tolerance(tolerance);
        let samples = dop853.every(0.0137).take(150);
        close_on(1.0, samples.map(|state| violation!(chain, &state.unwrap())).fold(0.0, larger), 0.0, 1e-14);
        close_on(1.0, violation!(chain, dop853.advance_to(2.5).unwrap()), 0.0, 1e-14);
        let mut jets = Sleigh.simulate(sleigh()).with_tolerance(tolerance);
        let samples = jets.every(-0.09).take(100);
        close_on(1.0, samples.map(|state| violation!(Sleigh, &state.unwrap())).fold(0.0, larger), 0.0, 1e-14);
    }
}

#[test]
fn samples_are_as_good_as_ends_of_steps() {
    let (chain, start) = chain();
    let mut sampled = chain.simulate(start).with_tolerance(1e-13);
    let samples: Vec<_> = sampled.every(0.31).take(8).map(|state| state.unwrap()).collect();
    for state in samples {
        let mut direct = chain.simulate(start).with_tolerance(1e-15);
        all_close(numbers(&state), numbers(direct.advance_to(state.t).unwrap()), 1e-10);
    }
}

#[test]
fn both_methods_and_all_orders_end_at_the_same_state() {
    let (chain, start) = chain();
    let expected = numbers(chain.simulate(start).with_tolerance(1e-15).advance_to(1.0).unwrap());
    let mut dop853 = chain.simulate_with::<Dop853>(start).with_tolerance(1e-14);
    all_close(numbers(dop853.advance_to(1.0).unwrap()), &expected, 1e-10);
    let mut jet = chain.stepper::<Jet<10>>(start);
    let mut rk4 = chain.stepper::<Rk4>(start);
    for _ in 0..1000 {
        jet.step(0.001, &[]).unwrap();
        rk4.step(0.001, &[]).unwrap();
    }
    all_close(numbers(jet.state()), &expected, 1e-10);
    all_close(numbers(rk4.state()), &expected, 1e-6);
    let expected = numbers(Sleigh.simulate(sleigh()).with_tolerance(1e-15).advance_to(3.0).unwrap());
    let mut dop853 = Sleigh.simulate_with::<Dop853>(sleigh()).with_tolerance(1e-14);
    all_close(numbers(dop853.advance_to(3.0).unwrap()), &expected, 1e-10);
}

#[test]
fn projection_keeps_the_orders_of_the_methods() {
    let (chain, start) = chain();
    let exact = numbers(chain.simulate(start).with_tolerance(1e-15).advance_to(0.5).unwrap());
    fn error<M: lagrangian::FixedStep<Chain, 6, 0>>(
        (chain, start): (&Chain, State<f64, 6>),
        steps: u32,
        exact: &[f64],
    ) -> f64 {
        let mut motion = chain.stepper::<M>(start);
        for _ in 0..steps {
            motion.step(0.5 / f64::from(steps), &[]).unwrap();
        }
        numbers(motion.state()).iter().zip(exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    }
    let at = (&chain, start);
    let order = |coarse: f64, fine: f64| (coarse / fine).log2();
    between(3.7, order(error::<Rk4>(at, 50, &exact), error::<Rk4>(at, 100, &exact)), 4.3);
    between(2.7, order(error::<Jet<3>>(at, 50, &exact), error::<Jet<3>>(at, 100, &exact)), 3.3);
    between(5.7, order(error::<Jet<6>>(at, 40, &exact), error::<Jet<6>>(at, 80, &exact)), 6.4);
}

#[test]
fn time_runs_backwards_to_where_it_began() {
    let (chain, start) = chain();
    let mut jets = chain.simulate(start).with_tolerance(1e-15);
    jets.advance_to(1.0).unwrap();
    all_close(numbers(jets.advance_to(0.0).unwrap()), numbers(&start), 1e-10);
    let mut dop853 = chain.simulate_with::<Dop853>(start).with_tolerance(1e-15);
    dop853.advance_to(1.0).unwrap();
    all_close(numbers(dop853.advance_to(0.0).unwrap()), numbers(&start), 1e-10);
    let mut jet = Sleigh.stepper::<Jet<12>>(sleigh());
    for h in [0.01, -0.01] {
        for _ in 0..300 {
            jet.step(h, &[]).unwrap();
        }
    }
    all_close(numbers(jet.state()), numbers(&sleigh()), 1e-11);
    let mut jets = Sleigh.simulate(sleigh()).with_tolerance(1e-15);
    jets.advance_to(-3.0).unwrap();
    all_close(numbers(jets.advance_to(0.0).unwrap()), numbers(&sleigh()), 1e-11);
}

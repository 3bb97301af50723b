//! One description for every scalar: `f64`, `f32`, and dual numbers that the library has never seen.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between, close};
use crate::support::difference::{derivative, moved};
use crate::support::dual::Dual;
use crate::support::identities::model;
use crate::support::sample::Samples;

/// A pole on a cart, with a damped bearing and a motor, in any scalar.
#[derive(Clone, Copy)]
struct CartPole<R> {
    cart: R,
    pole: R,
    length: R,
    g: R,
    damping: R,
}

#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl<R: Real> CartPole<R> {
    #[point(mass = self.cart)]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, R::zero())
    }

    #[point(mass = self.pole)]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.pole * self.g * self.tip(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities<R>) -> R {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(at = cart)]
    fn motor(&self, u: &Inputs<R>) -> Vector2<R> {
        Vector2::new(u.motor, R::zero())
    }
}

fn cart_pole<R: Real>() -> CartPole<R> {
    let [cart, pole, length, g, damping] = [1.0, 0.25, 0.5, 9.81, 0.125].map(R::from_f64);
    CartPole { cart, pole, length, g, damping }
}

fn random() -> (State<f64, 2>, [f64; 1]) {
    let mut samples = Samples::new(7);
    (samples.state(-2.0, 2.0), [samples.number(-3.0, 3.0)])
}

fn lowered(state: &State<f64, 2>) -> State<f32, 2> {
    State::new(state.q.map(|x| x as f32), state.v.map(|x| x as f32)).at_time(state.t as f32)
}

#[test]
fn double_precision_solves_the_textbooks_equations() {
    let (state, [push]) = random();
    let CartPole { cart, pole, length, g, damping } = cart_pole::<f64>();
    let ([_, theta], [_, rate]) = (state.q, state.v);
    let coupling = pole * length * theta.cos();
    let mass = Matrix2::new(cart + pole, coupling, coupling, pole * length * length);
    let right = Vector2::new(
        push + pole * length * rate * rate * theta.sin(),
        pole * g * length * theta.sin() - damping * rate,
    );
    let expected = mass.lu().solve(&right).unwrap();
    all_close(cart_pole().accelerations(&state, &[push]).unwrap(), expected.as_slice(), 1e-13);
    all_close(cart_pole::<f64>().mass_matrix(&state).as_slice(), mass.as_slice(), 1e-15);
    model!(cart_pole::<f64>(), inputs = [push]).holds(-1.0, 1.0);
}

#[test]
fn single_precision_differs_from_double_by_its_own_rounding() {
    let (state, u) = random();
    let double = cart_pole::<f64>().accelerations(&state, &u).unwrap();
    let single = cart_pole::<f32>().accelerations(&lowered(&state), &u.map(|u| u as f32)).unwrap();
    for (single, double) in single.into_iter().zip(double) {
        between(0.0, (f64::from(single) / double - 1.0).abs(), 1e-5);
    }
    let energy = f64::from(cart_pole::<f32>().energy(&lowered(&state)));
    close(energy, cart_pole::<f64>().energy(&state), 1e-6);
}

#[test]
fn a_motion_in_single_precision_follows_the_one_in_double() {
    let start = State::new([0.0, 0.5], [0.0, 0.0]);
    let (single, double) = (cart_pole::<f32>(), cart_pole::<f64>());
    let mut low = single.simulate(lowered(&start)).with_inputs([0.5]);
    let mut high = double.simulate(start).with_inputs([0.5]);
    low.advance_to(1.0).unwrap();
    high.advance_to(1.0).unwrap();
    for (low, high) in low.state().iter().zip(high.state().iter()) {
        close(f64::from(low), high, 1e-4);
    }
}

#[test]
fn dual_numbers_differentiate_the_generated_code() {
    let (state, u) = random();
    let system = cart_pole::<Dual>();
    for index in 0..4 {
        let mut numbers: Vec<Dual> = state.iter().map(Dual::constant).collect();
        numbers[index].slope = 1.0;
        let dual = State::new([numbers[0], numbers[1]], [numbers[2], numbers[3]]);
        let found = system.accelerations(&dual, &u.map(Dual::constant)).unwrap();
        let plain = cart_pole::<f64>();
        let expected = derivative(0.005, |x| plain.accelerations(&moved(&state, index, x), &u).unwrap());
        all_close(found.map(|a| a.slope), expected, 1e-11);
        all_close(found.map(|a| a.value), plain.accelerations(&state, &u).unwrap(), 1e-15);
    }
}

#[test]
fn a_motion_of_dual_numbers_carries_its_sensitivity() {
    // The sensitivity of the angle after a second to the length of the pole.
    let run = |length: Dual| {
        let system = CartPole { length, ..cart_pole::<Dual>() };
        let start = State::at_rest([0.0, 0.5].map(Dual::constant));
        let mut motion = system.simulate(start).with_tolerance(Dual::constant(1e-12));
        motion.advance_to(Dual::constant(1.0)).unwrap().q[1]
    };
    let found = run(Dual { value: 0.5, slope: 1.0 }).slope;
    let [expected] = derivative(0.01, |x| [run(Dual::constant(0.5 + x)).value]);
    close(found, expected, 1e-8);
}

/// A description in single precision alone.
struct Single {
    k: f32,
}

#[lagrangian(coordinates = [x])]
impl Single {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f32 {
        0.5 * v.x * v.x
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f32 {
        0.1 * self.k * q.x.powi(2)
    }
}

#[test]
fn a_description_in_f32_stays_in_f32() {
    let state: State<f32, 1> = State::at_rest([3.0]);
    let [a]: [f32; 1] = Single { k: 5.0 }.accelerations(&state).unwrap();
    close(f64::from(a), -3.0, 1e-6);
    let energy: f32 = Single { k: 5.0 }.energy(&state);
    close(f64::from(energy), 4.5, 1e-6);
}

/// The scalar bound in a where clause, and a parameter that is no scalar.
struct Labelled<'a, S, L>
where
    S: Real,
    L: ?Sized,
{
    stiffness: S,
    label: &'a L,
}

#[lagrangian(coordinates = [x: [2]])]
impl<S, L> Labelled<'_, S, L>
where
    S: Real,
    L: ?Sized + AsRef<str>,
{
    #[kinetic]
    fn kinetic(&self, v: &Velocities<S>) -> S {
        let half = S::from_f64(0.5);
        half * (v.x[0] * v.x[0] + v.x[1] * v.x[1])
    }

    #[potential]
    fn spring(&self, q: &Coordinates<S>) -> S {
        self.stiffness * (q.x[0] - q.x[1]).powi(2) / 2.0 + S::pi() * q.x[0]
    }
}

#[test]
fn where_clauses_and_other_parameters_are_kept() {
    let system = Labelled { stiffness: 4.0, label: "spring" };
    let a = system.accelerations(&State::at_rest([1.0, 0.5])).unwrap();
    all_close(a, [-2.0 - std::f64::consts::PI, 2.0], 1e-15);
    assert_eq!(system.label, "spring");
    let single = Labelled { stiffness: 4.0_f32, label: &String::from("other") };
    assert_eq!(single.accelerations(&State::at_rest([1.0, 0.5])).unwrap()[1], 2.0_f32);
}

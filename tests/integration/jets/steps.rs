//! Taylor steps of fixed order and length.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between};
use crate::support::motion::numbers;

/// A cart, a pole, and a motor; generic.
#[derive(Clone, Copy)]
struct CartPole<R> {
    cart: R,
    pole: R,
    length: R,
}

#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl<R: Real> CartPole<R> {
    #[point(mass = self.cart)]
    fn base(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, R::zero())
    }

    #[point(mass = self.pole)]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.base(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }

    #[potential]
    fn weight(&self, q: &Coordinates<R>) -> R {
        self.pole * 9.81 * self.tip(q).y
    }

    #[force(at = base)]
    fn motor(&self, v: &Velocities<R>, u: &Inputs<R>, t: R) -> Vector2<R> {
        Vector2::new(u.motor * (2.0 * t).cos() - 0.1 * v.x, R::zero())
    }
}

const CART_POLE: CartPole<f64> = CartPole { cart: 1.0, pole: 0.3, length: 0.8 };

/// No friction, no time.
struct DoublePendulum;

#[lagrangian(coordinates = [upper, lower])]
impl DoublePendulum {
    #[point(mass = 1.0)]
    fn elbow(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.upper.sin(), -q.upper.cos())
    }

    #[point(mass = 1.0)]
    fn hand(&self, q: &Coordinates) -> Vector2<f64> {
        self.elbow(q) + Vector2::new(q.lower.sin(), -q.lower.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (self.elbow(q).y + self.hand(q).y)
    }
}

const INPUT: [f64; 1] = [2.0];

fn start() -> State<f64, 2> {
    State::new([0.2, 1.0], [-0.3, 0.5]).at_time(0.4)
}

fn exact(system: &CartPole<f64>, t: f64) -> State<f64, 2> {
    let mut motion = system.simulate_with::<Dop853>(start()).with_tolerance(1e-15).with_inputs(INPUT);
    *motion.advance_to(0.4 + t).unwrap()
}

fn distance(a: &State<f64, 2>, b: &State<f64, 2>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// The largest error at each quarter of a time, forward or backward.
fn error<const ORDER: usize>(t: f64, steps: u32) -> f64 {
    let mut motion = CART_POLE.stepper::<Jet<ORDER>>(start());
    let mut largest = 0.0_f64;
    for quarter in 1..=4 {
        for _ in 0..steps / 4 {
            motion.step(t / f64::from(steps), &INPUT).unwrap();
        }
        largest = largest.max(distance(motion.state(), &exact(&CART_POLE, 0.25 * t * f64::from(quarter))));
    }
    largest
}

fn order<const ORDER: usize>(steps: u32) {
    for t in [1.0, -1.0] {
        let (coarse, fine) = (error::<ORDER>(t, steps), error::<ORDER>(t, 2 * steps));
        let measured = (coarse / fine).log2();
        println!("order {ORDER}: measured {measured:.2}, errors {coarse:.1e}, {fine:.1e}");
        between(ORDER as f64 - 0.6, measured, ORDER as f64 + 0.9);
    }
}

#[test]
fn steps_have_their_orders_in_both_directions() {
    order::<1>(3000);
    order::<2>(400);
    order::<3>(200);
    order::<4>(80);
    order::<5>(60);
    order::<6>(60);
    order::<8>(40);
    order::<12>(32);
}

#[test]
fn a_high_order_reaches_rounding_and_the_highest_does_no_harm() {
    for error in [error::<12>(1.0, 80), error::<20>(1.0, 40), error::<40>(1.0, 20)] {
        println!("error {error:.1e}");
        assert!(error < 2e-14, "{error:e}");
    }
}

#[test]
fn forward_and_backward_is_the_start() {
    let mut motion = CART_POLE.stepper::<Jet<16>>(start());
    for h in [0.02, -0.02] {
        for _ in 0..50 {
            motion.step(h, &INPUT).unwrap();
        }
    }
    all_close(numbers(motion.state()), numbers(&start()), 1e-13);
    assert_eq!(motion.state().t, start().t);
}

#[test]
fn a_step_of_no_length_changes_nothing() {
    let mut motion = CART_POLE.stepper::<Jet<6>>(start());
    motion.step(0.0, &INPUT).unwrap();
    assert_eq!(motion.state(), &start());
    assert_eq!(motion.step(f64::NAN, &INPUT).unwrap_err().cause, Cause::InvalidStep);
    assert_eq!(motion.step(0.1, &[f64::NAN]).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(motion.step(1e300, &INPUT).unwrap_err().cause, Cause::NotFinite);
    assert_eq!(motion.state(), &start());
    // A failed step leaves no trace.
    let mut fresh = CART_POLE.stepper::<Jet<6>>(start());
    assert_eq!(motion.step(0.1, &INPUT), fresh.step(0.1, &INPUT));
}

#[test]
fn inputs_are_held_over_each_step() {
    let plan = [[3.0], [-2.0], [0.0], [5.0]];
    let mut jet = CART_POLE.stepper::<Jet<14>>(start());
    let mut reference = CART_POLE.simulate_with::<Dop853>(start()).with_tolerance(1e-15);
    for (k, input) in plan.iter().enumerate() {
        jet.step(0.05, input).unwrap();
        reference.set_inputs(*input);
        reference.advance_to(start().t + 0.05 * (k + 1) as f64).unwrap();
        all_close(numbers(jet.state()), numbers(reference.state()), 1e-13);
    }
}

#[test]
fn order_four_is_better_than_runge_kutta_and_order_six_far_better() {
    let both = |steps: u32| {
        let h = 1.0 / f64::from(steps);
        let (mut rk4, mut jet) = (CART_POLE.stepper::<Rk4>(start()), CART_POLE.stepper::<Jet<6>>(start()));
        let mut four = CART_POLE.stepper::<Jet<4>>(start());
        for _ in 0..steps {
            rk4.step(h, &INPUT).unwrap();
            jet.step(h, &INPUT).unwrap();
            four.step(h, &INPUT).unwrap();
        }
        let exact = exact(&CART_POLE, 1.0);
        [rk4.state(), four.state(), jet.state()].map(|state| distance(state, &exact))
    };
    for steps in [100, 200] {
        let [rk4, four, six] = both(steps);
        println!("cart-pole, {steps} steps: RK4 {rk4:.1e}, order 4 {four:.1e}, order 6 {six:.1e}");
        assert!(four < 5.0 * rk4 && six < 1e-2 * rk4, "{rk4:e} {four:e} {six:e}");
    }
    let start = State::at_rest([1.5, 2.0]);
    let reference =
        DoublePendulum.simulate_with::<Dop853>(start).with_tolerance(1e-15).advance_to(2.0).copied();
    let reference = reference.unwrap();
    let (mut rk4, mut six) = (DoublePendulum.stepper::<Rk4>(start), DoublePendulum.stepper::<Jet<6>>(start));
    let mut four = DoublePendulum.stepper::<Jet<4>>(start);
    for _ in 0..200 {
        rk4.step(0.01, &[]).unwrap();
        four.step(0.01, &[]).unwrap();
        six.step(0.01, &[]).unwrap();
    }
    let [rk4, four, six] = [rk4.state(), four.state(), six.state()].map(|state| distance(state, &reference));
    println!("double pendulum: RK4 {rk4:.1e}, order 4 {four:.1e}, order 6 {six:.1e}");
    assert!(four < 5.0 * rk4 && six < 3e-2 * rk4, "{rk4:e} {four:e} {six:e}");
}

#[test]
fn single_precision_steps_keep_what_rounding_takes() {
    let single = CartPole::<f32> { cart: 1.0, pole: 0.3, length: 0.8 };
    let begin = State::new([0.2_f32, 1.0], [-0.3, 0.5]).at_time(0.4);
    let mut motion = single.stepper::<Jet<6>>(begin);
    let steps = 10_000;
    for _ in 0..steps {
        motion.step(1e-4, &[2.0]).unwrap();
    }
    let exact = exact(&CART_POLE, 1.0);
    // Plain sums would lose ten thousand rounding errors, a few times 1e-4.
    all_close(motion.state().q.map(f64::from), exact.q, 3e-6);
    all_close(motion.state().v.map(f64::from), exact.v, 3e-6);
}

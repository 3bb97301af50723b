//! The systems of all benchmarks, described to the macro and written by hand.

#[cfg(feature = "peers")]
pub mod andrews;
#[cfg(feature = "peers")]
pub mod car_axis;
pub mod constrained;
pub mod described;
#[cfg(feature = "peers")]
pub mod dual;
#[cfg(feature = "peers")]
pub mod first_order;
pub mod hand;
#[cfg(feature = "peers")]
pub mod multipliers;
pub mod number;

use std::cell::RefCell;
use std::hint::black_box;
use std::marker::PhantomData;

use lagrangian::System;

use crate::rhs::random_states;
use hand::ByHand as _;

/// A system with several implementations of its accelerations.
pub trait Case {
    /// Its name in all reports.
    fn name(&self) -> &'static str;
    /// The names of the implementations.
    fn subjects(&self) -> Vec<&'static str>;
    /// Evaluates one implementation at all states.
    fn run(&self, subject: usize);
    /// Panics where two implementations differ by more than rounding.
    fn check(&self);
}

/// Writes the accelerations at (t, q, v).
type Accelerations<const N: usize> = fn(f64, &[f64; N], &[f64; N], &mut [f64; N]);

struct Measured<S: System<N>, const N: usize> {
    name: &'static str,
    generated: S,
    constants: S::Constants,
    by_hand: Vec<(&'static str, Accelerations<N>)>,
    states: Vec<([f64; N], [f64; N])>,
    out: RefCell<Vec<[f64; N]>>,
}

#[inline(never)]
fn generated<S: System<N, Scalar = f64>, const N: usize>(
    system: &S,
    constants: &S::Constants,
    t: f64,
    q: &[f64; N],
    v: &[f64; N],
    out: &mut [f64; N],
) {
    *out = system.accelerations_at(constants, t, q, v, &[]);
}

impl<S: System<N, Scalar = f64>, const N: usize> Case for Measured<S, N> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn subjects(&self) -> Vec<&'static str> {
        std::iter::once("generated").chain(self.by_hand.iter().map(|(name, _)| *name)).collect()
    }

    fn run(&self, subject: usize) {
        let mut out = self.out.borrow_mut();
        let t = black_box(0.3);
        if subject == 0 {
            for ((q, v), out) in self.states.iter().zip(out.iter_mut()) {
                generated(&self.generated, &self.constants, t, q, v, out);
            }
        } else {
            let by_hand = self.by_hand[subject - 1].1;
            for ((q, v), out) in self.states.iter().zip(out.iter_mut()) {
                by_hand(t, q, v, out);
            }
        }
        black_box(&mut out);
    }

    fn check(&self) {
        let t = 0.3;
        for (q, v) in &self.states {
            let (mut ours, mut theirs) = ([0.0; N], [0.0; N]);
            generated(&self.generated, &self.constants, t, q, v, &mut ours);
            for (subject, by_hand) in &self.by_hand {
                by_hand(t, q, v, &mut theirs);
                let scale = ours.iter().fold(1.0_f64, |scale, a| scale.max(a.abs()));
                for (a, b) in ours.iter().zip(&theirs) {
                    assert!((a - b).abs() <= 1e-9 * scale, "{}: generated {a}, {subject} {b}", self.name);
                }
            }
        }
    }
}

fn measured<S: System<N, Scalar = f64>, const N: usize>(
    name: &'static str,
    system: S,
    by_hand: &[(&'static str, Accelerations<N>)],
    shift: impl Fn(usize, f64) -> f64,
) -> Measured<S, N> {
    let mut states = random_states::<N>();
    for (q, _) in &mut states {
        q.iter_mut().enumerate().for_each(|(i, q)| *q = shift(i, *q));
    }
    let constants = system.constants();
    let out = RefCell::new(vec![[0.0; N]; states.len()]);
    Measured { name, generated: system, constants, by_hand: by_hand.to_vec(), states, out }
}

/// Calls the visitor with every system.
pub fn for_each(visit: &mut dyn FnMut(&dyn Case)) {
    use described as d;
    use hand as h;
    // Coordinates start in (−1, 1); the shifts keep away from singular configurations.
    let same = |_: usize, q: f64| q;
    let polar = |i: usize, q: f64| if i == 0 { q + 2.0 } else { q };
    let tilted = |i: usize, q: f64| if i == 1 { 0.4 * q + 1.0 } else { q };
    let spherical = |i: usize, q: f64| if i == 0 { 0.4 * q + 1.0 } else { q };
    let spread = |i: usize, q: f64| q + 3.0 * (i % 7) as f64;
    visit(&measured(
        "dpend",
        d::DoublePendulum(PhantomData),
        &[("hand", h::DoublePendulum::accelerations)],
        same,
    ));
    visit(&measured(
        "spring",
        d::SpringPendulum(PhantomData),
        &[("hand", h::SpringPendulum::accelerations)],
        polar,
    ));
    visit(&measured("hh", d::HenonHeiles(PhantomData), &[("hand", h::HenonHeiles::accelerations)], same));
    visit(&measured("kepler", d::Kepler(PhantomData), &[("hand", h::Kepler::accelerations)], polar));
    visit(&measured("pleiades", d::Pleiades(PhantomData), &[("hand", h::Pleiades::accelerations)], spread));
    visit(&measured("top", d::Top(PhantomData), &[("hand", h::Top::accelerations)], tilted));
    visit(&measured(
        "sph",
        d::SphericalPendulum(PhantomData),
        &[("hand", h::SphericalPendulum::accelerations)],
        spherical,
    ));
    visit(&measured("cart", d::CartPole(PhantomData), &[("hand", h::CartPole::accelerations)], same));
    visit(&measured(
        "nlink3",
        d::Chain3(PhantomData),
        &[("hand", h::Dense::accelerations), ("hand_linear", h::Linear::accelerations)],
        same,
    ));
    visit(&measured(
        "nlink5",
        d::Chain5(PhantomData),
        &[("hand", h::Dense::accelerations), ("hand_linear", h::Linear::accelerations)],
        same,
    ));
    visit(&measured(
        "nlink10",
        d::Chain10(PhantomData),
        &[("hand", h::Dense::accelerations), ("hand_linear", h::Linear::accelerations)],
        same,
    ));
    visit(&measured(
        "nlink20",
        d::Chain20(PhantomData),
        &[("hand", h::Dense::accelerations), ("hand_linear", h::Linear::accelerations)],
        same,
    ));
}

//! The systems of all benchmarks, described to the macro and written by hand.

#[cfg(feature = "peers")]
pub mod andrews;
#[cfg(feature = "peers")]
pub mod car_axis;
pub mod chains;
pub mod constrained;
pub mod described;
#[cfg(feature = "peers")]
pub mod dual;
#[cfg(feature = "peers")]
pub mod first_order;
pub mod hand;
pub mod long;
#[cfg(feature = "peers")]
pub mod multipliers;
pub mod number;
pub mod rods;

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
    /// How many states one run evaluates.
    fn states(&self) -> usize;
    /// The names of the implementations.
    fn subjects(&self) -> Vec<&'static str>;
    /// Evaluates one implementation at all states.
    fn run(&self, subject: usize);
    /// For each implementation the largest distance from another one, relative to the largest acceleration of
    /// a state.
    fn deviations(&self) -> Vec<f64>;
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

    fn states(&self) -> usize {
        self.states.len()
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

    fn deviations(&self) -> Vec<f64> {
        let t = 0.3;
        let mut deviations = vec![0.0_f64; 1 + self.by_hand.len()];
        let mut found = vec![[0.0; N]; deviations.len()];
        for (q, v) in &self.states {
            generated(&self.generated, &self.constants, t, q, v, &mut found[0]);
            for ((_, by_hand), found) in self.by_hand.iter().zip(&mut found[1..]) {
                by_hand(t, q, v, found);
            }
            let scale = found.iter().flatten().fold(0.0_f64, |scale, a| scale.max(a.abs()));
            for (one, deviation) in found.iter().zip(&mut deviations) {
                for (a, b) in found.iter().flat_map(|other| one.iter().zip(other)) {
                    let apart = (a - b).abs() / scale;
                    // `f64::max` would hide NaN.
                    if apart.is_nan() || apart > *deviation {
                        *deviation = apart;
                    }
                }
            }
        }
        deviations
    }
}

/// The number of states: so many that no call is predicted, so few that other processes do not interrupt all
/// runs.
fn states_of(coordinates: usize) -> usize {
    if coordinates <= 20 { 512 } else { 4 }
}

fn measured<S: System<N, Scalar = f64>, const N: usize>(
    name: &'static str,
    system: S,
    by_hand: &[(&'static str, Accelerations<N>)],
    shift: impl Fn(usize, f64) -> f64,
) -> Measured<S, N> {
    let mut states = random_states::<N>(states_of(N));
    for (q, _) in &mut states {
        q.iter_mut().enumerate().for_each(|(i, q)| *q = shift(i, *q));
    }
    measured_at(name, system, by_hand, states)
}

fn measured_at<S: System<N, Scalar = f64>, const N: usize>(
    name: &'static str,
    system: S,
    by_hand: &[(&'static str, Accelerations<N>)],
    states: Vec<([f64; N], [f64; N])>,
) -> Measured<S, N> {
    let constants = system.constants();
    let out = RefCell::new(vec![[0.0; N]; states.len()]);
    Measured { name, generated: system, constants, by_hand: by_hand.to_vec(), states, out }
}

/// Calls the visitor with every system.
pub fn for_each(visit: &mut dyn FnMut(&dyn Case)) {
    use chains as c;
    use described as d;
    use hand as h;
    use rods as r;
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
    macro_rules! chain {
        ($name:literal, $system:expr) => {
            visit(&measured(
                $name,
                $system,
                &[
                    ("hand", c::Dense::accelerations),
                    ("hand-tensions", c::Tensions::accelerations),
                    ("hand-recursive", c::Recursive::accelerations),
                ],
                same,
            ));
        };
    }
    chain!("nlink3", d::Chain3(PhantomData));
    chain!("nlink5", d::Chain5(PhantomData));
    chain!("nlink10", d::Chain10(PhantomData));
    chain!("nlink20", d::Chain20(PhantomData));
    chain!("nlink50", long::Chain50);
    chain!("nlink100", long::Chain100);
    macro_rules! rods {
        ($name:literal, $system:ident, $rods:literal) => {
            visit(&measured_at(
                $name,
                long::$system,
                &[
                    ("hand", r::DenseRods::<$rods>::accelerations),
                    ("hand-recursive", r::Tridiagonal::<$rods>::accelerations),
                ],
                random_states::<$rods>(states_of($rods)).iter().map(hanging).collect(),
            ));
        };
    }
    rods!("rods20", Rods20, 20);
    rods!("rods100", Rods100, 100);
}

/// The ends of unit rods and their velocities, from angles and angular velocities.
fn hanging<const RODS: usize, const N: usize>((q, v): &([f64; RODS], [f64; RODS])) -> ([f64; N], [f64; N]) {
    const { assert!(N == 2 * RODS, "two coordinates a rod") };
    let (mut ends, mut velocities) = ([0.0; N], [0.0; N]);
    let (mut end, mut velocity) = ([0.0; 2], [0.0; 2]);
    for i in 0..RODS {
        let (s, c) = q[i].sin_cos();
        end = [end[0] + s, end[1] - c];
        velocity = [velocity[0] + c * v[i], velocity[1] + s * v[i]];
        [ends[i], ends[RODS + i]] = end;
        [velocities[i], velocities[RODS + i]] = velocity;
    }
    (ends, velocities)
}

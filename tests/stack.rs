//! Analyses of a hundred coordinates on the stack of a thread that nobody asked to be larger, 2 MiB, and on 3
//! MiB in code that is not optimised.

// Descriptions index as their formulas do.
#![allow(clippy::needless_range_loop)]

use std::thread;

use lagrangian::{Stability, prelude::*};

/// The stack of a new thread. Without optimisation the factors of the saddle-point system are copied from
/// frame to frame.
const STACK: usize = if cfg!(debug_assertions) { 3 << 20 } else { 2 << 20 };

/// Points on a chain of fifty rods.
macro_rules! chain {
    ($name:ident { $($more:item)* }) => {
        struct $name;

        #[lagrangian(coordinates = [x: [50], y: [50]], jacobians)]
        impl $name {
            #[point(mass = 0.1)]
            fn points(&self, q: &Coordinates) -> [Vector2<f64>; 50] {
                core::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
            }

            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 {
                q.y.iter().map(|y| 0.981 * y).sum()
            }

            #[holonomic]
            fn rods(&self, q: &Coordinates) -> [f64; 50] {
                core::array::from_fn(|i| {
                    let (x, y) = if i == 0 { (0.0, 0.0) } else { (q.x[i - 1], q.y[i - 1]) };
                    (q.x[i] - x).powi(2) + (q.y[i] - y).powi(2) - 0.04
                })
            }

            $($more)*
        }
    };
}

chain!(Loose {});
// In a straight line one angle is left.
chain!(Stiff {
    #[holonomic]
    fn straight(&self, q: &Coordinates) -> [f64; 49] {
        core::array::from_fn(|i| q.x[i] * q.y[i + 1] - q.y[i] * q.x[i + 1])
    }
});

/// At an angle from straight down.
fn straight(angle: f64) -> [f64; 100] {
    core::array::from_fn(|i| {
        let length = 0.2 * (i % 50 + 1) as f64;
        if i < 50 { length * angle.sin() } else { -length * angle.cos() }
    })
}

fn on_a_small_stack(work: impl FnOnce() + Send + 'static) {
    thread::Builder::new().stack_size(STACK).spawn(work).unwrap().join().unwrap();
}

#[test]
fn a_hundred_coordinates_with_ninety_nine_constraints() {
    on_a_small_stack(|| {
        let rest = Stiff.equilibrium(straight(0.3), &[]).unwrap();
        assert_eq!(rest.stability, Stability::Stable);
        assert!((rest.state.q[99] + 10.0).abs() < 1e-12, "{}", rest.state.q[99]);
    });
    on_a_small_stack(|| {
        let state = State::at_rest(straight(0.0));
        assert_eq!(Stiff.linearize(&state, &[]).unwrap().order(), 2);
        let modes = Stiff.modes(&state, &[]).unwrap();
        // ω² = g Σ n / (l Σ n²) = 3 g / (l (2 N + 1)).
        let frequency = (3.0 * 9.81 / (0.2 * 101.0_f64)).sqrt();
        assert!((modes[0].frequency() - frequency).abs() < 1e-10, "{modes:?}");
    });
}

#[test]
fn a_hundred_coordinates_with_fifty_constraints() {
    on_a_small_stack(|| {
        let state = State::at_rest(straight(0.0));
        assert_eq!(Loose.linearize(&state, &[]).unwrap().order(), 100);
        let modes = Loose.modes(&state, &[]).unwrap();
        // A heavy chain of many links: ω = 1.2024 √(g / L), half the first zero of J₀ (D. Bernoulli, 1733),
        // and more by some 1 / 4 N.
        let continuous = 1.202_412_8 * (9.81_f64 / 10.0).sqrt();
        assert!((0.98..1.02).contains(&(modes[0].frequency() / continuous)), "{}", modes[0].frequency());
    });
}

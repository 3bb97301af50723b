//! Scopes in which names mean something else, nothing at all, or no warning is tolerated.

use lagrangian::prelude::*;

use crate::support::close::all_close;

/// A scope where every name that an expansion could lean on means something else.
mod hostile {
    #![allow(dead_code, non_camel_case_types, unused_macros)]

    use ::lagrangian::lagrangian;

    pub struct Option;
    pub struct Result;
    pub struct Some;
    pub struct Ok;
    pub struct Err;
    pub struct Vec;
    pub struct Box;
    pub struct String;
    pub struct Copy;
    pub struct Clone;
    pub struct Debug;
    pub struct From;
    pub struct Into;
    pub struct Default;
    pub struct State;
    pub struct System;
    pub struct Real;
    pub struct MotionError;
    pub struct Cause;
    pub struct SMatrix;
    pub mod core {}
    pub mod std {}
    pub mod lagrangian {}
    pub mod lagrange {}
    pub mod lagrange_runtime {}
    pub mod nalgebra {}
    pub type f64 = ::core::primitive::f64;
    macro_rules! vec {
        () => {
            compile_error!("not this one")
        };
    }
    macro_rules! assert {
        () => {
            compile_error!("not this one")
        };
    }

    /// A trait whose methods look like those of the scalar.
    pub trait Elementary {
        fn sin_cos(self) -> (f64, f64);
        fn sqrt(self) -> f64;
        fn solve(self) -> f64;
    }

    impl Elementary for f64 {
        fn sin_cos(self) -> (f64, f64) {
            (7.0, 7.0)
        }
        fn sqrt(self) -> f64 {
            7.0
        }
        fn solve(self) -> f64 {
            7.0
        }
    }

    pub struct Pendulum {
        pub length: f64,
    }

    #[lagrangian(coordinates = [theta, r])]
    impl Pendulum {
        #[point(mass = 1.0)]
        fn bob(&self, q: &Coordinates) -> ::nalgebra::Vector2<f64> {
            ::nalgebra::Vector2::new(q.theta.sin(), -q.theta.cos()) * q.r
        }

        #[potential]
        fn energy_of_place(&self, q: &Coordinates) -> f64 {
            9.81 * self.bob(q).y + 50.0 * (q.r - self.length).powi(2) + (1.0 + q.r * q.r).sqrt()
        }
    }
}

#[test]
fn a_hostile_scope_changes_nothing() {
    let state = State::new([0.5, 1.25], [0.3, -0.2]);
    let found = hostile::Pendulum { length: 1.0 }.accelerations(&state).unwrap();
    let spring = -100.0 * 0.25 - 1.25 / (1.0 + 1.25_f64.powi(2)).sqrt();
    let expected =
        [(-9.81 * 0.5_f64.sin() + 2.0 * 0.2 * 0.3) / 1.25, 9.81 * 0.5_f64.cos() + 1.25 * 0.09 + spring];
    all_close(found, expected, 1e-14);
}

/// A scope with nothing but the language itself.
mod bare {
    #![no_implicit_prelude]

    use ::lagrangian::lagrangian;

    pub struct Oscillator {
        pub k: f64,
    }

    #[lagrangian(coordinates = [x: [2]], inputs = [push])]
    impl Oscillator {
        #[kinetic]
        fn kinetic(&self, v: &Velocities) -> f64 {
            0.5 * (v.x[0] * v.x[0] + v.x[1] * v.x[1] + v.x[0] * v.x[1])
        }

        #[potential]
        fn spring(&self, q: &Coordinates) -> f64 {
            0.5 * self.k * (q.x[0] - q.x[1]).powi(2)
        }

        #[force(on = x[0])]
        fn push(&self, u: &Inputs) -> f64 {
            u.push
        }
    }

    /// The same in a generic scalar, beside a trait that offers its functions to everything.
    pub struct Generic<R> {
        pub k: R,
    }

    #[allow(dead_code)]
    pub trait Everything: ::core::marker::Sized {
        fn sin(self) -> Self {
            self
        }
        fn sqrt(self) -> Self {
            self
        }
        fn from_f64(_: f64) -> u8 {
            0
        }
    }

    impl<T> Everything for T {}

    #[lagrangian(coordinates = [x])]
    impl<R: ::lagrangian::Real> Generic<R> {
        #[kinetic]
        fn kinetic(&self, v: &Velocities<R>) -> R {
            0.5 * v.x * v.x
        }

        #[potential]
        fn spring(&self, q: &Coordinates<R>) -> R {
            self.k * (1.0 - ::lagrangian::Real::cos(q.x))
        }
    }
}

#[test]
fn a_module_without_the_prelude_can_hold_a_system() {
    let system = bare::Oscillator { k: 2.0 };
    let found = system.accelerations(&State::at_rest([1.0, 0.5]), &[3.0]).unwrap();
    // M = [[1, 1/2], [1/2, 1]], f = (3 − 1, 1).
    all_close(found, [2.0, 0.0], 1e-15);
    let generic = bare::Generic { k: 2.0_f32 };
    let [a] = generic.accelerations(&State::at_rest([0.5])).unwrap();
    all_close([f64::from(a)], [-2.0 * 0.5_f64.sin()], 1e-6);
}

/// A module that tolerates no warning: the expansion gives none.
mod strict {
    #![deny(warnings, unused, nonstandard_style, unsafe_code)]
    #![deny(missing_docs, missing_debug_implementations, missing_copy_implementations, single_use_lifetimes)]
    #![deny(trivial_casts, trivial_numeric_casts, unused_qualifications, unused_results, unused_lifetimes)]
    #![deny(clippy::all)]

    use lagrangian::prelude::*;

    /// A pendulum on a cart.
    #[derive(Clone, Copy, Debug)]
    pub struct Strict<R> {
        /// Length.
        pub l: R,
    }

    #[lagrangian(coordinates = [x, theta: [1]], inputs = [push])]
    impl<R: Real> Strict<R> {
        #[point(mass = 2.0)]
        fn cart(&self, q: &Coordinates<R>) -> R {
            q.x
        }

        #[point(mass = 1.0)]
        fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
            Vector2::new(self.cart(q) + self.l * q.theta[0].sin(), -self.l * q.theta[0].cos())
        }

        #[potential]
        fn gravity(&self, q: &Coordinates<R>, _t: R) -> R {
            9.81 * self.bob(q).y
        }

        #[dissipation]
        fn friction(&self, v: &Velocities<R>) -> R {
            v.x.powi(2)
        }

        #[force(at = cart)]
        fn push(&self, u: &Inputs<R>) -> R {
            u.push
        }
    }
}

#[test]
fn an_expansion_gives_no_warnings() {
    let system = strict::Strict { l: 2.0 };
    let [cart, bob] = system.accelerations(&State::at_rest([0.0, 0.0]), &[4.0]).unwrap();
    all_close([cart, bob], [2.0, -1.0], 1e-15);
}

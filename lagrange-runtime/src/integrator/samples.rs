//! Systems with a closed solution, for the tests of the integrators.

use crate::system::System;
use crate::system::error::Cause;
use crate::system::state::State;

/// Systems of `f64` without constants: accelerations and energy as expressions.
macro_rules! system {
    ($name:ident, $n:literal, $k:literal, |$t:ident, $q:ident, $v:ident, $u:ident| $a:expr, $energy:expr) => {
        system!($name, $n, $k, |$t, $q, $v, $u| $a, $energy, {
            let _ = $q;
            Ok(())
        });
    };
    ($name:ident, $n:literal, $k:literal, |$t:ident, $q:ident, $v:ident, $u:ident| $a:expr, $energy:expr, $check:expr) => {
        pub(crate) struct $name;

        impl System<$n, $k> for $name {
            type Scalar = f64;
            type Method = crate::integrator::Dop853;
            type Constants = ();

            fn constants(&self) {}

            fn accelerations_at(
                &self,
                (): &(),
                $t: f64,
                $q: &[f64; $n],
                #[allow(unused_variables)] $v: &[f64; $n],
                $u: &[f64; $k],
            ) -> [f64; $n] {
                $a
            }

            fn check_at(&self, (): &(), _: f64, $q: &[f64; $n], _: &[f64; $n]) -> Result<(), Cause> {
                $check
            }

            fn energy_at(&self, (): &(), _: f64, $q: &[f64; $n], $v: &[f64; $n]) -> f64 {
                $energy
            }
        }
    };
}

// q = cos t from (1, 0), with a force as input.
system!(Oscillator, 1, 1, |_t, q, v, u| [u[0] - q[0]], 0.5 * (v[0] * v[0] + q[0] * q[0]));

// Two bodies, a = μ = 1.
system!(
    Kepler,
    2,
    0,
    |_t, q, v, _u| {
        let r = q[0].hypot(q[1]);
        [-q[0] / (r * r * r), -q[1] / (r * r * r)]
    },
    0.5 * (v[0] * v[0] + v[1] * v[1]) - 1.0 / q[0].hypot(q[1])
);

// q = exp(sin t): linear, but driven by time in every term.
system!(Driven, 1, 0, |t, q, v, _u| [t.cos() * v[0] - t.sin() * q[0]], 0.5 * v[0] * v[0] + q[0]);

// q = 1/(1 − t) from (1, 1): infinite at t = 1.
system!(BlowUp, 1, 0, |_t, q, v, _u| [2.0 * q[0] * q[0] * q[0]], 0.5 * v[0] * v[0] - 0.5 * q[0].powi(4));

// Free motion until the mass is gone at q = 2.
system!(
    Vanishing,
    1,
    0,
    |_t, q, v, _u| [if q[0] < 2.0 { 0.0 } else { f64::NAN }],
    0.5 * v[0] * v[0] + 0.0 * q[0],
    if q[0] < 2.0 {
        Ok(())
    } else {
        Err(Cause::SingularMassMatrix { pivot: 0, name: crate::system::name::Name::NONE })
    }
);

// Free motion until the force has no value at q = 2.
system!(
    Undefined,
    1,
    0,
    |_t, q, v, _u| [if q[0] < 2.0 { 0.0 } else { f64::NAN }],
    0.5 * v[0] * v[0] + 0.0 * q[0]
);

/// The pericentre of an orbit with eccentricity `e`; one period is 2π.
pub(crate) fn pericentre(e: f64) -> State<f64, 2> {
    State::new([1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
}

/// The exact state of [`Driven`].
pub(crate) fn driven(t: f64) -> State<f64, 1> {
    State::new([t.sin().exp()], [t.cos() * t.sin().exp()]).at_time(t)
}

/// Largest difference of coordinates and velocities.
pub(crate) fn distance<const N: usize>(a: &State<f64, N>, b: &State<f64, N>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

//! Constrained systems written by hand.

use core::cell::Cell;

use super::{Equations, Footing, Residuals, Surface};
use crate::integrator::Dop853;
use crate::linear::{Diagonal, Saddle};
use crate::number::elements::Each;
use crate::system::System;
use crate::system::error::Cause;
use crate::system::state::State;

/// A pendulum of length 1 whose rod is asked for twice: by its length and by the square of it.
pub(crate) struct Twofold {
    /// How often M and A were factored.
    pub(crate) factored: Cell<usize>,
}

impl System<2> for Twofold {
    type Scalar = f64;
    type Method = Dop853;
    type Constants = ();

    const CONSTRAINED: bool = true;
    const COUPLED: bool = true;
    const CONSERVES_ENERGY: bool = true;

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), t: f64, q: &[f64; 2], v: &[f64; 2], u: &[f64; 0]) -> [f64; 2] {
        super::accelerations(self, &(), t, q, v, u)
    }

    fn project_at(
        &self,
        (): &(),
        state: &mut State<f64, 2>,
        from: Option<&State<f64, 2>>,
    ) -> Result<(), Cause> {
        super::project(self, state, from)
    }

    fn land_at(
        &self,
        constants: &(),
        state: &mut State<f64, 2>,
        inputs: Option<&[f64; 0]>,
    ) -> Result<Footing<f64, 2>, Cause> {
        super::land(self, constants, state, inputs)
    }

    fn energy_at(&self, (): &(), _: f64, q: &[f64; 2], v: &[f64; 2]) -> f64 {
        0.5 * (v[0] * v[0] + v[1] * v[1]) + 9.81 * q[1]
    }
}

impl Surface<2, 0, 2> for Twofold {
    type Saddle = Saddle<f64, 2, 2>;

    fn equations_at(
        &self,
        (): &(),
        t: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        _: &[f64; 0],
    ) -> Equations<Self::Saddle, f64, 2, 2> {
        let (saddle, gradients) = self.saddle_at(t, q, v);
        let speed = v[0] * v[0] + v[1] * v[1];
        let length = q[0].hypot(q[1]);
        let rate = (q[0] * v[0] + q[1] * v[1]) / length;
        let gamma = [(rate * rate - speed) / length, -2.0 * speed];
        Equations { saddle, gradients, forces: [0.0, -9.81], gamma }
    }

    fn residuals_at(&self, _: f64, q: &[f64; 2], v: &[f64; 2]) -> Residuals<f64, 2> {
        let length = q[0].hypot(q[1]);
        let rate = q[0] * v[0] + q[1] * v[1];
        let size = (q[0] * v[0]).abs() + (q[1] * v[1]).abs();
        Residuals {
            positions: [length - 1.0, length * length - 1.0],
            position_sizes: [length + 1.0, length * length + 1.0],
            rates: [rate / length, 2.0 * rate],
            rate_sizes: [size / length, 2.0 * size],
        }
    }

    fn saddle_at(&self, _: f64, q: &[f64; 2], _: &[f64; 2]) -> (Self::Saddle, [[f64; 2]; 2]) {
        self.factored.set(self.factored.get() + 1);
        let length = q[0].hypot(q[1]);
        let gradients = [q.each(|x| x / length), q.each(|x| 2.0 * x)];
        (Saddle::factor(&[[1.0, 0.0], [0.0, 1.0]], &gradients), gradients)
    }
}

/// A pendulum of length 1 with one row, ½ (x² + y² − 1) = 0.
pub(crate) struct Rod;

impl System<2> for Rod {
    type Scalar = f64;
    type Method = Dop853;
    type Constants = ();

    const CONSTRAINED: bool = true;

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), t: f64, q: &[f64; 2], v: &[f64; 2], u: &[f64; 0]) -> [f64; 2] {
        super::accelerations(self, &(), t, q, v, u)
    }

    fn energy_at(&self, (): &(), _: f64, q: &[f64; 2], v: &[f64; 2]) -> f64 {
        0.5 * (v[0] * v[0] + v[1] * v[1]) + 9.81 * q[1]
    }
}

impl Surface<2, 0, 1> for Rod {
    type Saddle = Diagonal<f64, 2, 1>;

    fn equations_at(
        &self,
        (): &(),
        t: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        _: &[f64; 0],
    ) -> Equations<Self::Saddle, f64, 2, 1> {
        let (saddle, gradients) = self.saddle_at(t, q, v);
        Equations { saddle, gradients, forces: [0.0, -9.81], gamma: [-(v[0] * v[0] + v[1] * v[1])] }
    }

    fn residuals_at(&self, _: f64, q: &[f64; 2], v: &[f64; 2]) -> Residuals<f64, 1> {
        let sum =
            |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] + a[1] * b[1], (a[0] * b[0]).abs() + (a[1] * b[1]).abs()];
        let ([square, _], [rate, size]) = (sum(*q, *q), sum(*q, *v));
        Residuals {
            positions: [0.5 * (square - 1.0)],
            position_sizes: [0.5 * (square + 1.0)],
            rates: [rate],
            rate_sizes: [size],
        }
    }

    fn saddle_at(&self, _: f64, q: &[f64; 2], _: &[f64; 2]) -> (Self::Saddle, [[f64; 2]; 1]) {
        (Diagonal::factor([1.0; 2], &[*q]), [*q])
    }
}

/// A point that slides along x, under y = 0 and y + x z = 0: rows that depend on each other at x = 0.
pub(crate) struct Fold;

impl System<3> for Fold {
    type Scalar = f64;
    type Method = Dop853;
    type Constants = ();

    const CONSTRAINED: bool = true;
    const COUPLED: bool = true;

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), t: f64, q: &[f64; 3], v: &[f64; 3], u: &[f64; 0]) -> [f64; 3] {
        super::accelerations(self, &(), t, q, v, u)
    }

    fn land_at(
        &self,
        constants: &(),
        state: &mut State<f64, 3>,
        inputs: Option<&[f64; 0]>,
    ) -> Result<Footing<f64, 3>, Cause> {
        super::land(self, constants, state, inputs)
    }

    fn energy_at(&self, (): &(), _: f64, _: &[f64; 3], v: &[f64; 3]) -> f64 {
        0.5 * v.iter().map(|v| v * v).sum::<f64>()
    }
}

impl Surface<3, 0, 2> for Fold {
    type Saddle = Saddle<f64, 3, 2>;

    fn equations_at(
        &self,
        (): &(),
        t: f64,
        q: &[f64; 3],
        v: &[f64; 3],
        _: &[f64; 0],
    ) -> Equations<Self::Saddle, f64, 3, 2> {
        let (saddle, gradients) = self.saddle_at(t, q, v);
        Equations { saddle, gradients, forces: [0.0; 3], gamma: [0.0, -2.0 * v[0] * v[2]] }
    }

    fn residuals_at(&self, _: f64, &[x, y, z]: &[f64; 3], v: &[f64; 3]) -> Residuals<f64, 2> {
        let (along, across) = (z * v[0], v[1] + x * v[2]);
        Residuals {
            positions: [y, y + x * z],
            position_sizes: [y.abs(), y.abs() + (x * z).abs()],
            rates: [v[1], across + along],
            rate_sizes: [v[1].abs(), v[1].abs() + (x * v[2]).abs() + along.abs()],
        }
    }

    fn saddle_at(&self, _: f64, &[x, _, z]: &[f64; 3], _: &[f64; 3]) -> (Self::Saddle, [[f64; 3]; 2]) {
        let gradients = [[0.0, 1.0, 0.0], [z, 1.0, x]];
        let mass = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        (Saddle::factor(&mass, &gradients), gradients)
    }
}

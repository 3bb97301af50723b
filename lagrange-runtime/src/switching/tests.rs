//! Motions with closed solutions, on systems written by hand.

// Digits are those of the references.
#![allow(clippy::excessive_precision)]

mod friction;
mod impacts;
mod kinks;

use super::{Functions, Hybrid, Laws, Regime, Row, Switching, Wanted};
use crate::constraints::{self, Equations, Footing, Residuals, Surface};
use crate::integrator::Dop853;
use crate::linear::Switched;
use crate::motion::simulation::Simulation;
use crate::number::real::Real;
use crate::system::System;
use crate::system::control::Held;
use crate::system::error::Cause;
use crate::system::state::State;

/// A system with constant gradients: rows are A q + b, their rates A v + c.
trait Toy<const N: usize, const C: usize, const W: usize>: Copy + core::fmt::Debug {
    const ROWS: [Row; C];

    fn mass(&self) -> [f64; N];
    fn forces(&self, t: f64, q: &[f64; N], v: &[f64; N], kinks: &[f64; W]) -> [f64; N];
    fn gradients(&self) -> [[f64; N]; C];

    fn offsets(&self) -> [f64; C] {
        [0.0; C]
    }

    fn drift(&self) -> [f64; C] {
        [0.0; C]
    }

    fn restitution(&self) -> [f64; C] {
        [0.0; C]
    }

    fn kinetic(&self) -> [f64; C] {
        [0.0; C]
    }

    fn fixed(&self) -> [f64; C] {
        self.kinetic()
    }

    fn kinks<R: Real>(&self, _q: &[R; N], _v: &[R; N]) -> [R; W] {
        [R::zero(); W]
    }
}

#[derive(Clone, Copy, Debug)]
struct Model<T, const N: usize, const C: usize, const W: usize>(T);

#[derive(Clone, Copy, Debug)]
struct InRegime<T, const N: usize, const C: usize, const W: usize> {
    toy: T,
    regime: Regime<f64, C, W>,
}

type Motion<'a, T, const N: usize, const C: usize, const W: usize> =
    Simulation<'a, Model<T, N, C, W>, Held<f64, 0>, Hybrid<Dop853, C, W>, N, 0>;

/// b + Σ aᵢ xᵢ and |b| + Σ |aᵢ xᵢ|, with b = `more`.
fn sums<const N: usize>(a: &[f64; N], x: &[f64; N], more: f64) -> (f64, f64) {
    a.iter().zip(x).fold((more, more.abs()), |(sum, size), (a, x)| (sum + a * x, size + (a * x).abs()))
}

impl<T: Toy<N, C, W>, const N: usize, const C: usize, const W: usize> Model<T, N, C, W> {
    fn start(&self, q: [f64; N], v: [f64; N]) -> Motion<'_, T, N, C, W> {
        self.simulate(State::new(q, v)).with_tolerance(1e-13)
    }

    fn residuals(&self, q: &[f64; N], v: &[f64; N]) -> Residuals<f64, C> {
        let (gradients, offsets, drift) = (self.0.gradients(), self.0.offsets(), self.0.drift());
        let rates: [(f64, f64); C] = core::array::from_fn(|row| sums(&gradients[row], v, drift[row]));
        let gaps: [(f64, f64); C] = core::array::from_fn(|row| match T::ROWS[row] {
            Row::Friction { .. } => (0.0, 0.0),
            _ => sums(&gradients[row], q, offsets[row]),
        });
        Residuals {
            positions: gaps.map(|(gap, _)| gap),
            position_sizes: gaps.map(|(_, size)| size),
            rates: rates.map(|(rate, _)| rate),
            rate_sizes: rates.map(|(_, size)| size),
        }
    }
}

impl<T: Toy<N, C, W>, const N: usize, const C: usize, const W: usize> System<N> for Model<T, N, C, W> {
    type Scalar = f64;
    type Method = Hybrid<Dop853, C, W>;
    type Constants = ();
    const SWITCHED: bool = true;

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), t: f64, q: &[f64; N], v: &[f64; N], u: &[f64; 0]) -> [f64; N] {
        super::accelerations::<Self, N, 0, C, W>(self, t, q, v, u)
    }

    fn energy_at(&self, (): &(), _: f64, _: &[f64; N], v: &[f64; N]) -> f64 {
        self.0.mass().iter().zip(v).map(|(m, v)| 0.5 * m * v * v).sum()
    }
}

impl<T: Toy<N, C, W>, const N: usize, const C: usize, const W: usize> Switching<N, 0, C, W>
    for Model<T, N, C, W>
{
    type InRegime = InRegime<T, N, C, W>;
    const ROWS: [Row; C] = T::ROWS;

    fn in_regime(&self, regime: &Regime<f64, C, W>) -> Self::InRegime {
        InRegime { toy: self.0, regime: *regime }
    }

    fn laws_at(&self, _: f64, q: &[f64; N], v: &[f64; N], _: &[f64; 0]) -> Laws<f64, C, W> {
        let kinks = self.0.kinks(q, v);
        Laws {
            rows: self.residuals(q, v),
            restitution: self.0.restitution(),
            kinetic: self.0.kinetic(),
            fixed: self.0.fixed(),
            kinks,
            kink_sizes: kinks.map(f64::abs),
        }
    }

    fn functions_in<R: Real>(
        in_regime: &Self::InRegime,
        number: impl Fn(f64) -> R,
        _: R,
        q: &[R; N],
        v: &[R; N],
        _: &[R; 0],
        _: &Wanted<C, W>,
    ) -> Functions<R, C, W> {
        let toy = &in_regime.toy;
        let (gradients, offsets, drift) = (toy.gradients(), toy.offsets(), toy.drift());
        let sum = |row: usize, x: &[R; N], more: [f64; C]| {
            (0..N).fold(number(more[row]), |sum, i| sum + number(gradients[row][i]) * x[i])
        };
        let rows = core::array::from_fn(|row| match T::ROWS[row] {
            Row::Friction { .. } => sum(row, v, drift),
            _ => sum(row, q, offsets),
        });
        Functions { rows, fixed: toy.fixed().map(number), kinks: toy.kinks(q, v) }
    }

    fn equations_in(
        in_regime: &Self::InRegime,
        t: f64,
        q: &[f64; N],
        v: &[f64; N],
        u: &[f64; 0],
    ) -> Option<Equations<Switched<f64, N, C>, f64, N, C>> {
        Some(in_regime.equations_at(&(), t, q, v, u))
    }
}

impl<T: Toy<N, C, W>, const N: usize, const C: usize, const W: usize> System<N> for InRegime<T, N, C, W> {
    type Scalar = f64;
    type Method = Dop853;
    type Constants = ();
    const CONSTRAINED: bool = C > 0;
    const COUPLED: bool = C > 1;

    fn constants(&self) {}

    fn accelerations_at(&self, (): &(), t: f64, q: &[f64; N], v: &[f64; N], u: &[f64; 0]) -> [f64; N] {
        self.balance_at(&(), t, q, v, u).accelerations
    }

    fn begin_at(&self, (): &(), start: &mut State<f64, N>) -> Result<(), Cause> {
        constraints::begin::<Self, N, 0, C>(self, start)
    }

    fn project_at(
        &self,
        (): &(),
        state: &mut State<f64, N>,
        from: Option<&State<f64, N>>,
    ) -> Result<(), Cause> {
        constraints::project::<Self, N, 0, C>(self, state, from)
    }

    fn land_at(
        &self,
        constants: &(),
        state: &mut State<f64, N>,
        inputs: Option<&[f64; 0]>,
    ) -> Result<Footing<f64, N>, Cause> {
        constraints::land::<Self, N, 0, C>(self, constants, state, inputs)
    }

    fn tangential_at(&self, state: &State<f64, N>, change: &State<f64, N>) -> State<f64, N> {
        constraints::tangential::<Self, N, 0, C>(self, state, change)
    }

    fn energy_at(&self, (): &(), _: f64, _: &[f64; N], v: &[f64; N]) -> f64 {
        self.toy.mass().iter().zip(v).map(|(m, v)| 0.5 * m * v * v).sum()
    }
}

impl<T: Toy<N, C, W>, const N: usize, const C: usize, const W: usize> Surface<N, 0, C>
    for InRegime<T, N, C, W>
{
    type Saddle = Switched<f64, N, C>;

    fn equations_at(
        &self,
        (): &(),
        t: f64,
        q: &[f64; N],
        v: &[f64; N],
        _: &[f64; 0],
    ) -> Equations<Self::Saddle, f64, N, C> {
        let (saddle, gradients) = self.saddle_at(t, q, v);
        let mut forces = self.toy.forces(t, q, v, &self.regime.kinks);
        let slopes = self.toy.gradients();
        for (row, kind) in T::ROWS.iter().enumerate() {
            if let Row::Friction { normal: None, .. } = kind {
                let force = self.toy.kinetic()[row] * self.regime.slip[row];
                forces.iter_mut().zip(slopes[row]).for_each(|(sum, slope)| *sum -= force * slope);
            }
        }
        Equations { saddle, gradients, forces, gamma: [0.0; C] }
    }

    fn residuals_at(&self, _: f64, q: &[f64; N], v: &[f64; N]) -> Residuals<f64, C> {
        let all = Model(self.toy).residuals(q, v);
        let active = |values: [f64; C]| core::array::from_fn(|row| self.regime.activity(row) * values[row]);
        Residuals {
            positions: active(all.positions),
            position_sizes: active(all.position_sizes),
            rates: active(all.rates),
            rate_sizes: active(all.rate_sizes),
        }
    }

    fn saddle_at(&self, _: f64, q: &[f64; N], v: &[f64; N]) -> (Self::Saddle, [[f64; N]; C]) {
        let masses = self.toy.mass();
        let mass = core::array::from_fn(|i| core::array::from_fn(|j| if i == j { masses[i] } else { 0.0 }));
        let slopes = self.toy.gradients();
        let activity: [f64; C] = core::array::from_fn(|row| self.regime.activity(row));
        let gradients: [[f64; N]; C] = core::array::from_fn(|row| slopes[row].map(|x| x * activity[row]));
        let rates = Model(self.toy).residuals(q, v).rates;
        let mut coupling = [[0.0; N]; C];
        for (row, kind) in T::ROWS.iter().enumerate() {
            let Row::Friction { normal: Some(normal), pair } = kind else { continue };
            let direction = match pair {
                None => self.regime.slip[row],
                Some(other) => {
                    let slips = self.regime.slip[row.min(*other)];
                    slips * rates[row] / (1.0 - slips + rates[row].powi(2) + rates[*other].powi(2)).sqrt()
                }
            };
            let share = self.toy.kinetic()[row] * direction * self.regime.side[*normal];
            coupling[*normal].iter_mut().zip(slopes[row]).for_each(|(sum, slope)| *sum -= share * slope);
        }
        (Switched::factor(&mass, &gradients, &coupling, &activity), gradients)
    }
}

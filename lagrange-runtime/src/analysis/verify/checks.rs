//! The identities, one after another, at one state.

use num_traits::Zero;

use super::scales::Scales;
use super::{Certificate, Described, Driven, Identity, Verifiable, Violation, derivative, double};
use crate::linear::Ldlt;
use crate::number::elements::array;
use crate::number::real::Real;
use crate::system::state::State;

/// Comparisons at one state.
struct Judge {
    seen: Certificate,
}

impl Judge {
    /// Whether two numbers agree to half of the digits of their summands, and to within the uncertainty of
    /// differences.
    fn compare<R: Real>(
        &mut self,
        identity: Identity,
        found: R,
        expected: R,
        scale: R,
        uncertainty: R,
    ) -> Result<(), Violation> {
        let off = (found - expected).abs();
        let allowed = R::epsilon().sqrt() * R::from_f64(2.0) * scale + R::from_f64(8.0) * uncertainty;
        // Outside the domain there is nothing to compare, nor among the smallest numbers, whose rounding
        // errors are no share of them.
        let is_smallest = scale.is_positive() && !(scale * R::epsilon()).is_positive();
        if !off.is_finite() || !allowed.is_finite() || is_smallest {
            return Ok(());
        }
        self.seen.comparisons += 1;
        if (off - allowed).largest() > Zero::zero() {
            return Err(Violation { identity, by: double(off), allowed: double(allowed) });
        }
        let share = if allowed.is_positive() { double(off / allowed) } else { 0.0 };
        self.seen.worst = if share > self.seen.worst { share } else { self.seen.worst };
        Ok(())
    }
}

/// A state on the path q + τ v + ½ τ² a.
fn along<R: Real, const N: usize>(state: &State<R, N>, a: &[R; N], time: R) -> State<R, N> {
    let half = R::from_f64(0.5) * time * time;
    State {
        t: state.t + time,
        q: array(|i| state.q[i] + time * state.v[i] + half * a[i]),
        v: array(|i| state.v[i] + time * a[i]),
    }
}

/// Checks everything; `None` outside the domain of the model.
pub(super) fn at_state<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    u: &[S::Scalar; K],
) -> Result<Option<Certificate>, Violation> {
    let mut judge = Judge { seen: Certificate { states: 1, comparisons: 0, worst: 0.0 } };
    positive(system, state, &mut judge)?;
    let Some(state) = system.nearest_at(state) else { return Ok(None) };
    let Some(driven) = system.driven_at(&state, u) else { return Ok(None) };
    let Driven { accelerations: a, loads } = driven;
    let momenta = system.momenta_at(&state);
    let integral = system.integral_at(&state);
    if !momenta.iter().chain(&a).chain(&loads).chain([&integral]).all(|x| x.is_finite()) {
        return Ok(None);
    }
    let work = momenta.iter().zip(&state.v).fold(S::Scalar::zero(), |sum, (&p, &v)| sum + (p * v).abs());
    let energy = work + integral.abs();

    let scales = Scales::of(&system.mass_at(&state), &state, &a);

    skew(system, &state, &scales, &mut judge)?;
    equations(system, &state, &driven, (&scales, energy), &mut judge)?;
    if let Some(rate) = system.integral_rate_at(&state, u) {
        let (found, doubt) = derivative(|time| system.integral_at(&along(&state, &a, time)), scales.time);
        let [terms] = scales.terms(&state, &a, |state| [system.integral_at(state)]);
        let scale = energy * scales.pace + rate.abs() + terms;
        judge.compare(Identity::PowerBalance, found, rate, scale, doubt)?;
    }
    for index in 0..S::CONSERVED {
        let conserved = |state: &State<S::Scalar, N>| system.conserved_at(state, index);
        let (found, doubt) = derivative(|time| conserved(&along(&state, &a, time)), scales.time);
        let [terms] = scales.terms(&state, &a, |state| [conserved(state)]);
        let scale = conserved(&state).abs() * scales.pace + terms;
        judge.compare(Identity::Conservation { index }, found, Zero::zero(), scale, doubt)?;
    }
    constraints(system, &state, &scales, &mut judge)?;
    described(system, &state, (work, integral), scales.time, &mut judge)?;
    Ok(Some(judge.seen))
}

fn positive<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    judge: &mut Judge,
) -> Result<(), Violation> {
    let mass = system.mass_at(state);
    if S::DEFINITE {
        let terms = || {
            let rows = mass.iter().zip(&state.v);
            rows.flat_map(|(row, &left)| row.iter().zip(&state.v).map(move |(&entry, &v)| left * entry * v))
        };
        let form = terms().fold(S::Scalar::zero(), |sum, term| sum + term);
        let size = terms().fold(S::Scalar::zero(), |sum, term| sum + term.abs());
        let least = if (-form).is_positive() { form } else { S::Scalar::zero() };
        judge.compare(Identity::PositiveInertia, least, Zero::zero(), size, Zero::zero())?;
        let finite = mass.iter().flatten().all(|entry| entry.is_finite());
        if S::CONSTRAINTS == 0 && finite && Ldlt::factor(mass).is_err() {
            let identity = Identity::PositiveInertia;
            return Err(Violation { identity, by: double(form), allowed: 0.0 });
        }
    }
    Ok(())
}

fn skew<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    scales: &Scales<S::Scalar, N>,
    judge: &mut Judge,
) -> Result<(), Violation> {
    let Some(coriolis) = system.coriolis_at(state) else { return Ok(()) };
    let mass = system.mass_at(state);
    let still = [S::Scalar::zero(); N];
    for (i, j) in (0..N).flat_map(|i| (0..=i).map(move |j| (i, j))) {
        let (rate, doubt) = derivative(|time| system.mass_at(&along(state, &still, time))[i][j], scales.time);
        let sum = coriolis[i][j] + coriolis[j][i];
        let size = (mass[i][i] * mass[j][j]).abs().sqrt() + mass[i][j].abs();
        let scale = size * scales.pace + coriolis[i][j].abs() + coriolis[j][i].abs();
        judge.compare(Identity::SkewCoriolis, rate, sum, scale, doubt)?;
    }
    Ok(())
}

/// ṗ = ∂L/∂q + Q − ∂D/∂v + Aᵀλ, with L = v·p − h.
fn equations<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    Driven { accelerations: a, loads }: &Driven<S::Scalar, N>,
    (scales, energy): (&Scales<S::Scalar, N>, S::Scalar),
    judge: &mut Judge,
) -> Result<(), Violation> {
    let terms = scales.terms(state, a, |state| system.momenta_at(state));
    let lagrangian = |state: &State<S::Scalar, N>| {
        let momenta = system.momenta_at(state);
        let work = momenta.iter().zip(&state.v).fold(S::Scalar::zero(), |sum, (&p, &v)| sum + p * v);
        work - system.integral_at(state)
    };
    for i in 0..N {
        let (rate, of_rate) = derivative(|time| system.momenta_at(&along(state, a, time))[i], scales.time);
        let place = scales.places[i];
        let by_place = |x| {
            let mut moved = *state;
            moved.q[i] += x;
            lagrangian(&moved)
        };
        let (slope, of_slope) = derivative(by_place, place);
        let scale = terms[i] + slope.abs() + loads[i].abs() + energy / place;
        let identity = Identity::LagrangesEquation { coordinate: i };
        judge.compare(identity, rate, slope + loads[i], scale, of_rate + of_slope)?;
    }
    Ok(())
}

fn constraints<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    scales: &Scales<S::Scalar, N>,
    judge: &mut Judge,
) -> Result<(), Violation> {
    for constraint in 0..S::CONSTRAINTS {
        let gradient = system.gradient_at(state, constraint);
        for (i, &entry) in gradient.iter().enumerate() {
            let holonomic = S::is_holonomic(constraint);
            let step = if holonomic { scales.places[i] } else { scales.places[i] / scales.time };
            let moved = |x| {
                let mut moved = *state;
                let place = if holonomic { &mut moved.q } else { &mut moved.v };
                if let Some(place) = place.get_mut(i) {
                    *place += x;
                }
                system.constraint_at(&moved, constraint)
            };
            let (slope, doubt) = derivative(moved, step);
            let sizes = gradient.iter().zip(&scales.places);
            let size = sizes.fold(S::Scalar::zero(), |sum, (&entry, &place)| sum + entry.abs() * place);
            let scale = size / scales.places[i];
            judge.compare(Identity::ConstraintGradient { constraint }, slope, entry, scale, doubt)?;
        }
    }
    Ok(())
}

/// The energies by the user's own functions.
fn described<S: Verifiable<N, K>, const N: usize, const K: usize>(
    system: &S,
    state: &State<S::Scalar, N>,
    (work, integral): (S::Scalar, S::Scalar),
    time: S::Scalar,
    judge: &mut Judge,
) -> Result<(), Violation> {
    let momenta = system.momenta_at(state);
    let Described { kinetic, potential, lagrangian, uncertainty } = system.described_at(state, time);
    let scale = work + integral.abs() + kinetic.abs() + potential.abs() + lagrangian.abs();
    if let Some([t, v]) = system.energies_at(state) {
        judge.compare(Identity::KineticEnergy, t, kinetic, scale, uncertainty)?;
        judge.compare(Identity::PotentialEnergy, v, potential, scale, Zero::zero())?;
    }
    let product = momenta.iter().zip(&state.v).fold(S::Scalar::zero(), |sum, (&p, &v)| sum + p * v);
    let expected = kinetic - potential + lagrangian;
    judge.compare(Identity::Lagrangian, product - integral, expected, scale, uncertainty)
}

//! Orientations in space: three numbers of a state, by name a unit quaternion and an angular velocity.
//!
//! A state holds modified Rodrigues parameters ρ = 4 tan(θ/4) n of a turn by θ \[rad] about the unit vector
//! n, and their rates ρ′. For small turns ρ is the rotation vector \[rad] and ρ′ the angular velocity
//! \[rad/s]. Two triples describe each orientation, ρ by θ and −16ρ/|ρ|² by θ − 2π; the shorter one has
//! |ρ| ≤ 4 and is never singular. A motion changes to it at the end of a step that went beyond half a turn
//! ([`settle`]).
//! (Schaub and Junkins, *Analytical Mechanics of Space Systems*, 4th ed., section 3.5, where σ = ρ/4.)

mod axes;
mod drift;
mod motion;

pub use axes::{BodyAxes, ByName};
pub(crate) use drift::drift;

use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use num_traits::Zero;

use crate::number::elements::{Each, array};
use crate::number::real::Real;
use crate::system::state::State;
#[doc(hidden)]
pub use motion::{accelerations, axes, complete, turning};

/// The velocity of a pose among the coordinates, as a state names it: `v.hull` of `hull: Pose`. The function
/// `self.hull_velocity(q, v)` returns a [`Twist3`](crate::Twist3), with all components in both axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseVelocity<R> {
    /// Velocity of the pose's origin in space axes \[m/s].
    pub linear: Vector3<R>,
    /// Angular velocity in body axes \[rad/s].
    pub angular: Vector3<R>,
}

/// |ρ|² at half a turn.
const HALF_A_TURN: f64 = 16.0;

fn square<R: Real>([x, y, z]: [R; 3]) -> R {
    x * x + y * y + z * z
}

fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The three numbers that begin at an index.
#[inline(always)]
pub(crate) fn triple<R: Real, const N: usize>(numbers: &[R; N], first: usize) -> [R; 3] {
    numbers.get(first..first + 3).and_then(<[R]>::first_chunk).copied().unwrap_or([R::zero(); 3])
}

/// The orientation of three parameters: from body axes to space axes.
#[must_use]
pub fn rotation<R: Real>(rho: [R; 3]) -> UnitQuaternion<R> {
    let s = square(rho) * R::from_f64(1.0 / 16.0);
    let reciprocal = R::one() / (R::one() + s);
    let [x, y, z] = rho.each(|component| R::from_f64(0.5) * component * reciprocal);
    Unit::new_unchecked(Quaternion::from_vector(nalgebra::Vector4::new(x, y, z, (R::one() - s) * reciprocal)))
}

/// The parameters of an orientation, those of the turn by half a turn at most. A quaternion of any length is
/// the orientation of the unit one in its direction; zero has none, and gives no numbers.
#[must_use]
pub fn parameters<R: Real>(rotation: &UnitQuaternion<R>) -> [R; 3] {
    let [x, y, z, w]: [R; 4] = rotation.as_ref().coords.into();
    let length = (square([x, y, z]) + w * w).sqrt();
    // Both signs of a quaternion are one orientation.
    let sign = w.signum();
    let scale = R::from_f64(4.0) * sign / (length + w * sign);
    [x * scale, y * scale, z * scale]
}

/// The rates of the parameters at an angular velocity in body axes.
#[must_use]
pub fn rates<R: Real>(rho: [R; 3], angular: &Vector3<R>) -> [R; 3] {
    rates_at(rho, (*angular).into())
}

/// ρ′ = (1 − s) ω + ½ ρ × ω + ⅛ ρ (ρ·ω) with s = |ρ|²/16.
fn rates_at<R: Real>(rho: [R; 3], omega: [R; 3]) -> [R; 3] {
    let s = square(rho) * R::from_f64(1.0 / 16.0);
    let along = dot(rho, omega) * R::from_f64(0.125);
    let turned = cross(rho, omega);
    array(|i| (R::one() - s) * omega[i] + R::from_f64(0.5) * turned[i] + rho[i] * along)
}

/// The inverse: the matrix of [`rates_at`] is 1 + s times an orthogonal one.
fn spin<R: Real>(rho: [R; 3], rates: [R; 3]) -> [R; 3] {
    let s = square(rho) * R::from_f64(1.0 / 16.0);
    let scale = R::one() / (R::one() + s);
    let rates = rates.each(|rate| rate * scale * scale);
    let along = dot(rho, rates) * R::from_f64(0.125);
    let turned = cross(rho, rates);
    array(|i| (R::one() - s) * rates[i] - R::from_f64(0.5) * turned[i] + rho[i] * along)
}

/// The pose of six parameters: position \[m], then orientation.
#[must_use]
pub fn pose<R: Real>([x, y, z, a, b, c]: [R; 6]) -> Isometry3<R> {
    Isometry3 { rotation: rotation([a, b, c]), translation: Translation3::new(x, y, z) }
}

/// The parameters of a pose.
#[must_use]
pub fn pose_parameters<R: Real>(pose: &Isometry3<R>) -> [R; 6] {
    let ([x, y, z], [a, b, c]): ([R; 3], _) = (pose.translation.vector.into(), parameters(&pose.rotation));
    [x, y, z, a, b, c]
}

/// The velocity of a pose from its six components.
#[must_use]
pub fn pose_velocity<R: Real>([x, y, z, a, b, c]: [R; 6]) -> PoseVelocity<R> {
    PoseVelocity { linear: Vector3::new(x, y, z), angular: Vector3::new(a, b, c) }
}

/// The rates of a pose's parameters at its velocity.
#[must_use]
pub fn pose_rates<R: Real>([_, _, _, a, b, c]: [R; 6], velocity: &PoseVelocity<R>) -> [R; 6] {
    let ([x, y, z], [a, b, c]): ([R; 3], _) = (velocity.linear.into(), rates([a, b, c], &velocity.angular));
    [x, y, z, a, b, c]
}

/// The same state with the shorter triple of each orientation; `None` if it has that already. `orientations`
/// tells where the triples begin. Lanes and derivatives follow their own values.
#[must_use]
pub fn settle<R: Real, const N: usize>(orientations: &[usize], state: &State<R, N>) -> Option<State<R, N>> {
    let mut settled: Option<State<R, N>> = None;
    for &first in orientations {
        let (rho, rates) = (triple(&state.q, first), triple(&state.v, first));
        let beyond = square(rho) - R::from_f64(HALF_A_TURN);
        if beyond.largest() > Zero::zero() {
            let state = settled.get_or_insert(*state);
            let shorter = other(rho, rates);
            // Zero in lanes that stay.
            let moves = (R::one() + beyond.signum()) * R::from_f64(0.5);
            for i in 0..3 {
                for (to, from, new) in
                    [(&mut state.q, rho[i], shorter.0[i]), (&mut state.v, rates[i], shorter.1[i])]
                {
                    if let Some(to) = to.get_mut(first + i) {
                        *to = moves * new + (R::one() - moves) * from;
                    }
                }
            }
        }
    }
    settled
}

/// The same state with those triples of its orientations that lie nearest to the ones of another state. Two
/// computations of one motion may change to the shorter triple at different times.
#[must_use]
pub(crate) fn beside<R: Real, T: Real, const N: usize>(
    orientations: &[usize],
    state: &State<T, N>,
    near: &State<R, N>,
    value: impl Fn(T) -> R,
) -> State<T, N> {
    let mut state = *state;
    for &first in orientations {
        let (rho, rates, near) = (triple(&state.q, first), triple(&state.v, first), triple(&near.q, first));
        let far = |rho: [T; 3]| square(array(|i| value(rho[i]) - near[i]));
        let opposite = opposite(rho, rates, square(rho));
        // A turn by nothing has an infinite opposite, which is nearer to none.
        if (far(rho) - far(opposite.0)).is_positive() {
            for i in 0..3 {
                for (to, new) in [(&mut state.q, opposite.0[i]), (&mut state.v, opposite.1[i])] {
                    if let Some(to) = to.get_mut(first + i) {
                        *to = new;
                    }
                }
            }
        }
    }
    state
}

/// Gives the three numbers of an orientation one size: the largest of theirs, `least` at least.
pub(crate) fn share<R: Real, const N: usize>(sizes: &mut [R; N], first: usize, least: R) {
    if let Some(triple) = sizes.get_mut(first..first + 3) {
        let largest = triple.iter().fold(least, |largest, &size| largest.max(size));
        triple.fill(largest);
    }
}

/// The other triple of an orientation, and its rates. Triples of less than half a turn, which stay, give
/// finite numbers.
fn other<R: Real>(rho: [R; 3], rates: [R; 3]) -> ([R; 3], [R; 3]) {
    opposite(rho, rates, square(rho).max(R::from_f64(HALF_A_TURN)))
}

/// The other triple of an orientation with this |ρ|², and its rates.
fn opposite<R: Real>(rho: [R; 3], rates: [R; 3], square: R) -> ([R; 3], [R; 3]) {
    let scale = -(R::from_f64(HALF_A_TURN) / square);
    let along = rho[0] * rates[0] + rho[1] * rates[1] + rho[2] * rates[2];
    let back = R::from_f64(2.0) * along / square;
    (rho.each(|component| component * scale), array(|i| (rates[i] - back * rho[i]) * scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turns about many axes, up to a whole turn.
    fn turns() -> impl Iterator<Item = UnitQuaternion<f64>> {
        (0..200).map(|i| {
            let x = f64::from(i);
            UnitQuaternion::new(Vector3::new((1.3 * x).sin(), (2.1 * x).cos(), (0.7 * x).sin()) * 0.018 * x)
        })
    }

    #[test]
    fn parameters_are_those_of_the_orientation() {
        for turn in turns() {
            let rho = parameters(&turn);
            assert!(square(rho) <= HALF_A_TURN * (1.0 + 1e-15));
            let back = rotation(rho);
            assert!((back.to_rotation_matrix().matrix() - turn.to_rotation_matrix().matrix()).norm() < 2e-15);
            assert!((back.as_ref().norm() - 1.0).abs() < 4e-16);
        }
        let small = UnitQuaternion::new(Vector3::new(1e-5, -2e-5, 3e-5));
        let [x, y, z] = parameters(&small);
        assert!((Vector3::new(x, y, z) - small.scaled_axis()).norm() < 1e-14);
    }

    #[test]
    fn a_quaternion_of_any_length_is_an_orientation() {
        for (turn, length) in turns().zip([1e-3, 0.5, 2.0, 1e3].into_iter().cycle()) {
            let long = parameters(&Unit::new_unchecked(turn.into_inner() * length));
            assert!(long.iter().zip(parameters(&turn)).all(|(a, b)| (a - b).abs() < 4e-15));
        }
        assert!(
            parameters(&Unit::new_unchecked(Quaternion::from([0.0; 4]))).iter().all(|x: &f64| x.is_nan())
        );
    }

    /// Along ρ + τ ρ′ the quaternion turns by ω: compared with a difference of quaternions.
    #[test]
    fn rates_turn_by_the_angular_velocity() {
        for turn in turns() {
            let (rho, omega) = (parameters(&turn), Vector3::new(0.3, -1.1, 0.7));
            let slope = rates(rho, &omega);
            let place = |tau: f64| rotation(core::array::from_fn(|i| rho[i] + tau * slope[i]));
            let tau = 1e-4;
            let found = (place(-tau).inverse() * place(tau)).scaled_axis() / (2.0 * tau);
            assert!((found - omega).norm() < 1e-7, "{found} {omega}");
        }
    }

    #[test]
    fn both_triples_are_one_orientation_in_one_motion() {
        for turn in turns().skip(1) {
            let (rho, omega) = (parameters(&turn), Vector3::new(0.3, -1.1, 0.7));
            // The longer triple: |ρ| |ρ*| = 16.
            let n = square(rho);
            let long = rho.map(|component| -16.0 * component / n);
            let state = State::new(long, rates(long, &omega));
            let settled = settle(&[0], &state).expect("beyond half a turn");
            let expected = rates(rho, &omega);
            for i in 0..3 {
                assert!((settled.q[i] - rho[i]).abs() < 4e-15, "{settled:?} {rho:?}");
                assert!((settled.v[i] - expected[i]).abs() < 4e-15, "{settled:?} {expected:?}");
            }
            assert!(settle(&[0], &settled).is_none_or(|again| square(again.q) <= 16.0));
        }
    }

    #[test]
    fn a_state_within_half_a_turn_stays() {
        assert_eq!(settle(&[1], &State::new([1e3, 1.0, 2.0, 3.0], [1.0; 4])), None);
        assert_eq!(settle(&[], &State::new([1e3], [1.0])), None);
    }

    #[test]
    fn poses_are_positions_and_orientations() {
        let numbers = [1.0, 2.0, 3.0, 0.1, 0.2, -0.3];
        let again = pose_parameters(&pose(numbers));
        assert!(numbers.iter().zip(again).all(|(a, b)| (a - b).abs() < 1e-15));
        let speeds = pose_rates(numbers, &pose_velocity([4.0, 5.0, 6.0, 0.0, 0.0, 0.0]));
        assert_eq!(speeds, [4.0, 5.0, 6.0, 0.0, 0.0, 0.0]);
    }
}

//! Motions at the tightest practical tolerance, compared with reference states.

use lagrangian::{Adaptive, Control, Dop853, Held, Simulation, State, System};

use super::close::all_close;

/// The tolerance of all reference motions. Down to it the errors of most cases fall in proportion; a tenth of
/// it gains a factor of a few and takes six times as long, because the error estimate is rounding then.
pub const TIGHT: f64 = 1e-15;

/// Moves to each time and compares the state, given as coordinates then velocities.
#[track_caller]
pub fn follows<S, const N: usize, const M: usize>(
    system: &S,
    start: State<f64, N>,
    reference: impl IntoIterator<Item = (f64, [f64; M])>,
    tolerance: f64,
) where
    S: System<N, 0, Scalar = f64>,
{
    follows_by::<S::Method, _, N, M>(system, start, reference, tolerance);
}

/// The same by method `A`.
#[track_caller]
pub fn follows_by<A, S, const N: usize, const M: usize>(
    system: &S,
    start: State<f64, N>,
    reference: impl IntoIterator<Item = (f64, [f64; M])>,
    tolerance: f64,
) where
    S: System<N, 0, Scalar = f64>,
    A: Adaptive<S, Held<f64, 0>, N, 0>,
{
    let mut motion = system.simulate_with::<A>(start).with_tolerance(TIGHT);
    for (t, expected) in reference {
        motion.advance_to(t).expect("motion: no obstacle");
        all_close(numbers(motion.state()), expected, tolerance);
    }
}

/// The same by the method of the system and by [`Dop853`].
#[track_caller]
pub fn both_follow<S, const N: usize, const M: usize>(
    system: &S,
    start: State<f64, N>,
    reference: impl IntoIterator<Item = (f64, [f64; M])> + Clone,
    tolerance: f64,
) where
    S: System<N, 0, Scalar = f64>,
{
    follows(system, start, reference.clone(), tolerance);
    follows_by::<Dop853, _, N, M>(system, start, reference, tolerance);
}

/// The state at a time.
#[track_caller]
pub fn state_at<S, const N: usize>(system: &S, start: State<f64, N>, t: f64) -> State<f64, N>
where
    S: System<N, 0, Scalar = f64>,
{
    let mut motion = system.simulate(start).with_tolerance(TIGHT);
    *motion.advance_to(t).expect("motion: no obstacle")
}

/// The time near `guess` at which a function of the state vanishes, by Newton's method along the motion.
#[track_caller]
pub fn root<S, const N: usize>(
    system: &S,
    start: State<f64, N>,
    guess: f64,
    value_and_rate: impl Fn(&State<f64, N>) -> (f64, f64),
) -> f64
where
    S: System<N, 0, Scalar = f64>,
{
    let mut motion = system.simulate(start).with_tolerance(TIGHT);
    motion.advance_to(guess).expect("motion: no obstacle");
    for _ in 0..20 {
        let (value, rate) = value_and_rate(motion.state());
        let correction = -value / rate;
        if correction.abs() < 1e-15 * guess.abs() {
            return motion.t();
        }
        motion.advance_by(correction).expect("motion: no obstacle");
    }
    // Rounding may keep the correction just above its limit.
    motion.t()
}

/// The largest deviation of a quantity from its first value, at `count` samples `dt` apart.
pub fn drift<S, C, M, const N: usize, const K: usize>(
    motion: &mut Simulation<'_, S, C, M, N, K>,
    dt: f64,
    count: usize,
    quantity: impl Fn(&State<f64, N>) -> f64,
) -> f64
where
    S: System<N, K, Scalar = f64>,
    C: Control<f64, N, K>,
    M: Adaptive<S, C, N, K>,
{
    let first = quantity(motion.state());
    let mut largest = 0.0_f64;
    for _ in 0..count {
        motion.advance_by(dt).expect("motion: no obstacle");
        let deviation = (quantity(motion.state()) - first).abs();
        // `f64::max` would hide a NaN.
        assert!(deviation.is_finite(), "motion: the quantity is {deviation} off at t = {}", motion.t());
        largest = largest.max(deviation);
    }
    largest
}

/// The 2N numbers of a state, coordinates first.
pub fn numbers<const N: usize>(state: &State<f64, N>) -> Vec<f64> {
    state.iter().collect()
}

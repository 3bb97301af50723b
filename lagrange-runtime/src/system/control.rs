//! [`Control`]: the source of the inputs of a motion.

use super::state::State;

/// The source of the inputs of a system.
pub trait Control<R, const N: usize, const K: usize> {
    /// Whether the inputs are the same at all states.
    const HELD: bool = K == 0;

    /// The inputs at a state. It is called several times per step, also at trial states, so the result must
    /// depend on the state alone.
    fn inputs(&self, state: &State<R, N>) -> [R; K];
}

/// Inputs that stay constant until they are set again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held<R, const K: usize>(pub [R; K]);

impl<R: Copy, const N: usize, const K: usize> Control<R, N, K> for Held<R, K> {
    const HELD: bool = true;

    #[inline]
    fn inputs(&self, _: &State<R, N>) -> [R; K] {
        self.0
    }
}

/// Inputs as a function of the state.
#[derive(Clone, Copy, Debug)]
pub struct Feedback<F>(pub F);

impl<R, F: Fn(&State<R, N>) -> [R; K], const N: usize, const K: usize> Control<R, N, K> for Feedback<F> {
    #[inline]
    fn inputs(&self, state: &State<R, N>) -> [R; K] {
        (self.0)(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The inputs of a control, and whether they are the same at two states.
    fn said<const K: usize, C: Control<f64, 1, K>>(control: &C) -> (bool, bool) {
        let [here, there] = [0.0, 1.0].map(|x| control.inputs(&State::new([x], [x])));
        (C::HELD, here == there)
    }

    #[test]
    fn inputs_that_are_held_are_the_same_at_all_states() {
        assert_eq!(said(&Held([3.0])), (true, true));
        // Without inputs nothing changes.
        assert_eq!(said(&Feedback(|_: &State<f64, 1>| [])), (true, true));
        assert_eq!(said(&Feedback(|state: &State<f64, 1>| [-state.q[0]])), (false, false));
    }
}

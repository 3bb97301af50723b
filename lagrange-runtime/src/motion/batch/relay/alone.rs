//! Lanes that stop, found one by one.

use super::super::lane::{get, set};
use super::{MOST, Relay, Standing};
use crate::number::real::{Real, Vector};
use crate::system::smooth::Smooth;

impl<S: Smooth<N, K>, const N: usize, const K: usize> Relay<S, N, K>
where
    S::Scalar: Vector,
{
    /// Stops the lanes that cannot take the next step by themselves, after [`Relay::step`] found that there
    /// are any. `alone` gives a system with the parameters of a lane in all lanes, so that whether a lane
    /// stops follows from its own numbers.
    pub fn stop_unsolvable(&mut self, alone: impl Fn(usize) -> S) {
        for lane in 0..S::Scalar::COUNT {
            if self.standing(lane) != Standing::Running {
                continue;
            }
            let kept = (self.constants, self.state, self.residue, self.unit, self.target, self.before);
            let flags = (self.standing, self.attempts, self.fresh);
            let system = core::mem::replace(&mut self.system, alone(lane));
            self.constants = self.system.jet_constants();
            let (state, residue) = (get(&self.state, lane), get(&self.residue, lane));
            for other in 0..S::Scalar::COUNT {
                set(&mut self.state, other, &state);
                set(&mut self.residue, other, &residue);
            }
            self.unit = S::Scalar::splat(kept.3.lane(lane));
            self.target = S::Scalar::splat(kept.4.lane(lane));
            let of = |flags: &[bool; MOST]| flags.get(lane).copied().unwrap_or_default();
            self.standing = [Standing::Running; MOST];
            self.attempts = [self.attempts.get(lane).copied().unwrap_or_default(); MOST];
            self.fresh = [of(&self.fresh); MOST];
            let goes_on = self.step();
            self.system = system;
            (self.constants, self.state, self.residue, self.unit, self.target, self.before) = kept;
            (self.standing, self.attempts, self.fresh) = flags;
            if let (false, Some(standing)) = (goes_on, self.standing.get_mut(lane)) {
                *standing = Standing::Stopped;
            }
        }
    }
}

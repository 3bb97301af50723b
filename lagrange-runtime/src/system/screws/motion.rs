//! What a state's velocities make of the groups, and what accelerations add.

use super::composite::{Inertia, Pair};
use super::{Group, Screws};
use crate::number::real::Real;

/// All about the point of each group.
pub(super) struct Motion<R, const N: usize, const G: usize> {
    /// V.
    pub twists: [Pair<R>; G],
    /// Ṡ.
    pub rates: [Pair<R>; N],
    /// A and F of what a group alone moves, without accelerations of coordinates.
    accelerations: [Pair<R>; G],
    forces: [Pair<R>; G],
}

impl<R: Real, const N: usize, const G: usize> Motion<R, N, G> {
    /// Of nothing. What is this large is filled in where it stands, because a result would be copied.
    pub fn new() -> Self {
        let nothing = Pair::zero();
        Motion {
            twists: [nothing; G],
            rates: [nothing; N],
            accelerations: [nothing; G],
            forces: [nothing; G],
        }
    }

    #[inline(never)]
    pub fn fill<const C: usize, const P: usize>(
        &mut self,
        screws: &Screws<R, N, G, C, P>,
        groups: &[Group; G],
        v: &[R; N],
    ) {
        for (place, group) in groups.iter().enumerate() {
            let (mut twist, mut acceleration) = match self.twists.get(group.parent) {
                Some(twist) => {
                    let arm = screws.arm(place, group.parent);
                    (twist.at(&arm), self.accelerations[group.parent].at(&arm))
                }
                None => (Pair::zero(), screws.free()),
            };
            for &j in group.coordinates {
                twist = twist.plus(v[j], &screws.screw(j));
            }
            for (k, &j) in group.coordinates.iter().enumerate() {
                let rate = match screws.rates.get(group.given + k) {
                    Some([rate, _]) => Pair::of(rate),
                    None => twist.moves(&screws.screw(j)),
                };
                acceleration = acceleration.plus(v[j], &rate);
                self.rates[j] = rate;
            }
            let inertia = Inertia::of(&screws.inertias[place]);
            self.forces[place] = inertia.times(&acceleration).sum(&twist.turns(&inertia.times(&twist)));
            (self.twists[place], self.accelerations[place]) = (twist, acceleration);
        }
    }

    /// F of all that each group moves, with what accelerations of coordinates add to A, if there are any.
    pub fn forces<const C: usize, const P: usize>(
        &self,
        screws: &Screws<R, N, G, C, P>,
        groups: &[Group; G],
        pushed: Option<&[Pair<R>; G]>,
    ) -> [Pair<R>; G] {
        let mut forces = self.forces;
        for (place, group) in groups.iter().enumerate().rev() {
            if let Some(pushed) = pushed {
                let own = Inertia::of(&screws.inertias[place]).times(&pushed[place]);
                forces[place] = forces[place].sum(&own);
            }
            let force = forces[place];
            if let Some(parent) = forces.get_mut(group.parent) {
                *parent = parent.sum(&force.wrench_from(&screws.arm(place, group.parent)));
            }
        }
        forces
    }

    /// S̈.
    pub fn second_rates<const C: usize, const P: usize>(
        &self,
        screws: &Screws<R, N, G, C, P>,
        groups: &[Group; G],
        pushed: &[Pair<R>; G],
        a: &[R; N],
    ) -> [Pair<R>; N] {
        let mut rates = [Pair::zero(); N];
        let mut changes = screws.changes.iter();
        for (place, group) in groups.iter().enumerate() {
            let (twist, acceleration) = (&self.twists[place], self.accelerations[place].sum(&pushed[place]));
            let above = pushed.get(group.parent).map(|above| above.at(&screws.arm(place, group.parent)));
            let carried = above.map_or(screws.free(), |above| above.sum(&screws.free()));
            for (k, &j) in group.coordinates.iter().enumerate() {
                let screw = screws.screw(j);
                let Some([_, second]) = screws.rates.get(group.given + k) else {
                    rates[j] = acceleration.moves(&screw).sum(&twist.moves(&self.rates[j]));
                    continue;
                };
                rates[j] = Pair::of(second).sum(&carried.moves(&screw));
                for (&i, change) in group.coordinates.iter().zip(&mut changes) {
                    rates[j] = rates[j].plus(a[i], &Pair::of(change));
                }
            }
        }
        rates
    }
}

impl<R: Real, const N: usize, const G: usize, const C: usize, const P: usize> Screws<R, N, G, C, P> {
    /// What accelerations of coordinates add to A.
    pub(super) fn pushed(&self, groups: &[Group; G], a: &[R; N]) -> [Pair<R>; G] {
        let mut pushed = [Pair::zero(); G];
        for (place, group) in groups.iter().enumerate() {
            let mut sum = match pushed.get(group.parent) {
                Some(above) => above.at(&self.arm(place, group.parent)),
                None => Pair::zero(),
            };
            for &j in group.coordinates {
                sum = sum.plus(a[j], &self.screw(j));
            }
            pushed[place] = sum;
        }
        pushed
    }
}

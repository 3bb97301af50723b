//! M and the derivatives of inverse dynamics of rigid bodies that hang on each other, from the screws of
//! the coordinates.
//!
//! A coordinate that moves some bodies as one gives them all the twist S v, and what they do in its absence
//! is carried along. With a body's twist V, its acceleration A (that of its frame less gravity), its
//! inertia I and F = I A + V ×* I V, where dots are rates along the motion,
//!
//! ∂F/∂q = S ×* F + I S̈ + B Ṡ,  ∂F/∂v = 2 I Ṡ + B S,  B x = I (x × V) + x ×* I V + V ×* I x.
//!
//! I, B and F add up over all bodies that a coordinate moves. So a pair of coordinates takes a few dot
//! products, and nothing is carried from link to link (Carpentier and Mansard, RSS 2018; Singh, Russell and
//! Wensing, IEEE Robotics and Automation Letters 7, 2022). B asks for the angular part of x alone: B x = 2 (G
//! x, −P × x), with the momentum P. All vectors are in space axes. What a group moves is added up about a
//! point of its own, at one of its bodies: about a point at a distance d, a small moment of inertia would be
//! a difference of numbers of size m d². Only coordinates of different groups meet about a common point.

mod composite;
mod motion;
mod pairs;
#[cfg(test)]
mod tests;

use crate::number::real::Real;
use crate::system::System;
use crate::system::linearized::{Factored, Linearization};
use composite::{Pair, Vector, each};
use motion::Motion;
use pairs::Masses;

/// Coordinates that move the same bodies.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// The place of the group that moves these bodies and more: before this one. Without any, the number of
    /// groups.
    pub parent: usize,
    /// The coordinates.
    pub coordinates: &'static [usize],
    /// Where the rates of their screws begin in [`Screws::rates`], or the length of that array if none are
    /// given. The screws then change with the groups before this one and with nothing else.
    pub given: usize,
}

/// What a state is for the groups.
#[derive(Clone, Copy, Debug)]
pub struct Screws<R, const N: usize, const G: usize, const C: usize, const P: usize> {
    /// The point of each group, from a common one.
    pub points: [Vector<R>; G],
    /// S of each coordinate about the point of its group: angular part, linear part.
    pub screws: [[R; 6]; N],
    /// Ṡ and S̈ without accelerations of coordinates, where they are given, in the order of groups.
    pub rates: [[[R; 6]; 2]; C],
    /// ∂S/∂q where rates are given, for each group the rows S with the columns q.
    pub changes: [[R; 6]; P],
    /// Mass, first moment, and moments of inertia xx, xy, xz, yy, yz, zz of the bodies that a group moves
    /// and no other group after it.
    pub inertias: [[R; 10]; G],
    /// The acceleration of free fall.
    pub gravity: Vector<R>,
}

/// A system whose inertia forces and weights follow from screws.
pub trait Carried<const N: usize, const K: usize, const G: usize, const C: usize, const P: usize>:
    System<N, K>
{
    /// What hangs on a group follows it.
    const GROUPS: [Group; G];

    /// What a state is for the groups.
    fn screws_at(
        &self,
        constants: &Self::Constants,
        t: Self::Scalar,
        q: &[Self::Scalar; N],
        v: &[Self::Scalar; N],
    ) -> Screws<Self::Scalar, N, G, C, P>;
}

/// Weights less inertia forces.
#[must_use]
pub fn residual<R: Real, const N: usize, const G: usize, const C: usize, const P: usize>(
    screws: &Screws<R, N, G, C, P>,
    groups: &[Group; G],
    v: &[R; N],
    a: &[R; N],
) -> [R; N] {
    let mut motion = Motion::new();
    motion.fill(screws, groups, v);
    let forces = motion.forces(screws, groups, Some(&screws.pushed(groups, a)));
    screws.along(groups, &forces)
}

/// M, and the derivatives of the residual by coordinates and velocities.
#[must_use]
pub fn linearization<R: Real, const N: usize, const G: usize, const C: usize, const P: usize>(
    screws: &Screws<R, N, G, C, P>,
    groups: &[Group; G],
    v: &[R; N],
    a: &[R; N],
) -> Linearization<R, N> {
    let (mut motion, mut masses) = (Motion::new(), Masses::new());
    motion.fill(screws, groups, v);
    let zero = [[R::zero(); N]; N];
    let mut result = Linearization { mass: zero, by_q: zero, by_v: zero };
    masses.fill(screws, groups, &motion, &mut result.mass);
    screws.derivatives(groups, &motion, &masses, a, [&mut result.by_q, &mut result.by_v]);
    result
}

/// The same at the accelerations of the motion under other forces `rest`, which M gives by the way.
pub fn factored<R: Real, const N: usize, const G: usize, const C: usize, const P: usize>(
    screws: &Screws<R, N, G, C, P>,
    groups: &[Group; G],
    v: &[R; N],
    rest: &[R; N],
    result: &mut Factored<R, N>,
) {
    let (mut motion, mut masses) = (Motion::new(), Masses::new());
    motion.fill(screws, groups, v);
    masses.fill(screws, groups, &motion, result.mass());
    if result.factor() {
        let mut a = screws.along(groups, &motion.forces(screws, groups, None));
        a.iter_mut().zip(rest).for_each(|(force, &rest)| *force += rest);
        result.accelerate(&mut a);
        screws.derivatives(groups, &motion, &masses, &a, [&mut result.by_q, &mut result.by_v]);
    }
}

impl<R: Real, const N: usize, const G: usize, const C: usize, const P: usize> Screws<R, N, G, C, P> {
    /// Minus the components of forces along the screws.
    fn along(&self, groups: &[Group; G], forces: &[Pair<R>; G]) -> [R; N] {
        let mut components = [R::zero(); N];
        for (group, force) in groups.iter().zip(forces) {
            for &j in group.coordinates {
                components[j] = -self.screw(j).dot(force);
            }
        }
        components
    }

    /// The vector to the point of a group from that of another.
    fn arm(&self, to: usize, from: usize) -> Vector<R> {
        each(|i| self.points[to][i] - self.points[from][i])
    }

    fn screw(&self, coordinate: usize) -> Pair<R> {
        Pair::of(&self.screws[coordinate])
    }

    /// A of a frame without acceleration: minus gravity.
    fn free(&self) -> Pair<R> {
        Pair([R::zero(); 3], each(|i| -self.gravity[i]))
    }
}

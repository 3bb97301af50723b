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
#[cfg(test)]
mod tests;

use crate::number::real::Real;
use crate::system::linearized::Linearization;
use composite::{Composite, Pair, Vector, each};

/// Coordinates that move the same bodies.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// The place of the group that moves these bodies and more: before this one. Without any, the number of
    /// groups.
    pub parent: usize,
    /// The coordinates.
    pub coordinates: &'static [usize],
    /// Where the rates of their screws stand. Without any, their number: what moves the screws is then all
    /// that changes them.
    pub given: usize,
}

/// What a state is for the groups.
#[derive(Clone, Copy, Debug)]
pub struct Screws<R, const N: usize, const G: usize, const C: usize, const P: usize> {
    /// The point of each group, from a common one.
    pub points: [Vector<R>; G],
    /// S of each coordinate about the point of its group: angular part, linear part.
    pub screws: [[R; 6]; N],
    /// Ṡ and S̈ where they are given, in the order of groups.
    pub rates: [[[R; 6]; 2]; C],
    /// ∂S/∂q where rates are given, for each group the rows S with the columns q.
    pub changes: [[R; 6]; P],
    /// Mass, first moment, and moments of inertia xx, xy, xz, yy, yz, zz of the bodies that a group moves
    /// and no other group after it.
    pub inertias: [[R; 10]; G],
    /// The acceleration of free fall.
    pub gravity: Vector<R>,
}

/// Coordinates that are taken together with another one, on vectors.
const LANES: usize = 4;

/// The coordinates on the way to a group.
struct Path<R, const N: usize> {
    coordinates: [usize; N],
    /// The parts of S, Ṡ and S̈ of some coordinates side by side.
    blocks: [[[R; LANES]; 18]; N],
}

/// Weights less inertia forces.
#[must_use]
pub fn residual<R: Real, const N: usize, const G: usize, const C: usize, const P: usize>(
    screws: &Screws<R, N, G, C, P>,
    groups: &[Group; G],
    v: &[R; N],
    a: &[R; N],
) -> [R; N] {
    let (_, composites) = screws.composites(groups, v, a);
    let mut residual = [R::zero(); N];
    for (group, bodies) in groups.iter().zip(&composites) {
        for &j in group.coordinates {
            residual[j] = -screws.screw(j).dot(&bodies.force);
        }
    }
    residual
}

/// M, and the derivatives of the residual by coordinates and velocities.
#[must_use]
pub fn linearization<R: Real, const N: usize, const G: usize, const C: usize, const P: usize>(
    screws: &Screws<R, N, G, C, P>,
    groups: &[Group; G],
    v: &[R; N],
    a: &[R; N],
) -> Linearization<R, N> {
    let (rates, composites) = screws.composites(groups, v, a);
    screws.pairs(groups, &rates, &composites)
}

impl<R: Real, const N: usize, const G: usize, const C: usize, const P: usize> Screws<R, N, G, C, P> {
    /// Ṡ and S̈ of all coordinates, and what each group moves as one.
    fn composites(
        &self,
        groups: &[Group; G],
        v: &[R; N],
        a: &[R; N],
    ) -> ([[Pair<R>; 2]; N], [Composite<R>; G]) {
        let nothing = Pair::zero();
        let mut twists = [nothing; G];
        let mut accelerations = [nothing; G];
        let mut rates = [[nothing; 2]; N];
        let mut composites = [Composite::zero(); G];
        let free = Pair([R::zero(); 3], self.gravity.map(|g| -g));
        for (place, group) in groups.iter().enumerate() {
            let (mut twist, mut acceleration) = match twists.get(group.parent) {
                Some(twist) => {
                    let arm = self.arm(place, group.parent);
                    (twist.at(&arm), accelerations[group.parent].at(&arm))
                }
                None => (nothing, free),
            };
            for &j in group.coordinates {
                twist = twist.plus(v[j], &self.screw(j));
            }
            for (k, &j) in group.coordinates.iter().enumerate() {
                let screw = self.screw(j);
                rates[j][0] = match self.rates.get(group.given + k) {
                    Some([rate, _]) => Pair::of(rate),
                    None => twist.moves(&screw),
                };
                acceleration = acceleration.plus(v[j], &rates[j][0]).plus(a[j], &screw);
            }
            for (k, &j) in group.coordinates.iter().enumerate() {
                let screw = self.screw(j);
                rates[j][1] = match self.rates.get(group.given + k) {
                    Some([_, second]) => Pair::of(second).sum(&free.moves(&screw)),
                    None => acceleration.moves(&screw).sum(&twist.moves(&rates[j][0])),
                };
            }
            (twists[place], accelerations[place]) = (twist, acceleration);
            composites[place] = Composite::of(&self.inertias[place], &twist, &acceleration);
        }
        for (place, group) in groups.iter().enumerate().rev() {
            let own = composites[place];
            if let Some(parent) = composites.get_mut(group.parent) {
                parent.add(&own, &self.arm(place, group.parent));
            }
        }
        (rates, composites)
    }

    /// To the point of a group from that of another.
    fn arm(&self, to: usize, from: usize) -> Vector<R> {
        each(|i| self.points[to][i] - self.points[from][i])
    }

    fn screw(&self, coordinate: usize) -> Pair<R> {
        Pair::of(&self.screws[coordinate])
    }

    #[inline(never)]
    fn pairs(
        &self,
        groups: &[Group; G],
        rates: &[[Pair<R>; 2]; N],
        composites: &[Composite<R>; G],
    ) -> Linearization<R, N> {
        let zero = [[R::zero(); N]; N];
        let mut result = Linearization { mass: zero, by_q: zero, by_v: zero };
        let mut path = Path::<R, N>::new();
        let mut ends = [0; G];
        let mut changes = self.changes.iter();
        for (place, (group, bodies)) in groups.iter().zip(composites).enumerate() {
            let above = ends.get(group.parent).copied().unwrap_or(0);
            ends[place] = above + group.coordinates.len();
            let point = &self.points[place];
            for (k, &j) in group.coordinates.iter().enumerate() {
                let (screw, [rate, second]) = (self.screw(j), rates[j]);
                path.put(above + k, j, &[screw, rate, second].map(|part| part.from(point)));
                let moving = Moving::of(bodies, &screw, &rates[j]);
                for &i in group.coordinates {
                    let other = self.screw(i);
                    result.mass[i][j] = other.dot(&moving.momentum);
                    result.by_q[i][j] = -other.dot(&moving.by_q);
                    result.by_v[i][j] = -other.dot(&moving.by_v);
                }
                if above > 0 {
                    path.pairs_with(j, &moving.from(point), above, &mut result);
                }
            }
            if group.given < C {
                for &i in group.coordinates {
                    for &j in group.coordinates {
                        let Some(change) = changes.next() else { continue };
                        result.by_q[i][j] -= Pair::of(change).dot(&bodies.force);
                    }
                }
            }
        }
        result
    }
}

/// What a coordinate does to the bodies that it moves.
struct Moving<R> {
    /// I S.
    momentum: Pair<R>,
    /// S ×* F + I S̈ + B Ṡ.
    by_q: Pair<R>,
    /// 2 I Ṡ + B S.
    by_v: Pair<R>,
    /// Bᵀ S.
    back: Vector<R>,
}

impl<R: Real> Moving<R> {
    fn of(bodies: &Composite<R>, screw: &Pair<R>, [rate, second]: &[Pair<R>; 2]) -> Self {
        Moving {
            momentum: bodies.times(screw),
            by_q: screw.turns(&bodies.force).sum(&bodies.times(second)).sum(&bodies.gyrates(rate)),
            by_v: bodies.times(rate).doubled().sum(&bodies.gyrates(screw)),
            back: bodies.gyrates_back(screw),
        }
    }

    /// The same about the point that this one's point is counted from.
    fn from(&self, point: &Vector<R>) -> Self {
        let [momentum, by_q, by_v] =
            [&self.momentum, &self.by_q, &self.by_v].map(|wrench| wrench.wrench_from(point));
        Moving { momentum, by_q, by_v, back: self.back }
    }
}

impl<R: Real, const N: usize> Path<R, N> {
    fn new() -> Self {
        Path { coordinates: [0; N], blocks: [[[R::zero(); LANES]; 18]; N] }
    }

    fn put(&mut self, place: usize, coordinate: usize, parts: &[Pair<R>; 3]) {
        self.coordinates[place] = coordinate;
        let block = &mut self.blocks[place / LANES];
        let parts = parts.iter().flat_map(Pair::parts);
        block.iter_mut().zip(parts).for_each(|(row, part)| row[place % LANES] = part);
    }

    /// The entries of a coordinate with the first ones, which move more bodies.
    #[inline]
    fn pairs_with(&self, j: usize, moving: &Moving<R>, count: usize, result: &mut Linearization<R, N>) {
        let Moving { momentum, by_q, by_v, back } = moving;
        let (momentum, doubled) = (momentum.parts(), momentum.doubled().parts());
        let (by_q, by_v) = (by_q.parts(), by_v.parts());
        for (coordinates, block) in self.coordinates[..count].chunks(LANES).zip(&self.blocks) {
            let nothing = [R::zero(); LANES];
            let (mut across, mut ahead, mut inertia, mut below, mut behind) =
                (nothing, nothing, nothing, nothing, nothing);
            for i in 0..6 {
                let (screw, rate, second) = (&block[i], &block[6 + i], &block[12 + i]);
                add(&mut across, by_q[i], screw);
                add(&mut ahead, by_v[i], screw);
                add(&mut inertia, momentum[i], screw);
                add(&mut below, momentum[i], second);
                add(&mut behind, doubled[i], rate);
            }
            for (i, &back) in back.iter().enumerate() {
                add(&mut below, back, &block[6 + i]);
                add(&mut behind, back, &block[i]);
            }
            for (lane, &i) in coordinates.iter().enumerate() {
                result.by_q[i][j] = -across[lane];
                result.by_v[i][j] = -ahead[lane];
                result.mass[i][j] = inertia[lane];
                result.mass[j][i] = inertia[lane];
                result.by_q[j][i] = -below[lane];
                result.by_v[j][i] = -behind[lane];
            }
        }
    }
}

#[inline(always)]
fn add<R: Real>(sum: &mut [R; LANES], factor: R, row: &[R; LANES]) {
    for (sum, &entry) in sum.iter_mut().zip(row) {
        *sum = R::mul_add(factor, entry, *sum);
    }
}

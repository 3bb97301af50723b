//! Pairs of coordinates, of which one moves all that the other moves.

use super::composite::{Composite, Pair, Vector};
use super::motion::Motion;
use super::{Group, Screws};
use crate::number::real::Real;

/// Coordinates that are taken together with another one, on vectors.
pub(super) const LANES: usize = 4;

type Matrix<R, const N: usize> = [[R; N]; N];

/// Bodies that move as one, and M.
pub(super) struct Masses<R, const N: usize, const G: usize> {
    composites: [Composite<R>; G],
    /// I S of each coordinate.
    momenta: [Pair<R>; N],
    pub matrix: Matrix<R, N>,
}

impl<R: Real, const N: usize, const G: usize> Masses<R, N, G> {
    pub fn of<const C: usize, const P: usize>(
        screws: &Screws<R, N, G, C, P>,
        groups: &[Group; G],
        motion: &Motion<R, N, G>,
    ) -> Self {
        let mut composites = [Composite::zero(); G];
        for (place, composite) in composites.iter_mut().enumerate() {
            *composite = Composite::of(&screws.inertias[place], &motion.twists[place]);
        }
        for (place, group) in groups.iter().enumerate().rev() {
            let own = composites[place];
            if let Some(parent) = composites.get_mut(group.parent) {
                parent.add(&own, &screws.arm(place, group.parent));
            }
        }
        let mut masses = Masses { composites, momenta: [Pair::zero(); N], matrix: [[R::zero(); N]; N] };
        let mut path = Path::<R, N, 6>::new();
        let mut ends = [0; G];
        for (place, group) in groups.iter().enumerate() {
            let above = ends.get(group.parent).copied().unwrap_or(0);
            ends[place] = above + group.coordinates.len();
            let point = &screws.points[place];
            for (k, &j) in group.coordinates.iter().enumerate() {
                let screw = screws.screw(j);
                let momentum = masses.composites[place].inertia.times(&screw);
                masses.momenta[j] = momentum;
                for &i in group.coordinates {
                    masses.matrix[i][j] = screws.screw(i).dot(&momentum);
                }
                path.put(above + k, j, screw.from(point).parts());
                path.masses(j, &momentum.wrench_from(point), above, &mut masses.matrix);
            }
        }
        masses
    }
}

impl<R: Real, const N: usize, const G: usize, const C: usize, const P: usize> Screws<R, N, G, C, P> {
    /// ∂r/∂q and ∂r/∂v, into matrices of zeros.
    #[inline(never)]
    pub(super) fn derivatives(
        &self,
        groups: &[Group; G],
        motion: &Motion<R, N, G>,
        masses: &Masses<R, N, G>,
        a: &[R; N],
        [by_q, by_v]: [&mut Matrix<R, N>; 2],
    ) {
        let pushed = self.pushed(groups, a);
        let forces = motion.forces(self, groups, &pushed);
        let second_rates = motion.second_rates(self, groups, &pushed, a);
        let mut path = Path::<R, N, 18>::new();
        let mut ends = [0; G];
        let mut changes = self.changes.iter();
        for (place, group) in groups.iter().enumerate() {
            let (bodies, force) = (&masses.composites[place], &forces[place]);
            let above = ends.get(group.parent).copied().unwrap_or(0);
            ends[place] = above + group.coordinates.len();
            let point = &self.points[place];
            for (k, &j) in group.coordinates.iter().enumerate() {
                let parts = [self.screw(j), motion.rates[j], second_rates[j]];
                let [screw, rate, second] = &parts;
                let moving = Moving {
                    momentum: masses.momenta[j],
                    by_q: screw.turns(force).sum(&bodies.inertia.times(second)).sum(&bodies.gyrates(rate)),
                    by_v: bodies.inertia.times(rate).doubled().sum(&bodies.gyrates(screw)),
                    back: bodies.gyrates_back(screw),
                };
                for &i in group.coordinates {
                    let other = self.screw(i);
                    by_q[i][j] = -other.dot(&moving.by_q);
                    by_v[i][j] = -other.dot(&moving.by_v);
                }
                path.put(above + k, j, parts.iter().flat_map(|part| part.from(point).parts()));
                path.derivatives(j, &moving.from(point), above, [&mut *by_q, &mut *by_v]);
            }
            if group.given < C {
                for &i in group.coordinates {
                    for (&j, change) in group.coordinates.iter().zip(&mut changes) {
                        by_q[i][j] -= Pair::of(change).dot(force);
                    }
                }
            }
        }
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
    /// The same about the point that this one's point is counted from.
    fn from(&self, point: &Vector<R>) -> Self {
        Moving {
            momentum: self.momentum.wrench_from(point),
            by_q: self.by_q.wrench_from(point),
            by_v: self.by_v.wrench_from(point),
            back: self.back,
        }
    }
}

/// The coordinates on the way to a group.
struct Path<R, const N: usize, const S: usize> {
    coordinates: [usize; N],
    /// What belongs to some coordinates side by side.
    blocks: [[[R; LANES]; S]; N],
}

impl<R: Real, const N: usize, const S: usize> Path<R, N, S> {
    fn new() -> Self {
        Path { coordinates: [0; N], blocks: [[[R::zero(); LANES]; S]; N] }
    }

    fn put(&mut self, place: usize, coordinate: usize, parts: impl IntoIterator<Item = R>) {
        self.coordinates[place] = coordinate;
        let block = &mut self.blocks[place / LANES];
        block.iter_mut().zip(parts).for_each(|(row, part)| row[place % LANES] = part);
    }

    /// The first coordinates, which move more bodies, block by block.
    fn above(&self, count: usize) -> impl Iterator<Item = (&[usize], &[[R; LANES]; S])> {
        self.coordinates[..count].chunks(LANES).zip(&self.blocks)
    }
}

impl<R: Real, const N: usize> Path<R, N, 6> {
    /// Entries of M of a coordinate with the first ones.
    #[inline]
    fn masses(&self, j: usize, momentum: &Pair<R>, count: usize, mass: &mut Matrix<R, N>) {
        let momentum = momentum.parts();
        for (coordinates, block) in self.above(count) {
            let mut inertia = [R::zero(); LANES];
            for (&part, screw) in momentum.iter().zip(block) {
                add(&mut inertia, part, screw);
            }
            for (&i, inertia) in coordinates.iter().zip(inertia) {
                mass[i][j] = inertia;
                mass[j][i] = inertia;
            }
        }
    }
}

impl<R: Real, const N: usize> Path<R, N, 18> {
    /// Derivatives of a coordinate with the first ones.
    #[inline]
    fn derivatives(&self, j: usize, moving: &Moving<R>, count: usize, [of_q, of_v]: [&mut Matrix<R, N>; 2]) {
        let Moving { momentum, by_q, by_v, back } = moving;
        let (momentum, doubled) = (momentum.parts(), momentum.doubled().parts());
        let (by_q, by_v) = (by_q.parts(), by_v.parts());
        for (coordinates, block) in self.above(count) {
            let nothing = [R::zero(); LANES];
            let (mut across, mut ahead, mut below, mut behind) = (nothing, nothing, nothing, nothing);
            for i in 0..6 {
                let (screw, rate, second) = (&block[i], &block[6 + i], &block[12 + i]);
                add(&mut across, by_q[i], screw);
                add(&mut ahead, by_v[i], screw);
                add(&mut below, momentum[i], second);
                add(&mut behind, doubled[i], rate);
            }
            for (i, &back) in back.iter().enumerate() {
                add(&mut below, back, &block[6 + i]);
                add(&mut behind, back, &block[i]);
            }
            for (lane, &i) in coordinates.iter().enumerate() {
                of_q[i][j] = -across[lane];
                of_v[i][j] = -ahead[lane];
                of_q[j][i] = -below[lane];
                of_v[j][i] = -behind[lane];
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

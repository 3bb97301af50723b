//! Pairs of coordinates, of which one moves all that the other moves.

use super::composite::{Composite, Pair, Vector};
use super::motion::Motion;
use super::{Group, Screws};
use crate::number::real::Real;

/// The number of coordinates that are paired with another one at once, on vectors.
pub(super) const LANES: usize = 8;

type Matrix<R, const N: usize> = [[R; N]; N];

/// Bodies that move as one.
pub(super) struct Masses<R, const N: usize, const G: usize> {
    composites: [Composite<R>; G],
    /// I S of each coordinate.
    momenta: [Pair<R>; N],
}

impl<R: Real, const N: usize, const G: usize> Masses<R, N, G> {
    /// Of nothing.
    pub fn new() -> Self {
        Masses { composites: [Composite::zero(); G], momenta: [Pair::zero(); N] }
    }

    /// Fills in the bodies, and M into a matrix of zeros.
    #[inline(never)]
    pub fn fill<const C: usize, const P: usize>(
        &mut self,
        screws: &Screws<R, N, G, C, P>,
        groups: &[Group; G],
        motion: &Motion<R, N, G>,
        matrix: &mut Matrix<R, N>,
    ) {
        let Masses { composites, momenta } = self;
        for (place, composite) in composites.iter_mut().enumerate() {
            *composite = Composite::of(&screws.inertias[place], &motion.twists[place]);
        }
        for (place, group) in groups.iter().enumerate().rev() {
            let own = composites[place];
            if let Some(parent) = composites.get_mut(group.parent) {
                parent.add(&own, &screws.arm(place, group.parent));
            }
        }
        let mut path = Path::<R, N, 6>::new();
        let mut ends = [0; G];
        for (place, group) in groups.iter().enumerate() {
            let above = ends.get(group.parent).copied().unwrap_or(0);
            ends[place] = above + group.coordinates.len();
            let point = &screws.points[place];
            for (k, &j) in group.coordinates.iter().enumerate() {
                let screw = screws.screw(j);
                let momentum = composites[place].inertia.times(&screw);
                momenta[j] = momentum;
                for &i in group.coordinates {
                    matrix[i][j] = screws.screw(i).dot(&momentum);
                }
                path.coordinates[above + k] = j;
                put(&mut path.rows, above + k, &screw.from(point));
                if above > 0 {
                    path.masses(j, &momentum.wrench_from(point), above, matrix);
                }
            }
        }
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
        let forces = motion.forces(self, groups, Some(&pushed));
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
                path.coordinates[above + k] = j;
                for (part, rows) in parts.iter().zip(path.rows.as_chunks_mut::<6>().0) {
                    put(rows, above + k, &part.from(point));
                }
                if above > 0 {
                    path.derivatives(j, &moving.from(point), above, [&mut *by_q, &mut *by_v]);
                }
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
    /// What belongs to the coordinates, side by side.
    rows: [[R; N]; S],
}

impl<R: Real, const N: usize, const S: usize> Path<R, N, S> {
    fn new() -> Self {
        Path { coordinates: [0; N], rows: [[R::zero(); N]; S] }
    }

    /// The first coordinates, which move more bodies, some at a time: a block may begin with some of the one
    /// before, so that it ends within the rows.
    fn above(&self, count: usize) -> impl Iterator<Item = (usize, &[usize])> {
        let blocks = (0..count).step_by(LANES);
        blocks.map(move |first| {
            let first = first.min(N.saturating_sub(LANES));
            (first, &self.coordinates[first..count.min(first + LANES)])
        })
    }

    /// A part of a row; where the rows are shorter, all of it.
    #[inline(always)]
    fn part(&self, row: usize, first: usize) -> [R; LANES] {
        let row = &self.rows[row][first..];
        match row.first_chunk() {
            Some(part) => *part,
            None => {
                let mut part = [R::zero(); LANES];
                part.iter_mut().zip(row).for_each(|(part, &entry)| *part = entry);
                part
            }
        }
    }
}

impl<R: Real, const N: usize> Path<R, N, 6> {
    /// Entries of M of a coordinate with the first ones.
    #[inline]
    fn masses(&self, j: usize, momentum: &Pair<R>, count: usize, mass: &mut Matrix<R, N>) {
        let mut entries = [R::zero(); LANES];
        for (first, coordinates) in self.above(count) {
            self.along(momentum, first, &mut entries);
            for (&i, &entry) in coordinates.iter().zip(&entries) {
                mass[i][j] = entry;
                mass[j][i] = entry;
            }
        }
    }

    /// Components of a wrench along some screws. A function of its own, which ends with stores side by side:
    /// in a loop that scatters results the compiler takes numbers one by one.
    #[inline(never)]
    fn along(&self, wrench: &Pair<R>, first: usize, components: &mut [R; LANES]) {
        let mut sums = [R::zero(); LANES];
        for (i, part) in wrench.parts().into_iter().enumerate() {
            add(&mut sums, part, &self.part(i, first));
        }
        *components = sums;
    }
}

impl<R: Real, const N: usize> Path<R, N, 18> {
    /// Derivatives of a coordinate with the first ones.
    #[inline]
    fn derivatives(&self, j: usize, moving: &Moving<R>, count: usize, [of_q, of_v]: [&mut Matrix<R, N>; 2]) {
        let mut products = [[R::zero(); LANES]; 4];
        for (first, coordinates) in self.above(count) {
            self.products(moving, first, &mut products);
            let [across, ahead, below, behind] = &products;
            for (lane, &i) in coordinates.iter().enumerate() {
                of_q[i][j] = -across[lane];
                of_v[i][j] = -ahead[lane];
                of_q[j][i] = -below[lane];
                of_v[j][i] = -behind[lane];
            }
        }
    }

    /// What stands in the derivatives by q and v of some coordinates with one that they carry, less the sign:
    /// their rows, then their columns. A function of its own, as [`Path::along`] is.
    #[inline(never)]
    fn products(&self, moving: &Moving<R>, first: usize, products: &mut [[R; LANES]; 4]) {
        let Moving { momentum, by_q, by_v, back } = moving;
        let (momentum, by_q, by_v) = (momentum.parts(), by_q.parts(), by_v.parts());
        let nothing = [R::zero(); LANES];
        let (mut across, mut ahead, mut below, mut behind) = (nothing, nothing, nothing, nothing);
        for i in 0..6 {
            add(&mut across, by_q[i], &self.part(i, first));
            add(&mut ahead, by_v[i], &self.part(i, first));
            add(&mut below, momentum[i], &self.part(12 + i, first));
            add(&mut behind, momentum[i], &self.part(6 + i, first));
        }
        behind.iter_mut().for_each(|sum| *sum += *sum);
        for (i, &back) in back.iter().enumerate() {
            add(&mut below, back, &self.part(6 + i, first));
            add(&mut behind, back, &self.part(i, first));
        }
        *products = [across, ahead, below, behind];
    }
}

#[inline(always)]
fn put<R: Real, const N: usize>(rows: &mut [[R; N]; 6], place: usize, pair: &Pair<R>) {
    for (row, part) in rows.iter_mut().zip(pair.parts()) {
        row[place] = part;
    }
}

#[inline(always)]
fn add<R: Real>(sum: &mut [R; LANES], factor: R, row: &[R; LANES]) {
    for (sum, &entry) in sum.iter_mut().zip(row) {
        *sum = R::mul_add(factor, entry, *sum);
    }
}

//! Kinetic energies of the user's own positions and poses, whatever their type.

use nalgebra::{
    Isometry, OPoint, Quaternion, Rotation, SVector, Translation, Unit, UnitComplex, UnitQuaternion,
};

use super::derivative;
use crate::number::real::Real;

/// Most numbers that a pose has: a position and the entries of a rotation.
const MOST: usize = 12;

/// A position or a pose as numbers whose rates give the kinetic energy.
pub trait Placed<R> {
    /// Components of the position from place 0, those of the attitude from place 3: an angle; cosine and
    /// sine; or the nine entries of a rotation, row by row.
    fn components(&self) -> [R; MOST];

    /// Whether the attitude is that of a body in space.
    const SPATIAL: bool = false;
}

/// T = ½ m ṙ² + ½ ω·I ω of a particle or body on a path, and the uncertainty of it; `time` is the scale of
/// the path. The inertia of a planar body stands in the first entry.
///
/// With J = ½ tr I − I the energy of a rotation is ½ tr(Ṙ J Ṙᵀ), so that no angular velocity is formed.
pub fn kinetic<R: Real, P: Placed<R>>(
    path: impl Fn(R) -> P,
    time: R,
    mass: R,
    inertia: [[R; 3]; 3],
) -> (R, R) {
    let half = R::from_f64(0.5);
    let mut rates = [R::zero(); MOST];
    let mut doubts = [R::zero(); MOST];
    for (k, (rate, doubt)) in rates.iter_mut().zip(&mut doubts).enumerate() {
        (*rate, *doubt) = derivative(|x| path(x).components()[k.min(MOST - 1)], time);
    }
    let trace = half * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    let weight = |a: usize, b: usize| if a == b { trace - inertia[a][b] } else { -inertia[a][b] };
    let (mut energy, mut doubt) = (R::zero(), R::zero());
    for (&rate, &uncertain) in rates.iter().zip(&doubts).take(3) {
        energy += half * mass * rate * rate;
        doubt += mass.abs() * rate.abs() * uncertain;
    }
    if P::SPATIAL {
        for row in 1..4 {
            for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))) {
                let (left, right) = (rates[3 * row + a], rates[3 * row + b]);
                energy += half * weight(a, b) * left * right;
                doubt += weight(a, b).abs() * left.abs() * doubts[3 * row + b];
            }
        }
    } else {
        for (&rate, &uncertain) in rates.iter().zip(&doubts).skip(3) {
            energy += half * inertia[0][0] * rate * rate;
            doubt += inertia[0][0].abs() * rate.abs() * uncertain;
        }
    }
    (energy, doubt)
}

fn joined<R: Real>(position: &[R], attitude: &[R]) -> [R; MOST] {
    let mut all = [R::zero(); MOST];
    all.iter_mut().zip(position).for_each(|(to, &from)| *to = from);
    all.iter_mut().skip(3).zip(attitude).for_each(|(to, &from)| *to = from);
    all
}

/// Positions on a line.
impl<R: Real> Placed<R> for R {
    fn components(&self) -> [R; MOST] {
        joined(&[*self], &[])
    }
}

impl<R: Real, const D: usize> Placed<R> for SVector<R, D> {
    fn components(&self) -> [R; MOST] {
        joined(self.as_slice(), &[])
    }
}

impl<R: Real, const D: usize> Placed<R> for OPoint<R, nalgebra::Const<D>> {
    fn components(&self) -> [R; MOST] {
        joined(self.coords.as_slice(), &[])
    }
}

/// An attitude.
pub trait Turned<R> {
    /// Its numbers.
    fn numbers(&self) -> [R; 9];
    /// Whether it is that of a body in space.
    const SPATIAL: bool;
}

impl<R: Real> Turned<R> for R {
    fn numbers(&self) -> [R; 9] {
        let mut all = [R::zero(); 9];
        all[0] = *self;
        all
    }
    const SPATIAL: bool = false;
}

impl<R: Real> Turned<R> for UnitComplex<R> {
    fn numbers(&self) -> [R; 9] {
        let mut all = [R::zero(); 9];
        (all[0], all[1]) = (self.as_ref().re, self.as_ref().im);
        all
    }
    const SPATIAL: bool = false;
}

impl<R: Real> Turned<R> for Rotation<R, 2> {
    fn numbers(&self) -> [R; 9] {
        let mut all = [R::zero(); 9];
        let [[cos, sin], _] = self.matrix().data.0;
        (all[0], all[1]) = (cos, sin);
        all
    }
    const SPATIAL: bool = false;
}

impl<R: Real> Turned<R> for Rotation<R, 3> {
    fn numbers(&self) -> [R; 9] {
        let [[a, d, g], [b, e, h], [c, f, i]] = self.matrix().data.0;
        [a, b, c, d, e, f, g, h, i]
    }
    const SPATIAL: bool = true;
}

impl<R: Real> Turned<R> for UnitQuaternion<R> {
    fn numbers(&self) -> [R; 9] {
        let quaternion: &Quaternion<R> = Unit::as_ref(self);
        let [[i, j, k, w]] = quaternion.coords.data.0;
        let two = R::from_f64(2.0);
        let one = R::one();
        [
            one - two * (j * j + k * k),
            two * (i * j - w * k),
            two * (i * k + w * j),
            two * (i * j + w * k),
            one - two * (i * i + k * k),
            two * (j * k - w * i),
            two * (i * k - w * j),
            two * (j * k + w * i),
            one - two * (i * i + j * j),
        ]
    }
    const SPATIAL: bool = true;
}

impl<R: Real, P: Placed<R>, T: Turned<R>> Placed<R> for (P, T) {
    fn components(&self) -> [R; MOST] {
        let [x, y, z, ..] = self.0.components();
        joined(&[x, y, z], &self.1.numbers())
    }
    const SPATIAL: bool = T::SPATIAL;
}

impl<R: Real, T: Turned<R>, const D: usize> Placed<R> for Isometry<R, T, D> {
    fn components(&self) -> [R; MOST] {
        let Translation { vector } = &self.translation;
        joined(vector.as_slice(), &self.rotation.numbers())
    }
    const SPATIAL: bool = T::SPATIAL;
}

/// An argument that a function takes by reference or by value.
pub trait Given<T> {
    /// The argument.
    fn give(self) -> T;
}

impl<'a, T> Given<&'a T> for &'a T {
    fn give(self) -> &'a T {
        self
    }
}

impl<T: Copy> Given<T> for &T {
    fn give(self) -> T {
        *self
    }
}

/// The argument that a function takes.
#[inline]
pub fn given<'a, T, G>(value: &'a T) -> G
where
    &'a T: Given<G>,
{
    value.give()
}

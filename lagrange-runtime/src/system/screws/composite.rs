//! Twists, wrenches, and bodies that move as one.

use crate::number::real::Real;

pub(super) type Vector<R> = [R; 3];

/// A twist, or a wrench: angular part, linear part.
#[derive(Clone, Copy)]
pub(super) struct Pair<R>(pub Vector<R>, pub Vector<R>);

/// Mass, first moment, and moments of inertia about a point.
#[derive(Clone, Copy)]
pub(super) struct Inertia<R> {
    mass: R,
    moment: Vector<R>,
    turning: [Vector<R>; 3],
}

/// Bodies as one, at a state.
#[derive(Clone, Copy)]
pub(super) struct Composite<R> {
    pub inertia: Inertia<R>,
    /// The columns of G.
    gyration: [Vector<R>; 3],
    /// P.
    momentum: Vector<R>,
}

impl<R: Real> Pair<R> {
    pub fn zero() -> Self {
        Pair([R::zero(); 3], [R::zero(); 3])
    }

    pub fn of(&[a, b, c, d, e, f]: &[R; 6]) -> Self {
        Pair([a, b, c], [d, e, f])
    }

    /// The sum with a multiple.
    pub fn plus(&self, factor: R, other: &Self) -> Self {
        let both = |a: &Vector<R>, b: &Vector<R>| each(|i| R::mul_add(factor, b[i], a[i]));
        Pair(both(&self.0, &other.0), both(&self.1, &other.1))
    }

    pub fn parts(&self) -> [R; 6] {
        let Pair([a, b, c], [d, e, f]) = *self;
        [a, b, c, d, e, f]
    }

    pub fn sum(&self, other: &Self) -> Self {
        Pair(sum(&self.0, &other.0), sum(&self.1, &other.1))
    }

    pub fn doubled(&self) -> Self {
        self.sum(self)
    }

    pub fn dot(&self, other: &Self) -> R {
        dot(&self.0, &other.0) + dot(&self.1, &other.1)
    }

    /// A twist about a point that lies at an arm from that of `self`.
    pub fn at(&self, arm: &Vector<R>) -> Self {
        Pair(self.0, plus_cross(&self.1, &self.0, arm))
    }

    /// A twist about the point that its own point is counted from.
    pub fn from(&self, point: &Vector<R>) -> Self {
        Pair(self.0, plus_cross(&self.1, point, &self.0))
    }

    /// A wrench about the point that its own point is counted from.
    pub fn wrench_from(&self, point: &Vector<R>) -> Self {
        Pair(plus_cross(&self.0, point, &self.1), self.1)
    }

    /// The rate of a twist that moves along with `self`: self × twist.
    pub fn moves(&self, twist: &Self) -> Self {
        let linear = plus_cross(&cross(&self.0, &twist.1), &self.1, &twist.0);
        Pair(cross(&self.0, &twist.0), linear)
    }

    /// The rate of a wrench that moves along with `self`: self ×* wrench.
    pub fn turns(&self, wrench: &Self) -> Self {
        let angular = plus_cross(&cross(&self.0, &wrench.0), &self.1, &wrench.1);
        Pair(angular, cross(&self.0, &wrench.1))
    }
}

impl<R: Real> Inertia<R> {
    pub fn of(&[mass, hx, hy, hz, xx, xy, xz, yy, yz, zz]: &[R; 10]) -> Self {
        Inertia { mass, moment: [hx, hy, hz], turning: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] }
    }

    /// I x.
    #[inline]
    pub fn times(&self, Pair(angular, linear): &Pair<R>) -> Pair<R> {
        let turned = each(|i| dot(&self.turning[i], angular));
        let pushed = each(|i| self.mass * linear[i]);
        Pair(plus_cross(&turned, &self.moment, linear), plus_cross(&pushed, angular, &self.moment))
    }
}

impl<R: Real> Composite<R> {
    pub fn zero() -> Self {
        let nothing = [R::zero(); 3];
        let inertia = Inertia { mass: R::zero(), moment: nothing, turning: [nothing; 3] };
        Composite { inertia, gyration: [nothing; 3], momentum: nothing }
    }

    pub fn of(inertia: &[R; 10], Pair(spin, velocity): &Pair<R>) -> Self {
        let inertia = Inertia::of(inertia);
        let Inertia { mass, moment, turning } = &inertia;
        let momentum = plus_cross(&each(|i| *mass * velocity[i]), spin, moment);
        // G x = ω × (J x − ½ tr J x) − (h × v) × x − v × (h × x).
        let half = (turning[0][0] + turning[1][1] + turning[2][2]) * R::from_f64(0.5);
        let [cx, cy, cz] = cross(moment, velocity);
        let along = dot(velocity, moment);
        let zero = R::zero();
        let crossed = [[zero, -cz, cy], [cz, zero, -cx], [-cy, cx, zero]];
        let mut gyration = crossed;
        for k in 0..3 {
            let mut column = turning[k];
            column[k] -= half;
            let turned = plus_cross(&crossed[k], spin, &column);
            gyration[k] = each(|i| R::mul_add(-moment[i], velocity[k], turned[i]));
            gyration[k][k] += along;
        }
        Composite { inertia, gyration, momentum }
    }

    /// Adds bodies whose point lies at an arm from that of `self`.
    pub fn add(&mut self, Composite { inertia, gyration, momentum }: &Self, arm: &Vector<R>) {
        let Inertia { mass, moment, turning } = inertia;
        // About the other point: h + m d, J + (d·h′ + d·h) 1 − d h′ᵀ − h dᵀ, G + (d·P) 1 − P dᵀ.
        let carried = each(|i| R::mul_add(*mass, arm[i], moment[i]));
        let (round, along) = (dot(arm, &carried) + dot(arm, moment), dot(arm, momentum));
        for k in 0..3 {
            for i in 0..3 {
                let shift = R::mul_add(-arm[k], carried[i], turning[k][i]);
                self.inertia.turning[k][i] += R::mul_add(-moment[k], arm[i], shift);
                self.gyration[k][i] += R::mul_add(-momentum[i], arm[k], gyration[k][i]);
            }
            self.inertia.turning[k][k] += round;
            self.gyration[k][k] += along;
        }
        self.inertia.mass += *mass;
        self.inertia.moment = sum(&self.inertia.moment, &carried);
        self.momentum = sum(&self.momentum, momentum);
    }

    /// B x.
    pub fn gyrates(&self, Pair(x, _): &Pair<R>) -> Pair<R> {
        let [a, b, c] = &self.gyration;
        let torque = each(|i| R::mul_add(a[i], x[0], R::mul_add(b[i], x[1], c[i] * x[2])));
        Pair(torque, cross(x, &self.momentum)).doubled()
    }

    /// The angular part of Bᵀ x, the only one.
    pub fn gyrates_back(&self, Pair(angular, linear): &Pair<R>) -> Vector<R> {
        let across = cross(&self.momentum, linear);
        let half = each(|k| dot(&self.gyration[k], angular) + across[k]);
        sum(&half, &half)
    }
}

/// The vector whose components a function gives. They are written out because the compiler leaves a call of a
/// function where `map` of an array stands.
#[inline(always)]
pub(super) fn each<R>(part: impl Fn(usize) -> R) -> Vector<R> {
    [part(0), part(1), part(2)]
}

#[inline(always)]
fn cross<R: Real>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    let part = |i: usize, j: usize| R::mul_add(a[i], b[j], -(a[j] * b[i]));
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// c + a × b.
#[inline(always)]
fn plus_cross<R: Real>(c: &Vector<R>, a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    let part = |k: usize, i: usize, j: usize| R::mul_add(a[i], b[j], R::mul_add(-a[j], b[i], c[k]));
    [part(0, 1, 2), part(1, 2, 0), part(2, 0, 1)]
}

#[inline(always)]
fn dot<R: Real>(a: &Vector<R>, b: &Vector<R>) -> R {
    R::mul_add(a[0], b[0], R::mul_add(a[1], b[1], a[2] * b[2]))
}

#[inline(always)]
fn sum<R: Real>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    each(|i| a[i] + b[i])
}

//! A four-bar linkage: a loop, which two constraints close.

use lagrangian::prelude::*;

/// Crank, coupler and rocker between two pivots, with their masses in the middle of the bars. With the
/// lengths of `a_four_bar` the shortest and the longest are together less than the others, so the crank turns
/// all round and the loop is never flat.
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    /// Lengths of crank, coupler and rocker \[m].
    pub l: [f64; 3],
    /// Their masses \[kg].
    pub m: [f64; 3],
    /// Distance of the pivots \[m].
    pub ground: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [crank, coupler, rocker])]
impl FourBar {
    /// A vector along a bar, from its angle to the ground.
    fn along(&self, angle: f64, length: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin()) * length
    }

    #[point(mass = self.m[0])]
    fn crank_mass(&self, q: &Coordinates) -> Vector2<f64> {
        self.along(q.crank, 0.5 * self.l[0])
    }

    #[point(mass = self.m[1])]
    fn coupler_mass(&self, q: &Coordinates) -> Vector2<f64> {
        self.along(q.crank, self.l[0]) + self.along(q.coupler, 0.5 * self.l[1])
    }

    #[point(mass = self.m[2])]
    fn rocker_mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(self.ground, 0.0) + self.along(q.rocker, 0.5 * self.l[2])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g
            * (self.m[0] * self.crank_mass(q).y
                + self.m[1] * self.coupler_mass(q).y
                + self.m[2] * self.rocker_mass(q).y)
    }

    /// The coupler ends where the rocker does.
    #[holonomic]
    fn closed(&self, q: &Coordinates) -> Vector2<f64> {
        self.along(q.crank, self.l[0]) + self.along(q.coupler, self.l[1])
            - Vector2::new(self.ground, 0.0)
            - self.along(q.rocker, self.l[2])
    }
}

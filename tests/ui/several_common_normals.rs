//! Common sizes of reactions that are none.

use lagrangian::prelude::*;

pub struct Rod {
    pub mass: f64,
    pub mu: f64,
}

#[lagrangian(coordinates = [a: [2], b: [2]])]
impl Rod {
    #[point(mass = self.mass)]
    fn one(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.a[0], q.a[1])
    }

    #[point(mass = self.mass)]
    fn other(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.b[0], q.b[1])
    }

    #[holonomic]
    fn across(&self, q: &Coordinates) -> f64 {
        self.one(q).x
    }

    #[holonomic]
    fn along(&self, q: &Coordinates) -> f64 {
        self.other(q).y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        self.one(q).y
    }

    #[friction(coefficient = self.mu, normal = [across, along])]
    fn at_two_places(&self, v: &Velocities) -> f64 {
        v.a[1]
    }

    #[friction(coefficient = self.mu, normal = [across, across])]
    fn at_one_twice(&self, v: &Velocities) -> f64 {
        v.a[1]
    }

    #[friction(coefficient = self.mu, normal = [across, floor])]
    fn with_a_gap(&self, v: &Velocities) -> f64 {
        v.a[1]
    }

    #[friction(coefficient = self.mu, normal = one)]
    fn beside_a_gap(&self, v: &Velocities) -> f64 {
        v.a[1]
    }

    #[friction(coefficient = self.mu, normal = [])]
    fn of_none(&self, v: &Velocities) -> f64 {
        v.a[1]
    }
}

fn main() {}

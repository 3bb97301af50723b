//! A planet and its sun.

use lagrangian::prelude::*;

/// A planet that a resting sun attracts, in the plane of its orbit.
#[derive(Clone, Copy, Debug)]
pub struct Kepler {
    /// Gravitational parameter of the sun \[m³/s²].
    pub mu: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Kepler {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn attraction(&self, q: &Coordinates) -> f64 {
        -self.mu / self.planet(q).norm()
    }
}

//! A chain of five links.

use lagrangian::prelude::*;

/// Point masses on massless links, hung up at one end, in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct Links {
    /// Mass at the end of each link \[kg].
    pub mass: f64,
    /// Length of each link \[m].
    pub length: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [theta: [LINKS]])]
impl Links {
    /// The number of links.
    pub const LINKS: usize = 5;

    /// Angles are measured from the downward vertical.
    #[point(mass = self.mass)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; Self::LINKS] {
        let mut end = Vector2::zeros();
        q.theta.map(|theta| {
            end += self.length * Vector2::new(theta.sin(), -theta.cos());
            end
        })
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| self.mass * self.g * joint.y).sum()
    }
}

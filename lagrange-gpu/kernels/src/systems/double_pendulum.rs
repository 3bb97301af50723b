//! Two point masses on massless rods.

use lagrangian::prelude::*;

/// The upper mass hangs on the wall, the lower one on the upper.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Masses \[kg].
    pub m: [f64; 2],
    /// Rod lengths \[m].
    pub l: [f64; 2],
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [theta: [2]])]
impl DoublePendulum {
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) * self.l[0]
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos()) * self.l[1]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }
}

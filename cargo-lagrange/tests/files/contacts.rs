pub struct Puck {
    pub mass: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = self.mass)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * self.mass * q.y
    }

    #[unilateral]
    fn gap(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = 0.3, normal = gap)]
    fn grip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

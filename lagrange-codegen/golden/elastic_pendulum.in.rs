#[lagrangian(coordinates = [theta, r], inputs = [motor], jacobians)]
impl ElasticPendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        q.r * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.bob(q).y
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (q.r - self.length).powi(2)
    }

    #[force(on = theta)]
    fn motor(&self, u: &Inputs) -> f64 {
        u.motor
    }
}

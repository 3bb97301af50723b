#[lagrangian(coordinates = [theta], analysis)]
impl RotatingPendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates, t: f64) -> Vector3<f64> {
        let out = self.length * q.theta.sin();
        let (sin, cos) = (self.rate * t).sin_cos();
        Vector3::new(out * cos, out * sin, -self.length * q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        self.mass * self.g * self.bob(q, t).z
    }
}

#[lagrangian(coordinates = [theta: [2]])]
impl DoublePendulum {
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }
}

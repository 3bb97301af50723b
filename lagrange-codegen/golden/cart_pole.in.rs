#[lagrangian(coordinates = [x, theta], inputs = [motor])]
impl<R: Real> CartPole<R> {
    #[point(mass = self.cart_mass)]
    fn cart(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, R::zero())
    }

    #[point(mass = self.pole_mass)]
    fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.pole_mass * self.g * self.tip(q).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities<R>) -> R {
        0.5 * self.damping * v.theta.powi(2)
    }

    #[force(at = cart)]
    fn motor(&self, u: &Inputs<R>) -> Vector2<R> {
        Vector2::new(u.motor, R::zero())
    }
}

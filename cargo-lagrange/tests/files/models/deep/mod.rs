#[lagrangian(coordinates = [x])]
impl Deep {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * self.mass * v.x.powi(2)
    }
}

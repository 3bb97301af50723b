#[lagrangian(coordinates = [phi, theta, psi])]
impl Top {
    #[body(mass = self.mass, inertia = [self.across, self.across, self.along])]
    fn gyroscope(&self, q: &Coordinates) -> Isometry3<f64> {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        Isometry3::from_parts((attitude * Vector3::new(0.0, 0.0, self.arm)).into(), attitude.into())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * self.arm * q.theta.cos()
    }
}

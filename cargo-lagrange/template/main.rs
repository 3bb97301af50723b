use lagrangian::prelude::*;

/// A pendulum with friction in its hinge.
pub struct Pendulum {
    /// Mass [kg].
    pub mass: f64,
    /// Length [m].
    pub length: f64,
    /// Gravity [m/s²].
    pub gravity: f64,
    /// Damping of the hinge [N·m·s].
    pub damping: f64,
}

// `theta` is the angle from the lowest position [rad].
#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.mass * self.gravity * self.bob(q).y
    }

    #[dissipation]
    fn hinge(&self, _q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * self.damping * v.theta.powi(2)
    }
}

fn main() -> Result<(), MotionError<f64>> {
    let pendulum = Pendulum { mass: 1.0, length: 1.0, gravity: 9.81, damping: 0.1 };
    let mut motion = pendulum.simulate(State::at_rest([2.0]));
    println!(" t [s]   theta [rad]    energy [J]");
    for step in 0..=20 {
        motion.advance_to(0.5 * f64::from(step))?;
        let state = motion.state();
        println!("{:6.2}  {:12.6}  {:12.6}", state.t, state.q[0], motion.energy());
    }
    Ok(())
}

//! A mass on springs in a turning frame: the motor that turns it does work, so T + V is not conserved,
//! but the Jacobi integral is.

use std::error::Error;

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

/// A mass held by two springs at right angles in a frame that a motor turns.
#[derive(Clone, Copy, Debug)]
pub struct RotatingFrame {
    /// Mass \[kg].
    pub mass: f64,
    /// Stiffness along the x and y axes of the frame \[N/m].
    pub stiffness: [f64; 2],
    /// Damping along the x axis of the frame \[N s/m].
    pub damping: f64,
    /// Angular velocity of the frame \[rad/s].
    pub rate: f64,
}

#[lagrangian(coordinates = [x, y])]
impl RotatingFrame {
    /// Position in space; x and y count in the frame.
    #[point(mass = self.mass)]
    fn position(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        Rotation2::new(self.rate * t) * Vector2::new(q.x, q.y)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (self.stiffness[0] * q.x.powi(2) + self.stiffness[1] * q.y.powi(2))
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.x.powi(2)
    }
}

impl RotatingFrame {
    /// Angular momentum about the axis of the frame \[kg m²/s].
    pub fn angular_momentum(&self, state: &State<f64, 2>) -> f64 {
        let ([x, y], [px, py]) = (state.q, self.momenta(state));
        x * py - y * px
    }
}

/// Energy balance without damping, then the damped motion against its exact solution.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n", RotatingFrame::STRUCTURE);
    let free = RotatingFrame { mass: 1.0, stiffness: [20.0, 30.0], damping: 0.0, rate: 2.0 };
    let start = State::new([0.1, -0.05], [0.0, 0.3]);
    let mut motion = free.simulate(start).with_tolerance(1e-13);
    let states = motion.every(0.01).take(1001).collect::<Result<Vec<_>, _>>()?;

    // The motor's work is its torque, the rate of change of angular momentum, times the angle turned.
    println!("  t [s]    T + V [J]   motor's work [J]   Jacobi integral [J]");
    let work =
        |state: &State<f64, 2>| free.rate * (free.angular_momentum(state) - free.angular_momentum(&start));
    for state in states.iter().step_by(100) {
        let (energy, jacobi) = (free.energy(state), free.jacobi_integral(state));
        println!("{:7.2} {energy:12.9} {:18.9} {jacobi:21.15}", state.t, work(state));
    }
    let range = |value: &dyn Fn(&State<f64, 2>) -> f64| {
        let values = || states.iter().map(value);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    let varies = range(&|state| free.energy(state)) / free.energy(&start);
    let drifts = range(&|state| free.jacobi_integral(state)) / free.jacobi_integral(&start);
    let unbooked = range(&|state| free.energy(state) - work(state)) / free.energy(&start);
    println!("\nT + V varies by {:.1} %, the Jacobi integral by {drifts:.1e} of itself", 100.0 * varies);

    // The damped system is linear; its matrix exponential gives the state after 5 s.
    let damped = RotatingFrame { damping: 0.4, ..free };
    let mut settling = damped.simulate(start).with_tolerance(1e-13);
    let reached: Vec<f64> = settling.advance_to(5.0)?.iter().collect();
    let exact = [
        0.016_309_761_580_395_77,
        0.058_079_316_386_490_25,
        -0.194_417_882_975_006_92,
        -0.093_730_675_309_278_3,
    ];
    let miss = reached.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("Damped, after 5 s: {miss:.1e} from the matrix exponential");

    let in_space = |state: &State<f64, 2>| {
        let position = free.position(&state.q.into(), state.t);
        (position.x, position.y)
    };
    let charts = [
        Chart::new("Seen from the frame", "x [m]", "y [m]")
            .equal_scales()
            .line("", states.iter().map(|state| (state.q[0], state.q[1]))),
        Chart::new("Seen from outside", "x [m]", "y [m]")
            .equal_scales()
            .line("", states.iter().map(in_space)),
        Chart::new("Only one of them is conserved", "time [s]", "energy [J]")
            .line("T + V", states.iter().map(|state| (state.t, free.energy(state))))
            .line("Jacobi integral", states.iter().map(|state| (state.t, free.jacobi_integral(state)))),
    ];
    println!("Drawn: {}", Figure::new(charts).save("target/rotating_frame.svg")?.display());

    assert!(varies > 0.1, "the motor does no work");
    assert!(drifts < 1e-11, "the Jacobi integral changed by {drifts:e} of itself");
    assert!(unbooked < 1e-11, "T + V changed by {unbooked:e} more than the motor's work");
    assert!(miss < 1e-11, "the damped motion is {miss:e} off");
    Ok(())
}

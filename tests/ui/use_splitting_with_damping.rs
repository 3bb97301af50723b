//! A splitting method for a system with damping.

use lagrangian::prelude::*;

pub struct Oscillator {
    pub damping: f64,
}

#[lagrangian(coordinates = [x])]
impl Oscillator {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * q.x.powi(2)
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.x.powi(2)
    }
}

fn main() {
    let oscillator = Oscillator { damping: 0.1 };
    let _ = oscillator.stepper::<BlanesMoan4>(State::at_rest([1.0]));
}

//! Masses of very different sizes: heavy bodies do not hide that a light one is off its constraints.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// Three points on rods.
struct Chain {
    masses: [f64; 3],
    rods: [f64; 3],
}

#[lagrangian(coordinates = [x: [3], y: [3]])]
impl Chain {
    #[point(mass = self.masses[..])]
    fn points(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        [0, 1, 2].map(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * (self.masses[0] * q.y[0] + self.masses[1] * q.y[1] + self.masses[2] * q.y[2])
    }

    #[holonomic]
    fn lengths(&self, q: &Coordinates) -> [f64; 3] {
        let mut last = Vector2::zeros();
        let mut lengths = [0.0; 3];
        for i in 0..3 {
            let end = Vector2::new(q.x[i], q.y[i]);
            lengths[i] = (end - last).norm_squared() - self.rods[i] * self.rods[i];
            last = end;
        }
        lengths
    }
}

fn off(chain: &Chain, state: &State<f64, 6>) -> f64 {
    chain.constraint_residuals(state).iter().fold(0.0, |off: f64, residual| off.max(residual.abs()))
}

/// Up to a ratio of 1e14. A ratio of inertias costs half of its digits: ε √1e14 of lengths up to 6 m.
#[test]
fn what_is_found_is_on_the_constraints_whatever_the_masses() {
    let mut samples = Samples::new(57);
    let mut found = 0;
    for trial in 0..3000 {
        let decades = 1.0 + f64::from(trial % 7);
        let masses = [(); 3].map(|()| 10.0_f64.powf(samples.number(-decades, decades)));
        let chain = Chain { masses, rods: [(); 3].map(|()| samples.number(0.5, 2.0)) };
        let rough = [0.0, 1e-6, 1e-3, 0.1, 0.5, 2.0][trial as usize % 6];
        let (mut q, mut end) = ([0.0; 6], Vector2::zeros());
        for i in 0..3 {
            let angle: f64 = samples.number(-3.0, 3.0);
            end += chain.rods[i] * Vector2::new(angle.sin(), -angle.cos());
            q[i] = end.x + rough * samples.number(-1.0, 1.0);
            q[i + 3] = end.y + rough * samples.number(-1.0, 1.0);
        }
        let start = State::new(q, [(); 6].map(|()| samples.number(-1.0, 1.0)));
        let Ok(state) = chain.consistent(start) else { continue };
        assert!(off(&chain, &state) < 1e-9, "{masses:?} {start:?}: {:e}", off(&chain, &state));
        found += 1;
        if let Ok(end) = chain.simulate(state).with_tolerance(1e-8).advance_to(0.1) {
            assert!(off(&chain, end) < 1e-9, "{masses:?} {start:?}: {:e}", off(&chain, end));
        }
    }
    assert!(found > 2700, "{found}");
}

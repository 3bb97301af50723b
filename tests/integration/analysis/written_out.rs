//! Motions with derivatives of random systems against the variational equations written out, Φ′ = (∂f/∂x) Φ +
//! ∂f/∂p, with the symbolic derivatives of the equations, and extrapolated (Gragg; Hairer, Nørsett, Wanner,
//! *Solving Ordinary Differential Equations I*, § II.9): neither the method nor the derivatives are those of
//! the motions.

use lagrangian::prelude::*;

use crate::support::close::close_on;

/// Three coordinates with inertia that depends on place, waves of potential, friction, gyroscopic and driving
/// forces.
#[derive(Clone, Copy)]
struct Waves {
    mass: [f64; 3],
    coupling: f64,
    height: [f64; 4],
    wave: [f64; 12],
    stiffness: f64,
    friction: f64,
    drive: f64,
}

#[lagrangian(coordinates = [x: [3]], sensitivities = [self.mass[1], self.height[2], self.friction, self.drive])]
impl Waves {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        (0..3).map(|i| 0.5 * self.mass[i] * v.x[i].powi(2)).sum::<f64>()
            + self.coupling * (q.x[0] - q.x[1]).cos() * v.x[0] * v.x[1]
            + 0.2 * q.x[2].sin().powi(2) * v.x[1].powi(2)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        let mut sum = (0.3 * q.x[2]).exp();
        for i in 0..3 {
            sum += 0.5 * self.stiffness * q.x[i].powi(2);
        }
        for k in 0..4 {
            let phase = (0..3).map(|i| self.wave[3 * k + i] * q.x[i]).sum::<f64>();
            sum += self.height[k] * (phase + 0.5).cos() + 0.1 / (2.0 + phase.sin());
        }
        sum
    }

    #[dissipation]
    fn friction(&self, v: &Velocities) -> f64 {
        0.5 * self.friction * ((v.x[0] - v.x[2]).powi(2) + v.x[1].powi(2))
    }

    #[force(on = x)]
    fn drive(&self, q: &Coordinates, v: &Velocities, t: f64) -> [f64; 3] {
        let turn = 0.3 * q.x[0].tanh();
        [self.drive * (1.3 * t + q.x[1]).sin() - turn * v.x[1], turn * v.x[0], 0.0]
    }
}

/// Numbers between −1 and 1, the same in every run (Marsaglia's xorshift).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / 2.0_f64.powi(52) - 1.0
    }

    fn several<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.next())
    }
}

/// q, v and Φ by columns of six numbers: three coordinates, three velocities and four parameters.
type Whole = [f64; 66];

fn rates(system: &Waves, t: f64, x: &Whole) -> Whole {
    let state = State { t, q: std::array::from_fn(|i| x[i]), v: std::array::from_fn(|i| x[3 + i]) };
    let a = system.accelerations(&state).unwrap();
    let response = system.response(&state, &[]).unwrap();
    let by_p = system.sensitivities(&state, &[]).unwrap().accelerations;
    let mut rates = [0.0; 66];
    for i in 0..3 {
        (rates[i], rates[3 + i]) = (state.v[i], a[i]);
        for column in 0..10 {
            let at = 6 * (column + 1);
            let along =
                (0..3).map(|j| response.by_q[(i, j)] * x[at + j] + response.by_v[(i, j)] * x[at + 3 + j]);
            let own = if column < 6 { 0.0 } else { by_p[(i, column - 6)] };
            (rates[at + i], rates[at + 3 + i]) = (x[at + 3 + i], along.sum::<f64>() + own);
        }
    }
    rates
}

/// One step of Gragg's midpoint rule in 2, 4, … 16 parts, extrapolated to parts of no length.
fn extrapolated(system: &Waves, t: f64, x: &Whole, step: f64) -> Whole {
    let mut table: Vec<Whole> = Vec::new();
    for row in 0..8_usize {
        let parts = 2 * (row + 1);
        let h = step / parts as f64;
        let moved = |x: &Whole, by: f64, rates: &Whole| std::array::from_fn(|i| x[i] + by * rates[i]);
        let (mut before, mut now): (Whole, Whole) = (*x, moved(x, h, &rates(system, t, x)));
        for part in 1..parts {
            let next = moved(&before, 2.0 * h, &rates(system, t + part as f64 * h, &now));
            (before, now) = (now, next);
        }
        table.push(now);
        for column in (0..row).rev() {
            let ratio = ((row + 1) as f64 / (column + 1) as f64).powi(2) - 1.0;
            let finer = table[column + 1];
            for i in 0..66 {
                table[column][i] = finer[i] + (finer[i] - table[column][i]) / ratio;
            }
        }
    }
    table[0]
}

#[test]
fn derivatives_of_random_motions() {
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    for _ in 0..12 {
        let system = Waves {
            mass: numbers.several().map(|x: f64| 1.5 + x),
            coupling: 0.3 * numbers.next(),
            height: numbers.several(),
            wave: numbers.several().map(|x: f64| 2.0 * x),
            stiffness: 1.0 + 0.5 * numbers.next(),
            friction: 0.2 + 0.2 * numbers.next(),
            drive: numbers.next(),
        };
        let start = State { t: numbers.next(), q: numbers.several(), v: numbers.several() };
        let (end, steps) = (start.t + 3.0, 60);
        let mut x = [0.0; 66];
        for (to, from) in x.iter_mut().zip(start.iter()) {
            *to = from;
        }
        (0..6).for_each(|i| x[6 + 7 * i] = 1.0);
        for step in 0..steps {
            x = extrapolated(&system, start.t + 0.05 * f64::from(step), &x, 0.05);
        }
        let varied = system.variational();
        for (tolerance, error) in [(1e-8, 1e-6), (1e-13, 1e-12)] {
            let found = varied.motion(start).unwrap().with_tolerance(tolerance).advance_to(end).unwrap();
            let size = x[6..].iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (column, expected) in x[6..].chunks(6).enumerate() {
                for (row, &expected) in expected.iter().enumerate() {
                    let by_p = |rows: &SMatrix<f64, 3, 4>| rows[(row % 3, column - 6)];
                    let found = match (column < 6, row < 3) {
                        (true, _) => found.entry(row, column),
                        (false, true) => by_p(&found.q_by_p),
                        (false, false) => by_p(&found.v_by_p),
                    };
                    close_on(size, found, expected, error);
                }
            }
        }
    }
}

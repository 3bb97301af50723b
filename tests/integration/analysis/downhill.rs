//! Equilibria of any guess: beside zero, where coordinates have no size; on closed curves and linkages, where
//! the way down is the only one; of orientations, however far they are turned.

use std::f64::consts::TAU;

use lagrangian::Stability;
use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A mass between springs to three sides.
struct Web {
    stiffness: f64,
    length: f64,
    angle: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Web {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        let mut energy = 0.0;
        for side in 0..3 {
            let angle = self.angle + TAU / 3.0 * side as f64;
            let way = self.mass(q) - Vector2::new(angle.cos(), angle.sin());
            energy += 0.5 * self.stiffness * (way.norm() - self.length).powi(2);
        }
        energy
    }
}

#[test]
fn an_equilibrium_at_zero_is_found_again() {
    let mut samples = Samples::new(1);
    for round in 0..200 {
        let stiffness = samples.number(1.0, 100.0);
        let web = Web { stiffness, length: samples.number(0.1, 0.9), angle: samples.number(0.0, 6.0) };
        let near = if round == 0 { 0.0 } else { 10_f64.powf(samples.number(-20.0, -1.0)) };
        let mut guess = [0; 2].map(|_| near * samples.number(-1.0, 1.0));
        // What has been found is the next guess.
        for _ in 0..3 {
            for found in [web.equilibrium(guess, &[]), web.stationary_point(guess, &[])] {
                let found = found.unwrap();
                assert_eq!(found.stability, Stability::Stable, "{round}: {guess:?}");
                assert!(found.is_isolated, "{round}: {guess:?}");
                found.state.q.iter().for_each(|&q| close_on(1.0, q, 0.0, 1e-14));
                guess = found.state.q;
            }
        }
    }
}

/// A potential with hills on a line.
struct Waves {
    size: f64,
    pace: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Waves {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn landscape(&self, q: &Coordinates) -> f64 {
        0.5 * q.x * q.x + self.size * (self.pace * q.x).sin()
    }
}

#[test]
fn no_hill_is_crossed() {
    let mut samples = Samples::new(2);
    let mut valleys = 0;
    for _ in 0..1000 {
        let waves = Waves { size: samples.number(-3.0, 3.0), pace: samples.number(1.0, 5.0) };
        let guess = samples.number(-6.0, 6.0);
        let force = |x: f64| -x - waves.size * waves.pace * (waves.pace * x).cos();
        // The first place down the slope where the force vanishes.
        let ahead = 1e-4 * force(guess).signum();
        let (mut low, mut high) = (guess, guess + ahead);
        while force(high) * ahead > 0.0 {
            (low, high) = (high, high + ahead);
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if force(middle) * ahead > 0.0 { low = middle } else { high = middle }
        }
        // A valley that hardly is one may be passed.
        let stiffness = 1.0 - waves.size * waves.pace.powi(2) * (waves.pace * low).sin();
        if stiffness > 0.1 * waves.pace {
            let found = waves.equilibrium([guess], &[]).unwrap().state.q[0];
            assert!((found - low).abs() < 1e-6, "{} {} {guess}: {found}, not {low}", waves.size, waves.pace);
            valleys += 1;
        }
    }
    assert!(valleys > 500, "{valleys}");
}

/// A bead on the oval of a cubic curve, beside a branch that goes to infinity.
struct Oval {
    p: f64,
    c: f64,
    pull: [f64; 2],
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Oval {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn load(&self, q: &Coordinates) -> f64 {
        self.pull[0] * q.x + self.pull[1] * q.y
    }

    #[holonomic]
    fn wire(&self, q: &Coordinates) -> f64 {
        q.y.powi(2) - q.x.powi(3) + self.p * q.x - self.c
    }
}

#[test]
fn a_bead_stays_on_its_branch() {
    let mut samples = Samples::new(3);
    for _ in 0..300 {
        let p = samples.number(0.8, 2.0);
        // The oval lies between the two lower roots of x³ − p x + c.
        let widest = (p / 3.0).sqrt();
        let c = samples.number(-0.4, 0.4) * (4.0 * p.powi(3) / 27.0).sqrt();
        let pull = [0; 2].map(|_| samples.number(-10.0, 10.0));
        let start = -widest * samples.number(0.9, 1.1);
        let height = (start.powi(3) - p * start + c).sqrt();
        let side = if samples.unit() < 0.5 { 1.0 } else { -1.0 };
        let found = Oval { p, c, pull }.equilibrium([start, side * height], &[]).unwrap();
        assert_eq!(found.stability, Stability::Stable);
        assert!(found.state.q[0] < widest, "{p} {c} {pull:?} {start}: {:?}", found.state.q);
    }
}

/// An attitude in a field: −Σ aᵢ xᵢ of body axes, with four stationary attitudes.
struct Field {
    pulls: [Vector3<f64>; 3],
}

#[lagrangian(coordinates = [attitude: Rotation], jacobians)]
impl Field {
    #[body(mass = 1.0, inertia = [1.0, 1.3, 1.7])]
    fn hull(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        (Vector3::zeros(), q.attitude)
    }

    #[potential]
    fn energy_in_field(&self, q: &Coordinates) -> f64 {
        -(self.pulls[0].dot(&(q.attitude * Vector3::x()))
            + self.pulls[1].dot(&(q.attitude * Vector3::y()))
            + self.pulls[2].dot(&(q.attitude * Vector3::z())))
    }
}

#[test]
fn every_attitude_leads_to_a_stationary_one() {
    let mut samples = Samples::new(4);
    for _ in 0..300 {
        let pulls = [0; 3].map(|_| Vector3::from([0; 3].map(|_| samples.number(-2.0, 2.0))));
        let field = Field { pulls };
        let guess = [0; 3].map(|_| samples.number(-8.0, 8.0));
        let size = pulls.iter().map(Vector3::norm).sum::<f64>();
        for found in [field.stationary_point(guess, &[]), field.equilibrium(guess, &[])] {
            let q = found.unwrap().state.q;
            // Half a turn has the length four.
            assert!(Vector3::from(q).norm() < 4.0 + 1e-9, "{guess:?}: {q:?}");
            let attitude = FieldCoordinates::from(q).attitude;
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            let torques = axes.iter().zip(&pulls).map(|(axis, pull)| (attitude * axis).cross(pull));
            close_on(size, torques.sum::<Vector3<f64>>().norm(), 0.0, 1e-7);
        }
    }
}

//! Many constraints that have few coordinates in common, which are eliminated by lists of places.

use lagrangian::prelude::*;

use crate::support::close::close_on;

const G: f64 = 9.81;

/// Unit masses on eight unit rods, the first from the origin.
struct Rods;

#[lagrangian(coordinates = [x: [8], y: [8]])]
impl Rods {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 8] {
        core::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| G * joint.y).sum()
    }

    // The rods from the free end to the fixed one.
    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 8] {
        let joints = self.joints(q);
        let mut rods = [0.0; 8];
        for i in 0..8 {
            let above = if i == 7 { Vector2::zeros() } else { joints[6 - i] };
            rods[i] = (joints[7 - i] - above).norm_squared() - 1.0;
        }
        rods
    }
}

/// The same in angles.
struct Angles;

#[lagrangian(coordinates = [theta: [8]])]
impl Angles {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 8] {
        let mut joints = [Vector2::zeros(); 8];
        let mut end = Vector2::zeros();
        for i in 0..8 {
            end += Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
            joints[i] = end;
        }
        joints
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| G * joint.y).sum()
    }
}

/// Where the joints are, and how fast they move.
fn hanging(state: &State<f64, 8>) -> State<f64, 16> {
    let (mut q, mut v, mut end, mut speed) = ([0.0; 16], [0.0; 16], [0.0; 2], [0.0; 2]);
    for i in 0..8 {
        let (sine, cosine) = state.q[i].sin_cos();
        end = [end[0] + sine, end[1] - cosine];
        speed = [speed[0] + cosine * state.v[i], speed[1] + sine * state.v[i]];
        [q[i], q[8 + i]] = end;
        [v[i], v[8 + i]] = speed;
    }
    State::new(q, v)
}

fn turned(angle: f64) -> State<f64, 8> {
    State::new(
        core::array::from_fn(|i| angle + 0.3 * (i as f64).sin()),
        core::array::from_fn(|i| 0.5 * (2.0 * i as f64).cos()),
    )
}

#[test]
fn a_chain_of_rods_moves_as_in_angles() {
    let structure = Rods::STRUCTURE.to_string();
    assert!(
        structure.contains("8 × 8 matrix that is left a sparse factorisation has 7 entries"),
        "{structure}"
    );
    let start = turned(0.8);
    let mut expected = Angles.simulate(start).with_tolerance(1e-13);
    let mut motion = Rods.simulate(hanging(&start)).with_tolerance(1e-13);
    for t in [0.25, 0.5, 1.0] {
        expected.advance_to(t).expect("the motion goes on");
        motion.advance_to(t).expect("the motion goes on");
        let (found, expected) = (motion.state(), hanging(expected.state()));
        for i in 0..16 {
            close_on(1.0, found.q[i], expected.q[i], 1e-10);
            close_on(1.0, found.v[i], expected.v[i], 1e-9);
        }
    }
}

/// Sixteen points on a ladder with two braces, of which one would do.
struct Ladder;

#[lagrangian(coordinates = [x: [16], y: [16]])]
impl Ladder {
    #[point(mass = 0.5)]
    fn points(&self, q: &Coordinates) -> [Vector2<f64>; 16] {
        core::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[holonomic]
    fn rods(&self, q: &Coordinates) -> [f64; 31] {
        let p = self.points(q);
        let mut rods = [0.0; 31];
        for i in 0..7 {
            rods[i] = (p[i + 1] - p[i]).norm_squared() - 1.0;
            rods[7 + i] = (p[i + 9] - p[i + 8]).norm_squared() - 1.0;
            rods[14 + i] = (p[i + 9] - p[i]).norm_squared() - 2.0;
        }
        for i in 0..8 {
            rods[21 + i] = (p[i + 8] - p[i]).norm_squared() - 1.0;
        }
        for i in 0..2 {
            rods[29 + i] = (p[3 * i + 1] - p[3 * i + 8]).norm_squared() - 2.0;
        }
        rods
    }
}

#[test]
fn a_ladder_with_rods_too_many_spins_as_a_body() {
    let structure = Ladder::STRUCTURE.to_string();
    assert!(structure.contains("a sparse factorisation"), "{structure}");
    // About its centre, at 3 rad/s.
    let at = |angle: f64| {
        let (sine, cosine) = angle.sin_cos();
        let (mut q, mut v) = ([0.0; 32], [0.0; 32]);
        for i in 0..16 {
            let (x, y) = ((i % 8) as f64 - 3.5, (i / 8) as f64 - 0.5);
            [q[i], q[16 + i]] = [cosine * x - sine * y, sine * x + cosine * y];
            [v[i], v[16 + i]] = [-3.0 * q[16 + i], 3.0 * q[i]];
        }
        State::new(q, v)
    };
    let start = at(0.4);
    let accelerations = Ladder.accelerations(&start).expect("the ladder spins");
    for (found, place) in accelerations.iter().zip(&start.q) {
        close_on(1.0, *found, -9.0 * place, 1e-11);
    }
    let reactions = Ladder.reactions(&start).expect("the ladder spins");
    assert!(!reactions.are_unique());
    let mut motion = Ladder.simulate(start).with_tolerance(1e-12);
    motion.advance_to(0.5).expect("the ladder spins");
    let (found, expected) = (motion.state(), at(0.4 + 1.5));
    for i in 0..32 {
        close_on(1.0, found.q[i], expected.q[i], 1e-10);
    }
}

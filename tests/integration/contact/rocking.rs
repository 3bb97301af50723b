//! N06: Housner's rocking block, which switches from corner to corner.

use lagrangian::Contact;
use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::close_on;

struct Block;

const HALF: [f64; 2] = [0.2, 0.5];

#[lagrangian(coordinates = [x, y, theta])]
impl Block {
    #[body(mass = 1.0, inertia = (0.2 * 0.2 + 0.5 * 0.5) / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.theta)
    }

    fn corner(&self, q: &Coordinates, side: f64) -> Vector2<f64> {
        let turn = Rotation2::new(q.theta);
        Vector2::new(q.x, q.y) + turn * Vector2::new(side * 0.2, -0.5)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    #[unilateral]
    fn corners(&self, q: &Coordinates) -> [f64; 2] {
        [self.corner(q, -1.0).y, self.corner(q, 1.0).y]
    }

    #[friction(coefficient = 10.0, normal = corners)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        [-1.0, 1.0].map(|side| v.x - (q.theta.sin() * side * 0.2 - q.theta.cos() * 0.5) * v.theta)
    }
}

/// Tilted about its right corner.
fn tilted(angle: f64) -> State<f64, 3> {
    let (sin, cos) = angle.sin_cos();
    State::at_rest([-(cos * HALF[0] - sin * HALF[1]), sin * HALF[0] + cos * HALF[1], -angle].map(|x: f64| x))
}

#[test]
fn a_block_rocks_from_corner_to_corner_and_stands() {
    let angle = 0.22830382626741894;
    let start = tilted(angle);
    let mut motion = Block.simulate(start).with_tolerance(TIGHT);
    let impacts = [
        (0.42525069704209145, 1.0151999386126647),
        (0.9290969992161432, 0.8051585720031478),
        (1.2892595908674072, 0.6385740398645655),
    ];
    for (time, rate) in impacts {
        let impact = motion.advance_to_switch(10.0).unwrap().unwrap();
        close_on(1.0, impact.state.t, time, 1e-12);
        close_on(1.0, impact.state.v[2].abs(), rate, 1e-10);
        assert_eq!(
            motion.contacts().corners.map(|corner| corner == Contact::Closed).iter().filter(|x| **x).count(),
            1
        );
    }
    let state = *motion.advance_to(20.0).unwrap();
    assert_eq!(state.v, [0.0; 3]);
    assert_eq!(motion.contacts().corners, [Contact::Closed; 2]);
    close_on(1.0, state.q[2], 0.0, 1e-12);
    close_on(1.0, state.q[1], 0.5, 1e-12);
}

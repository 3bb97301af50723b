//! Three bodies that attract each other.

use alloc::{vec, vec::Vec};

use lagrangian::prelude::*;

use crate::{Model, Point, Scene, Slider, follow};

/// Three point masses in a plane, in units in which the gravitational constant is 1.
#[derive(Clone, Copy, Debug)]
pub struct ThreeBody {
    /// Their masses.
    pub mass: [f64; 3],
}

#[lagrangian(coordinates = [x: [3], y: [3]])]
impl ThreeBody {
    #[point(mass = self.mass[0])]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x[0], q.y[0])
    }

    #[point(mass = self.mass[1])]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x[1], q.y[1])
    }

    #[point(mass = self.mass[2])]
    fn third(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x[2], q.y[2])
    }

    fn bodies(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        [self.first(q), self.second(q), self.third(q)]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let r = self.bodies(q);
        let pair = |i: usize, j: usize| -self.mass[i] * self.mass[j] / (r[i] - r[j]).norm();
        pair(0, 1) + pair(1, 2) + pair(2, 0)
    }
}

/// The figure eight of Chenciner and Montgomery: the place of the first body, and the velocity of the third.
const EIGHT: [Point; 2] = [[0.970_004_36, -0.243_087_53], [-0.932_407_37, -0.864_731_46]];

impl Model<6> for ThreeBody {
    const PARAMETERS: &'static [Slider] = &[
        Slider::new("first mass", "", [0.5, 1.5, 0.01], 1.0),
        Slider::new("second mass", "", [0.5, 1.5, 0.01], 1.0),
        Slider::new("third mass", "", [0.5, 1.5, 0.01], 1.0),
    ];
    const SETTINGS: &'static [Slider] = &[
        Slider::new("first x", "", [-1.5, 1.5, 0.01], EIGHT[0][0]),
        Slider::new("first y", "", [-1.0, 1.0, 0.01], EIGHT[0][1]),
    ];
    const VIEW: [f64; 4] = [-1.8, -1.0, 1.8, 1.0];

    fn new(p: &[f64]) -> Self {
        Self { mass: [p[0], p[1], p[2]] }
    }

    fn placed(&self, settings: &[f64]) -> Option<State<f64, 6>> {
        let ([x, y], [[a, b], [u, v]]) = ([settings[0], settings[1]], EIGHT);
        Some(State::new([x, -a, 0.0, y, -b, 0.0], [-u / 2.0, -u / 2.0, u, -v / 2.0, -v / 2.0, v]))
    }

    fn settings(&self, state: &State<f64, 6>) -> Vec<f64> {
        vec![state.q[0], state.q[3]]
    }

    fn moved(&self, state: &State<f64, 6>, t: f64) -> Result<State<f64, 6>, MotionError<f64>> {
        follow(self, state, t)
    }

    fn energies(&self, state: &State<f64, 6>) -> [f64; 2] {
        [self.kinetic_energy(state), self.potential_energy(state)]
    }

    fn draw(&self, state: &State<f64, 6>, scene: &mut Scene) {
        for (colour, place) in (0..).zip(self.bodies(&state.q.into())) {
            let mass = self.mass[usize::from(colour)];
            scene.trail(colour, place.into());
            scene.disc(colour, place.into(), 2.5 * mass.cbrt());
        }
    }

    fn handles(&self, state: &State<f64, 6>) -> Vec<Point> {
        self.bodies(&state.q.into()).map(Into::into).to_vec()
    }

    /// The velocities stay.
    fn dragged(&self, state: &State<f64, 6>, handle: usize, [x, y]: Point) -> Option<State<f64, 6>> {
        let mut state = *state;
        (state.q[handle], state.q[handle + 3]) = (x, y);
        Some(state)
    }
}

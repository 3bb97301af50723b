//! A chain of four equal rods with both ends at one place, a rhombus that folds: two degrees of freedom.
//! Folded, rods that lie on each other could turn on as one.

use lagrangian::prelude::*;

use super::super::curve::offsets;
use super::super::runs::Run;
use super::Starts;

/// Uniform rods of 1 m.
#[derive(Clone, Copy, Debug)]
pub struct Chain {
    /// Masses [kg].
    pub m: [f64; 4],
}

#[lagrangian(coordinates = [angle: [4]])]
impl Chain {
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    /// Where a rod begins.
    fn joint(q: &Coordinates, rod: usize) -> Vector2<f64> {
        let mut place = Vector2::zeros();
        for angle in q.angle.iter().take(rod) {
            place += Self::along(*angle);
        }
        place
    }

    #[body(mass = self.m[..], inertia = [self.m[0] / 12.0, self.m[1] / 12.0, self.m[2] / 12.0, self.m[3] / 12.0])]
    fn rods(&self, q: &Coordinates) -> [(Vector2<f64>, f64); 4] {
        core::array::from_fn(|i| (Self::joint(q, i) + 0.5 * Self::along(q.angle[i]), q.angle[i]))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let rods = self.rods(q);
        9.81 * (self.m[0] * rods[0].0.y
            + self.m[1] * rods[1].0.y
            + self.m[2] * rods[2].0.y
            + self.m[3] * rods[3].0.y)
    }

    #[holonomic]
    fn end(&self, q: &Coordinates) -> Vector2<f64> {
        Self::joint(q, 4)
    }
}

/// The same as a rhombus in two free angles.
#[derive(Clone, Copy, Debug)]
pub struct Rhombus {
    /// Masses [kg].
    pub m: [f64; 4],
}

#[lagrangian(coordinates = [a, b])]
impl Rhombus {
    #[body(mass = self.m[..], inertia = [self.m[0] / 12.0, self.m[1] / 12.0, self.m[2] / 12.0, self.m[3] / 12.0])]
    fn rods(&self, q: &Coordinates) -> [(Vector2<f64>, f64); 4] {
        let (a, b) = (Vector2::new(q.a.cos(), q.a.sin()), Vector2::new(q.b.cos(), q.b.sin()));
        [(0.5 * a, q.a), (a + 0.5 * b, q.b), (0.5 * a + b, q.a), (0.5 * b, q.b)]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let rods = self.rods(q);
        9.81 * (self.m[0] * rods[0].0.y
            + self.m[1] * rods[1].0.y
            + self.m[2] * rods[2].0.y
            + self.m[3] * rods[3].0.y)
    }
}

/// The rhombus in the angles of its rods.
fn unfolded(state: &State<f64, 2>) -> State<f64, 4> {
    let ([a, b], [x, y]) = (state.q, state.v);
    let turn = std::f64::consts::PI;
    State::new([a, b, a + turn, b + turn], [x, y, x, y]).at_time(state.t)
}

/// Through the straight and the folded position by turns. The true motion is that of the free angles, which
/// nothing singular is in; tolerance 1e-14.
pub fn starts(count: usize) -> Starts<Chain, 4> {
    let run = |folded: bool, d: f64, m: [f64; 4]| {
        let turn = if folded { std::f64::consts::PI } else { 0.0 };
        let start = State::new([0.4, 0.4 + turn + d], [1.0, 6.0]);
        let rhombus = Rhombus { m };
        let mut motion = rhombus.simulate(start).with_tolerance(1e-14);
        let mut at = |t: f64| motion.advance_to(t).map(unfolded).ok();
        let (regular, end) = (at(0.05)?, at(0.5)?);
        Some(Run { system: Chain { m }, start: unfolded(&start), offset: d, regular, end })
    };
    let runs = offsets(count).enumerate().filter_map(|(i, d)| {
        let m = if i % 4 < 2 { [1.0; 4] } else { [1.0, 0.4, 2.2, 0.7] };
        // Two starts of each kind follow each other, one on either side.
        run(i / 4 % 2 == 0, d, m)
    });
    Starts { name: "chain4", runs: runs.collect() }
}

//! Derivatives of motions through half a turn, where a state changes to the other three numbers of an
//! orientation.

use lagrangian::prelude::*;

use crate::support::close::close_on;
use crate::support::sample::Samples;

/// A body on a spring at one of its corners.
struct Body;

#[lagrangian(coordinates = [hull: Pose], jacobians)]
impl Body {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 2.5])]
    fn hull(&self, q: &Coordinates) -> Isometry3<f64> {
        q.hull
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        let tip = q.hull * Point3::new(0.3, -0.2, 0.5);
        0.5 * (tip - Point3::new(1.0, 0.5, -1.0)).norm_squared()
    }
}

/// The numbers of the same orientation that lie nearest to others.
fn like(q: [f64; 6], near: [f64; 6]) -> [f64; 6] {
    let square: f64 = q[3..].iter().map(|x| x * x).sum();
    let mut other = q;
    other[3..].iter_mut().for_each(|x| *x *= -16.0 / square);
    let far = |q: [f64; 6]| -> f64 { (3..6).map(|i| (q[i] - near[i]).powi(2)).sum() };
    if far(q) <= far(other) { q } else { other }
}

/// Each few columns are computed by a motion of their own, which may have changed to the other numbers where
/// the others have not.
#[test]
fn all_columns_belong_to_the_numbers_of_the_state() {
    for k in 0..60 {
        let spin = 2.0 + 0.06 * f64::from(k);
        let twist =
            PoseVelocity { linear: Vector3::new(0.1, 0.2, 0.0), angular: Vector3::new(spin, 0.4, -0.3) };
        let place = BodyCoordinates { hull: Isometry3::identity() };
        let start = Body.state(place, BodyVelocities { hull: twist });
        let end = Body.variational().motion(start).unwrap().advance_to(2.0).unwrap();
        let h = 1e-5;
        for column in 0..12 {
            let moved = |h: f64| {
                let mut start = start;
                if column < 6 {
                    start.q[column] += h
                } else {
                    start.v[column - 6] += h
                }
                let end_of = Body.simulate(start).with_tolerance(1e-13).advance_to(2.0).unwrap().q;
                like(end_of, end.state.q)
            };
            let (more, less) = (moved(h), moved(-h));
            for row in 0..6 {
                close_on(10.0, end.entry(row, column), (more[row] - less[row]) / (2.0 * h), 1e-6);
            }
        }
    }
}

/// A free body that spins about an axis.
struct Top {
    inertia: [f64; 3],
}

#[lagrangian(coordinates = [turn: Rotation], jacobians)]
impl Top {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn hull(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        (Vector3::new(0.0, 0.0, 0.0), q.turn)
    }
}

/// Deviations turn with Ω = n √((C − A) (C − B) / (A B)) in body axes: multipliers exp(± iΩT), and 1 four
/// times, wherever the turn begins.
#[test]
fn multipliers_do_not_depend_on_the_numbers_of_the_orientation() {
    let mut samples = Samples::new(71);
    for k in 0..60 {
        let least = samples.number(0.5, 1.0);
        let inertia = [least + samples.number(0.5, 1.0), least + samples.number(1.0, 1.4), least];
        let top = Top { inertia };
        let [a, b, c] = inertia;
        let precession = 2.0 * ((c - a) * (c - b) / (a * b)).sqrt();
        let phase = -3.135 + 6.27 * f64::from(k) / 60.0;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), phase);
        let start = top.state(TopCoordinates { turn }, TopVelocities { turn: Vector3::new(0.0, 0.0, 2.0) });
        let period = std::f64::consts::PI;
        let found = top.variational().monodromy(start, period).unwrap();
        let trace: f64 = found.multipliers.iter().map(|multiplier| multiplier.re).sum();
        close_on(6.0, trace, 4.0 + 2.0 * (precession * period).cos(), 1e-9);
        let (first, last) = (found.multipliers[0], found.multipliers[5]);
        close_on(1.0, first.norm(), 1.0, 1e-4);
        close_on(1.0, last.norm(), 1.0, 1e-4);
    }
}

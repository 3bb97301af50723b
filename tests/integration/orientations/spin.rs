//! Modes about steady spins, in axes that turn with the body.

use lagrangian::Mode;
use lagrangian::prelude::*;

use crate::support::close::close;

/// A symmetric top on its tip.
struct Top {
    gravity: f64,
}

const TRANSVERSE: f64 = 0.02 + 2.0 * 0.3 * 0.3;
const AXIAL: f64 = 0.3;

#[lagrangian(coordinates = [attitude: Rotation], jacobians)]
impl Top {
    #[body(mass = 2.0, inertia = [0.02, 0.02, AXIAL])]
    fn top(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::from(q.attitude * Vector3::new(0.0, 0.0, 0.3)), q.attitude)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        2.0 * self.gravity * self.top(q).translation.z
    }
}

fn spinning(turn: UnitQuaternion<f64>, angular: Vector3<f64>) -> State<f64, 3> {
    Top { gravity: 9.81 }.state(TopCoordinates { attitude: turn }, TopVelocities { attitude: angular })
}

/// A sleeping top: with z = x + i y of its tilt, A z″ − i C ω z′ − m g l z = 0 in space, and frequencies less
/// by ω in the body (Goldstein, *Classical Mechanics*, 3rd ed., § 5.7).
#[test]
fn a_sleeping_top_has_the_same_modes_however_it_stands() {
    let (spin, moment) = (150.0, 2.0 * 9.81 * 0.3);
    let root = ((AXIAL * spin).powi(2) - 4.0 * TRANSVERSE * moment).sqrt();
    let in_space = [1.0, -1.0].map(|sign| (AXIAL * spin + sign * root) / (2.0 * TRANSVERSE));
    let mut expected = in_space.map(|frequency: f64| (frequency - spin).abs());
    expected.sort_by(f64::total_cmp);
    for angle in [0.0, 1.0, 3.0, core::f64::consts::PI] {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        let state = spinning(turn, Vector3::new(0.0, 0.0, spin));
        let modes = Top { gravity: 9.81 }.modes(&state, &[]).unwrap();
        let (still, moving): (Vec<&Mode<3>>, Vec<&Mode<3>>) =
            modes.iter().partition(|mode| mode.frequency() == 0.0);
        assert_eq!((still.len(), moving.len()), (1, 2), "{modes:?}");
        for (mode, frequency) in moving.iter().zip(expected) {
            close(mode.eigenvalue.im, frequency, 1e-11);
            assert_eq!(mode.eigenvalue.re, 0.0);
        }
    }
}

/// Too slow a spin does not hold it: the tilt grows at the same rate in the body as in space.
#[test]
fn a_slow_top_falls() {
    let (spin, moment) = (5.0, 2.0 * 9.81 * 0.3);
    let square = 4.0 * TRANSVERSE * moment - (AXIAL * spin).powi(2);
    let growth = square.sqrt() / (2.0 * TRANSVERSE);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 2.0);
    let modes = Top { gravity: 9.81 }.modes(&spinning(turn, Vector3::new(0.0, 0.0, spin)), &[]).unwrap();
    let grows = modes.iter().find(|mode| mode.eigenvalue.re > 0.0).expect("it falls");
    close(grows.eigenvalue.re, growth, 1e-12);
    close(grows.eigenvalue.im, spin - AXIAL * spin / (2.0 * TRANSVERSE), 1e-12);
}

struct Free;

#[lagrangian(coordinates = [base: Pose], jacobians)]
impl Free {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 2.5])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        q.base
    }
}

/// A free body that spins about a principal axis: stable about the first and the last, not about the middle
/// one (Landau and Lifshitz, *Mechanics*, § 37), in every attitude.
#[test]
fn a_free_body_spins_about_its_principal_axes() {
    let inertia = [1.0, 2.0, 2.5_f64];
    for (axis, turn) in [(0, 0.3), (1, -1.7), (2, 2.9)] {
        let [a, b] = [(axis + 1) % 3, (axis + 2) % 3].map(|other| inertia[axis] - inertia[other]);
        let square = a * b / (inertia[(axis + 1) % 3] * inertia[(axis + 2) % 3]) * 100.0;
        let mut angular = Vector3::zeros();
        angular[axis] = 10.0;
        let attitude = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.8, 1.1) * turn);
        let place = Isometry3::from_parts(Translation3::new(1.0, 2.0, 3.0), attitude);
        let velocity = PoseVelocity { linear: Vector3::zeros(), angular };
        let state = Free.state(FreeCoordinates { base: place }, FreeVelocities { base: velocity });
        let modes = Free.modes(&state, &[]).unwrap();
        // A deviation that rests in space turns back in the body.
        let carried = modes.iter().filter(|mode| (mode.eigenvalue.im - 10.0).abs() < 1e-9);
        assert_eq!(carried.count(), 1, "{modes:?}");
        let root = square.abs().sqrt();
        let nutation = modes.iter().filter(|mode| (mode.frequency() - root).abs() < 1e-9);
        let grows = modes.iter().any(|mode| mode.eigenvalue.re > 0.0);
        assert_eq!((nutation.count(), grows), if square > 0.0 { (1, false) } else { (2, true) }, "{modes:?}");
        let largest = modes.iter().map(|mode| mode.eigenvalue.re).fold(0.0, f64::max);
        assert!(if grows { (largest - root).abs() < 1e-9 } else { largest == 0.0 }, "{modes:?}");
    }
}

//! Numbers at the ends of their range: the right result or an error, and always an end.

use lagrangian::prelude::*;

use crate::support::close::close;

/// A spring with a damper beside two others, whose parts do not act on each other.
struct Apart {
    k: f64,
    c: f64,
    soft: f64,
}

#[lagrangian(coordinates = [x, y, z], jacobians, analysis)]
impl Apart {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (self.k * q.x.powi(2) + self.k * (q.y - 0.5 * q.x).powi(2) + self.soft * q.z.powi(2))
    }

    #[dissipation]
    fn dampers(&self, v: &Velocities) -> f64 {
        0.5 * self.c * (v.x.powi(2) + v.z.powi(2))
    }
}

fn modes(system: &Apart) -> Result<Vec<lagrangian::Mode<3>>, MotionError<f64>> {
    system.modes(&State::at_rest([0.0; 3]), &[])
}

#[test]
fn modes_scale_with_their_unit_of_time() {
    let unit = modes(&Apart { k: 1.0, c: 0.3, soft: 1.7 }).unwrap();
    // Time in other units; k beyond 1e154 once kept balancing from ending.
    for power in [-200, -100, -50, 50, 100, 160, 200, 300] {
        let rate = 10.0_f64.powi(power / 2);
        let square = rate * rate;
        let found = modes(&Apart { k: square, c: 0.3 * rate, soft: 1.7 * square }).unwrap();
        assert_eq!(found.len(), unit.len());
        for (found, unit) in found.iter().zip(&unit) {
            close(found.eigenvalue.re / rate, unit.eigenvalue.re, 1e-13);
            close(found.eigenvalue.im / rate, unit.eigenvalue.im, 1e-13);
            for (found, unit) in found.shape.iter().zip(&unit.shape) {
                close((found - unit).re, 0.0, 1e-12);
                close((found - unit).im, 0.0, 1e-12);
            }
        }
    }
}

#[test]
fn a_part_that_is_far_softer_takes_no_part_in_the_modes_of_others() {
    for rate in [1e20, 1e50, 1e80] {
        for mode in modes(&Apart { k: rate * rate, c: rate, soft: 1.0 }).unwrap() {
            let [x, y, z] = [0, 1, 2].map(|i| mode.shape[i].re.hypot(mode.shape[i].im));
            assert!((x == 0.0 && y == 0.0) != (z == 0.0), "{rate:e}: {mode:?}");
        }
    }
}

#[test]
fn what_numbers_cannot_hold_is_an_error() {
    for (k, c, soft) in [(1e307, 1e307, 1.0), (1e-300, 1e-150, 1e300), (1e308, 0.0, 1.0), (1e300, 1e200, 1.0)]
    {
        let cause = modes(&Apart { k, c, soft }).unwrap_err().cause;
        assert!(matches!(cause, Cause::NoEigenvalues | Cause::NotFinite), "{cause:?}");
        assert!(cause.to_string().contains("parameters"));
    }
}

#[test]
fn certificates_end_at_the_smallest_states() {
    let system = Apart { k: 1.0, c: 0.1, soft: 2.0 };
    for size in [0.0, 5e-324, 1e-310, 1e-300, 1e-160, 1e-100] {
        let certificate = system.verify_at(&[State::new([size; 3], [size; 3])]).unwrap();
        assert_eq!(certificate.states, 1, "{size:e}");
    }
}

//! Flows of Hamiltonian systems are reversible and symplectic in (q, p).

use lagrangian::prelude::*;
use nalgebra::DMatrix;

use crate::support::close::{all_close, close};
use crate::support::difference::{derivative, moved};
use crate::support::motion::{TIGHT, numbers, state_at};

/// A bead on a moving arm: M depends on q, and the charge adds a gyroscopic term.
struct Arm {
    field: f64,
}

#[lagrangian(coordinates = [r, phi])]
impl Arm {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.r * q.phi.cos(), q.r * q.phi.sin())
    }

    #[kinetic]
    fn arm(&self, v: &Velocities) -> f64 {
        0.2 * v.phi.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        5.0 * (q.r - 1.0).powi(2) + 2.0 * self.bead(q).y
    }

    #[lagrangian]
    fn magnetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        self.field / 2.0 * q.r * q.r * v.phi
    }
}

const ARM: Arm = Arm { field: 1.5 };

fn start() -> State<f64, 2> {
    State::new([1.2, 0.3], [-0.4, 0.9])
}

#[test]
fn a_motion_finds_its_way_back() {
    let mut motion = ARM.simulate(start()).with_tolerance(TIGHT);
    motion.advance_to(20.0).unwrap();
    all_close(numbers(motion.advance_to(0.0).unwrap()), numbers(&start()), 1e-10);
}

#[test]
fn reversed_velocities_and_field_retrace_the_motion() {
    let end = state_at(&ARM, start(), 10.0);
    let reversed = Arm { field: -ARM.field };
    let back = state_at(&reversed, State::new(end.q, end.v.map(|v| -v)), 10.0);
    all_close(back.q, start().q, 1e-10);
    all_close(back.v, start().v.map(|v| -v), 1e-10);
    // With the field as it was, the magnetic force bends the other way.
    let astray = state_at(&ARM, State::new(end.q, end.v.map(|v| -v)), 10.0);
    assert!((astray.q[0] - start().q[0]).abs() > 1e-3);
}

/// ∂(q, p)/∂(q, v) of a state that depends on the start.
fn jacobian(canonical: impl Fn(&State<f64, 2>) -> [f64; 4]) -> DMatrix<f64> {
    let columns: Vec<f64> =
        (0..4).flat_map(|i| derivative(0.002, |x| canonical(&moved(&start(), i, x)))).collect();
    DMatrix::from_vec(4, 4, columns)
}

#[test]
fn the_flow_is_symplectic() {
    let canonical = |state: &State<f64, 2>| {
        let ([a, b], [c, d]) = (state.q, ARM.momenta(state));
        [a, b, c, d]
    };
    let before = jacobian(canonical);
    let after = jacobian(|s| canonical(&state_at(&ARM, *s, 3.0)));
    let flow = after * before.try_inverse().unwrap();
    let form = DMatrix::from_row_slice(
        4,
        4,
        &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
    );
    let carried = flow.transpose() * &form * &flow;
    for (found, expected) in carried.iter().zip(form.iter()) {
        assert!((found - expected).abs() < 1e-8, "{carried}");
    }
    close(flow.determinant(), 1.0, 1e-8);
}

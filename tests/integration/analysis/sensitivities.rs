//! Derivatives of motions by the start and by parameters, against differences of motions and against each
//! other.

use lagrangian::{Transition, prelude::*};

use crate::support::close::{close, close_on};
use crate::support::difference::{STEP, derivative, moved};
use crate::support::dual::Dual;

const TIGHT: f64 = 1e-14;

/// A double pendulum with a motor and friction, generic, with derivatives by three parameters.
#[derive(Clone, Copy)]
struct Arm<R> {
    masses: [R; 2],
    length: R,
    friction: R,
}

#[lagrangian(
    coordinates = [theta: [2]], inputs = [motor],
    sensitivities = [self.masses[1], self.length, self.friction]
)]
impl<R: Real> Arm<R> {
    #[point(mass = self.masses[0])]
    fn upper(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) * self.length
    }

    #[point(mass = self.masses[1])]
    fn lower(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        9.81 * (self.masses[0] * self.upper(q).y + self.masses[1] * self.lower(q).y)
    }

    #[dissipation]
    fn friction(&self, v: &Velocities<R>) -> R {
        0.5 * self.friction * (v.theta[0].powi(2) + (v.theta[1] - v.theta[0]).powi(2))
    }

    #[force(on = theta)]
    fn motor(&self, q: &Coordinates<R>, u: &Inputs<R>) -> [R; 2] {
        [u.motor * q.theta[0].cos(), -u.motor]
    }
}

const ARM: Arm<f64> = Arm { masses: [1.0, 0.7], length: 0.9, friction: 0.1 };

fn with(system: &Arm<f64>, p: [f64; 3]) -> Arm<f64> {
    Arm {
        masses: [system.masses[0], system.masses[1] + p[0]],
        length: system.length + p[1],
        friction: system.friction + p[2],
    }
}

#[test]
fn accelerations_by_parameters() {
    assert_eq!(
        <Arm<f64> as Sensitive<2, 1, 0, 3, 7>>::PARAMETERS,
        ["self.masses[1]", "self.length", "self.friction"]
    );
    let state = State::new([0.4, -0.9], [1.1, 0.3]);
    let found = ARM.sensitivities(&state, &[0.6]).unwrap();
    let system = ARM;
    let constant = Dual::constant;
    for parameter in 0..3 {
        let slope = |index: usize, value: f64| Dual { value, slope: f64::from(u8::from(index == parameter)) };
        let arm = Arm {
            masses: [constant(system.masses[0]), slope(0, system.masses[1])],
            length: slope(1, system.length),
            friction: slope(2, system.friction),
        };
        let state = State { t: constant(0.0), q: state.q.map(constant), v: state.v.map(constant) };
        let a = arm.accelerations(&state, &[constant(0.6)]).unwrap();
        for i in 0..2 {
            close_on(10.0, found.accelerations[(i, parameter)], a[i].slope, 1e-14);
        }
    }
}

fn flow(arm: &Arm<f64>, start: State<f64, 2>) -> [f64; 4] {
    let mut motion = arm.simulate(start).with_tolerance(TIGHT).with_inputs([0.6]);
    let State { q, v, .. } = *motion.advance_to(2.0).unwrap();
    [q[0], q[1], v[0], v[1]]
}

fn columns<const N: usize, const P: usize>(found: &Transition<f64, N, P>, column: usize) -> Vec<f64> {
    let (upper, lower): (Vec<f64>, Vec<f64>) = match column {
        c if c < N => (
            found.q_by_q.column(c).iter().copied().collect(),
            found.v_by_q.column(c).iter().copied().collect(),
        ),
        c if c < 2 * N => {
            let c = c - N;
            (
                found.q_by_v.column(c).iter().copied().collect(),
                found.v_by_v.column(c).iter().copied().collect(),
            )
        }
        c => {
            let c = c - 2 * N;
            (
                found.q_by_p.column(c).iter().copied().collect(),
                found.v_by_p.column(c).iter().copied().collect(),
            )
        }
    };
    upper.into_iter().chain(lower).collect()
}

#[test]
fn the_transition_is_the_derivative_of_the_motion() {
    let start = State::new([0.4, -0.9], [1.1, 0.3]);
    let varied = ARM.variational();
    let mut motion = varied.motion(start).unwrap().with_tolerance(1e-13).with_inputs([0.6]);
    let found = motion.advance_to(2.0).unwrap();
    let end = flow(&ARM, start);
    for (found, expected) in found.state.iter().zip(end) {
        close(found, expected, 1e-11);
    }
    assert_eq!(found.state.t, 2.0);
    for column in 0..7_usize {
        let expected = derivative(0.5 * STEP, |x| match column.checked_sub(4) {
            None => flow(&ARM, moved(&start, column, x)),
            Some(p) => flow(&with(&ARM, std::array::from_fn(|i| if i == p { x } else { 0.0 })), start),
        });
        for (found, expected) in columns(&found, column).into_iter().zip(expected) {
            close_on(10.0, found, expected, 1e-10);
        }
    }
}

/// A Hénon–Heiles potential: velocities are momenta.
struct HenonHeiles;

#[lagrangian(coordinates = [x, y], jacobians)]
impl HenonHeiles {
    #[point(mass = 1.0)]
    fn particle(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        0.5 * (q.x.powi(2) + q.y.powi(2)) + q.x.powi(2) * q.y - q.y.powi(3) / 3.0
    }
}

#[test]
fn the_transition_of_a_conservative_system_is_symplectic() {
    let varied = HenonHeiles.variational();
    let mut motion = varied.motion(State::new([0.1, 0.2], [0.3, -0.1])).unwrap().with_tolerance(1e-14);
    let found = motion.advance_to(30.0).unwrap();
    // Φᵀ J Φ = J.
    let Transition { q_by_q: a, q_by_v: b, v_by_q: c, v_by_v: d, .. } = found;
    let (one, zero) = (SMatrix::<f64, 2, 2>::identity(), SMatrix::<f64, 2, 2>::zeros());
    let size = a.norm() * d.norm();
    for (found, expected) in [
        (a.transpose() * c - c.transpose() * a, zero),
        (b.transpose() * d - d.transpose() * b, zero),
        (a.transpose() * d - c.transpose() * b, one),
    ] {
        for (found, expected) in found.iter().zip(&expected) {
            close_on(size, *found, *expected, 1e-11);
        }
    }
}

/// A pendulum in Cartesian coordinates on a rod whose length is a parameter.
#[derive(Clone, Copy)]
struct Rod {
    length: f64,
    g: f64,
}

#[lagrangian(coordinates = [x, y], sensitivities = [self.length, self.g])]
impl Rod {
    #[point(mass = 1.3)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        1.3 * self.g * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

#[test]
fn transitions_of_constrained_motions_obey_the_constraints() {
    let rod = Rod { length: 0.7, g: 9.81 };
    let start = rod.consistent(State::new([0.5, -0.4], [0.3, 0.2])).unwrap();
    let varied = rod.variational();
    let mut motion = varied.motion(start).unwrap().with_tolerance(1e-13);
    let found = motion.advance_to(1.5).unwrap();
    // The derivative of what `consistent` makes of a start.
    let flow = |rod: &Rod, start: State<f64, 2>| {
        let start = rod.consistent(start).unwrap();
        let State { q, v, .. } = *rod.simulate(start).with_tolerance(TIGHT).advance_to(1.5).unwrap();
        [q[0], q[1], v[0], v[1]]
    };
    for column in 0..6 {
        let expected = derivative(STEP, |x| match column {
            4 => flow(&Rod { length: rod.length + x, ..rod }, start),
            5 => flow(&Rod { g: rod.g + x, ..rod }, start),
            _ => flow(&rod, moved(&start, column, x)),
        });
        for (found, expected) in columns(&found, column).into_iter().zip(expected) {
            close_on(10.0, found, expected, 1e-9);
        }
    }
    let gradient = rod.constraint_jacobian(&found.state);
    for entry in (gradient * found.q_by_q).iter().chain(&(gradient * found.q_by_v)) {
        close(*entry, 0.0, 1e-12);
    }
    // With the length the bob moves out by as much.
    close((gradient * found.q_by_p)[0], 1.0, 1e-13);
}

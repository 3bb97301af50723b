//! Planar four-bar linkages, in angles and in the places of their joints.

use lagrangian::prelude::*;

use crate::support::close::{all_close, between, close, close_on};
use crate::support::constrained::bound;
use crate::support::motion::{TIGHT, drift, root, state_at};

/// Masses of the joints; lengths of crank, coupler, rocker and ground; gravitational acceleration.
#[derive(Clone, Copy)]
struct Linkage {
    m: [f64; 2],
    crank: f64,
    coupler: f64,
    rocker: f64,
    ground: f64,
    g: f64,
}

/// By the angles of the three moving links from the line of the ground.
struct Angles(Linkage);

#[lagrangian(coordinates = [crank, coupler, rocker])]
impl Angles {
    fn along(angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin())
    }

    #[point(mass = self.0.m[0])]
    fn first(&self, q: &Coordinates) -> Vector2<f64> {
        self.0.crank * Self::along(q.crank)
    }

    #[point(mass = self.0.m[1])]
    fn second(&self, q: &Coordinates) -> Vector2<f64> {
        self.first(q) + self.0.coupler * Self::along(q.coupler)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.g * (self.0.m[0] * self.first(q).y + self.0.m[1] * self.second(q).y)
    }

    #[holonomic]
    fn closure(&self, q: &Coordinates) -> Vector2<f64> {
        self.second(q) - self.0.rocker * Self::along(q.rocker) - Vector2::new(self.0.ground, 0.0)
    }
}

/// By the places of the two moving joints.
struct Joints(Linkage);

#[lagrangian(coordinates = [first: [2], second: [2]])]
impl Joints {
    #[point(mass = self.0.m[..])]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        [Vector2::from(q.first), Vector2::from(q.second)]
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.0.g * (self.0.m[0] * q.first[1] + self.0.m[1] * q.second[1])
    }

    #[holonomic]
    fn links(&self, q: &Coordinates) -> [f64; 3] {
        let [first, second] = self.joints(q);
        [
            first.norm() - self.0.crank,
            (second - first).norm() - self.0.coupler,
            (second - Vector2::new(self.0.ground, 0.0)).norm() - self.0.rocker,
        ]
    }
}

/// The crank can go round: shortest and longest together are shorter than the others.
const LINKAGE: Linkage =
    Linkage { m: [1.5, 2.0], crank: 0.4, coupler: 1.1, rocker: 0.9, ground: 1.0, g: 9.81 };

/// Opposite links are equal, so that it can lie flat.
const PARALLELOGRAM: Linkage = Linkage { coupler: 1.0, rocker: 0.4, ..LINKAGE };

/// The motion of a parallelogram: its joints are pendulums of equal length side by side.
struct Wheel(Linkage);

#[lagrangian(coordinates = [angle])]
impl Wheel {
    #[point(mass = self.0.m[0] + self.0.m[1])]
    fn joints(&self, q: &Coordinates) -> Vector2<f64> {
        self.0.crank * Vector2::new(q.angle.cos(), q.angle.sin())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        (self.0.m[0] + self.0.m[1]) * self.0.g * self.joints(q).y
    }
}

/// The open configuration at an angle of the crank, which turns at a rate.
fn assembled(linkage: Linkage, crank: f64, rate: f64) -> State<f64, 3> {
    let Linkage { crank: a, coupler: b, rocker: c, ground: d, .. } = linkage;
    let (x, y) = (d - a * crank.cos(), -a * crank.sin());
    // The joint that completes the triangle of coupler, rocker and the diagonal, above it.
    let diagonal = x.hypot(y);
    let bend = ((b * b + diagonal * diagonal - c * c) / (2.0 * b * diagonal)).acos();
    let coupler = y.atan2(x) + bend;
    let rocker = (b * coupler.sin() - y).atan2(b * coupler.cos() - x);
    // Velocities along and across the rocker and the coupler.
    let coupler_rate = a * rate * (crank - rocker).sin() / (b * (rocker - coupler).sin());
    let rocker_rate = a * rate * (crank - coupler).sin() / (c * (rocker - coupler).sin());
    State::new([crank, coupler, rocker], [rate, coupler_rate, rocker_rate])
}

/// The same by joints.
fn places(linkage: Linkage, state: &State<f64, 3>) -> State<f64, 4> {
    let Linkage { crank: a, rocker: c, ground: d, .. } = linkage;
    let ([first, _, second], [turn, _, swing]) = (state.q, state.v);
    let at = |length: f64, angle: f64| [length * angle.cos(), length * angle.sin()];
    let ([x1, y1], [x2, y2]) = (at(a, first), at(c, second));
    State::new([x1, y1, d + x2, y2], [-turn * y1, turn * x1, -swing * y2, swing * x2]).at_time(state.t)
}

#[test]
fn both_forms_move_alike() {
    let (angles, joints) = (Angles(LINKAGE), Joints(LINKAGE));
    let start = assembled(LINKAGE, 0.5, 9.0);
    let mut by_angles = angles.simulate(start).with_tolerance(TIGHT);
    let mut by_joints = joints.simulate(places(LINKAGE, &start)).with_tolerance(TIGHT);
    let mut dop853 = joints.simulate_with::<Dop853>(places(LINKAGE, &start)).with_tolerance(TIGHT);
    for k in 1..=10 {
        let t = 0.3 * f64::from(k);
        let expected = places(LINKAGE, by_angles.advance_to(t).unwrap());
        for state in [*by_joints.advance_to(t).unwrap(), *dop853.advance_to(t).unwrap()] {
            all_close(state.q, expected.q, 1e-10);
            all_close(state.v, expected.v, 1e-10);
        }
    }
    // The crank went round, so that every configuration was passed.
    assert!(by_angles.state().q[0] > 10.0);
}

#[test]
fn a_turn_of_the_crank_ends_as_it_began() {
    // One degree of freedom: the energy determines the speed in every configuration.
    let angles = Angles(LINKAGE);
    let start = assembled(LINKAGE, 0.5, 9.0);
    let turn = std::f64::consts::TAU;
    let time = root(&angles, start, 0.7, |s| (s.q[0] - 0.5 - turn, s.v[0]));
    let state = state_at(&angles, start, time);
    all_close(state.v, start.v, 1e-11);
    all_close([state.q[1], state.q[2]], [start.q[1], start.q[2]], 1e-12);
    for angle in [1.1, 2.7, 4.4] {
        let place = assembled(LINKAGE, angle, 1.0);
        let unit = angles.kinetic_energy(&place);
        let expected = ((angles.energy(&start) - angles.potential_energy(&place)) / unit).sqrt();
        let time = root(&angles, start, (angle - 0.5) / 9.0, |s| (s.q[0] - angle, s.v[0]));
        close(state_at(&angles, start, time).v[0], expected, 1e-11);
    }
}

#[test]
fn the_links_carry_what_they_must() {
    let joints = Joints(LINKAGE);
    let state = places(LINKAGE, &assembled(LINKAGE, 1.2, 4.0));
    let a = joints.accelerations(&state).unwrap();
    let [crank, coupler, rocker] = joints.reactions(&state).unwrap().links;
    let on_joints = joints.reactions_on_joints(&state).unwrap().links;
    for (i, m) in LINKAGE.m.into_iter().enumerate() {
        let sum: nalgebra::Vector2<f64> = on_joints.iter().map(|forces| forces[i]).sum();
        let needed = nalgebra::Vector2::new(m * a[2 * i], m * (a[2 * i + 1] + LINKAGE.g));
        all_close(sum, needed, 1e-12);
    }
    // Unit gradients: the sizes of the forces are the multipliers.
    close(on_joints[0][0].norm(), crank.abs(), 1e-13);
    close(on_joints[1][0].norm(), coupler.abs(), 1e-13);
    close(on_joints[1][1].norm(), coupler.abs(), 1e-13);
    close(on_joints[2][1].norm(), rocker.abs(), 1e-13);
    bound!(joints, [true; 3]).holds([state]);
    bound!(Angles(LINKAGE), [true; 2]).holds([assembled(LINKAGE, 1.2, 4.0)]);
}

#[test]
fn energy_and_closure_stay() {
    let angles = Angles(LINKAGE);
    let start = assembled(LINKAGE, 0.5, 9.0);
    let energy = angles.energy(&start);
    let mut motion = angles.simulate(start).with_tolerance(TIGHT);
    between(-1.0, drift(&mut motion, 0.05, 400, |s| angles.energy(s)), 1e-12 * energy);
    for residual in angles.constraint_residuals(motion.state()) {
        close_on(1.0, residual, 0.0, 1e-14);
    }
    for rate in angles.constraint_rates(motion.state()) {
        close_on(10.0, rate, 0.0, 1e-14);
    }
}

#[test]
fn a_parallelogram_passes_its_flat_configurations() {
    // In a flat configuration the constraints lose a rank, and two branches of motions meet. However near the
    // state is to it, accelerations are those of its own branch. So a method that evaluates them goes across.
    let (angles, wheel) = (Angles(PARALLELOGRAM), Wheel(PARALLELOGRAM));
    let start = State::new([0.3, 0.0, 0.3], [12.0, 0.0, 12.0]);
    let energy = angles.energy(&start);
    let mut rk4 = angles.stepper::<Rk4>(start);
    let mut single = wheel.simulate(State::new([0.3], [12.0])).with_tolerance(TIGHT);
    for step in 1..=10_000 {
        let state = *rk4.step(5e-4, &[]).unwrap();
        if step % 100 == 0 {
            let State { q: [angle], v: [rate], .. } = *single.advance_to(state.t).unwrap();
            close(angles.energy(&state), energy, 1e-10);
            all_close(state.q, [angle, 0.0, angle], 1e-8);
            all_close(state.v, [rate, 0.0, rate], 1e-8);
            for residual in angles.constraint_residuals(&state) {
                close_on(1.0, residual, 0.0, 1e-14);
            }
        }
    }
    assert!(rk4.state().q[0] > 18.0 * std::f64::consts::PI);
}

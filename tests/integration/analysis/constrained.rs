//! Systems with constraints: S04, S05, S08 and S14 in Cartesian coordinates, redundant and nonholonomic
//! constraints.

use std::f64::consts::{FRAC_PI_6, PI};

use lagrangian::{EquilibriumError, Name, Stability, prelude::*};

use crate::support::close::{all_close, close};
use crate::support::reference::seed;

const G: f64 = 9.81;

/// A mass on an incline with a spring, in the plane, and the line as a constraint (S04).
struct Incline {
    angle: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Incline {
    #[point(mass = 2.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    /// x to the right, y downwards, the plane falls to the right.
    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        25.0 * (q.x.powi(2) + q.y.powi(2)) - 2.0 * G * q.y
    }

    #[holonomic]
    fn line(&self, q: &Coordinates) -> f64 {
        q.x * self.angle.sin() - q.y * self.angle.cos()
    }
}

#[test]
fn s04_normal_force_and_frequency_on_an_incline() {
    let reference = seed("S04");
    let system = Incline { angle: FRAC_PI_6 };
    let rest = system.equilibrium([1.0, -0.3], &[]).unwrap();
    let place = reference.number("q_eq");
    all_close(rest.state.q, [place * FRAC_PI_6.cos(), place * FRAC_PI_6.sin()], 1e-14);
    close(rest.multipliers[0], reference.number("normal_force"), 1e-14);
    assert!(rest.is_isolated && rest.are_unique);
    close(system.reactions(&rest.state).unwrap().line, rest.multipliers[0], 1e-14);
    let modes = system.modes(&rest.state, &[]).unwrap();
    assert_eq!(modes.len(), 1);
    close(modes[0].frequency(), reference.number("omega"), 1e-14);
    close(modes[0].shape[1].re / modes[0].shape[0].re, FRAC_PI_6.tan(), 1e-14);
    let model = system.linearize(&rest.state, &[]).unwrap();
    assert_eq!((model.order(), model.displacements.len()), (2, 1));
    close(model.state_matrix::<2>().unwrap()[(1, 0)], -25.0, 1e-13);
    close(model.drift::<2>().unwrap().norm(), 0.0, 1e-12);
}

/// There is no motion for small deviations to deviate from. The rule is that for the start of a motion.
#[test]
fn a_state_off_the_constraints_has_no_linear_model() {
    let system = Incline { angle: FRAC_PI_6 };
    let (sin, cos) = FRAC_PI_6.sin_cos();
    let mut refused = [0; 2];
    for off in [0.0, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-6, 1e-3, 1.0] {
        let position = State::at_rest([0.7 * cos + off * sin, 0.7 * sin - off * cos]);
        let velocity = State::new([0.7 * cos, 0.7 * sin], [0.3 * cos + off * sin, 0.3 * sin - off * cos]);
        for (state, count) in [position, velocity].iter().zip(&mut refused) {
            let start = system.simulate(*state).advance_to(1e-3).err();
            let found = [system.linearize(state, &[]).err(), system.modes(state, &[]).err()];
            assert_eq!(found, [start, start], "{off:e}");
            *count += usize::from(start.is_some());
            if off == 1e-3 {
                let name = |name: Name| name.to_string() == "line";
                assert!(match start.unwrap().cause {
                    Cause::PositionViolated { name: found, .. } => state.v == [0.0; 2] && name(found),
                    Cause::VelocityViolated { name: found, .. } => state.v != [0.0; 2] && name(found),
                    _ => false,
                });
            }
        }
    }
    // Those from 9e-10 of the numbers on.
    assert_eq!(refused, [5, 5]);
}

/// Two masses on wall and floor joined by a bar, all coordinates kept (S05).
struct Ladder {
    m: [f64; 2],
    a: f64,
}

#[lagrangian(coordinates = [upper_x, upper_y, lower_x, lower_y], inputs = [push], jacobians)]
impl Ladder {
    #[point(mass = self.m[0])]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.upper_x, q.upper_y)
    }

    #[point(mass = self.m[1])]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.lower_x, q.lower_y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * (self.m[0] * q.upper_y + self.m[1] * q.lower_y)
    }

    #[force(at = lower)]
    fn push(&self, u: &Inputs) -> Vector2<f64> {
        Vector2::new(u.push, 0.0)
    }

    #[holonomic]
    fn wall(&self, q: &Coordinates) -> f64 {
        q.upper_x
    }

    #[holonomic]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.lower_y
    }

    #[holonomic]
    fn bar(&self, q: &Coordinates) -> f64 {
        (self.upper(q) - self.lower(q)).norm() - self.a * 2.0_f64.sqrt()
    }
}

#[test]
fn s05_a_ladder_that_a_force_holds() {
    let reference = seed("S05");
    let ladder = Ladder { m: [2.0, 3.0], a: 0.5 };
    let force = reference.number("F2");
    let rest = ladder.stationary_point([0.1, 0.6, 0.4, 0.0], &[force]).unwrap();
    all_close(rest.state.q, [0.0, 0.5, 0.5, 0.0], 1e-12);
    let [wall, floor, bar] = rest.multipliers;
    close(bar, reference.number("bar_compression"), 1e-13);
    close(floor, reference.number("N_floor"), 1e-13);
    close(wall, reference.number("N_wall"), 1e-13);
    // F₂ = −m₁ g (a + x₂) / (a − x₁) in general.
    let rest = ladder.stationary_point([0.0, 0.5, 0.5, 0.0], &[-30.0]).unwrap();
    close(rest.state.q[2] / rest.state.q[1], 30.0 / (2.0 * G), 1e-13);
    // The top of a hill: one eigenvalue grows.
    assert_eq!(rest.stability, Stability::Unstable { directions: 1 });
    let modes = ladder.modes(&rest.state, &[-30.0]).unwrap();
    assert_eq!(modes.len(), 2);
    close(modes[0].eigenvalue.re, -modes[1].eigenvalue.re, 1e-14);
    assert!(modes[1].eigenvalue.re > 1.0);
}

#[test]
fn s05_inverse_dynamics_tells_what_must_be_pushed() {
    let reference = seed("S05");
    let ladder = Ladder { m: [2.0, 3.0], a: 0.5 };
    let state = State::at_rest([0.0, 0.5, 0.5, 0.0]);
    let needed = ladder.inverse_dynamics(&state, &[0.0; 4]).unwrap();
    all_close(needed.total, [0.0, 2.0 * G, 0.0, 3.0 * G], 1e-15);
    // The push and the forces at rest have the same power along the only possible motion.
    let along = [0.0, -1.0, 1.0, 0.0];
    let power: f64 = needed.required.iter().zip(along).map(|(force, v)| force * v).sum();
    close(power, reference.number("F2"), 1e-14);
    let a = ladder.accelerations(&state, &[-4.0]).unwrap();
    let needed = ladder.inverse_dynamics(&state, &a).unwrap();
    let power: f64 = needed.required.iter().zip(along).map(|(force, v)| force * v).sum();
    close(power, -4.0, 1e-13);
    let gradients = ladder.constraint_jacobian(&state);
    for i in 0..4 {
        let borne: f64 = (0..3).map(|c| gradients[(c, i)] * needed.multipliers[c]).sum();
        close(needed.required[i] + borne, needed.total[i], 1e-13);
    }
}

/// A double pendulum of four Cartesian coordinates, with its upper rod given twice (S08).
struct Rods;

#[lagrangian(coordinates = [r: [2], s: [2]], jacobians, allow(redundant))]
impl Rods {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::from(q.r)
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::from(q.s)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -G * (q.r[0] + q.s[0])
    }

    #[holonomic]
    fn first(&self, q: &Coordinates) -> f64 {
        self.upper(q).norm() - 1.0
    }

    #[holonomic]
    fn second(&self, q: &Coordinates) -> f64 {
        (self.lower(q) - self.upper(q)).norm() - 1.0
    }

    #[holonomic]
    fn again(&self, q: &Coordinates) -> f64 {
        self.upper(q).norm_squared() - 1.0
    }
}

#[test]
fn s08_modes_of_a_double_pendulum_by_its_rods() {
    let rest = Rods.equilibrium([0.9, 0.3, 1.9, 0.1], &[]).unwrap();
    all_close(rest.state.q, [1.0, 0.0, 2.0, 0.0], 1e-12);
    assert!(!rest.are_unique && rest.is_isolated);
    // Tensions 2 m g and m g; the first is shared by two constraints with least squares: gradients 1 and 2.
    all_close(rest.multipliers, [-2.0 * G / 5.0, -G, -4.0 * G / 5.0], 1e-13);
    let modes = Rods.modes(&rest.state, &[]).unwrap();
    let found: Vec<f64> = modes.iter().map(|mode| mode.frequency()).collect();
    all_close(found, seed("S08").numbers::<2>("linear_omegas"), 1e-13);
    for (mode, ratio) in modes.iter().zip([1.0 + 2.0_f64.sqrt(), 1.0 - 2.0_f64.sqrt()]) {
        close(mode.shape[3].re / mode.shape[1].re, ratio, 1e-13);
        close(mode.shape[0].re.hypot(mode.shape[2].re), 0.0, 1e-13);
    }
}

/// A bead on a whirling hoop in Cartesian coordinates that turn with it (S14).
struct Hoop {
    rate: f64,
}

#[lagrangian(coordinates = [x, z], jacobians)]
impl Hoop {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.z.powi(2) + (self.rate * q.x).powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        G * q.z
    }

    #[holonomic]
    fn circle(&self, q: &Coordinates) -> f64 {
        q.x.hypot(q.z) - 0.5
    }
}

#[test]
fn s14_the_whirling_hoop_with_a_multiplier() {
    let reference = seed("S14");
    let hoop = Hoop { rate: 6.0 };
    let rest = hoop.equilibrium([0.3, -0.2], &[]).unwrap();
    let angle = reference.number("phi_eq");
    all_close(rest.state.q, [0.5 * angle.sin(), 0.5 * angle.cos()], 1e-13);
    // The hoop bears the centrifugal force in full: N = −m W² R.
    close(rest.multipliers[0], -18.0, 1e-13);
    close(hoop.modes(&rest.state, &[]).unwrap()[0].frequency(), reference.number("omega_about_eq"), 1e-13);
    let other = hoop.equilibrium([-0.3, -0.2], &[]).unwrap();
    close(other.state.q[0], -0.5 * angle.sin(), 1e-13);
    let slow = Hoop { rate: 3.0 };
    let bottom = slow.equilibrium([0.2, -0.4], &[]).unwrap();
    all_close(bottom.state.q, [0.0, -0.5], 1e-12);
    let frequency = slow.modes(&bottom.state, &[]).unwrap()[0].frequency();
    close(frequency, reference.number("omega_bottom_at_Omega_3"), 1e-14);
}

/// A ball on a table that shakes.
struct Shaken;

#[lagrangian(coordinates = [x, z], jacobians)]
impl Shaken {
    #[point(mass = 1.0)]
    fn ball(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.z)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        G * q.z + q.x.powi(2)
    }

    #[holonomic]
    fn table(&self, q: &Coordinates, t: f64) -> f64 {
        q.z - 0.1 * (3.0 * t).sin()
    }
}

#[test]
fn where_a_constraint_moves_nothing_rests() {
    let found = Shaken.equilibrium([0.3, -0.2], &[]);
    let name = Name::new(&Shaken::NAMES.constraints[0]);
    assert_eq!(found, Err(EquilibriumError::MovingConstraint { constraint: 0, name }));
}

/// A pendulum in Cartesian coordinates (S01).
struct Pendulum;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Pendulum {
    #[point(mass = 1.3)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -1.3 * G * q.x
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 0.7
    }
}

#[test]
fn s01_gauss_methods_run_on_constrained_systems() {
    let start = State::at_rest([0.7 * 1.0_f64.cos(), 0.7 * 1.0_f64.sin()]);
    let period = 1.789_730_921_643_471_3;
    let mut motion = Pendulum.stepper::<Gauss8>(start);
    for _ in 0..400 {
        motion.step(10.0 * period / 400.0, &[]).unwrap();
    }
    all_close(motion.state().q, start.q, 1e-9);
    assert!(motion.state().v.iter().all(|v| v.abs() < 1e-9));
    let energy = Pendulum.energy(&start);
    close(motion.energy(), energy, 1e-11);
    close(Pendulum.constraint_residuals(motion.state())[0], 0.0, 1e-12);
    let top = Pendulum.stationary_point([-0.5, 0.1], &[]).unwrap();
    close(top.state.q[1].atan2(top.state.q[0]).abs(), PI, 1e-13);
}

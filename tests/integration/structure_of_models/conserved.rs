//! Integrals that are found, and those that must not be claimed.

use lagrangian::prelude::*;

use super::CLOSED_FORM;
use crate::support::close::{all_close, close, close_on};
use crate::support::sample::Samples;

/// C03: a free rigid body in Euler's angles.
struct EulerTop {
    inertia: [f64; 3],
}

#[lagrangian(coordinates = [phi, theta, psi], analysis)]
impl EulerTop {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn top(&self, q: &Coordinates) -> (Vector3<f64>, Rotation3<f64>) {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        (Vector3::zeros(), attitude)
    }
}

#[test]
fn a_free_body_keeps_its_energy_and_the_momentum_of_precession() {
    assert_eq!(EulerTop::CYCLIC, ["phi"]);
    assert_eq!(EulerTop::CONSERVED, ["energy", "momentum of phi"]);
    let top = EulerTop { inertia: [1.0, 2.0, 3.0] };
    // φ = ψ = 0, θ = 1: body rates (1, 0, 1.2).
    let start = State::new([0.0, 1.0, 0.0], [0.0, 1.0, 1.2]);
    let momentum = 3.0 * 1.2 * 1.0_f64.cos();
    all_close(top.conserved(&start), [2.66, momentum], CLOSED_FORM);
    let mut motion = top.simulate(start).with_tolerance(1e-13);
    all_close(top.conserved(motion.advance_to(7.0).unwrap()), [2.66, momentum], 1e-11);
}

/// C04: a heavy symmetric top.
struct Top {
    a: f64,
    c: f64,
    moment: f64,
}

#[lagrangian(coordinates = [phi, theta, psi], analysis)]
impl Top {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let spin = v.psi + v.phi * q.theta.cos();
        0.5 * self.a * (v.theta.powi(2) + (v.phi * q.theta.sin()).powi(2)) + 0.5 * self.c * spin.powi(2)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.moment * q.theta.cos()
    }
}

#[test]
fn the_heavy_top_has_two_cyclic_coordinates() {
    assert_eq!(Top::CYCLIC, ["phi", "psi"]);
    assert_eq!(Top::CONSERVED, ["energy", "momentum of phi", "momentum of psi"]);
    let top = Top { a: 0.004, c: 0.0015, moment: 0.25 };
    let start = State::new([0.0, 0.6, 0.0], [0.0, 0.0, 150.0]);
    let [p_phi, p_psi] = top.cyclic_momenta(&start);
    close(p_psi, 0.225, CLOSED_FORM);
    close(p_phi, 0.225 * 0.6_f64.cos(), CLOSED_FORM);
    let mut motion = top.simulate(start).with_tolerance(1e-13);
    all_close(top.cyclic_momenta(motion.advance_to(0.5).unwrap()), [p_phi, p_psi], 1e-11);
}

/// C12: the swinging Atwood machine, with any ratio of masses and with the one that is integrable.
struct Atwood {
    counterweight: f64,
}

#[lagrangian(coordinates = [r, theta], analysis)]
impl Atwood {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * ((1.0 + self.counterweight) * v.r.powi(2) + (q.r * v.theta).powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.r * (self.counterweight - q.theta.cos())
    }
}

struct Integrable;

#[lagrangian(coordinates = [r, theta], analysis)]
impl Integrable {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * (4.0 * v.r.powi(2) + (q.r * v.theta).powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.r * (3.0 - q.theta.cos())
    }
}

#[test]
fn the_hidden_integral_of_atwoods_machine_is_not_claimed() {
    assert_eq!((Atwood::CYCLIC, Atwood::CONSERVED), ([""; 0], ["energy"]));
    assert_eq!((Integrable::CYCLIC, Integrable::CONSERVED), ([""; 0], ["energy"]));
    close(Integrable.conserved(&State::at_rest([2.0, 0.0]))[0], 9.81 * 4.0, CLOSED_FORM);
}

/// C05: a spherical pendulum in Cartesian coordinates.
struct SphericalPendulum {
    g: f64,
}

#[lagrangian(coordinates = [x, y, z], analysis)]
impl SphericalPendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * q.z
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        0.5 * (self.bob(q).norm_squared() - 1.0)
    }
}

#[test]
fn a_rotation_that_the_constraint_allows_is_found() {
    assert_eq!(SphericalPendulum::CYCLIC, [""; 0]);
    assert_eq!(SphericalPendulum::CONSERVED, ["energy", "angular momentum in the x–y plane"]);
    let pendulum = SphericalPendulum { g: 1.0 };
    let (sin, cos) = 1.3_f64.sin_cos();
    let start = State::new([sin, 0.0, cos], [0.06, 0.53, -0.06 * 1.3_f64.tan()]);
    let expected =
        [0.5 * (0.06_f64.powi(2) * (1.0 + 1.3_f64.tan().powi(2)) + 0.53_f64.powi(2)) + cos, 0.53 * sin];
    all_close(pendulum.conserved(&start), expected, CLOSED_FORM);
    let mut motion = pendulum.simulate(start).with_tolerance(1e-13);
    all_close(pendulum.conserved(motion.advance_to(10.0).unwrap()), expected, 1e-11);
}

/// P03: seven bodies in a plane.
struct Pleiades {
    masses: [f64; 7],
}

#[lagrangian(coordinates = [x: [7], y: [7]], analysis)]
impl Pleiades {
    #[point(mass = self.masses[..])]
    fn stars(&self, q: &Coordinates) -> [Vector2<f64>; 7] {
        std::array::from_fn(|i| Vector2::new(q.x[i], q.y[i]))
    }

    #[potential]
    fn gravitation(&self, q: &Coordinates) -> f64 {
        let stars = self.stars(q);
        let mut sum = 0.0;
        for i in 0..7 {
            for j in 0..i {
                sum -= self.masses[i] * self.masses[j] / (stars[i] - stars[j]).norm();
            }
        }
        sum
    }
}

#[test]
fn the_pleiades_keep_their_momenta() {
    let expected = [
        "energy",
        "momentum along x[0] + … + x[6]",
        "momentum along y[0] + … + y[6]",
        "angular momentum in the x–y plane",
    ];
    assert_eq!(Pleiades::CONSERVED, expected);
    let cluster = Pleiades { masses: std::array::from_fn(|i| (i + 1) as f64) };
    let mut samples = Samples::new(8);
    let state: State<f64, 14> = samples.state(-1.0, 1.0);
    let [_, px, py, l] = cluster.conserved(&state);
    let sum = |term: &dyn Fn(usize) -> f64| (0..7).map(|i| (i + 1) as f64 * term(i)).sum::<f64>();
    let (q, v) = (state.q, state.v);
    close_on(10.0, px, sum(&|i| v[i]), CLOSED_FORM);
    close_on(10.0, py, sum(&|i| v[7 + i]), CLOSED_FORM);
    close_on(10.0, l, sum(&|i| q[i] * v[7 + i] - q[7 + i] * v[i]), CLOSED_FORM);
    let x0 = [3.0, 3.0, -1.0, -3.0, 2.0, -2.0, 2.0, 3.0, -3.0, 2.0, 0.0, 0.0, -4.0, 4.0];
    let v0 = [0.0, 0.0, 0.0, 0.0, 0.0, 1.75, -1.5, 0.0, 0.0, 0.0, -1.25, 1.0, 0.0, 0.0];
    let start = State::new(x0, v0);
    let mut motion = cluster.simulate(start).with_tolerance(1e-13);
    let end = cluster.conserved(motion.advance_to(3.0).unwrap());
    for (end, start) in end.into_iter().zip(cluster.conserved(&start)) {
        close_on(100.0, end, start, 1e-10);
    }
}

/// A planar chain without gravity on a turning disc: the angles shift together.
struct Free {
    m: [f64; 3],
    l: [f64; 3],
    inertia: f64,
}

#[lagrangian(coordinates = [disc, theta: [3]], analysis)]
impl Free {
    #[point(mass = self.m[..])]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 3] {
        let mut end = Vector2::new(q.disc.cos(), q.disc.sin());
        std::array::from_fn(|i| {
            end += self.l[i] * Vector2::new(q.theta[i].cos(), q.theta[i].sin());
            end
        })
    }

    #[kinetic]
    fn disc(&self, v: &Velocities) -> f64 {
        0.5 * self.inertia * v.disc.powi(2)
    }

    /// A torque between the disc and the last link does no harm.
    #[force]
    fn torque(&self, q: &Coordinates, v: &Velocities) -> [f64; 4] {
        let torque = (q.theta[2] - q.disc).sin() * (v.theta[2] - v.disc);
        [torque, 0.0, 0.0, -torque]
    }
}

#[test]
fn a_common_shift_is_found_under_internal_forces() {
    assert_eq!(Free::CYCLIC, [""; 0]);
    assert_eq!(Free::CONSERVED, ["momentum along disc + theta[0] + theta[1] + theta[2]"]);
    let system = Free { m: [1.0, 2.0, 3.0], l: [0.5, 0.6, 0.7], inertia: 0.4 };
    let state = State::new([0.1, 0.2, 0.3, 0.4], [1.0, -0.5, 0.3, 0.2]);
    close(system.conserved(&state)[0], system.momenta(&state).iter().sum(), CLOSED_FORM);
}

/// A planar body pulled to the origin: it may turn about the origin only with its position.
struct Satellite {
    inertia: f64,
}

#[lagrangian(coordinates = [x, y, heading], analysis)]
impl Satellite {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn hull(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.heading)
    }

    #[potential]
    fn pull(&self, q: &Coordinates) -> f64 {
        // Tidal: the pull depends on the angle between the body and its position.
        let (sin, cos) = q.heading.sin_cos();
        0.5 * (q.x * cos + q.y * sin).powi(2) - 1.0 / (q.x.powi(2) + q.y.powi(2)).sqrt()
    }
}

#[test]
fn a_rotation_takes_an_angle_along() {
    assert_eq!(Satellite::CONSERVED, ["energy", "angular momentum in the x–y plane with heading"]);
    let satellite = Satellite { inertia: 0.3 };
    let state = State::new([1.0, 0.2, 0.3], [0.1, 0.9, -0.4]);
    close(satellite.conserved(&state)[1], 1.0 * 0.9 - 0.2 * 0.1 + 0.3 * -0.4, CLOSED_FORM);
    let mut motion = satellite.simulate(state).with_tolerance(1e-13);
    let end = *motion.advance_to(5.0).unwrap();
    all_close(satellite.conserved(&end), satellite.conserved(&state), 1e-11);
}

/// A skate: translations are symmetries of L, but the reaction of its edge has components along them.
struct Skate {
    inertia: f64,
}

#[lagrangian(coordinates = [x, y, heading], analysis)]
impl Skate {
    #[body(mass = 1.0, inertia = self.inertia)]
    fn blade(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (Vector2::new(q.x, q.y), q.heading)
    }

    #[nonholonomic]
    fn edge(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x * q.heading.sin() - v.y * q.heading.cos()
    }
}

#[test]
fn symmetries_that_reactions_break_are_no_integrals() {
    // L alone keeps all three momenta; the edge leaves that of the heading.
    assert_eq!(Skate::CYCLIC, ["heading"]);
    assert_eq!(Skate::CONSERVED, ["energy", "momentum of heading"]);
}

#[test]
fn certificates_are_given() {
    EulerTop { inertia: [1.0, 2.0, 3.0] }.verify().unwrap();
    Top { a: 0.004, c: 0.0015, moment: 0.25 }.verify().unwrap();
    Atwood { counterweight: 2.5 }.verify().unwrap();
    SphericalPendulum { g: 1.0 }.verify().unwrap();
    Pleiades { masses: std::array::from_fn(|i| (i + 1) as f64) }.verify().unwrap();
    Free { m: [1.0, 2.0, 3.0], l: [0.5, 0.6, 0.7], inertia: 0.4 }.verify().unwrap();
    Satellite { inertia: 0.3 }.verify().unwrap();
    Skate { inertia: 0.3 }.verify().unwrap();
}

/// A charge in a uniform magnetic field: L depends on both coordinates, T + V and M on neither.
struct Charge;

#[lagrangian(coordinates = [x, y], analysis)]
impl Charge {
    #[lagrangian]
    fn whole(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * (v.x.powi(2) + v.y.powi(2)) + 0.25 * (q.x * v.y - q.y * v.x)
    }
}

#[test]
fn a_coordinate_in_a_term_linear_in_the_velocities_is_not_cyclic() {
    assert!(
        Charge::CYCLIC.is_empty() && !Charge::CONSERVED.contains(&"momentum of x"),
        "{:?}",
        Charge::CONSERVED
    );
    let mut motion = Charge.simulate(State::new([1.0, 0.0], [0.0, 1.0])).with_tolerance(1e-13);
    let start = Charge.conserved(motion.state());
    all_close(Charge.conserved(motion.advance_to(3.0).unwrap()), start, 1e-11);
}

//! Certificates of systems of all kinds, and the page of a model.

use lagrangian::prelude::*;
use lagrangian::{Certificate, Identity, Violation};

/// Most ways to describe: a body, an array of points, energies, a constraint that is eliminated, one that
/// moves, one on velocities, an input, dissipation, and a scalar of the user's choice.
struct Machine<R> {
    mass: R,
    inertia: [R; 3],
    rate: R,
}

#[lagrangian(coordinates = [x, y, z, phi, theta, angle: [2], slave], inputs = [push], analysis)]
impl<R: Real> Machine<R> {
    #[body(mass = self.mass, inertia = self.inertia)]
    fn rotor(&self, q: &Coordinates<R>) -> (Vector3<R>, Rotation3<R>) {
        let (sin_phi, cos_phi) = q.phi.sin_cos();
        let (sin, cos) = q.theta.sin_cos();
        let zero = R::zero();
        let first = Matrix3::new(cos_phi, -sin_phi, zero, sin_phi, cos_phi, zero, zero, zero, R::one());
        let second = Matrix3::new(R::one(), zero, zero, zero, cos, -sin, zero, sin, cos);
        (Vector3::new(q.x, q.y, q.z), Rotation3::from_matrix_unchecked(first * second))
    }

    #[point(mass = 0.5)]
    fn links(&self, q: &Coordinates<R>, t: R) -> [Vector2<R>; 2] {
        q.angle.map(|angle| Vector2::new(q.slave + angle.sin(), (self.rate * t).sin() - angle.cos()))
    }

    #[kinetic]
    fn flywheel(&self, v: &Velocities<R>) -> R {
        0.3 * (v.angle[0] + 2.0 * v.phi).powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates<R>) -> R {
        q.x * q.x + q.angle[0] * q.angle[1] + q.theta.sin() + q.slave * q.slave
    }

    #[dissipation]
    fn damper(&self, v: &Velocities<R>) -> R {
        0.2 * v.angle[1] * v.angle[1]
    }

    #[force(on = phi)]
    fn motor(&self, u: &Inputs<R>, t: R) -> R {
        u.push * t.cos()
    }

    #[holonomic(eliminate = slave)]
    fn gear(&self, q: &Coordinates<R>, t: R) -> R {
        q.slave - 0.5 * q.x - 0.1 * t.sin()
    }

    #[holonomic]
    fn lift(&self, q: &Coordinates<R>, t: R) -> R {
        q.z - 0.1 * (self.rate * t).cos() - 0.2 * q.y
    }

    #[nonholonomic]
    fn skate(&self, q: &Coordinates<R>, v: &Velocities<R>) -> R {
        v.x * q.phi.sin() - v.y * q.phi.cos()
    }
}

#[test]
fn a_machine_of_everything_has_a_certificate() {
    let machine = Machine { mass: 1.3_f64, inertia: [0.2, 0.3, 0.4], rate: 1.7 };
    let passed: Certificate = machine.verify().unwrap();
    assert_eq!(passed.states, 12);
    assert!(passed.comparisons > 500 && passed.worst < 0.5, "{passed:?}");
    let single = Machine { mass: 1.3_f32, inertia: [0.2, 0.3, 0.4], rate: 1.7 };
    single.verify().unwrap();
}

/// A pendulum.
struct Pendulum;

#[lagrangian(coordinates = [theta], analysis)]
impl Pendulum {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * self.bob(q).y
    }
}

#[test]
fn numbers_that_make_no_physics_are_a_violation() {
    let text = Pendulum.verify().unwrap().to_string();
    assert!(text.starts_with("verified: ") && text.ends_with("of what was allowed"), "{text}");
    let states = [State::new([f64::INFINITY], [0.0])];
    assert!(matches!(Pendulum.verify_at(&states), Err(Violation { identity: Identity::Domain, .. })));
    // A negative moment of inertia among the parameters.
    let machine = Machine { mass: 1.3, inertia: [-5.0, 0.3, 0.4], rate: 1.7 };
    let violation = machine.verify().unwrap_err();
    assert_eq!(violation.identity, Identity::PositiveInertia, "{violation}");
}

/// A pendulum whose attribute asks for a test of its own.
#[derive(Clone, Copy)]
pub struct Tested<R> {
    length: R,
}

#[lagrangian(coordinates = [theta], verify = Self { length: R::one() })]
impl<R: Real> Tested<R> {
    #[point(mass = 2.0)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        19.62 * self.bob(q).y
    }
}

#[test]
fn equations_read_like_a_textbook() {
    assert_eq!(Tested::<f64>::EQUATIONS, "2 length²·θ̈ + 19.62 length·sin θ = 0");
    assert_eq!(
        Tested::<f64>::EQUATIONS_LATEX,
        "\\begin{aligned}\n2 {\\mathrm{length}}^{2} \\, \\ddot{\\theta} + 19.62 \\mathrm{length} \\, \\sin \\theta &= 0\n\\end{aligned}"
    );
}

/// Everything that is generated under lints that deny.
mod strict {
    #![deny(warnings, missing_docs)]

    use lagrangian::prelude::*;

    /// A charge in a magnetic field.
    #[derive(Clone, Copy, Debug)]
    pub struct Charge {
        /// Strength of the field.
        pub field: f64,
    }

    #[lagrangian(coordinates = [x, y], inputs = [push], analysis, verify = Charge { field: 1.5 })]
    impl Charge {
        #[lagrangian]
        fn particle(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
            0.5 * (v.x * v.x + v.y * v.y) + self.field * (1.0 + t) * (q.x * v.y - q.y * v.x)
        }

        #[force(on = x)]
        fn pusher(&self, u: &Inputs) -> f64 {
            u.push
        }
    }
}

#[test]
fn strict_lints_are_silent() {
    let charge = strict::Charge { field: 1.5 };
    let state = State::new([0.1, 0.2], [0.3, 0.4]);
    assert_eq!(strict::Charge::CONSERVED, [""; 0]);
    // L₁ of a Lagrangian given as a whole: the magnetic part.
    let (t2, t1, t0) = charge.kinetic_energy_parts(&state);
    assert!((t2 - 0.125).abs() < 1e-15 && (t1 - 1.5 * (0.1 * 0.4 - 0.2 * 0.3)).abs() < 1e-15 && t0 == 0.0);
}

//! Names of coordinates, inputs and parameters.

#![allow(non_snake_case)]

use lagrangian::prelude::*;

use crate::support::close::all_close;

/// Names that collide with each other, with keywords, and with those that generated code uses.
struct Letters {
    constants: f64,
    state: f64,
    w1: f64,
    lagrange: f64,
    r#fn: f64,
}

#[lagrangian(coordinates = [t, q, v, x_dot, θ, r#type, x, w2, u], inputs = [state, inputs, f64, q_dot])]
impl Letters {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let rates = [v.t, v.q, v.v, v.x_dot, v.θ, v.r#type, v.x, v.w2, v.u];
        rates.iter().enumerate().map(|(i, rate)| 0.5 * (1 + i) as f64 * rate * rate).sum()
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        self.constants * q.t
            + self.state * q.q
            + self.w1 * q.v
            + self.lagrange * q.x_dot
            + self.r#fn * q.r#type
            + q.θ * q.w2 * q.u
    }

    /// The time argument beside the coordinate `t`.
    #[force(on = t)]
    fn on_t(&self, v: &Velocities, t: f64) -> f64 {
        t * v.x
    }

    /// The velocity of `q` beside the input `q_dot`.
    #[force(on = q)]
    fn on_q(&self, v: &Velocities, u: &Inputs) -> f64 {
        v.q * u.q_dot
    }

    #[force(on = r#type)]
    fn on_type(&self, u: &Inputs) -> f64 {
        u.state * u.inputs + u.f64
    }
}

#[test]
fn coordinates_inputs_and_parameters_may_have_any_name() {
    let letters = Letters { constants: 10.0, state: 20.0, w1: 30.0, lagrange: 40.0, r#fn: 50.0 };
    let state = State::new([0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 3.0, 4.0], [0.5; 9]).at_time(7.0);
    let found = letters.accelerations(&state, &[2.0, 3.0, 4.0, 6.0]).unwrap();
    let forces = [-10.0 + 3.5, -20.0 + 3.0, -30.0, -40.0, -12.0, -50.0 + 10.0, 0.0, -8.0, -6.0];
    all_close(found, std::array::from_fn::<f64, 9, _>(|i| forces[i] / (i + 1) as f64), 1e-15);
    all_close(letters.momenta(&state), std::array::from_fn::<f64, 9, _>(|i| 0.5 * (i + 1) as f64), 1e-15);
    assert_eq!(LettersVelocities::from([1.0; 9]).r#type, 1.0);
}

/// The gas constant, and a radius of the same name.
const R: f64 = 8.0;

struct Sphere;

#[lagrangian(coordinates = [R])]
impl Sphere {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.R * v.R
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        R * q.R
    }
}

#[test]
fn a_coordinate_may_share_its_name_with_a_constant() {
    assert_eq!(Sphere.accelerations(&State::at_rest([2.0])).unwrap(), [-8.0]);
}

/// Names of the variables of the recurrences, as coordinates, inputs, parameters and locals of a helper.
struct Recurrences {
    orders: f64,
    tables: f64,
}

#[lagrangian(coordinates = [h, rate, order, inner, x], inputs = [left, fraction])]
impl Recurrences {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let inertia = 1.0 + self.series(q).powi(2);
        0.5 * (inertia * v.h.powi(2) + v.rate.powi(2) + v.order.powi(2) + v.inner.powi(2) + v.x.powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        self.orders * (q.h * q.rate).cos() + self.tables * (1.0 + q.order * q.inner).sqrt() + self.series(q)
    }

    #[force(on = h)]
    fn force(&self, v: &Velocities, u: &Inputs) -> f64 {
        let right = u.left - u.fraction * v.h;
        right * v.x
    }

    fn series(&self, q: &Coordinates) -> f64 {
        let h = q.x * q.h;
        let order = h.sin() + h;
        let rate = order * order;
        rate.exp() * order
    }
}

#[test]
fn names_of_the_recurrences_are_free() {
    let system = Recurrences { orders: 2.0, tables: 3.0 };
    let start = State::new([0.1, 0.2, 0.3, 0.4, 0.5], [0.5, 0.4, 0.3, 0.2, 0.1]);
    let inputs = [0.7, 0.3];
    let mut jets = system.simulate(start).with_inputs(inputs).with_tolerance(1e-14);
    let mut other = system.simulate_with::<Dop853>(start).with_inputs(inputs).with_tolerance(1e-14);
    let (found, expected) = (*jets.advance_to(1.0).unwrap(), *other.advance_to(1.0).unwrap());
    all_close(found.q, expected.q, 1e-11);
    all_close(found.v, expected.v, 1e-11);
}

/// Names that the equations of a regime bind for themselves.
struct Regimes {
    coupling: f64,
    shares: f64,
    functions: f64,
}

#[lagrangian(coordinates = [active, forces])]
impl Regimes {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (v.active.powi(2) + v.forces.powi(2))
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        let push = if q.forces > 0.5 { q.forces } else { 0.5 };
        0.5 * self.coupling * q.active.powi(2) + self.shares * q.forces + self.functions * push
    }

    #[unilateral]
    fn gap(&self, q: &Coordinates) -> f64 {
        q.forces
    }

    #[friction(limit = 0.25)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.active
    }
}

#[test]
fn names_of_the_equations_of_a_regime_are_free() {
    let system = Regimes { coupling: 2.0, shares: 9.0, functions: 4.0 };
    let found = system.accelerations(&State::new([0.5, 1.0], [0.1, 0.0])).unwrap();
    all_close(found, [-1.25, -13.0], 1e-14);
}

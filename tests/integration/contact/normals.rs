//! The normal force is that on the particle, whatever the coordinates and units of a constraint or gap.

use lagrangian::prelude::*;

use super::TIGHT;
use crate::support::close::{all_close, close_on};

/// A bead of 1 kg on a vertical hoop of 2 m, μ = 0.2, whose `normal` limits the friction.
macro_rules! bead {
    ($system:ident, $normal:ident, [$($coordinate:ident),*], $q:ident: $place:expr, $hoop:expr) => {
        struct $system;

        #[lagrangian(coordinates = [$($coordinate),*])]
        impl $system {
            #[point(mass = 1.0)]
            fn bead(&self, $q: &Coordinates) -> Vector2<f64> {
                $place
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                9.81 * self.bead(q).y
            }

            #[holonomic]
            fn hoop(&self, $q: &Coordinates) -> f64 {
                $hoop
            }

            #[friction(coefficient = 0.2, normal = $normal)]
            fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
                let (place, velocity) = (self.bead(q), self.bead_velocity(q, v));
                0.5 * (place.x * velocity.y - place.y * velocity.x)
            }
        }
    };
}

bead!(Plain, bead, [x, y], q: Vector2::new(q.x, q.y), q.x.powi(2) + q.y.powi(2) - 4.0);
bead!(Named, hoop, [x, y], q: Vector2::new(q.x, q.y), q.x.powi(2) + q.y.powi(2) - 4.0);
bead!(Scaled, bead, [a, b], q: Vector2::new(q.a, 2.0 * q.b), q.a.powi(2) + 4.0 * q.b.powi(2) - 4.0);
bead!(ScaledNamed, hoop, [a, b], q: Vector2::new(q.a, 2.0 * q.b), q.a.powi(2) + 4.0 * q.b.powi(2) - 4.0);
bead!(Polar, bead, [r, phi], q: q.r * Vector2::new(q.phi.cos(), q.phi.sin()), 5.0 * (q.r - 2.0));
bead!(
    Turned,
    bead,
    [x, y],
    q: Rotation2::new(0.3) * Vector2::new(q.x, q.y),
    q.x.powi(2) + q.y.powi(2) - 4.0
);

/// Where the bead is after half a second from an angle of 0.3 rad beside the lowest point, at 5 m/s. The
/// digits are those of μ |v² / 2 + 9.81 cos φ| as friction on φ, by Dormand and Prince in SciPy.
const END: [f64; 2] = [1.694486, -1.062412];

#[test]
fn the_normal_force_is_that_on_the_particle_in_any_coordinates() {
    let (place, speed) =
        ([2.0 * 0.3_f64.sin(), -2.0 * 0.3_f64.cos()], [5.0 * 0.3_f64.cos(), 5.0 * 0.3_f64.sin()]);
    let start = State::new(place, speed);
    let plain = Plain.simulate(start).with_tolerance(TIGHT).advance_to(0.5).unwrap().q;
    all_close(plain, END, 1e-6);
    let named = Named.simulate(start).with_tolerance(TIGHT).advance_to(0.5).unwrap().q;
    all_close(named, plain, 1e-12);

    let half = State::new([place[0], 0.5 * place[1]], [speed[0], 0.5 * speed[1]]);
    for end in [
        Scaled.simulate(half).with_tolerance(TIGHT).advance_to(0.5).unwrap().q,
        ScaledNamed.simulate(half).with_tolerance(TIGHT).advance_to(0.5).unwrap().q,
    ] {
        all_close([end[0], 2.0 * end[1]], plain, 1e-12);
    }

    let phi = 0.3 - std::f64::consts::FRAC_PI_2;
    let polar = State::new([2.0, phi], [0.0, 2.5]);
    let [r, phi] = Polar.simulate(polar).with_tolerance(TIGHT).advance_to(0.5).unwrap().q;
    all_close([r * phi.cos(), r * phi.sin()], plain, 1e-12);

    let back = Rotation2::new(-0.3);
    let turn = |pair: [f64; 2]| -> [f64; 2] { (back * Vector2::from(pair)).into() };
    let end = Turned
        .simulate(State::new(turn(place), turn(speed)))
        .with_tolerance(TIGHT)
        .advance_to(0.5)
        .unwrap()
        .q;
    let end: [f64; 2] = (Rotation2::new(0.3) * Vector2::from(end)).into();
    all_close(end, plain, 1e-12);
}

/// At the lowest point one component of the reaction vanishes.
#[test]
fn a_bead_starts_where_a_component_of_the_reaction_vanishes() {
    let start = State::new([0.0, -1.0], [5.0, 0.0]);
    let end = *Scaled.simulate(start).advance_to(1e-5).unwrap();
    // The weight along the hoop takes 1.2e-9 of it.
    close_on(1.0, end.v[0].hypot(2.0 * end.v[1]), 5.0 - 0.2 * (12.5 + 9.81) * 1e-5, 1e-8);
}

/// A puck on a floor whose gap is not in metres.
struct Puck {
    scale: f64,
}

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = 0.5)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        0.5 * 9.81 * q.y
    }

    #[unilateral]
    fn floor(&self, q: &Coordinates) -> f64 {
        self.scale * q.y
    }

    #[friction(coefficient = 0.3, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }
}

#[test]
fn a_gap_in_other_units_has_the_same_friction() {
    for scale in [1.0, 2.0, 1e-3] {
        let end = *Puck { scale }.simulate(State::new([0.0, 0.0], [2.0, 0.0])).advance_to(0.2).unwrap();
        close_on(1.0, end.q[0], 0.4 - 0.5 * 0.3 * 9.81 * 0.04, 1e-12);
    }
}

/// A cart with a leg whose foot slides on a floor, with the height of the foot as a coordinate that is
/// eliminated, and without it.
macro_rules! leg {
    ($system:ident, [$($coordinate:ident),*], $q:ident: $height:expr, $scale:literal, { $($constraint:tt)* }) => {
        struct $system;

        #[lagrangian(coordinates = [$($coordinate),*])]
        impl $system {
            #[point(mass = 1.0)]
            fn cart(&self, q: &Coordinates) -> Vector2<f64> {
                Vector2::new(q.x, 0.3 * q.x)
            }

            #[point(mass = 1.0)]
            fn foot(&self, $q: &Coordinates) -> Vector2<f64> {
                Vector2::new($q.x + 0.2 * $q.s, $height)
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                9.81 * (self.cart(q).y + self.foot(q).y)
            }

            $($constraint)*

            #[unilateral]
            fn floor(&self, q: &Coordinates) -> f64 {
                $scale * self.foot(q).y
            }

            #[friction(coefficient = 0.2, normal = floor)]
            fn slip(&self, q: &Coordinates, v: &Velocities) -> f64 {
                self.foot_velocity(q, v).x
            }
        }
    };
}

leg!(Redundant, [y, x, s], q: q.y, 3.0, {
    #[holonomic(eliminate = y)]
    fn length(&self, q: &Coordinates) -> f64 {
        q.y - q.x.sin() - 0.5 * q.s
    }
});
leg!(Minimal, [x, s], q: q.x.sin() + 0.5 * q.s, 1.0, {});

/// In the air, through an impact, and sliding from the start.
#[test]
fn a_coordinate_of_the_place_may_be_eliminated() {
    let (sin, cos) = 0.2_f64.sin_cos();
    for start in [State::new([0.4, 1.0], [1.0, 0.3]), State::new([0.2, -2.0 * sin], [1.0, -2.0 * cos])] {
        let redundant = Redundant.simulate(start).with_tolerance(TIGHT).advance_to(0.9).unwrap().q;
        let minimal = Minimal.simulate(start).with_tolerance(TIGHT).advance_to(0.9).unwrap().q;
        all_close(redundant, minimal, 1e-11);
    }
}

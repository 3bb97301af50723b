//! Mechanisms such as those of the book, and what their models hold.

use quote::quote;

use super::{lowered, value};
use crate::model::{Action, Attitude, RotationForm};

#[test]
fn a_double_pendulum_has_the_positions_and_potential_of_the_textbook() {
    let model = lowered(
        quote!(coordinates = [theta: [2]]),
        quote! {
            impl DoublePendulum {
                #[point(mass = self.m[0])]
                fn upper(&self, q: &Coordinates) -> Vector2<f64> {
                    self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
                }
                #[point(mass = self.m[1])]
                fn lower(&self, q: &Coordinates) -> Vector2<f64> {
                    self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
                }
                #[potential]
                fn gravity(&self, q: &Coordinates) -> f64 {
                    self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
                }
            }
        },
    )
    .unwrap();
    let paths: Vec<&str> = model.parameters.iter().map(|parameter| &*parameter.path).collect();
    assert_eq!(paths, ["self.m[0]", "self.l[0]", "self.m[1]", "self.l[1]", "self.g"]);
    let labels: Vec<&str> = model.parameters.iter().map(|parameter| &*parameter.label).collect();
    assert_eq!(labels, ["m_0", "l_0", "m_1", "l_1", "g"]);
    let parameters = |path: &str| match path {
        "self.m[0]" => 2.0,
        "self.l[0]" => 1.1,
        "self.m[1]" => 3.0,
        "self.l[1]" => 0.7,
        _ => 9.81,
    };
    let (a, b) = (0.3_f64, 0.7_f64);
    let lower = &model.points[1];
    assert_eq!(lower.name, "lower");
    assert_close(value(&model, lower.position[0], parameters), 1.1 * a.sin() + 0.7 * b.sin());
    let y = [-1.1 * a.cos(), -1.1 * a.cos() - 0.7 * b.cos()];
    let potential = model.potential[0].value;
    assert_close(value(&model, potential, parameters), 9.81 * (2.0 * y[0] + 3.0 * y[1]));
    assert_eq!(model.hints.name(lower.position[0]), Some("lower_x"));
    assert!(model.origins.contains(&potential));
}

#[test]
fn a_chain_costs_the_same_for_every_link() {
    let nodes = |links: usize| {
        let model = lowered(
            quote!(coordinates = [theta: [#links]]),
            quote! {
                impl Chain {
                    #[point(mass = self.mass)]
                    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; #links] {
                        let mut joints = [Vector2::zeros(); #links];
                        let mut end = Vector2::zeros();
                        for i in 0..#links {
                            end += self.length * Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
                            joints[i] = end;
                        }
                        joints
                    }
                    #[potential]
                    fn gravity(&self, q: &Coordinates) -> f64 {
                        self.joints(q).iter().map(|joint| self.mass * self.g * joint.y).sum()
                    }
                }
            },
        );
        let model = model.unwrap_or_else(|messages| panic!("{messages:?}"));
        assert_eq!(model.points.len(), links);
        assert_eq!(model.points[0].name, "joints[0]");
        model.graph.len()
    };
    let (short, middle, long) = (nodes(2), nodes(51), nodes(100));
    assert_eq!(long - middle, middle - short);
    assert!(long < 20 * 100, "{long} nodes");
}

#[test]
fn a_cart_pole_is_generic_over_the_scalar() {
    let model = lowered(
        quote!(coordinates = [x, theta], inputs = [motor]),
        quote! {
            impl<R: Real> CartPole<R> {
                #[point(mass = self.cart_mass)]
                fn cart(&self, q: &Coordinates<R>) -> Vector2<R> { Vector2::new(q.x, R::zero()) }
                #[point(mass = self.pole_mass)]
                fn tip(&self, q: &Coordinates<R>) -> Vector2<R> {
                    self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
                }
                #[potential]
                fn gravity(&self, q: &Coordinates<R>) -> R { self.pole_mass * self.g * self.tip(q).y }
                #[dissipation]
                fn bearing(&self, v: &Velocities<R>) -> R { 0.5 * self.damping * v.theta.powi(2) }
                #[force(at = cart)]
                fn motor(&self, u: &Inputs<R>) -> Vector2<R> { Vector2::new(u.motor, R::zero()) }
            }
        },
    )
    .unwrap();
    assert_close(value(&model, model.dissipation[0].value, |_| 3.0), 0.5 * 3.0 * 0.01);
    let Action::AtPosition { position, force } = &model.forces[0].action else {
        panic!("a force at a point")
    };
    assert_close(value(&model, position[0], |_| 1.0), 0.3);
    assert_close(value(&model, force[0], |_| 1.0), 1.5);
}

#[test]
fn a_top_keeps_the_composition_of_its_attitude() {
    let model = lowered(
        quote!(coordinates = [phi, theta, psi]),
        quote! {
            impl Top {
                #[body(mass = self.mass, inertia = self.inertia)]
                fn gyroscope(&self, q: &Coordinates) -> Isometry3<f64> {
                    let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
                        * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
                        * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
                    Isometry3::from_parts((attitude * Vector3::new(0.0, 0.0, self.arm)).into(), attitude.into())
                }
                #[potential]
                fn gravity(&self, q: &Coordinates) -> f64 { self.mass * self.g * self.arm * q.theta.cos() }
            }
        },
    )
    .unwrap();
    let body = &model.bodies[0];
    let Attitude::Spatial { rotation, inertia } = &body.attitude else { panic!("a body in space") };
    let RotationForm::Product(left, right) = &rotation.form else { panic!("a product") };
    assert!(matches!(left.form, RotationForm::Product(..)));
    assert!(matches!(right.form, RotationForm::Axis { .. }));
    let (phi, theta, psi) = (0.3_f64, 0.7_f64, 1.1_f64);
    let expected = phi.sin() * psi.cos() + phi.cos() * theta.cos() * psi.sin();
    assert_close(value(&model, rotation.matrix[1][0], |_| 1.0), expected);
    assert_close(value(&model, body.position[1], |_| 2.0), -2.0 * phi.cos() * theta.sin());
    assert!(model.graph.is_zero(inertia[0][1]));
    let paths: Vec<&str> = model.parameters.iter().map(|parameter| &*parameter.path).collect();
    let moments = "::lagrange_runtime::__private::PrincipalMoments::principal_moments(&self.inertia)[2]";
    assert!(paths.contains(&moments), "{paths:?}");
}

#[test]
fn masses_and_inertias_are_given_for_all_or_for_each() {
    let model = lowered(
        quote!(coordinates = [a: [2]]),
        quote! {
            impl Links {
                #[body(mass = self.m[..], inertia = [2.0, self.i])]
                fn links(&self, q: &Coordinates) -> [(Vector2<f64>, f64); 2] {
                    [(Vector2::new(q.a[0], 0.0), q.a[1]), (Vector2::zeros(), q.a[0])]
                }
                #[force(at = links)]
                fn wind(&self, t: f64) -> [(Vector2<f64>, f64); 2] {
                    [(Vector2::new(t, 0.0), 1.0), (Vector2::y(), t)]
                }
                #[force(at = links[1])]
                fn push(&self) -> Vector2<f64> { Vector2::x() }
                #[force(on = a)]
                fn motors(&self) -> [f64; 2] { [1.0, 2.0] }
                #[force(on = a[1])]
                fn motor(&self) -> f64 { 1.0 }
                #[force]
                fn all(&self, v: &Velocities) -> Vector2<f64> { -self.c * v.as_vector() }
            }
        },
    )
    .unwrap();
    let paths: Vec<&str> = model.parameters.iter().map(|parameter| &*parameter.path).collect();
    assert_eq!(paths, ["self.m[0]", "self.m[1]", "self.i", "self.c"]);
    assert_eq!(model.bodies[1].name, "links[1]");
    // Two forces and two torques of the wind, one push, three generalized forces.
    assert_eq!(model.forces.len(), 8);
    let Action::Generalized(entries) = &model.forces[6].action else { panic!("a generalized force") };
    assert_eq!(entries[0].0, 1);
}

#[test]
fn a_chain_of_a_hundred_links_lowers_fast_enough_without_optimisation() {
    let start = std::time::Instant::now();
    a_chain_costs_the_same_for_every_link();
    assert!(start.elapsed().as_millis() < 1000, "{:?}", start.elapsed());
}

fn assert_close(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-12, "{value} instead of {expected}");
}

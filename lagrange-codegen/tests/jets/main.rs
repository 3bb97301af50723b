//! Recurrences of whole descriptions: how many convolutions they take, and the coefficients they give.

mod constrained;
mod expansion;

use lagrange_codegen::diagnostics::Diagnostics;
use lagrange_codegen::expr::Variable;
use lagrange_codegen::jets::{self, Jets};
use lagrange_codegen::mechanics::{self, Equations};
use lagrange_codegen::model::Model;
use lagrange_codegen::{lower, syntax};
use proc_macro2::TokenStream;
use quote::quote;

use expansion::{solved, unknowns};

fn derived(args: TokenStream, item: TokenStream) -> (Model, Equations, Option<Jets>) {
    let mut diagnostics = Diagnostics::new();
    let item = syntax::parse(args, item, "::lagrangian", &mut diagnostics).expect("the description is good");
    let mut model = lower::lower(&item, &mut diagnostics);
    let equations =
        mechanics::derive(&mut model, true, &|_| false, &mut diagnostics).expect("there is a motion");
    let (_, jets) = jets::derive(&mut model, &equations, &[]);
    (model, equations, jets)
}

fn chain(links: usize) -> (Model, Equations, Option<Jets>) {
    derived(
        quote!(coordinates = [theta: [#links]]),
        quote! {
            impl Chain {
                #[point(mass = 1.0)]
                fn joints(&self, q: &Coordinates) -> [Vector2<f64>; #links] {
                    let mut end = Vector2::zeros();
                    q.theta.map(|theta| {
                        end += Vector2::new(theta.sin(), -theta.cos());
                        end
                    })
                }
                #[potential]
                fn gravity(&self, q: &Coordinates) -> f64 {
                    self.joints(q).iter().map(|joint| 9.81 * joint.y).sum()
                }
            }
        },
    )
}

/// Accelerations from M a = f, the equations that the other methods use.
fn accelerations(model: &Model, equations: &Equations, at: &dyn Fn(Variable) -> f64) -> Vec<f64> {
    let count = equations.force.len();
    let mass = |i: usize, j: usize| model.graph.evaluate(&[equations.mass.rows()[i.max(j)][i.min(j)]], at)[0];
    let columns = (0..count).map(|j| (0..count).map(|i| mass(i, j)).collect()).collect();
    solved(columns, model.graph.evaluate(&equations.force, at))
}

/// The first coefficients of the velocities are the accelerations. The second ones are the rates of the
/// accelerations along the motion, divided by two.
fn check((model, equations, jets): (Model, Equations, Option<Jets>)) {
    let jets = jets.expect("the system is smooth");
    let count = equations.force.len();
    let q = |i: u32| 0.3 + 0.4 * f64::from(i);
    let v = |i: u32| -0.4 + 0.5 * f64::from(i);
    let start = |variable: Variable| match variable {
        Variable::Coordinate(i) => q(i),
        Variable::Velocity(i) => v(i),
        Variable::Time => 0.9,
        _ => 1.3,
    };
    let series = unknowns(&jets, count, 2, &start);
    let a = accelerations(&model, &equations, &start);
    let moved = |h: f64| {
        accelerations(&model, &equations, &|variable: Variable| match variable {
            Variable::Coordinate(i) => q(i) + h * v(i) + 0.5 * h * h * a[i as usize],
            Variable::Velocity(i) => v(i) + h * a[i as usize],
            Variable::Time => 0.9 + h,
            other => start(other),
        })
    };
    let (ahead, behind) = (moved(1e-5), moved(-1e-5));
    for i in 0..count {
        let close = |found: f64, expected: f64, tolerance: f64| {
            assert!(
                (found - expected).abs() <= tolerance * expected.abs().max(1.0),
                "{found} is not {expected}"
            );
        };
        close(series[0][i], a[i], 1e-12);
        close(series[1][i], (ahead[i] - behind[i]) / 4e-5, 1e-6);
    }
}

#[test]
fn convolutions_are_as_few_as_by_hand() {
    let convolutions =
        |(_, _, jets): (Model, Equations, Option<Jets>)| jets.expect("it is smooth").convolutions.len();
    assert_eq!(convolutions(chain(2)), 10);
    // Four a link: two flows, two of the momentum. What its rate shares with it has cancelled.
    assert_eq!(convolutions(chain(5)), 20);
    let kepler = derived(
        quote!(coordinates = [x, y]),
        quote! {
            impl Kepler {
                #[point(mass = 1.0)]
                fn planet(&self, q: &Coordinates) -> Vector2<f64> { Vector2::new(q.x, q.y) }
                #[potential]
                fn gravity(&self, q: &Coordinates) -> f64 { -1.0 / self.planet(q).norm() }
            }
        },
    );
    assert_eq!(convolutions(kepler), 6);
}

#[test]
fn coefficients_of_chains_are_those_of_the_equations_of_motion() {
    check(chain(1));
    check(chain(2));
    check(chain(4));
}

#[test]
fn coefficients_of_every_kind_of_function() {
    check(derived(
        quote!(coordinates = [x, y]),
        quote! {
            impl Zoo {
                #[kinetic]
                fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
                    0.5 * ((1.0 + q.x.powi(2)) * v.x.powi(2) + (2.0 + q.y.sin()) * v.y.powi(2)) + 0.3 * q.x * v.x * v.y
                }
                #[potential]
                fn potential(&self, q: &Coordinates, t: f64) -> f64 {
                    (q.x * q.y).exp() + q.y.tanh() + (1.0 + q.x.powi(2)).ln() + (2.0 * t).sin() * q.x
                        + (1.0 + q.x * q.x + q.y * q.y).sqrt() + q.y.atan2(1.0 + q.x) + (2.0 + q.x).powf(0.3)
                        + (0.2 * q.x).asin() + q.x.tan() + q.y.cosh() + (1.5 + q.y).cbrt() + 1.0 / (3.0 + q.x)
                }
                #[dissipation]
                fn dissipation(&self, q: &Coordinates, v: &Velocities) -> f64 {
                    0.1 * (1.0 + q.y.powi(2)) * v.x.powi(2) + 0.05 * v.y.cosh()
                }
            }
        },
    ));
}

#[test]
fn a_lagrangian_need_not_be_quadratic_in_the_velocities() {
    check(derived(
        quote!(coordinates = [x, y]),
        quote! {
            impl Relativistic {
                #[lagrangian]
                fn lagrangian(&self, q: &Coordinates, v: &Velocities) -> f64 {
                    -4.0 * (1.0 - (v.x.powi(2) + v.y.powi(2)) / 4.0).sqrt() + 0.7 * q.x * v.y - q.x.powi(2) * q.y
                }
            }
        },
    ));
}

#[test]
fn kinks_have_no_series() {
    let smooth = |potential: TokenStream, force: TokenStream| {
        let item = quote! {
            impl Mass {
                #[kinetic]
                fn kinetic(&self, v: &Velocities) -> f64 { 0.5 * (v.x.powi(2) + v.y.powi(2)) }
                #[potential]
                fn potential(&self, q: &Coordinates) -> f64 { #potential }
                #[force]
                fn force(&self, v: &Velocities) -> [f64; 2] { #force }
            }
        };
        derived(quote!(coordinates = [x, y]), item).2.is_some()
    };
    assert!(smooth(quote!(q.x.powi(2) * q.y), quote!([-v.x, -v.y])));
    assert!(!smooth(quote!(q.x.abs() * q.y), quote!([-v.x, -v.y])));
    assert!(!smooth(quote!(q.x * q.y), quote!([-v.x.signum(), -v.y])));
    // Drag by the square of the speed, from rest.
    assert!(!smooth(quote!(q.x * q.y), quote!([-v.x * (v.x * v.x + v.y * v.y).sqrt(), -v.y])));
    assert!(smooth(quote!(q.x * q.y), quote!([-v.x * (1.0 + v.x * v.x + v.y * v.y).sqrt(), -v.y])));
}

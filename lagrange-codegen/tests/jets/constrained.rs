//! Recurrences of descriptions with constraints: every coefficient of velocities and multipliers against the
//! equations M a − Aᵀλ = f, A a = γ along the series itself.
//!
//! The states violate the constraints: w = df/dt or g keeps its value, or decays at Baumgarte's rate. No
//! constraint here has a denominator. Series leave denominators out, which gives the same motion only where w
//! is zero.

use lagrange_codegen::diagnostics::Diagnostics;
use lagrange_codegen::expr::{NodeId, Variable};
use lagrange_codegen::mechanics::Equations;
use lagrange_codegen::model::Model;
use lagrange_codegen::structure::{Facts, Saddle, Solution};
use lagrange_codegen::{jets, lower, mechanics, syntax};
use proc_macro2::TokenStream;
use quote::quote;

use crate::expansion::{solved, unknowns};

/// Orders of the series.
const ORDERS: usize = 5;

/// The distance of the points of an interpolating polynomial, and their number on each side.
const STEP: f64 = 0.003;
const SIDE: i32 = 4;

fn derived(args: TokenStream, item: TokenStream) -> (Model, Equations) {
    let mut diagnostics = Diagnostics::new();
    let item = syntax::parse(args, item, "::lagrangian", &mut diagnostics).expect("the description is good");
    let mut model = lower::lower(&item, &mut diagnostics);
    let equations = mechanics::derive(&mut model, true, &|_| false, &mut diagnostics);
    let messages: Vec<_> = diagnostics.messages().collect();
    (model, equations.unwrap_or_else(|| panic!("{messages:?}")))
}

/// The method that generated code solves with.
fn method(model: &mut Model, equations: &Equations) -> Saddle {
    let facts = Facts::of(model, equations);
    let told = (equations, &facts);
    let solution =
        Solution::plan(model, told, told, &mut Diagnostics::new()).expect("the mass matrix is formed");
    solution.saddle.expect("there are constraints")
}

/// (a, λ) from the equations.
fn solution(model: &Model, equations: &Equations, at: &dyn Fn(Variable) -> f64) -> Vec<f64> {
    let conditions = &equations.conditions;
    let (count, held) = (equations.force.len(), conditions.count());
    let values = |nodes: &[NodeId]| model.graph.evaluate(nodes, at);
    let gradients: Vec<Vec<f64>> = conditions.jacobian.iter().map(|row| values(row)).collect();
    let mut columns: Vec<Vec<f64>> = (0..count)
        .map(|j| {
            let mass: Vec<NodeId> = (0..count).map(|i| equations.mass.rows()[i.max(j)][i.min(j)]).collect();
            values(&mass).into_iter().chain(gradients.iter().map(|row| row[j])).collect()
        })
        .collect();
    columns.extend(gradients.iter().map(|row| row.iter().map(|a| -a).chain(vec![0.0; held]).collect()));
    solved(columns, [values(&equations.force), values(&conditions.gamma)].concat())
}

fn start(variable: Variable) -> f64 {
    match variable {
        Variable::Coordinate(i) => 0.6 + 0.3 * f64::from(i),
        Variable::Velocity(i) => -0.4 + 0.5 * f64::from(i),
        Variable::Time => 0.9,
        _ => 1.3,
    }
}

/// Coefficients of the polynomial through values at multiples of [`STEP`].
fn coefficients(values: impl Fn(f64) -> Vec<f64>) -> Vec<Vec<f64>> {
    // In units of the step, for the condition.
    let points: Vec<f64> = (-SIDE..=SIDE).map(f64::from).collect();
    let columns: Vec<Vec<f64>> =
        (0..points.len() as i32).map(|k| points.iter().map(|x| x.powi(k)).collect()).collect();
    let samples: Vec<Vec<f64>> = points.iter().map(|x| values(x * STEP)).collect();
    (0..samples[0].len())
        .map(|i| {
            let right = samples.iter().map(|sample| sample[i]).collect();
            let scaled = solved(columns.clone(), right);
            scaled.iter().zip(0..).map(|(c, k)| c / STEP.powi(k)).collect()
        })
        .collect()
}

/// Checks the recurrences of a description. An error says what is wrong.
fn check(model: &mut Model, equations: &Equations, recurrences: &Equations) -> Result<(), String> {
    let (count, held) = (equations.force.len(), equations.conditions.count());
    let jets = jets::derive(model, recurrences, &[]).1.ok_or("the system is not smooth")?;
    let series = unknowns(&jets, count, ORDERS, &start);
    // The motion by its series.
    let velocity = |i: usize, h: f64| {
        series.iter().rev().fold(0.0, |sum, now| h * (sum + now[i])) + start(Variable::Velocity(i as u32))
    };
    let position = |i: usize, h: f64| {
        let terms = series.iter().enumerate().rev();
        let moved = terms.fold(0.0, |sum, (k, now)| h * (sum + now[i] / (k as f64 + 2.0)));
        start(Variable::Coordinate(i as u32)) + h * (start(Variable::Velocity(i as u32)) + moved)
    };
    let at = |h: f64| {
        move |variable: Variable| match variable {
            Variable::Coordinate(i) => position(i as usize, h),
            Variable::Velocity(i) => velocity(i as usize, h),
            Variable::Time => start(Variable::Time) + h,
            other => start(other),
        }
    };
    let expected = coefficients(|h| solution(model, equations, &at(h)));
    let close = |what: &str, k: usize, found: f64, expected: f64| {
        let tolerance = [1e-12, 1e-10, 1e-8, 1e-6, 1e-4][k];
        match (found - expected).abs() <= tolerance * expected.abs().max(1.0) {
            true => Ok(()),
            false => Err(format!("{what}[{k}] = {found}, not {expected}")),
        }
    };
    for k in 0..ORDERS {
        for i in 0..count {
            close("a", k, (k + 1) as f64 * series[k][i], expected[i][k])?;
        }
        for c in count..count + held {
            close("λ", k, series[k][c], expected[c][k])?;
        }
    }
    let conditions = &equations.conditions;
    let rates = coefficients(|h| model.graph.evaluate(&conditions.rates, at(h)));
    let relaxation = conditions.relaxation.clone().unwrap_or_default();
    let changes = coefficients(|h| model.graph.evaluate(&relaxation, at(h)));
    for (c, rates) in rates.iter().enumerate() {
        for k in 1..ORDERS {
            close("w", k, k as f64 * rates[k], changes.get(c).map_or(0.0, |changes| changes[k - 1]))?;
        }
    }
    Ok(())
}

/// Checks a description, and that each of several faults in the equations of its recurrences is noticed.
#[track_caller]
fn holds(wanted: Saddle, args: TokenStream, item: TokenStream) {
    let (mut model, equations) = derived(args, item);
    assert_eq!(method(&mut model, &equations), wanted);
    if let Err(error) = check(&mut model, &equations, &equations) {
        panic!("{error}");
    }
    for (name, fault) in faults(&mut model, &equations) {
        assert!(check(&mut model, &equations, &fault).is_err(), "{name} is not noticed");
    }
}

fn faults(model: &mut Model, equations: &Equations) -> Vec<(String, Equations)> {
    let mut faults = Vec::new();
    let mut plant = |name: String, change: &dyn Fn(&mut Equations)| {
        let mut fault = equations.clone();
        change(&mut fault);
        faults.push((name, fault));
    };
    let graph = &mut model.graph;
    let conditions = &equations.conditions;
    for i in 0..conditions.reactions.len() {
        let wrong = graph.neg(conditions.reactions[i]);
        if wrong != conditions.reactions[i] {
            plant(format!("the sign of reaction {i}"), &|fault| fault.conditions.reactions[i] = wrong);
        }
    }
    let (time, force) = (graph.variable(Variable::Time), equations.momentum_rates[0]);
    let wrong = graph.add(force, time);
    plant("a force too many".to_owned(), &|fault| fault.momentum_rates[0] = wrong);
    for c in 0..conditions.count() {
        let wrong = graph.add(conditions.rates[c], time);
        plant(format!("constraint {c}, too fast"), &|fault| fault.conditions.rates[c] = wrong);
        if let Some(relaxation) = &conditions.relaxation {
            let wrong = graph.neg(relaxation[c]);
            plant(format!("the sign of relaxation {c}"), &|fault| {
                fault.conditions.relaxation.iter_mut().for_each(|all| all[c] = wrong);
            });
        }
    }
    faults
}

/// A particle on a moving ellipse, with a blade.
fn particle() -> TokenStream {
    quote! {
        impl Particle {
            #[point(mass = self.mass)]
            fn bead(&self, q: &Coordinates) -> Vector3<f64> { Vector3::new(q.x, q.y, q.z) }
            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 { 9.81 * q.z + 0.5 * (q.x * q.y).sin() }
            #[holonomic]
            fn ellipse(&self, q: &Coordinates, t: f64) -> f64 {
                q.x.powi(2) + 2.0 * q.y.powi(2) + 0.3 * (2.0 * t).sin() * q.z - 1.0
            }
            #[nonholonomic]
            fn blade(&self, q: &Coordinates, v: &Velocities) -> f64 {
                v.x * q.z.sin() - v.y * (1.0 + q.x.powi(2)) + 0.2 * v.z
            }
        }
    }
}

#[test]
fn constraints_of_particles() {
    holds(Saddle::Diagonal, quote!(coordinates = [x, y, z]), particle());
}

#[test]
fn constraints_stabilised_by_their_rates() {
    holds(Saddle::Diagonal, quote!(coordinates = [x, y, z], baumgarte = self.rate), particle());
}

/// A double pendulum on a cart whose end is guided.
fn guided() -> TokenStream {
    quote! {
        impl Guided {
            #[point(mass = 2.0)]
            fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
                let elbow = Vector2::new(q.x + q.a.sin(), -q.a.cos());
                [elbow, elbow + Vector2::new(q.b.sin(), -q.b.cos())]
            }
            #[kinetic]
            fn cart(&self, v: &Velocities) -> f64 { 1.5 * v.x.powi(2) }
            #[potential]
            fn gravity(&self, q: &Coordinates) -> f64 { self.joints(q).iter().map(|joint| 19.62 * joint.y).sum() }
            #[dissipation]
            fn drag(&self, v: &Velocities) -> f64 { 0.1 * v.a.powi(2) + 0.2 * (v.a - v.b).powi(2) }
            #[holonomic]
            fn guide(&self, q: &Coordinates, t: f64) -> [f64; 2] {
                let end = self.joints(q)[1];
                [end.y + 1.2 + 0.1 * t.cos(), (end + Vector2::new(3.0, q.x)).norm_squared() - 4.0]
            }
        }
    }
}

#[test]
fn constraints_with_a_full_mass_matrix() {
    holds(Saddle::Whole { definite: true }, quote!(coordinates = [x, a, b]), guided());
}

#[test]
fn stabilised_constraints_with_a_full_mass_matrix() {
    holds(Saddle::Whole { definite: true }, quote!(coordinates = [x, a, b], baumgarte = 2.5), guided());
}

#[test]
fn constraints_of_any_form_in_the_velocities_and_of_a_whole_lagrangian() {
    holds(
        Saddle::Whole { definite: false },
        quote!(coordinates = [x, y, z]),
        quote! {
            impl Charge {
                #[lagrangian]
                fn lagrangian(&self, q: &Coordinates, v: &Velocities) -> f64 {
                    -4.0 * (1.0 - (v.x.powi(2) + v.y.powi(2) + v.z.powi(2)) / 4.0).sqrt() + 0.7 * q.x * v.y - q.x.powi(2) * q.y
                }
                #[nonholonomic(chetaev)]
                fn speed(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
                    v.x.powi(2) + v.y.powi(2) + v.z * q.y - 0.4 * t.sin()
                }
            }
        },
    );
}

#[test]
fn coordinates_without_mass() {
    holds(
        Saddle::Whole { definite: true },
        quote!(coordinates = [x, y, angle]),
        quote! {
            impl Tied {
                #[point(mass = 1.5)]
                fn bead(&self, q: &Coordinates) -> Vector2<f64> { Vector2::new(q.x, q.y) }
                #[potential]
                fn spring(&self, q: &Coordinates) -> f64 { q.angle.powi(2) + q.y }
                #[holonomic]
                fn tie(&self, q: &Coordinates) -> f64 { q.angle + 0.2 * q.angle.powi(3) - q.x * q.y }
            }
        },
    );
}

//! Recurrences of whole descriptions: how many convolutions they take, and the coefficients they give.

use lagrange_codegen::diagnostics::Diagnostics;
use lagrange_codegen::expr::Variable;
use lagrange_codegen::jets::{self, Jets, Relation, Value};
use lagrange_codegen::mechanics::{self, Equations};
use lagrange_codegen::model::Model;
use lagrange_codegen::schedule::{Instruction, Slot};
use lagrange_codegen::{lower, syntax};
use proc_macro2::TokenStream;
use quote::quote;

fn derived(args: TokenStream, item: TokenStream) -> (Model, Equations, Option<Jets>) {
    let mut diagnostics = Diagnostics::new();
    let item = syntax::parse(args, item, "::lagrangian", &mut diagnostics).expect("the description is good");
    let mut model = lower::lower(&item, &mut diagnostics);
    let equations = mechanics::derive(&mut model, &|_| false, &mut diagnostics).expect("there is a motion");
    let jets = jets::derive(&mut model, &equations);
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

/// Coefficients by the definition: every order evaluated for N + 1 trial velocities and solved.
struct Expansion<'a> {
    jets: &'a Jets,
    /// By order, then by slot.
    series: Vec<Vec<f64>>,
    start: &'a dyn Fn(Variable) -> f64,
}

impl Expansion<'_> {
    fn convolution(&self, a: Slot, b: Slot, order: usize, now: &[f64]) -> f64 {
        let of =
            |slot: Slot, k: usize| if k == order { now[slot.index()] } else { self.series[k][slot.index()] };
        (0..=order).map(|j| of(a, j) * of(b, order - j)).sum()
    }

    /// All coefficients of an order for given coefficients of the velocities.
    fn order(&self, order: usize, velocities: &[f64]) -> Vec<f64> {
        let (program, k) = (&self.jets.program, order as f64);
        let mut now = vec![0.0; program.len()];
        for &slot in &self.jets.order {
            let held = if order == 0 { 1.0 } else { 0.0 };
            now[slot.index()] = match (self.jets.auxiliary(slot), program.instruction(slot)) {
                (Some(series), _) if order == 0 => match series.value {
                    Value::Unary(function, x) => function.evaluate(now[x.index()]),
                    Value::Binary(function, x, y) => function.evaluate(now[x.index()], now[y.index()]),
                    Value::Power(x, exponent) => now[x.index()].powf(0.5 * f64::from(exponent.0)),
                    Value::Same(x) => now[x.index()],
                },
                (Some(series), _) => match &series.relation {
                    Relation::Flow(rate) => self.series[order - 1][rate.index()] / k,
                    Relation::Same(x) => now[x.index()],
                    Relation::Chain(terms) => {
                        let term = |&(slope, x): &(Slot, Slot)| -> f64 {
                            let of = |j: usize| {
                                if j == order { now[x.index()] } else { self.series[j][x.index()] }
                            };
                            (1..=order)
                                .map(|j| j as f64 * of(j) * self.series[order - j][slope.index()])
                                .sum()
                        };
                        terms.iter().map(term).sum::<f64>() / k
                    }
                    Relation::Power(x, exponent) => {
                        let (e, y) = (exponent.value(), series.slot.index());
                        let of =
                            |j: usize| if j == order { now[x.index()] } else { self.series[j][x.index()] };
                        let term =
                            |j: usize| (e * (k - j as f64) - j as f64) * self.series[j][y] * of(order - j);
                        (0..order).map(term).sum::<f64>() / (k * self.series[0][x.index()])
                    }
                },
                (None, Instruction::Variable(Variable::Velocity(i))) => velocities[i as usize],
                (None, Instruction::Variable(Variable::Coordinate(i))) if order > 0 => {
                    self.velocity(order - 1, i) / k
                }
                (None, Instruction::Variable(Variable::Time)) if order > 0 => {
                    if order == 1 {
                        1.0
                    } else {
                        0.0
                    }
                }
                (None, Instruction::Variable(variable)) => held * (self.start)(variable),
                (None, Instruction::Literal(number)) => held * number.value(),
                (None, Instruction::Add(a, b)) => now[a.index()] + now[b.index()],
                (None, Instruction::Sub(a, b)) => now[a.index()] - now[b.index()],
                (None, Instruction::Neg(a)) => -now[a.index()],
                (None, Instruction::Mul(a, b)) => self.convolution(a, b, order, &now),
                (None, other) => unreachable!("{other:?}"),
            };
        }
        now
    }

    fn velocity(&self, order: usize, i: u32) -> f64 {
        let program = &self.jets.program;
        let slot = self
            .jets
            .order
            .iter()
            .find(|&&slot| program.instruction(slot) == Instruction::Variable(Variable::Velocity(i)));
        self.series[order][slot.expect("every velocity is read").index()]
    }
}

/// Coefficients of the velocities of the orders 1 to `orders`.
fn velocities(jets: &Jets, count: usize, orders: usize, start: &dyn Fn(Variable) -> f64) -> Vec<Vec<f64>> {
    let mut expansion = Expansion { jets, series: Vec::new(), start };
    let first: Vec<f64> = (0..count as u32).map(|i| start(Variable::Velocity(i))).collect();
    expansion.series.push(expansion.order(0, &first));
    let mut found = Vec::new();
    for order in 1..=orders {
        let momenta = |trial: &[f64]| -> Vec<f64> {
            let now = expansion.order(order, trial);
            jets.momenta.iter().map(|slot| now[slot.index()]).collect()
        };
        let known = momenta(&vec![0.0; count]);
        let columns: Vec<Vec<f64>> = (0..count)
            .map(|i| {
                let mut unit = vec![0.0; count];
                unit[i] = 1.0;
                momenta(&unit).iter().zip(&known).map(|(a, b)| a - b).collect()
            })
            .collect();
        let last = &expansion.series[order - 1];
        let right: Vec<f64> =
            (0..count).map(|i| last[jets.rates[i].index()] / order as f64 - known[i]).collect();
        let solution = solved(columns, right);
        let now = expansion.order(order, &solution);
        expansion.series.push(now);
        found.push(solution);
    }
    found
}

/// Σ columns\[j] x\[j] = right, by elimination.
fn solved(columns: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    let mut a: Vec<Vec<f64>> = (0..count).map(|i| (0..count).map(|j| columns[j][i]).collect()).collect();
    for k in 0..count {
        for i in k + 1..count {
            let factor = a[i][k] / a[k][k];
            let pivot = a[k].clone();
            a[i].iter_mut().zip(&pivot).skip(k).for_each(|(entry, pivot)| *entry -= factor * pivot);
            right[i] -= factor * right[k];
        }
    }
    for i in (0..count).rev() {
        let known: f64 = (i + 1..count).map(|j| a[i][j] * right[j]).sum();
        right[i] = (right[i] - known) / a[i][i];
    }
    right
}

/// Accelerations from M a = f, the equations that the other methods use.
fn accelerations(model: &Model, equations: &Equations, at: &dyn Fn(Variable) -> f64) -> Vec<f64> {
    let count = equations.force.len();
    let mass = |i: usize, j: usize| model.graph.evaluate(&[equations.mass[i.max(j)][i.min(j)]], at)[0];
    let columns = (0..count).map(|j| (0..count).map(|i| mass(i, j)).collect()).collect();
    solved(columns, model.graph.evaluate(&equations.force, at))
}

/// The first coefficients are the accelerations, the second half of their rate along the motion.
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
    let series = velocities(&jets, count, 2, &start);
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
    let lanes = |(_, _, jets): (Model, Equations, Option<Jets>)| jets.expect("it is smooth").lanes.len();
    assert_eq!(lanes(chain(2)), 10);
    // Six a link: two flows, two of the momentum, two of its rate.
    assert_eq!(lanes(chain(5)), 30);
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
    assert_eq!(lanes(kepler), 6);
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

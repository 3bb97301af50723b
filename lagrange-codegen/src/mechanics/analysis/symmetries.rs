//! Integrals of the motion by Noether's theorem, found by search.
//!
//! A shift q → q + ε ξ with ξ = S q + s, or with a turn of an orientation, takes I = p·ξ along: dI/dt = f·ξ +
//! p·ξ′ with f = ∂L/∂q + Q − ∂D/∂v, plus λᵀ A ξ where there are constraints. Both must vanish for all q, v,
//! t, u and all values of the parameters (Arnold, *Mathematical Methods of Classical Mechanics*, section 20).
//! They are linear in S and s: random samples give a linear system, its null space the candidates, and each
//! candidate is then confirmed at points of its own, near and far, to within the rounding errors of the
//! evaluation: a small force is a force. A kink far from all samples would look like no force at all. So each
//! sample takes one side of every kink at random, whatever the arguments are. Integrals that are not linear
//! in the momenta, or whose ξ depends on parameters, are not found.

use super::nullspace::{Noise, null_space};
use super::turns::{Shift, Turn};
use crate::expr::{Graph, NodeId, Rounded, Variable};
use crate::mechanics::Equations;
use crate::model::{Model, orientation};
use crate::number::Number;

/// The most unknowns of a search. More would take too long to eliminate in an unoptimised macro.
const MOST: usize = 280;

/// Samples beyond the number of unknowns.
const SPARE: usize = 16;

/// Points at which a candidate is confirmed.
const CONFIRMED: usize = 40;

/// The largest dI/dt that counts as zero, in units of the first-order bound of its rounding errors.
const ROUNDINGS: f64 = 8.0;

/// Points of confirmation have coordinates up to ten to this power.
const FAR: f64 = 6.0;

/// Largest denominator of an entry of S and s.
const DENOMINATOR: i128 = 12;

/// ξ = S q + s, and turns of orientations.
#[derive(Clone, Debug, Default)]
pub struct Generator {
    /// Entries of S: `(row, column, value)`.
    pub linear: Vec<(usize, usize, Number)>,
    /// Entries of s.
    pub shift: Vec<(usize, Number)>,
    /// Angles.
    pub turns: Vec<(Turn, Number)>,
}

/// A conserved quantity.
#[derive(Clone, Debug)]
pub struct Integral {
    /// The symmetry that it belongs to.
    pub generator: Generator,
    /// p·ξ.
    pub value: NodeId,
}

/// One degree of freedom of the search.
#[derive(Clone, Copy, Debug)]
enum Unknown {
    /// S_ij.
    Entry(usize, usize),
    /// A rotation: S_ij = −1 and S_ji = 1.
    Plane(usize, usize),
    /// s_i.
    Shift(usize),
    /// A turn of an orientation.
    Turn(Turn),
}

impl Unknown {
    /// The first coordinate that it moves.
    fn row(self) -> usize {
        match self {
            Unknown::Entry(i, _) | Unknown::Plane(i, _) | Unknown::Shift(i) => i,
            Unknown::Turn(turn) => turn.first,
        }
    }

    /// The generator of which it is the coefficient.
    fn generator(self) -> Generator {
        let (one, mut generator) = (Number::ONE, Generator::default());
        match self {
            Unknown::Entry(i, j) => generator.linear.push((i, j, one)),
            Unknown::Plane(i, j) => generator.linear.extend([(i, j, -one), (j, i, one)]),
            Unknown::Shift(i) => generator.shift.push((i, one)),
            Unknown::Turn(turn) => generator.turns.push((turn, one)),
        }
        generator
    }
}

/// A basis of the integrals p·ξ that are linear in the unknowns of the search.
pub fn integrals(model: &mut Model, equations: &Equations) -> Vec<Integral> {
    let unknowns = unknowns(model, equations);
    let generators: Vec<Generator> = unknowns.iter().map(|unknown| unknown.generator()).collect();
    let mut noise = Noise(0);
    let near = |attempt: usize| Sample::draw(model, equations, &mut noise, attempt, 1.0);
    let Some(samples) = samples(unknowns.len() + SPARE, near) else {
        return Vec::new();
    };
    // A force on a coordinate is weighed by the coordinate's momenta, since masses may differ by many orders.
    let weights: Vec<f64> = (0..equations.momenta.len())
        .map(|i| {
            let largest =
                samples.iter().fold(0.0, |largest: f64, sample| largest.max(sample.momenta[i].value.abs()));
            if largest > 0.0 { largest.recip() } else { 1.0 }
        })
        .collect();
    let scales: Vec<f64> = unknowns.iter().map(|unknown| weights[unknown.row()]).collect();
    let rows = samples
        .iter()
        .flat_map(|sample| sample.conditions(&generators))
        .map(|row| row.iter().zip(&scales).map(|(entry, scale)| entry * scale).collect());
    let candidates: Vec<Generator> = null_space(rows.collect(), unknowns.len())
        .iter()
        .filter_map(|vector| {
            let free = vector.iter().rposition(|&entry| entry == 1.0)?;
            let unscaled: Vec<f64> =
                vector.iter().zip(&scales).map(|(entry, scale)| entry * scale / scales[free]).collect();
            Generator::rational(&unscaled, &generators)
        })
        .collect();
    let far = |attempt: usize| {
        let scale = if attempt % 4 < 2 { 1.0 } else { 10_f64.powf(noise.between(0.0, FAR)) };
        Sample::draw(model, equations, &mut noise, attempt, scale)
    };
    let Some(others) = self::samples(CONFIRMED, far) else { return Vec::new() };
    let is_confirmed = |candidate: &Generator| others.iter().all(|sample| sample.confirms(candidate));
    let mut confirmed: Vec<Generator> = candidates.into_iter().filter(is_confirmed).collect();
    // Translations come first, in the order of the coordinates.
    confirmed.sort_by_key(|generator| !generator.linear.is_empty() || !generator.turns.is_empty());
    confirmed
        .into_iter()
        .map(|generator| Integral {
            value: generator.momentum(&mut model.graph, &equations.momenta),
            generator,
        })
        .collect()
}

/// The unknowns: rotations if M is constant and diagonal, else all of S, or none of these if they are too
/// many; and always translations and turns of orientations.
fn unknowns(model: &Model, equations: &Equations) -> Vec<Unknown> {
    let graph = &model.graph;
    let mass = equations.mass.rows();
    let count = mass.len();
    // Linear functions of an orientation's numbers have no meaning.
    let plain: Vec<usize> = (0..count).filter(|&i| !orientation::holds(&model.orientations, i)).collect();
    let shifts = plain.iter().copied().map(Unknown::Shift);
    let turns = model.orientations.iter().flat_map(|&first| {
        let all = [false, true].into_iter().flat_map(|in_body| (0..3).map(move |axis| (axis, in_body)));
        all.map(move |(axis, in_body)| Unknown::Turn(Turn { first, axis, in_body }))
    });
    let constant = mass.iter().flatten().all(|&entry| graph.dependence(entry).is_fixed());
    let diagonal =
        (0..count).all(|i| (0..i).all(|j| graph.is_zero(mass[i][j])) && !graph.is_zero(mass[i][i]));
    let mut searched: Vec<Unknown> = if constant && diagonal {
        // M S must be skew.
        let pairs = (0..count).flat_map(|j| (0..j).map(move |i| (i, j)));
        let equal = pairs.filter(|&(i, j)| mass[i][i] == mass[j][j]);
        let mut planes: Vec<(usize, usize)> = equal.collect();
        if planes.len() + count > MOST {
            let quantity = |i: usize| &model.coordinates[i];
            planes.retain(|&(i, j)| {
                quantity(i).name != quantity(j).name && quantity(i).index == quantity(j).index
            });
        }
        planes.into_iter().map(|(i, j)| Unknown::Plane(i, j)).collect()
    } else {
        plain.iter().flat_map(|&i| plain.iter().map(move |&j| Unknown::Entry(i, j))).collect()
    };
    if searched.len() + count > MOST {
        searched.clear();
    }
    searched.extend(shifts);
    searched.extend(turns);
    searched
}

/// The equations at one point.
struct Sample {
    q: Vec<f64>,
    v: Vec<f64>,
    momenta: Vec<Rounded>,
    rates: Vec<Rounded>,
    jacobian: Vec<Vec<Rounded>>,
}

impl Sample {
    fn draw(model: &Model, equations: &Equations, noise: &mut Noise, attempt: usize, scale: f64) -> Sample {
        let count = equations.momenta.len();
        // Roots and logarithms may need positive coordinates.
        let low = if attempt.is_multiple_of(2) { -1.5 } else { 0.1 };
        let mut draw = |count: usize, low: f64, high: f64| -> Vec<f64> {
            (0..count).map(|_| noise.between(low, high)).collect()
        };
        let (q, v) = (draw(count, scale * low, scale * 1.5), draw(count, -1.0, 1.0));
        let parameters = draw(model.parameters.len(), 0.5, 2.0);
        let inputs = draw(model.inputs.len(), -1.0, 1.0);
        let time = draw(1, -scale, scale)[0];
        let sides = draw(1, 1.0, 2.0)[0];
        let side =
            |argument: NodeId| Noise(sides.to_bits() ^ argument.index() as u64).between(-1.0, 1.0) > 0.0;
        let value = |variable: Variable| match variable {
            Variable::Coordinate(i) => q[i as usize],
            Variable::Velocity(i) => v[i as usize],
            Variable::Parameter(i) => parameters[i as usize],
            Variable::Input(i) => inputs[i as usize],
            Variable::Time => time,
            Variable::Acceleration(_)
            | Variable::Auxiliary(_)
            | Variable::Entry(_)
            | Variable::Multiplier(_)
            | Variable::Position(_) => f64::NAN,
        };
        let conditions = &equations.conditions;
        let mut roots = equations.momenta.clone();
        roots.extend(&equations.momentum_rates);
        roots.extend(conditions.jacobian.iter().flatten());
        let mut values = model.graph.evaluate_on_sides(&roots, value, side).into_iter();
        let mut take = || values.by_ref().take(count).collect::<Vec<_>>();
        let (momenta, rates) = (take(), take());
        let jacobian = (0..conditions.count()).map(|_| take()).collect();
        Sample { q, v, momenta, rates, jacobian }
    }

    fn is_finite(&self) -> bool {
        let numbers = self.momenta.iter().chain(&self.rates).chain(self.jacobian.iter().flatten());
        numbers.into_iter().all(|number| number.value.is_finite() && number.error.is_finite())
    }

    /// Rows of the linear system: dI/dt, then A ξ.
    fn conditions(&self, generators: &[Generator]) -> Vec<Vec<f64>> {
        let row = |force: &[Rounded], momenta: Option<&[Rounded]>| {
            let change = |&Shift { row, value, rate, .. }: &Shift| {
                force[row].value * value + momenta.map_or(0.0, |momenta| momenta[row].value * rate)
            };
            generators.iter().map(|generator| generator.field(self).iter().map(change).sum()).collect()
        };
        let mut rows = vec![row(&self.rates, Some(&self.momenta))];
        rows.extend(self.jacobian.iter().map(|gradient| row(gradient, None)));
        rows
    }

    /// Whether dI/dt and A ξ vanish up to rounding.
    fn confirms(&self, generator: &Generator) -> bool {
        let vanishes = |force: &[Rounded], momenta: Option<&[Rounded]>| {
            let (mut sum, mut error) = (0.0, 0.0);
            let mut add = |factor: f64, size: f64, number: Rounded| {
                sum += factor * number.value;
                error += f64::EPSILON * size * number.value.abs() + factor.abs() * number.error;
            };
            for Shift { row, value, rate, sizes } in generator.field(self) {
                add(value, sizes[0], force[row]);
                if let Some(momenta) = momenta {
                    add(rate, sizes[1], momenta[row]);
                }
            }
            sum.abs() <= ROUNDINGS * error
        };
        vanishes(&self.rates, Some(&self.momenta))
            && self.jacobian.iter().all(|gradient| vanishes(gradient, None))
    }
}

/// `wanted` points at which every value is finite; `None` if fewer than one in four draws gives such a point.
fn samples(wanted: usize, draw: impl FnMut(usize) -> Sample) -> Option<Vec<Sample>> {
    let samples: Vec<Sample> = (0..4 * wanted).map(draw).filter(Sample::is_finite).take(wanted).collect();
    (samples.len() == wanted).then_some(samples)
}

impl Generator {
    /// A numerical vector in fractions of small denominators; `None` if an entry is close to none.
    fn rational(vector: &[f64], generators: &[Generator]) -> Option<Generator> {
        let mut generator = Generator::default();
        for (&entry, part) in vector.iter().zip(generators) {
            let value = (1..=DENOMINATOR).find_map(|denominator| {
                let scaled = entry * denominator as f64;
                let near = scaled.abs() < 1e6 && (scaled - scaled.round()).abs() < 1e-6;
                near.then(|| Number::ratio(scaled.round() as i128, denominator)).flatten()
            })?;
            if !value.is_zero() {
                generator.linear.extend(part.linear.iter().map(|&(i, j, sign)| (i, j, sign * value)));
                generator.shift.extend(part.shift.iter().map(|&(i, one)| (i, one * value)));
                generator.turns.extend(part.turns.iter().map(|&(turn, one)| (turn, one * value)));
            }
        }
        Some(generator)
    }

    /// ξ and its rate.
    fn field(&self, sample: &Sample) -> Vec<Shift> {
        let mut field = Vec::with_capacity(self.linear.len() + self.shift.len() + 3 * self.turns.len());
        let mut add = |factor: f64, Shift { row, value, rate, sizes }: Shift| {
            let sizes = sizes.map(|size| factor.abs() * size);
            field.push(Shift { row, value: factor * value, rate: factor * rate, sizes });
        };
        for &(row, j, number) in &self.linear {
            let (value, rate) = (sample.q[j], sample.v[j]);
            add(number.value(), Shift { row, value, rate, sizes: [value.abs(), rate.abs()] });
        }
        for &(row, number) in &self.shift {
            add(number.value(), Shift { row, value: 1.0, rate: 0.0, sizes: [1.0, 0.0] });
        }
        for (turn, number) in &self.turns {
            turn.field(&sample.q, &sample.v).into_iter().for_each(|shift| add(number.value(), shift));
        }
        field
    }

    /// p·ξ.
    fn momentum(&self, graph: &mut Graph, momenta: &[NodeId]) -> NodeId {
        let mut terms: Vec<(NodeId, Number)> = self
            .linear
            .iter()
            .map(|&(i, j, value)| {
                let q = graph.variable(Variable::Coordinate(j as u32));
                (graph.mul(momenta[i], q), value)
            })
            .collect();
        terms.extend(self.shift.iter().map(|&(i, value)| (momenta[i], value)));
        terms.extend(self.turns.iter().map(|&(turn, value)| (turn.momentum(graph, momenta), value)));
        graph.sum(Number::ZERO, &terms)
    }
}

//! Coefficients by the definition: every order evaluated for trial unknowns and solved.

use lagrange_codegen::expr::Variable;
use lagrange_codegen::jets::{Jets, Relation, Value};
use lagrange_codegen::schedule::{Instruction, Slot};

/// All coefficients up to an order.
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

    /// All coefficients of an order for given coefficients of the velocities and of the multipliers.
    fn order(&self, order: usize, velocities: &[f64], multipliers: &[f64]) -> Vec<f64> {
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
                (None, Instruction::Variable(Variable::Multiplier(c))) => multipliers[c as usize],
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

/// Coefficients of the orders 1 to `orders`: the velocities, then the multipliers, which are those of the
/// order before.
pub fn unknowns(jets: &Jets, count: usize, orders: usize, start: &dyn Fn(Variable) -> f64) -> Vec<Vec<f64>> {
    let mut expansion = Expansion { jets, series: Vec::new(), start };
    let first: Vec<f64> = (0..count as u32).map(|i| start(Variable::Velocity(i))).collect();
    let held = jets.conditions.len();
    expansion.series.push(expansion.order(0, &first, &vec![0.0; held]));
    let mut found = Vec::new();
    for order in 1..=orders {
        let (last, k) = (&expansion.series[order - 1], order as f64);
        // The differences that the right unknowns make zero. They are affine in the unknowns: k p[k] = f[k −
        // 1] + (Aᵀμ)[k], and k w[k] = its rate.
        let defects = |trial: &[f64]| -> Vec<f64> {
            let (velocities, multipliers) = trial.split_at(count);
            let now = expansion.order(order, velocities, multipliers);
            let balance = (0..count).map(|i| {
                let reaction = jets.reactions.get(i).map_or(0.0, |slot| now[slot.index()]);
                k * now[jets.momenta[i].index()] - last[jets.rates[i].index()] - reaction
            });
            let conditions = jets.conditions.iter().enumerate().map(|(c, slot)| {
                k * now[slot.index()] - jets.relaxation.get(c).map_or(0.0, |slot| last[slot.index()])
            });
            balance.chain(conditions).collect()
        };
        let known = defects(&vec![0.0; count + held]);
        let columns: Vec<Vec<f64>> = (0..count + held)
            .map(|i| {
                let mut unit = vec![0.0; count + held];
                unit[i] = 1.0;
                defects(&unit).iter().zip(&known).map(|(a, b)| a - b).collect()
            })
            .collect();
        let solution = solved(columns, known.into_iter().map(|defect| -defect).collect());
        let (velocities, multipliers) = solution.split_at(count);
        let now = expansion.order(order, velocities, multipliers);
        expansion.series.push(now);
        found.push(solution);
    }
    found
}

/// Σ columns\[j] x\[j] = right, by elimination with partial pivoting.
pub fn solved(columns: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    let mut a: Vec<Vec<f64>> = (0..count).map(|i| (0..count).map(|j| columns[j][i]).collect()).collect();
    for k in 0..count {
        let pivot = (k..count).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap_or(k);
        a.swap(k, pivot);
        right.swap(k, pivot);
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

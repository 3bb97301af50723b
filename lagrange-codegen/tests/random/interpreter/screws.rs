//! Inertia forces of bodies and their derivatives from screws, body by body as they are defined, all about
//! one point. Sums over bodies are formed for each pair of coordinates alone.

use super::value::{solved, unknown};
use super::{Run, Value};

type Six = [f64; 6];

/// One of the groups of coordinates.
struct Group {
    parent: usize,
    coordinates: Vec<usize>,
    given: usize,
}

/// The quantities that forces are made of.
pub(super) struct Forces {
    groups: Vec<Group>,
    screws: Vec<Six>,
    rates: Vec<[Six; 2]>,
    /// ∂S/∂q, rows S.
    changes: Vec<Vec<Six>>,
    inertias: Vec<Vec<f64>>,
    twists: Vec<Six>,
    accelerations: Vec<Six>,
}

impl Forces {
    pub fn of(record: &Value, groups: &Value, v: &Value, a: &Value) -> Run<Forces> {
        let (v, a) = (v.to_numbers()?, a.to_numbers()?);
        let screws = sixes(record.field("screws")?)?;
        let mut given: Vec<Vec<Six>> =
            record.field("rates")?.list()?.iter().map(sixes).collect::<Run<_>>()?;
        let mut of_groups = sixes(record.field("changes")?)?.into_iter();
        let points = record.field("points")?.to_rows()?;
        let gravity = record.field("gravity")?.to_numbers()?;
        let mut forces = Forces {
            groups: Vec::new(),
            rates: vec![[[0.0; 6]; 2]; screws.len()],
            changes: vec![vec![[0.0; 6]; screws.len()]; screws.len()],
            inertias: record.field("inertias")?.to_rows()?,
            screws,
            twists: Vec::new(),
            accelerations: Vec::new(),
        };
        for (place, group) in groups.list()?.iter().enumerate() {
            let index = |name: &str| group.field(name).and_then(index);
            let coordinates = group.field("coordinates")?.to_indices()?;
            let group = Group { parent: index("parent")?, coordinates, given: index("given")? };
            let [x, y, z] = points[place][..] else { return unknown("a point".to_owned()) };
            let point = [x, y, z];
            for (k, &j) in group.coordinates.iter().enumerate() {
                forces.screws[j] = carried(&forces.screws[j], &point);
                for rate in given.get_mut(group.given + k).into_iter().flatten() {
                    *rate = carried(rate, &point);
                }
            }
            forces.inertias[place] = carried_inertia(&forces.inertias[place], &point);
            let fall = [0.0, 0.0, 0.0, -gravity[0], -gravity[1], -gravity[2]];
            let mut twist = forces.twists.get(group.parent).copied().unwrap_or_default();
            let mut acceleration = forces.accelerations.get(group.parent).copied().unwrap_or(fall);
            for &j in &group.coordinates {
                twist = plus(&twist, v[j], &forces.screws[j]);
            }
            for (k, &j) in group.coordinates.iter().enumerate() {
                let screw = forces.screws[j];
                forces.rates[j][0] =
                    given.get(group.given + k).map_or_else(|| moves(&twist, &screw), |rates| rates[0]);
                acceleration = plus(&plus(&acceleration, v[j], &forces.rates[j][0]), a[j], &screw);
            }
            // A coordinate that moves a screw changes it.
            for &i in &group.coordinates {
                let mut above = group.parent;
                while let Some(other) = forces.groups.get(above) {
                    for &j in &other.coordinates {
                        forces.changes[i][j] = moves(&forces.screws[j], &forces.screws[i]);
                    }
                    above = other.parent;
                }
                if group.given < given.len() {
                    for &j in &group.coordinates {
                        let change = of_groups.next().unwrap_or([f64::NAN; 6]);
                        forces.changes[i][j] = carried(&change, &point);
                    }
                }
            }
            // Given rates lack the part that accelerations contribute.
            for (k, &i) in group.coordinates.iter().enumerate() {
                let screw = forces.screws[i];
                forces.rates[i][1] = match given.get(group.given + k) {
                    Some(rates) => {
                        let changes = forces.changes[i].iter().zip(&a);
                        let driven = changes.fold(rates[1], |sum, (change, &a)| plus(&sum, a, change));
                        plus(&driven, 1.0, &moves(&fall, &screw))
                    }
                    None => plus(&moves(&acceleration, &screw), 1.0, &moves(&twist, &forces.rates[i][0])),
                };
            }
            forces.groups.push(group);
            forces.twists.push(twist);
            forces.accelerations.push(acceleration);
        }
        Ok(forces)
    }

    /// The forces at the accelerations that other forces give.
    pub fn in_motion(record: &Value, groups: &Value, v: &Value, rest: &Value) -> Run<Forces> {
        let rest = rest.to_numbers()?;
        let resting = Forces::of(record, groups, v, &Value::numbers(&vec![0.0; rest.len()]))?;
        let mass = resting.linearization().field("mass")?.to_rows()?;
        let forces = resting.residual().to_numbers()?;
        let total: Vec<f64> = forces.iter().zip(&rest).map(|(force, rest)| force + rest).collect();
        Forces::of(record, groups, v, &solved(&mass, &total)?)
    }

    /// Each body with the coordinates that move it.
    fn bodies(&self) -> impl Iterator<Item = (usize, Vec<usize>)> {
        (0..self.groups.len()).map(|body| {
            let (mut coordinates, mut group) = (Vec::new(), body);
            while let Some(one) = self.groups.get(group) {
                coordinates.extend(&one.coordinates);
                group = one.parent;
            }
            (body, coordinates)
        })
    }

    fn momentum(&self, body: usize, x: &Six) -> Six {
        let [m, hx, hy, hz, xx, xy, xz, yy, yz, zz] = self.inertias[body][..] else { return [f64::NAN; 6] };
        let [w, u] = halves(x);
        let (turned, pushed) = (cross(&[hx, hy, hz], &u), cross(&w, &[hx, hy, hz]));
        let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let torque = [0, 1, 2].map(|i| rows[i][0] * w[0] + rows[i][1] * w[1] + rows[i][2] * w[2] + turned[i]);
        joined(&torque, &[0, 1, 2].map(|i| m * u[i] + pushed[i]))
    }

    fn force(&self, body: usize) -> Six {
        let twist = &self.twists[body];
        let inertial = self.momentum(body, &self.accelerations[body]);
        plus(&inertial, 1.0, &turns(twist, &self.momentum(body, twist)))
    }

    /// I (x × V) + x ×* I V + V ×* I x.
    fn gyrates(&self, body: usize, x: &Six) -> Six {
        let twist = &self.twists[body];
        let first = self.momentum(body, &moves(x, twist));
        let second = turns(x, &self.momentum(body, twist));
        plus(&plus(&first, 1.0, &second), 1.0, &turns(twist, &self.momentum(body, x)))
    }

    pub fn residual(&self) -> Value {
        let mut residual = vec![0.0; self.screws.len()];
        for (body, coordinates) in self.bodies() {
            let force = self.force(body);
            coordinates.iter().for_each(|&i| residual[i] -= dot(&self.screws[i], &force));
        }
        Value::numbers(&residual)
    }

    pub fn linearization(&self) -> Value {
        let count = self.screws.len();
        let mut matrices = [const { Vec::new() }; 3].map(|_: Vec<f64>| vec![vec![0.0; count]; count]);
        for (body, coordinates) in self.bodies() {
            let force = self.force(body);
            for &j in &coordinates {
                let (screw, [rate, second]) = (&self.screws[j], &self.rates[j]);
                let momentum = self.momentum(body, screw);
                let by_q = plus(&turns(screw, &force), 1.0, &self.momentum(body, second));
                let by_q = plus(&by_q, 1.0, &self.gyrates(body, rate));
                let by_v = plus(&self.gyrates(body, screw), 2.0, &self.momentum(body, rate));
                for &i in &coordinates {
                    let screw = &self.screws[i];
                    matrices[0][i][j] += dot(screw, &momentum);
                    matrices[1][i][j] -= dot(screw, &by_q) + dot(&self.changes[i][j], &force);
                    matrices[2][i][j] -= dot(screw, &by_v);
                }
            }
        }
        let [mass, by_q, by_v] = matrices.map(|rows| Value::rows(&rows));
        Value::record([("mass", mass), ("by_q", by_q), ("by_v", by_v)])
    }
}

fn index(value: &Value) -> Run<usize> {
    match value {
        Value::Integer(index) => Ok(*index),
        other => unknown(format!("the index {other:?}")),
    }
}

fn sixes(value: &Value) -> Run<Vec<Six>> {
    value
        .to_rows()?
        .into_iter()
        .map(|row| row.try_into().or_else(|row| unknown(format!("{row:?}"))))
        .collect()
}

/// A twist about the origin, from that about a point.
fn carried(twist: &Six, point: &[f64; 3]) -> Six {
    let [w, u] = halves(twist);
    let across = cross(point, &w);
    joined(&w, &[0, 1, 2].map(|i| u[i] + across[i]))
}

/// An inertia about the origin, from that about a point: J + (2 h·p + m p²) 1 − h pᵀ − p hᵀ − m p pᵀ.
fn carried_inertia(inertia: &[f64], p: &[f64; 3]) -> Vec<f64> {
    let [m, hx, hy, hz, ..] = *inertia else { return vec![f64::NAN; 10] };
    let h = [hx, hy, hz];
    let along: f64 = (0..3).map(|i| (2.0 * h[i] + m * p[i]) * p[i]).sum();
    let mut carried = inertia.to_vec();
    (0..3).for_each(|i| carried[1 + i] += m * p[i]);
    for (entry, (i, j)) in carried[4..].iter_mut().zip([(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]) {
        *entry -= h[i] * p[j] + p[i] * h[j] + m * p[i] * p[j];
        *entry += if i == j { along } else { 0.0 };
    }
    carried
}

fn halves(&[a, b, c, d, e, f]: &Six) -> [[f64; 3]; 2] {
    [[a, b, c], [d, e, f]]
}

fn joined(&[a, b, c]: &[f64; 3], &[d, e, f]: &[f64; 3]) -> Six {
    [a, b, c, d, e, f]
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}

fn dot(a: &Six, b: &Six) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn plus(a: &Six, factor: f64, b: &Six) -> Six {
    std::array::from_fn(|i| a[i] + factor * b[i])
}

/// x × y of twists.
fn moves(x: &Six, y: &Six) -> Six {
    let ([w, u], [angular, linear]) = (halves(x), halves(y));
    let (first, second) = (cross(&w, &linear), cross(&u, &angular));
    joined(&cross(&w, &angular), &[0, 1, 2].map(|i| first[i] + second[i]))
}

/// x ×* y of a twist and a wrench.
fn turns(x: &Six, y: &Six) -> Six {
    let ([w, u], [torque, force]) = (halves(x), halves(y));
    let (first, second) = (cross(&w, &torque), cross(&u, &force));
    joined(&[0, 1, 2].map(|i| first[i] + second[i]), &cross(&w, &force))
}

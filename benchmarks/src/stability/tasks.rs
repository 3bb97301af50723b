//! The tasks: rows of the tables.

use std::error::Error;

use lagrangian::prelude::*;

use super::cell::{Cell, Measure, Task};
use super::systems::{
    Bead, DoublePendulum, HenonHeiles, Pair, Parallelogram, Relaxing, Rod, StiffSpring, Thrice,
};
use crate::problem::{Problem, problems};

/// A row: its name, and a function that makes its cells.
pub type Row = (&'static str, Box<dyn Fn() -> Vec<Cell>>);

/// Tolerances of doubles: the default one, and the finest.
const DOUBLE: [f64; 2] = [1e-10, 1e-14];
/// Tolerances of single precision: the default one is 100 ε.
const SINGLE: [f64; 2] = [1.2e-5, 1e-6];

/// All rows in the order of the tables.
pub fn rows() -> Result<Vec<Row>, Box<dyn Error>> {
    let reference = |name: &str| problems(Some(name)).map(|mut found| found.remove(0));
    let (dpend, hh, pendc) = (reference("dpend")?, reference("hh")?, reference("pendc")?);
    let mut rows: Vec<Row> = vec![
        ("stiff-damped", Box::new(stiff_damped)),
        ("stiff-spring", Box::new(stiff_spring)),
        ("chaotic", Box::new(move || chaotic(&dpend))),
        ("singular", Box::new(singular)),
        ("far-pair", Box::new(far_pair)),
        ("moving", Box::new(moving)),
    ];
    for (name, size, mass) in
        [("chaotic-split", 1.0, 1.0), ("units-large", 1e12, 1e-12), ("units-small", 1e-12, 1e12)]
    {
        let hh = hh.clone();
        rows.push((name, Box::new(move || galaxy(name, &hh, size, mass))));
    }
    for (name, pivot, length, mass) in [
        ("rod", 0.0, 1.0, 1.0),
        ("rod-far", 1e6, 1.0, 1.0),
        ("rod-large", 0.0, 1e12, 1e-12),
        ("rod-small", 0.0, 1e-12, 1e12),
    ] {
        let pendc = pendc.clone();
        rows.push((name, Box::new(move || rod(name, &pendc, pivot, length, mass))));
    }
    let reference = pendc.clone();
    rows.push(("redundant", Box::new(move || redundant(&reference))));
    rows.push(("f32", Box::new(move || single(&hh))));
    rows.push(("f32-rod", Box::new(move || single_rod(&pendc))));
    rows.push(("million", Box::new(million)));
    rows.push(("million-rod", Box::new(million_rod)));
    Ok(rows)
}

/// Distance from a state that is known, in units of a length.
fn from<R: Real + Into<f64>, const N: usize>(problem: &Problem, origin: f64, size: f64) -> Measure<R, N> {
    let problem = problem.clone();
    Measure::End(Box::new(move |state| {
        let place = |x: R| (x.into() - origin) / size;
        let found: Vec<f64> =
            state.q.iter().map(|q| place(*q)).chain(state.v.iter().map(|v| (*v).into() / size)).collect();
        problem.error(&found)
    }))
}

/// How far neighbours part: the distance of the ends over that of the starts, which are 1e-7 beside each
/// other.
fn parting<S, const N: usize>(system: &S, start: State<f64, N>, beside: State<f64, N>, span: f64) -> f64
where
    S: System<N, 0, Scalar = f64>,
{
    let end = |start| system.simulate(start).with_tolerance(1e-13).advance_to(span).copied();
    match (end(start), end(beside)) {
        (Ok(a), Ok(b)) => {
            let off = a.iter().zip(b.iter()).fold(0.0_f64, |off, (a, b)| off.max((a - b).abs()));
            (off / 1e-7).max(1.0)
        }
        _ => 1.0,
    }
}

fn stiff_damped() -> Vec<Cell> {
    let task = Task {
        name: "stiff-damped",
        system: Relaxing { rate: 1e4 },
        starts: vec![State::new([1.0], [0.0])],
        span: 10.0,
        steps: 1000,
        energy: None,
        measure: vec![Measure::End(Box::new(|s: &State<f64, 1>| {
            (s.q[0] - s.t.cos()).abs().max((s.v[0] + s.t.sin()).abs())
        }))],
        condition: 1.0,
        noise: f64::EPSILON,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit()].concat()
}

fn stiff_spring() -> Vec<Cell> {
    let (sin, cos) = 1.0_f64.sin_cos();
    // 0.5 J in the spring beside those of the swing, 9.81 (1 − cos 1).
    let unit = 5.0;
    let task = Task {
        name: "stiff-spring",
        system: StiffSpring { stiffness: 1e6 },
        starts: vec![State::at_rest([1.001 * sin, -1.001 * cos])],
        span: 10.0,
        steps: 1000,
        energy: Some(unit),
        measure: vec![Measure::Energy],
        condition: 1.0,
        // The energy of the spring moves by k s Δr, with the stretch s = 1e-3 and Δr = ε.
        noise: 1e6 * f64::EPSILON * 1e-3,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit(), task.split()].concat()
}

fn chaotic(problem: &Problem) -> Vec<Cell> {
    let (q, v) = problem.start();
    let (start, beside) = (State::new(q, v), State::new([q[0] + 1e-7, q[1]], v));
    let task = Task {
        name: "chaotic",
        system: DoublePendulum,
        starts: vec![start],
        span: problem.t_end,
        steps: 10_000,
        energy: Some(9.81),
        measure: vec![from(problem, 0.0, 1.0)],
        condition: parting(&DoublePendulum, start, beside, problem.t_end),
        noise: f64::EPSILON,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit()].concat()
}

fn galaxy(name: &'static str, problem: &Problem, size: f64, mass: f64) -> Vec<Cell> {
    let (q, v) = problem.start::<2>();
    let start = State::new(q, v);
    let beside = State::new([q[0] + 1e-7, q[1]], v);
    let original = HenonHeiles { size: 1.0, mass: 1.0 };
    let task = Task {
        name,
        system: HenonHeiles { size, mass },
        starts: vec![State::new(q.map(|x| x * size), v.map(|x| x * size))],
        span: problem.t_end,
        steps: 2000,
        energy: Some(0.1 * mass * size * size),
        measure: vec![from(problem, 0.0, size)],
        condition: parting(&original, start, beside, problem.t_end),
        noise: f64::EPSILON,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit(), task.split()].concat()
}

fn singular() -> Vec<Cell> {
    // Each start is this far before the flat position, where it arrives in the first tenth of the run.
    let starts: Vec<f64> = (0..16).map(|i| -10_f64.powf(-6.0 + 5.0 * f64::from(i) / 15.0)).collect();
    let flat = |state: &State<f64, 3>| state.q[1].sin().abs().max((state.q[2] - state.q[0]).sin().abs());
    let curve = |s: f64| ([s, 0.0, s], [1.0, 0.0, 1.0]);
    let runs: Vec<_> = starts
        .into_iter()
        .filter_map(|a| super::singular::along(Parallelogram, curve, a, 5.0, 0.5, 0.1))
        .collect();
    let task = Task {
        name: "singular",
        system: Parallelogram,
        starts: runs.iter().map(|run| run.start).collect(),
        span: 0.5,
        steps: 512,
        energy: None,
        measure: runs
            .into_iter()
            .map(|run| {
                Measure::End(Box::new(move |state: &State<f64, 3>| {
                    flat(state).max((state.q[0] - run.end.q[0]).abs())
                }))
            })
            .collect(),
        condition: 10.0,
        // Rounding over the distance of the nearest start.
        noise: f64::EPSILON / 1e-6,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit()].concat()
}

fn far_pair() -> Vec<Cell> {
    let far = 1e8;
    let (at, v) = ([far, -far], [3.0, -2.0]);
    // ω² = k (1/m₁ + 1/m₂), and each mass has its share of the distance.
    let rate = 1.5_f64.sqrt();
    let task = Task {
        name: "far-pair",
        system: Pair { stiffness: 1.0 },
        starts: vec![State::new([at[0], at[1], at[0] + 1.0, at[1]], [v[0], v[1], v[0], v[1] + 1.0])],
        span: 16.0,
        steps: 1600,
        energy: Some(20.0),
        measure: vec![Measure::End(Box::new(move |s: &State<f64, 4>| {
            let (x, y) = (s.q[2] - s.q[0], s.q[3] - s.q[1]);
            let (sin, cos) = (rate * s.t).sin_cos();
            (x - cos).abs().max((y - sin / rate).abs())
        }))],
        condition: 2.0,
        noise: far * f64::EPSILON,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit(), task.split()].concat()
}

fn moving() -> Vec<Cell> {
    let span = 5.0_f64;
    let task = Task {
        name: "moving",
        system: Bead,
        starts: vec![State::new([1.0, 0.0], [0.0, 1.0])],
        span,
        steps: 512,
        energy: None,
        measure: vec![Measure::End(Box::new(|s: &State<f64, 2>| {
            let (r, (sin, cos)) = (s.t.cosh(), s.t.sin_cos());
            (s.q[0] / r - cos).abs().max((s.q[1] / r - sin).abs())
        }))],
        // cosh t grows as fast as its errors do.
        condition: 2.0,
        noise: f64::EPSILON,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit()].concat()
}

/// How far neighbours of the pendulum part: one starts 1e-7 further down.
fn rod_parting(problem: &Problem) -> f64 {
    let system = Rod { pivot: [0.0; 2], length: 1.0, mass: 1.0 };
    let (sin, cos) = 1e-7_f64.sin_cos();
    parting(&system, State::at_rest([1.0, 0.0]), State::at_rest([cos, -sin]), problem.t_end)
}

fn rod(name: &'static str, problem: &Problem, pivot: f64, length: f64, mass: f64) -> Vec<Cell> {
    let (q, v) = problem.start::<2>();
    let task = Task {
        name,
        system: Rod { pivot: [pivot; 2], length, mass },
        starts: vec![State::new(q.map(|x| pivot + x * length), v.map(|x| x * length))],
        span: problem.t_end,
        steps: 10_240,
        energy: Some(9.81 * mass * length * length),
        measure: vec![from(problem, pivot, length)],
        condition: rod_parting(problem),
        noise: f64::EPSILON * (pivot / length).max(1.0),
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit()].concat()
}

fn redundant(problem: &Problem) -> Vec<Cell> {
    let (q, v) = problem.start();
    let task = Task {
        name: "redundant",
        system: Thrice,
        starts: vec![State::new(q, v)],
        span: problem.t_end,
        steps: 10_240,
        energy: Some(9.81),
        measure: vec![from(problem, 0.0, 1.0)],
        condition: rod_parting(problem),
        noise: f64::EPSILON,
        tolerances: DOUBLE,
        limited: false,
    };
    [task.general(), task.implicit()].concat()
}

/// A start in single precision, which is that of the reference rounded.
fn rounded(problem: &Problem) -> State<f32, 2> {
    let (q, v) = problem.start::<2>();
    State::new(q.map(|x| x as f32), v.map(|x| x as f32))
}

fn single(problem: &Problem) -> Vec<Cell> {
    let (q, v) = problem.start::<2>();
    let original = HenonHeiles { size: 1.0, mass: 1.0 };
    let beside = State::new([q[0] + 1e-7, q[1]], v);
    let task = Task {
        name: "f32",
        system: HenonHeiles::<f32> { size: 1.0, mass: 1.0 },
        starts: vec![rounded(problem)],
        span: problem.t_end,
        steps: 1024,
        energy: Some(0.1),
        measure: vec![from(problem, 0.0, 1.0)],
        condition: parting(&original, State::new(q, v), beside, problem.t_end),
        noise: f64::from(f32::EPSILON),
        tolerances: SINGLE,
        limited: false,
    };
    [task.general(), task.implicit(), task.split()].concat()
}

fn single_rod(problem: &Problem) -> Vec<Cell> {
    let task = Task {
        name: "f32-rod",
        system: Rod::<f32> { pivot: [0.0; 2], length: 1.0, mass: 1.0 },
        starts: vec![rounded(problem)],
        span: problem.t_end,
        steps: 1024,
        energy: Some(9.81),
        measure: vec![from(problem, 0.0, 1.0)],
        condition: rod_parting(problem),
        noise: f64::from(f32::EPSILON),
        tolerances: SINGLE,
        limited: false,
    };
    [task.general(), task.implicit()].concat()
}

fn million() -> Vec<Cell> {
    let task = Task {
        name: "million",
        system: HenonHeiles { size: 1.0, mass: 1.0 },
        starts: vec![State::new([0.0, 0.1], [0.4, 0.1])],
        span: 50_000.0,
        steps: 1 << 20,
        energy: Some(0.1),
        measure: vec![Measure::Energy],
        condition: 1.0,
        noise: f64::EPSILON,
        tolerances: DOUBLE,
        limited: true,
    };
    [task.general(), task.implicit(), task.split()].concat()
}

fn million_rod() -> Vec<Cell> {
    let task = Task {
        name: "million-rod",
        system: Rod { pivot: [0.0; 2], length: 1.0, mass: 1.0 },
        starts: vec![State::at_rest([1.0, 0.0])],
        span: 10_000.0,
        steps: 1 << 20,
        energy: Some(9.81),
        measure: vec![Measure::Energy],
        condition: 1.0,
        noise: f64::EPSILON,
        tolerances: DOUBLE,
        limited: true,
    };
    [task.general(), task.implicit()].concat()
}

//! The program of a robot. It answers requests about its states, line by line.
//!
//! `names`; `evaluate accelerations`, `evaluate derivatives`, `evaluate motions`; `refer accelerations`,
//! `refer derivatives`, the same, computed in 31 digits; `time SUBJECT SECONDS`. The states stand in the file
//! that the program is given: a count, then coordinates, velocities and inputs of each.

use std::hint::black_box;
use std::io::Write as _;
use std::time::Instant;

use lagrangian::integrator::FixedStep;
use lagrangian::prelude::*;
use lagrangian::{DoubleDouble, Linearized, Sensitive, System};

/// The answer to a request.
type Answer<'a> = dyn Fn(&Request) -> String + 'a;

/// A line of words.
enum Request<'a> {
    /// Values of all states.
    Evaluate(&'a str),
    /// The same, computed in more digits.
    Refer(&'a str),
    /// The time of a subject, to be measured for some seconds.
    Time(&'a str, f64),
}

/// Serves accelerations.
pub fn accelerations<S: System<N, K, Scalar = f64>, const N: usize, const K: usize>(
    robot: &S,
    names: &[&str; N],
) {
    let states = states::<N, K>();
    let constants = robot.constants();
    let evaluate = |(state, u): &(State<f64, N>, [f64; K]), out: &mut [f64; N]| {
        *out = robot.accelerations_at(&constants, state.t, &state.q, &state.v, u);
    };
    serve(names, &|request| match *request {
        Request::Evaluate("accelerations") => {
            let mut text = String::new();
            for state in &states {
                let mut out = [0.0; N];
                evaluate(state, &mut out);
                tell(&mut text, &out);
            }
            text
        }
        Request::Time("generated", seconds) => {
            let mut out = [0.0; N];
            fastest(&states, seconds, |state| {
                evaluate(black_box(state), &mut out);
                black_box(&mut out);
            })
        }
        _ => panic!("unknown request"),
    });
}

/// Serves accelerations and their derivatives, in doubles and computed in 31 digits.
pub fn derivatives<S, const N: usize, const K: usize, const D: usize>(robot: &S, names: &[&str; N])
where
    S: Sensitive<N, K, 0, 0, D, Scalar = f64> + Linearized<N, K>,
{
    let states = states::<N, K>();
    let constants = robot.constants();
    serve(names, &|request| {
        let mut text = String::new();
        match *request {
            Request::Evaluate("accelerations") => {
                for (State { t, q, v }, u) in &states {
                    tell(&mut text, &robot.accelerations_at(&constants, *t, q, v, u));
                }
            }
            Request::Evaluate("derivatives") => {
                for (state, u) in &states {
                    let jacobians = robot.jacobians(state, u).expect("regular states");
                    for matrix in [jacobians.by_q, jacobians.by_v] {
                        for i in 0..N {
                            tell(&mut text, &std::array::from_fn::<f64, N, _>(|j| matrix[(i, j)]));
                        }
                    }
                }
            }
            Request::Refer(what) => {
                let precise = robot.over(|value, _| DoubleDouble::from(value));
                for (state, u) in &states {
                    refer(&precise, &mut text, what, state, &u.map(DoubleDouble::from));
                }
            }
            Request::Time("generated-derivatives", seconds) => {
                return fastest(&states, seconds, |(state, u)| {
                    let _ = black_box(robot.jacobians(black_box(state), u));
                });
            }
            _ => panic!("unknown request"),
        }
        text
    });
}

/// Half the distance of the points of a difference. It leaves twenty of 31 digits, and its error is of the
/// order of its square.
const APART: f64 = 1e-10;

/// Writes accelerations or their derivatives at a state, computed in 31 digits and rounded to doubles.
fn refer<S: System<N, K, Scalar = DoubleDouble>, const N: usize, const K: usize>(
    robot: &S,
    text: &mut String,
    what: &str,
    state: &State<f64, N>,
    u: &[DoubleDouble; K],
) {
    let constants = robot.constants();
    let at = |q: &[DoubleDouble; N], v: &[DoubleDouble; N]| {
        robot.accelerations_at(&constants, DoubleDouble::from(state.t), q, v, u)
    };
    let (q, v) = (state.q.map(DoubleDouble::from), state.v.map(DoubleDouble::from));
    if what == "accelerations" {
        return tell(text, &at(&q, &v).map(DoubleDouble::high));
    }
    for by_velocities in [false, true] {
        let columns: [[f64; N]; N] = std::array::from_fn(|j| {
            let moved = |by: f64| {
                let (mut q, mut v) = (q, v);
                let place = if by_velocities { &mut v[j] } else { &mut q[j] };
                *place += DoubleDouble::from(by);
                at(&q, &v)
            };
            let (ahead, behind) = (moved(APART), moved(-APART));
            std::array::from_fn(|i| ((ahead[i] - behind[i]) / DoubleDouble::from(2.0 * APART)).high())
        });
        for i in 0..N {
            tell(text, &std::array::from_fn::<f64, N, _>(|j| columns[j][i]));
        }
    }
}

/// The end of motions [s].
const END: f64 = 0.5;
/// The number of fixed steps, and their length [s].
const STEPS: u32 = 10;
const STEP: f64 = 1e-3;

/// Serves motions.
pub fn motions<S, const N: usize, const K: usize>(robot: &S, names: &[&str; N])
where
    S: System<N, K, Scalar = f64>,
    Jet<8>: FixedStep<S, N, K>,
{
    let states = states::<N, K>();
    let constants = robot.constants();
    let steps = |(state, u): &(State<f64, N>, [f64; K])| {
        let mut stepper = robot.stepper::<Jet<8>>(*state);
        for _ in 0..STEPS {
            stepper.step(STEP, u).expect("a regular state");
        }
        *stepper.state()
    };
    let motion = |(state, _): &(State<f64, N>, [f64; K])| {
        let mut motion = robot.simulate(*state).with_tolerance(1e-12);
        *motion.advance_to(END).expect("a regular motion")
    };
    serve(names, &|request| match *request {
        Request::Evaluate("motions") => {
            let mut text = String::new();
            for state in &states {
                tell(&mut text, &steps(state).q);
                tell(&mut text, &motion(state).q);
            }
            text
        }
        Request::Time("accelerations-in-turn", seconds) => fastest(&states, seconds, |(state, u)| {
            let state = black_box(state);
            black_box(robot.accelerations_at(&constants, state.t, &state.q, &state.v, u));
        }),
        Request::Time("steps", seconds) => fastest(&states, seconds, |state| {
            black_box(steps(black_box(state)));
        }),
        Request::Time("motion", seconds) => fastest(&states, seconds, |state| {
            black_box(motion(black_box(state)));
        }),
        _ => panic!("unknown request"),
    });
}

fn serve<const N: usize>(names: &[&str; N], answer: &Answer) {
    for line in std::io::stdin().lines() {
        let line = line.expect("a line of text");
        let words: Vec<&str> = line.split_whitespace().collect();
        let text = match words[..] {
            ["names"] => names.join(" "),
            ["evaluate", what] => answer(&Request::Evaluate(what)),
            ["refer", what] => answer(&Request::Refer(what)),
            ["time", what, seconds] => {
                answer(&Request::Time(what, seconds.parse().expect("a number of seconds")))
            }
            _ => panic!("unknown request {line}"),
        };
        println!("{text}");
        std::io::stdout().flush().expect("an open pipe");
    }
}

fn states<const N: usize, const K: usize>() -> Vec<(State<f64, N>, [f64; K])> {
    let path = std::env::args().nth(1).expect("a file of states");
    let text = std::fs::read_to_string(path).expect("a readable file");
    let mut words = text.split_whitespace();
    let count: usize = words.next().and_then(|word| word.parse().ok()).expect("a count");
    let mut number = || words.next().and_then(|word| word.parse().ok()).expect("a number");
    let mut states = Vec::new();
    for _ in 0..count {
        let (q, v) = (std::array::from_fn(|_| number()), std::array::from_fn(|_| number()));
        states.push((State { t: 0.0, q, v }, std::array::from_fn(|_| number())));
    }
    assert!(words.next().is_none(), "the states are those of another robot");
    states
}

/// The fastest of many passes over all states, for one of them [ns].
fn fastest<T>(states: &[T], seconds: f64, mut evaluate: impl FnMut(&T)) -> String {
    let begin = Instant::now();
    let mut fastest = f64::INFINITY;
    loop {
        let start = Instant::now();
        states.iter().for_each(&mut evaluate);
        fastest = fastest.min(start.elapsed().as_secs_f64());
        if begin.elapsed().as_secs_f64() >= seconds {
            return format!("{:?}", fastest * 1e9 / states.len() as f64);
        }
    }
}

fn tell(text: &mut String, row: &[f64]) {
    for number in row {
        text.push_str(&format!("{number:?} "));
    }
}

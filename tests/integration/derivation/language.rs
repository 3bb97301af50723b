//! Constructs of Rust in a description: one potential written in many ways, and the control flow of
//! constants.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};
use crate::support::identities::model;
use crate::support::sample::Samples;

const N: usize = 6;

/// A row of masses; each potential below is Σ ½ (xᵢ₊₁ − xᵢ)².
struct Row;

/// How many potentials there are.
const SPELLINGS: f64 = 14.0;

#[lagrangian(coordinates = [x: [Self::N]])]
impl Row {
    const N: usize = 2 * 3;
    const LAST: usize = Self::N - 1;
    const HALF: f64 = 0.5;

    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        let mut sum = 0.0;
        for rate in v.x {
            sum += rate * rate;
        }
        Self::HALF * sum
    }

    #[potential]
    fn by_loop(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for i in 0..Self::LAST {
            let stretch = q.x[i + 1] - q.x[i];
            sum += stretch * stretch;
        }
        sum / 2.0
    }

    #[potential]
    fn by_inclusive_range(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for i in 1..=Self::LAST {
            sum += 0.5 * (q.x[i] - q.x[i - 1]).powi(2);
        }
        sum
    }

    #[potential]
    fn backwards(&self, q: &Coordinates) -> f64 {
        (0..5).rev().map(|i| 0.5 * (q.x[i + 1] - q.x[i]).powi(2)).sum()
    }

    #[potential]
    fn by_windows(&self, q: &Coordinates) -> f64 {
        q.x.windows(2).map(|pair| 0.5 * (pair[1] - pair[0]).powi(2)).sum()
    }

    #[potential]
    fn by_zip(&self, q: &Coordinates) -> f64 {
        let stretches = q.x.iter().zip(q.x.iter().skip(1)).map(|(left, right)| right - left);
        0.5 * stretches.map(|stretch| stretch * stretch).sum::<f64>()
    }

    #[potential]
    fn by_fold(&self, q: &Coordinates) -> f64 {
        let (sum, _) = q.x.iter().skip(1).fold((0.0, q.x[0]), |(sum, left), &right| {
            let stretch = right - left;
            (sum + 0.5 * stretch * stretch, right)
        });
        sum
    }

    #[potential]
    fn in_strides(&self, q: &Coordinates) -> f64 {
        let even: f64 = (0..Self::LAST).step_by(2).map(|i| self.spring(q.x[i], q.x[i + 1])).sum();
        let odd: f64 = (1..Self::LAST).step_by(2).map(|i| self.spring(q.x[i], q.x[i + 1])).sum();
        even + odd
    }

    #[potential]
    fn by_filter(&self, q: &Coordinates) -> f64 {
        (0..Self::N).filter(|i| i % 6 != 5).map(|i| Self::square(q.x[i + 1] - q.x[i]) / 2.0).sum()
    }

    #[potential]
    fn with_skips(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for (i, x) in q.x.iter().enumerate() {
            if i == 0 {
                continue;
            }
            if i > Self::LAST {
                break;
            }
            sum += self.spring(q.x[i - 1], *x);
        }
        sum
    }

    #[potential]
    fn by_cases(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for i in 0..Self::N {
            sum += match i {
                0 => 0.0,
                1 | 2 => self.spring(q.x[i], q.x[i - 1]),
                3..=4 => self.spring(q.x[i], q.x[i - 1]),
                _ => {
                    let last = q.x[i];
                    self.spring(last, q.x[i - 1])
                }
            };
        }
        sum
    }

    #[potential]
    fn by_slices(&self, q: &Coordinates) -> f64 {
        let [first, .., last] = &q.x;
        let inner: f64 = (1..4).map(|i| self.spring(q.x[i], q.x[i + 1])).sum();
        self.spring(*first, q.x[1]) + inner + self.spring(*last, q.x[4])
    }

    #[potential]
    fn by_vector(&self, q: &Coordinates) -> f64 {
        let x = SVector::<f64, 6>::from(q.x);
        let mut stretch = SVector::<f64, 5>::zeros();
        for i in 0..5 {
            stretch[i] = x[i + 1] - x[i];
        }
        0.5 * stretch.norm_squared()
    }

    #[potential]
    fn by_matrix(&self, q: &Coordinates) -> f64 {
        let stiffness = SMatrix::<f64, 6, 6>::from_fn(|i, j| {
            if i == j {
                if i == 0 || i == 5 { 1.0 } else { 2.0 }
            } else if i.abs_diff(j) == 1 {
                -1.0
            } else {
                0.0
            }
        });
        let x = q.as_vector();
        0.5 * x.dot(&(stiffness * x))
    }

    #[potential]
    fn with_early_return(&self, q: &Coordinates) -> f64 {
        let stretches: [f64; 5] = std::array::from_fn(|i| q.x[i + 1] - q.x[i]);
        if stretches.len() == 5 {
            return stretches.iter().map(|s| s * s).sum::<f64>() * 0.5;
        }
        0.0
    }

    fn spring(&self, a: f64, b: f64) -> f64 {
        let stretch = { Self::square(b - a) };
        Self::HALF * stretch
    }

    fn square(x: f64) -> f64 {
        x * x
    }
}

fn stretches(x: [f64; N]) -> [f64; N - 1] {
    std::array::from_fn(|i| x[i + 1] - x[i])
}

#[test]
fn all_spellings_mean_the_same() {
    let mut samples = Samples::new(1);
    for _ in 0..10 {
        let state: State<f64, N> = samples.state(-1.0, 1.0);
        let s = stretches(state.q);
        let energy = 0.5 * s.iter().map(|s| s * s).sum::<f64>();
        close(Row.potential_energy(&state), SPELLINGS * energy, 1e-14);
        let force: [f64; N] = std::array::from_fn(|i| {
            let (left, right) = (if i > 0 { s[i - 1] } else { 0.0 }, if i < N - 1 { s[i] } else { 0.0 });
            SPELLINGS * (left - right)
        });
        all_close(Row.bias(&state), force, 1e-13);
    }
}

#[test]
fn every_spelling_is_still_an_ordinary_function() {
    let q = RowCoordinates::from([0.1, 0.5, -0.2, 0.3, 0.9, -0.4]);
    let expected = Row.by_loop(&q);
    for found in [
        Row.by_inclusive_range(&q),
        Row.backwards(&q),
        Row.by_windows(&q),
        Row.by_zip(&q),
        Row.by_fold(&q),
        Row.in_strides(&q),
        Row.by_filter(&q),
        Row.with_skips(&q),
        Row.by_cases(&q),
        Row.by_slices(&q),
        Row.by_vector(&q),
        Row.by_matrix(&q),
        Row.with_early_return(&q),
    ] {
        close(found, expected, 1e-15);
    }
}

#[test]
fn the_identities_hold_for_a_row() {
    model!(Row).holds(-1.0, 1.0);
}

/// Vector algebra of nalgebra: a particle in a plane in space, in a linear field.
struct Algebra {
    direction: Vector3<f64>,
    field: Matrix3<f64>,
    origin: Point3<f64>,
}

#[lagrangian(coordinates = [s, w])]
impl Algebra {
    #[point(mass = 2.0)]
    fn place(&self, q: &Coordinates) -> Point3<f64> {
        let direction: Vector3<f64> = self.direction;
        let normal = direction.cross(&Vector3::z()).normalize();
        self.origin + direction * q.s + normal * q.w
    }

    #[potential]
    fn field_energy(&self, q: &Coordinates) -> f64 {
        let field: Matrix3<f64> = self.field;
        let r = self.place(q) - Point3::origin();
        0.5 * r.dot(&(field * r)) + field.trace() * r.x + (field.transpose() * r).z
    }
}

#[test]
fn vector_algebra_is_derived_as_it_is_evaluated() {
    let system = Algebra {
        direction: Vector3::new(1.0, 2.0, -0.5),
        field: Matrix3::new(2.0, 0.3, 0.1, 0.3, 1.0, -0.2, 0.1, -0.2, 3.0),
        origin: Point3::new(0.1, -0.2, 0.3),
    };
    let mut samples = Samples::new(5);
    for _ in 0..10 {
        let state: State<f64, 2> = samples.state(-1.0, 1.0);
        let r = system.place(&state.q.into()).coords;
        let normal = system.direction.cross(&Vector3::z()).normalize();
        let gradient = system.field * r + system.field.trace() * Vector3::x() + system.field.column(2);
        all_close(system.bias(&state), [gradient.dot(&system.direction), gradient.dot(&normal)], 1e-13);
        let mass = 2.0 * Matrix2::new(system.direction.norm_squared(), 0.0, 0.0, 1.0);
        all_close(system.mass_matrix(&state).as_slice(), mass.as_slice(), 1e-13);
        close(system.potential_energy(&state), system.field_energy(&state.q.into()), 1e-14);
    }
    model!(system).holds(-1.0, 1.0);
}

//! Spectra of families of matrices, of which many once stopped the iteration.

use nalgebra::DVector;

use super::super::vectors::null_vectors;
use super::*;

/// A linear congruential generator (Knuth, MMIX).
struct Samples(u64);

impl Samples {
    /// A number in [−1, 1).
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn matrix(&mut self, count: usize) -> DMatrix<f64> {
        DMatrix::from_fn(count, count, |_, _| self.number())
    }

    fn integer(&mut self, most: i32) -> f64 {
        (0.5 * (self.number() + 1.0) * f64::from(most + 1)).floor()
    }
}

/// [[0, 1], [−M⁻¹K, −M⁻¹D]].
fn state_matrix(mass: &DMatrix<f64>, damping: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> DMatrix<f64> {
    let count = mass.nrows();
    let inverse = mass.clone().try_inverse().unwrap();
    let (by_q, by_v) = (&inverse * stiffness, &inverse * damping);
    DMatrix::from_fn(2 * count, 2 * count, |i, j| match (i < count, j < count) {
        (true, true) => 0.0,
        (true, false) => f64::from(i + count == j),
        (false, true) => -by_q[(i - count, j)],
        (false, false) => -by_v[(i - count, j - count)],
    })
}

fn diagonal(entries: &[f64]) -> DMatrix<f64> {
    DMatrix::from_diagonal(&DVector::from_row_slice(entries))
}

/// Three coordinates with random M, C, G and K.
fn three_coordinates(samples: &mut Samples) -> DMatrix<f64> {
    let root = samples.matrix(3);
    let mass = &root * root.transpose() + DMatrix::identity(3, 3) * 0.3;
    let (damping, stiffness) = (samples.matrix(3), samples.matrix(3));
    state_matrix(&mass, &damping, &(&stiffness + stiffness.transpose()))
}

/// Undamped, with gyroscopic forces and a stiffness of any sign.
fn gyroscopic(samples: &mut Samples, count: usize) -> DMatrix<f64> {
    let (gyroscopic, stiffness) = (samples.matrix(count) * 3.0, samples.matrix(count));
    state_matrix(
        &DMatrix::identity(count, count),
        &(&gyroscopic - gyroscopic.transpose()),
        &(&stiffness + stiffness.transpose()),
    )
}

/// A symmetric top that sleeps upright.
fn sleeping_top(s: f64, g: f64) -> DMatrix<f64> {
    state_matrix(
        &DMatrix::identity(2, 2),
        &DMatrix::from_row_slice(2, 2, &[0.0, g, -g, 0.0]),
        &diagonal(&[-s, -s]),
    )
}

/// Three critically damped coordinates, mixed by a turn or not.
fn critical(samples: &mut Samples, is_mixed: bool) -> DMatrix<f64> {
    let rates: [f64; 3] = core::array::from_fn(|_| 1.0 + 0.1 * samples.integer(50));
    let squares = diagonal(&rates.map(|w| w * w));
    let dampings = diagonal(&rates.map(|w| 2.0 * w));
    let turn = if is_mixed { samples.matrix(3).qr().q() } else { DMatrix::identity(3, 3) };
    let on = |matrix: DMatrix<f64>| &turn * matrix * turn.transpose();
    state_matrix(&DMatrix::identity(3, 3), &on(dampings), &on(squares))
}

/// Decoupled coordinates with small integers for damping and stiffness.
fn integers(samples: &mut Samples) -> DMatrix<f64> {
    let mut drawn = || core::array::from_fn::<f64, 4, _>(|_| samples.integer(4));
    state_matrix(&DMatrix::identity(4, 4), &diagonal(&drawn()), &diagonal(&drawn()))
}

fn cyclic(count: usize) -> DMatrix<f64> {
    DMatrix::from_fn(count, count, |i, j| f64::from((i + 1) % count == j))
}

/// Cases of each family.
const CASES: usize = 400;

/// Eigenvalues, with sums and eigenvectors checked: the sum to `sum` and A x − λ x to `residual`, of the
/// largest entry.
fn checked(matrix: &DMatrix<f64>, is_reversible: bool, [sum, residual]: [f64; 2]) -> Vec<Complex<f64>> {
    let Some(found) = eigenvalues(matrix, f64::EPSILON, is_reversible) else {
        panic!("no eigenvalues: {matrix}")
    };
    assert_eq!(found.len(), matrix.nrows());
    let mut balanced = matrix.clone();
    balance(&mut balanced);
    let size = largest(&balanced);
    let total: f64 = found.iter().map(|found| found.value.re).sum();
    assert!((total - matrix.trace()).abs() <= sum * size, "{total} is not the trace of {matrix}");
    let complex = balanced.map(|x| Complex::new(x, 0.0));
    let zeros = found.iter().filter(|found| found.value == Complex::new(0.0, 0.0)).count();
    let nulls = null_vectors(&balanced, f64::EPSILON, zeros);
    assert!(nulls.iter().all(|vector| (&complex * vector).norm() <= residual * size), "{matrix}");
    for (k, Eigenvalue { value, scale, members }) in found.iter().enumerate() {
        let (value, scale) = (*value, *scale);
        if value == Complex::new(0.0, 0.0) {
            continue;
        }
        let Some(vector) = eigenvector(&balanced, value, scale, (members, k)) else {
            panic!("no vector of {value}: {matrix}")
        };
        let off = (&complex * &vector - &vector * value).norm();
        assert!(off <= residual * size * vector.norm(), "{value} is off by {off:e}: {matrix}");
    }
    let conjugate = |x: &Complex<f64>| found.iter().any(|found| found.value == x.conj());
    let values: Vec<_> = found.iter().map(|found| found.value).collect();
    assert!(values.iter().all(conjugate), "{values:?}");
    values
}

/// Sums and residuals of all cases of a family; `seed` and number of a case make it.
fn family(
    seed: u64,
    is_reversible: bool,
    bounds: [f64; 2],
    make: impl Fn(&mut Samples, usize) -> DMatrix<f64>,
) {
    let mut samples = Samples(seed);
    for case in 0..CASES {
        checked(&make(&mut samples, case), is_reversible, bounds);
    }
}

#[test]
fn random_matrices() {
    family(1, false, [1e-12; 2], |samples, case| samples.matrix(1 + case % 12));
    family(2, false, [1e-12; 2], |samples, _| three_coordinates(samples));
}

#[test]
#[ignore = "seconds; `scripts/check.sh features`"]
fn gyroscopic_systems() {
    for count in [2, 3, 6] {
        family(3, true, [1e-12; 2], |samples, _| gyroscopic(samples, count));
    }
    family(4, true, [1e-12; 2], |samples, _| sleeping_top(10.0 * samples.number(), 10.0 * samples.number()));
    family(5, true, [1e-12; 2], |samples, _| sleeping_top(samples.integer(10), 0.5 * samples.integer(20)));
}

#[test]
fn critical_and_free_coordinates() {
    family(6, false, [1e-12; 2], |samples, _| critical(samples, false));
    family(7, false, [1e-12; 2], |samples, _| integers(samples));
    // Defective and of three different rates in one part: the eigenvalues are off by the root of a rounding.
    family(8, false, [1e-11, 1e-8], |samples, _| critical(samples, true));
}

#[test]
#[ignore = "seconds; `scripts/check.sh features`"]
fn cyclic_permutations_have_the_roots_of_one() {
    for count in 1..=40 {
        for value in checked(&cyclic(count), false, [1e-12; 2]) {
            assert!((value.re.hypot(value.im) - 1.0).abs() < 1e-13, "{value}");
            let turns = value.im.atan2(value.re) * count as f64 / core::f64::consts::TAU;
            assert!((turns - turns.round()).abs() < 1e-12 * count as f64, "{value} of {count}");
        }
    }
}

#[test]
fn two_by_two() {
    let of = |entries: [[f64; 2]; 2]| of_two(entries).map(|value| (value.re, value.im));
    assert_eq!(of([[0.0, 1.0], [-4.0, -4.0]]), [(-2.0, 0.0); 2]);
    assert_eq!(of([[0.0, 1.0], [-4.0, 0.0]]), [(0.0, 2.0), (0.0, -2.0)]);
    assert_eq!(of([[0.0, 1.0], [4.0, 0.0]]), [(2.0, 0.0), (-2.0, 0.0)]);
    // The smaller root has all its digits.
    assert_eq!(of([[0.0, 1.0], [-1e-20, -1.0]]), [(-1.0, 0.0), (-1e-20, 0.0)]);
    assert_eq!(of([[1.0, -1.0], [1.0, -1.0]]), [(0.0, 0.0); 2]);
}

#[test]
fn parts_are_those_that_act_on_each_other() {
    // 0 ⇄ 2 → 1 → 3, and 3 on itself.
    let mut matrix = DMatrix::zeros(4, 4);
    for place in [(0, 2), (2, 0), (1, 2), (3, 1), (3, 3)] {
        matrix[place] = 1e-300;
    }
    assert_eq!(parts(&matrix), [std::vec![0, 2], std::vec![1], std::vec![3]]);
}

#[test]
fn defective_zeros_are_exact() {
    // Four masses in a row, free, with springs and dampers between them, mixed by a turn: two zeros and no
    // other near them.
    let mut samples = Samples(9);
    for _ in 0..CASES {
        let springs = DMatrix::from_fn(4, 4, |i, j| match i.abs_diff(j) {
            0 => 1.0 + f64::from((1..3).contains(&i)),
            1 => -1.0,
            _ => 0.0,
        });
        let turn = samples.matrix(8).qr().q();
        let matrix = state_matrix(&DMatrix::identity(4, 4), &(&springs * 0.1), &springs);
        let values = checked(&(&turn * matrix * turn.transpose()), false, [1e-12; 2]);
        let sizes = values.iter().map(|value| value.re.hypot(value.im));
        let (zeros, others): (Vec<_>, Vec<_>) = sizes.partition(|&size| size == 0.0);
        assert_eq!(zeros.len(), 2, "{values:?}");
        assert!(others.iter().all(|&size| size > 0.5), "{values:?}");
    }
}

#[test]
fn real_parts_are_zero_where_they_are_rounding() {
    // With z = x + i y the equation is z̈ − i g ż − s z = 0, so λ = i g / 2 ± √(s − g²/4).
    for (s, g) in [(10.0, 7.0), (10.0, 6.4), (10.0, 100.0), (1e-3, 7.0), (-3.0, 0.1)] {
        let root: f64 = (0.25_f64 * g * g - s).sqrt();
        for value in checked(&sleeping_top(s, g), true, [1e-12; 2]) {
            assert_eq!(value.re, 0.0, "{s} {g}");
            let size = value.im.abs();
            let off = (size - (0.5 * g + root)).abs().min((size - (0.5 * g - root).abs()).abs());
            assert!(off < 1e-12 * g.max(1.0), "{value}");
        }
    }
    // Below the critical spin, by however little that is more than rounding, two of four grow.
    for s in [10.0 + 1e-9, 10.0 + 1e-3, 20.0] {
        let values = checked(&sleeping_top(s, 40.0_f64.sqrt()), true, [1e-12; 2]);
        assert_eq!(values.iter().filter(|value| value.re > 0.0).count(), 2, "{values:?}");
    }
}

#[test]
fn a_part_of_one_is_deflated_only_if_it_is_zero() {
    for x in [0.0, 1e-280, -3.0] {
        assert_eq!(checked(&DMatrix::from_element(1, 1, x), false, [1e-12; 2]), [Complex::new(x, 0.0)]);
    }
}

use super::*;
use crate::linear::samples::Noise;

/// L Lᵀ with a random L whose diagonal is well away from zero.
fn positive_definite<const N: usize>(noise: &mut Noise) -> [[f64; N]; N] {
    let b: [[f64; N]; N] = noise.matrix();
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            (0..N).map(|k| b[i][k] * b[j][k]).sum::<f64>() + if i == j { 0.5 } else { 0.0 }
        })
    })
}

/// The largest residual of either equation, relative to the magnitudes that were added up for it.
fn residuals<const N: usize, const C: usize>(
    mass: &[[f64; N]; N],
    a: &[[f64; N]; C],
    (v, kappa): &([f64; N], [f64; C]),
    r: &[f64; N],
    y: &[f64; C],
) -> (f64, f64) {
    let (mut motion, mut constraint) = (0.0_f64, 0.0_f64);
    for i in 0..N {
        let (mut sum, mut size) = (-r[i], r[i].abs());
        for j in 0..N {
            let term = mass[i.max(j)][i.min(j)] * v[j];
            (sum, size) = (sum + term, size + term.abs());
        }
        for c in 0..C {
            let term = a[c][i] * kappa[c];
            (sum, size) = (sum - term, size + term.abs());
        }
        motion = motion.max(sum.abs() / size);
    }
    for c in 0..C {
        let (mut sum, mut size) = (-y[c], y[c].abs());
        for j in 0..N {
            let term = a[c][j] * v[j];
            (sum, size) = (sum + term, size + term.abs());
        }
        constraint = constraint.max(sum.abs() / size);
    }
    (motion, constraint)
}

fn check<const N: usize, const C: usize>() {
    let mut noise = Noise((N * 100 + C) as u64);
    let mut worst = (0.0_f64, 0.0_f64);
    for _ in 0..100 {
        let (mass, a) = (positive_definite::<N>(&mut noise), noise.matrix_of::<C, N>());
        let (r, y) = (noise.vector(), noise.vector());
        let saddle = Saddle::factor(&mass, &a);
        assert_eq!((saddle.rank(), saddle.defect(), saddle.vanishing()), (C, None, None));
        let (motion, constraint) = residuals(&mass, &a, &saddle.solve(&r, &y), &r, &y);
        worst = (worst.0.max(motion), worst.1.max(constraint));
    }
    std::println!("{N} {C}: {:.1} {:.1} eps", worst.0 / f64::EPSILON, worst.1 / f64::EPSILON);
}

#[test]
fn solves_random_systems() {
    check::<1, 1>();
    check::<2, 1>();
    check::<3, 1>();
    check::<4, 2>();
    check::<7, 6>();
    check::<8, 6>();
    check::<12, 8>();
    check::<20, 10>();
    check::<5, 0>();
    check::<5, 5>();
}

impl Noise {
    fn matrix_of<const I: usize, const J: usize>(&mut self) -> [[f64; J]; I] {
        core::array::from_fn(|_| self.vector())
    }
}

#[test]
fn debug_redundant() {
    let mass = [[2.0, 0.0, 0.0], [0.5, 3.0, 0.0], [0.1, 0.2, 1.0]];
    let a = [[1.0, 2.0, 0.5], [2.0, 4.0, 1.0], [0.0, 0.0, 0.0], [1.0, 0.0, -1.0]];
    let y = [1.0, 2.0, 0.0, 0.5];
    let s = Saddle::factor(&mass, &a);
    let x = s.solve(&[1.0, 2.0, 3.0], &y);
    std::println!("{x:?} {:?} {:?} {:?} {:?}", s.rank(), s.defect(), s.vanishing(), s.dropped);
    std::println!("{:?}", residuals(&mass, &a, &x, &[1.0, 2.0, 3.0], &y));
    let d = Diagonal::factor([0.5, 0.3, 1.0], &a);
    let mass = [[2.0, 0.0, 0.0], [0.0, 1.0 / 0.3, 0.0], [0.0, 0.0, 1.0]];
    let s = Saddle::factor(&mass, &a);
    std::println!("{:?} {:?}", d.solve(&[1.0, 2.0, 3.0], &y), s.solve(&[1.0, 2.0, 3.0], &y));
    std::println!("{d:?}");
    let m = [[1.0, 0.0], [1.0, 1.0]];
    std::println!("{:?}", Saddle::factor(&m, &[[0.0, 0.0]]).defect());
    std::println!("{:?}", Saddle::factor(&m, &[[0.0, 1.0]]).solve(&[1.0, 0.0], &[1.0]));
    std::println!("{:?}", Saddle::factor(&[[1.0, 0.0], [0.0, f64::NAN]], &[[0.0, 1.0]]).defect());
    std::println!("{:?}", Saddle::factor(&[[1.0, 0.0], [0.0, 1.0]], &[[f64::NAN, 1.0]]).defect());
}

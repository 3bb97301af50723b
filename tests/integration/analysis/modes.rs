//! Modes where eigenvalues meet, vanish, or are far apart, against closed forms.

use lagrangian::{Mode, prelude::*};
use nalgebra::Complex;

use crate::support::close::{all_close, between, close};

/// The modes of a system at rest at the origin.
fn at_rest<S: Tangent<N, Scalar = f64>, const N: usize>(system: &S) -> Vec<Mode<N>> {
    system.modes(&State::at_rest([0.0; N]), &[]).unwrap()
}

fn frequencies<const N: usize>(modes: &[Mode<N>]) -> Vec<f64> {
    modes.iter().map(Mode::frequency).collect()
}

/// The natural test of stability.
fn is_stable<const N: usize>(modes: &[Mode<N>]) -> bool {
    modes.iter().all(|mode| mode.eigenvalue.re <= 0.0)
}

struct Damped {
    k: f64,
    c: f64,
}

#[lagrangian(coordinates = [x], jacobians)]
impl Damped {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector1<f64> {
        Vector1::new(q.x)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        0.5 * self.k * q.x.powi(2)
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.c * v.x.powi(2)
    }
}

#[test]
fn critical_damping_has_one_rate_twice() {
    for w in (1..=300).map(|n| 0.1 * f64::from(n)) {
        let modes = at_rest(&Damped { k: w * w, c: 2.0 * w });
        assert_eq!(modes.len(), 2);
        for mode in &modes {
            close(mode.eigenvalue.re, -w, 1e-15);
            assert_eq!(mode.eigenvalue.im, 0.0);
            close(mode.damping_ratio(), 1.0, 1e-15);
            close(mode.shape[0].re, 1.0, 1e-15);
        }
    }
}

#[test]
fn near_critical_damping_and_far_beyond() {
    for (k, c) in [(4.0, 4.0004), (4.0004, 4.0), (1.0, 1e9), (1e-20, 1.0), (1e-40, 1.0)] {
        let modes = at_rest(&Damped { k, c });
        let discriminant: f64 = 0.25 * c * c - k;
        if discriminant < 0.0 {
            all_close(
                [modes[0].eigenvalue.re, modes[0].eigenvalue.im],
                [-0.5 * c, (-discriminant).sqrt()],
                1e-11,
            );
        } else {
            let fast = 0.5 * c + discriminant.sqrt();
            // A slow decay is exact to its own size.
            close(modes[0].eigenvalue.re * fast / k, -1.0, 1e-11);
            close(modes[1].eigenvalue.re, -fast, 1e-11);
        }
    }
}

/// A pendulum with a damped joint on a cart that nothing holds.
struct Cart {
    damping: f64,
}

#[lagrangian(coordinates = [x, theta], jacobians)]
impl Cart {
    #[point(mass = 1.3)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = 0.7)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x + 0.9 * q.theta.sin(), -0.9 * q.theta.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.7 * 9.81 * self.bob(q).y
    }

    #[dissipation]
    fn joint(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.theta.powi(2)
    }
}

/// The same by the places of both points, with a rod between them.
struct TiedCart {
    damping: f64,
}

#[lagrangian(coordinates = [x, u, v], jacobians)]
impl TiedCart {
    #[point(mass = 1.3)]
    fn cart(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, 0.0)
    }

    #[point(mass = 0.7)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.u, q.v)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        (q.u - q.x).powi(2) + q.v.powi(2) - 0.81
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.7 * 9.81 * self.bob(q).y
    }

    // About the bottom (u̇ − ẋ) / 0.9 is the rate of the angle.
    #[dissipation]
    fn joint(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * ((v.u - v.x) / 0.9).powi(2)
    }
}

#[test]
fn a_free_cart_is_one_exact_zero() {
    // θ̈ m l² M/(M + m) + c θ̇ + m g l θ = 0.
    let inertia: f64 = 0.7 * 0.81 * 1.3 / 2.0;
    for damping in [0.0, 0.1, 0.15] {
        let decay = 0.5 * damping / inertia;
        let frequency = (0.7 * 9.81 * 0.9 / inertia - decay * decay).sqrt();
        let check = |eigenvalues: Vec<Complex<f64>>| {
            assert_eq!(eigenvalues.len(), 2, "{eigenvalues:?}");
            assert_eq!(eigenvalues[0], Complex::new(0.0, 0.0));
            all_close([eigenvalues[1].re, eigenvalues[1].im], [-decay, frequency], 1e-13);
        };
        let modes = at_rest(&Cart { damping });
        close(modes[0].shape[0].re, 0.5_f64.sqrt(), 1e-14);
        close(modes[0].shape[1].re, 0.0, 1e-14);
        check(modes.iter().map(|mode| mode.eigenvalue).collect());
        for x in [0.0, 0.3, -17.1] {
            let modes = TiedCart { damping }.modes(&State::at_rest([x, x, -0.9]), &[]).unwrap();
            check(modes.iter().map(|mode| mode.eigenvalue).collect());
        }
    }
}

/// A stiff direction and a soft one.
struct Slot {
    stiff: f64,
    soft: f64,
    c: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Slot {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * (self.stiff * q.x.powi(2) + self.soft * q.y.powi(2))
    }

    #[dissipation]
    fn damper(&self, v: &Velocities) -> f64 {
        0.5 * self.c * v.y.powi(2)
    }
}

#[test]
fn a_stiff_direction_does_not_round_a_soft_one() {
    for stiff in [1e14, 1e20] {
        let held = at_rest(&Slot { stiff, soft: 1.0, c: 0.0 });
        let values: Vec<_> = held.iter().map(|mode| mode.eigenvalue).collect();
        assert_eq!(values, [Complex::new(0.0, 1.0), Complex::new(0.0, stiff.sqrt())]);
        let pushed = at_rest(&Slot { stiff, soft: -1.0, c: 0.0 });
        let values: Vec<_> = pushed.iter().map(|mode| mode.eigenvalue).collect();
        assert_eq!(
            values,
            [Complex::new(-1.0, 0.0), Complex::new(1.0, 0.0), Complex::new(0.0, stiff.sqrt())]
        );
        // A damping that is small beside the stiff direction counts too.
        let damped = at_rest(&Slot { stiff, soft: 1.0, c: 1e-7 });
        close(damped[0].eigenvalue.re / -5e-8, 1.0, 1e-15);
        close(damped[0].shape[1].re, 1.0, 1e-15);
        close(damped[0].shape[0].re, 0.0, 1e-15);
    }
}

/// A symmetric top on its tip: inertias 1 about the axis and 0.5 across it, weight times height 5, by the
/// direction of its axis.
struct Top {
    spin: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Top {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        let momentum = self.spin * (q.x * v.y - q.y * v.x);
        0.25 * (v.x.powi(2) + v.y.powi(2)) - 0.5 * momentum
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -2.5 * (q.x.powi(2) + q.y.powi(2))
    }
}

#[test]
fn a_sleeping_top_stands_above_its_critical_spin() {
    // With z = x + i y: z̈ / 2 − i s ż − 5 z = 0 has the roots z ∝ e^{iνt}, ν = s ± √(s² − 10).
    for spin in (1..=100).map(|n| 0.1 * f64::from(n)) {
        let modes = at_rest(&Top { spin });
        let discriminant: f64 = spin * spin - 10.0;
        assert_eq!(is_stable(&modes), discriminant > 0.0, "{spin}: {modes:?}");
        let values = modes.iter().map(|mode| (mode.eigenvalue.re, mode.eigenvalue.im));
        let mut found: Vec<_> = values.collect();
        found.sort_by(|a, b| (a.0 + a.1).total_cmp(&(b.0 + b.1)));
        let root = discriminant.abs().sqrt();
        let expected = if discriminant > 0.0 {
            [(0.0, spin - root), (0.0, spin + root)]
        } else {
            [(-root, spin), (root, spin)]
        };
        assert_eq!(found.len(), 2);
        for (found, expected) in found.iter().zip(expected) {
            all_close([found.0, found.1], [expected.0, expected.1], 1e-12);
            if discriminant > 0.0 {
                assert_eq!(found.0, 0.0);
            }
        }
    }
}

/// The restricted three-body problem in the plane, in the frame that turns with both masses: 1 − μ at (−μ, 0)
/// and μ at (1 − μ, 0), both at rest.
struct ThreeBodies {
    ratio: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl ThreeBodies {
    #[kinetic]
    fn kinetic(&self, q: &Coordinates, v: &Velocities) -> f64 {
        0.5 * ((v.x - q.y).powi(2) + (v.y + q.x).powi(2))
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let near = ((q.x + self.ratio).powi(2) + q.y.powi(2)).sqrt();
        let far = ((q.x - 1.0 + self.ratio).powi(2) + q.y.powi(2)).sqrt();
        -(1.0 - self.ratio) / near - self.ratio / far
    }
}

#[test]
fn the_triangle_of_lagrange_is_stable_below_the_ratio_of_routh() {
    // λ⁴ + λ² + 27 μ (1 − μ) / 4 = 0 (Szebehely, *Theory of Orbits*, § 5.4).
    let critical = 0.5 * (1.0 - (23.0_f64 / 27.0).sqrt());
    for (ratio, is_below) in [0.001, 0.01, 0.012_150_585, 0.02, 0.03, critical - 1e-6, critical - 1e-10]
        .map(|ratio| (ratio, true))
        .into_iter()
        .chain([critical + 1e-10, critical + 1e-6, 0.04, 0.1, 0.3, 0.5].map(|ratio| (ratio, false)))
    {
        for side in [-1.0, 1.0] {
            let system = ThreeBodies { ratio };
            let rest = system.equilibrium([0.5 - ratio, side * 0.75_f64.sqrt()], &[]).unwrap();
            let modes = system.modes(&rest.state, &[]).unwrap();
            assert_eq!(modes.len(), 2);
            assert_eq!(is_stable(&modes), is_below, "{ratio}: {modes:?}");
            let product = 6.75 * ratio * (1.0 - ratio);
            if is_below {
                let root = (1.0 - 4.0 * product).sqrt();
                let expected = [(0.5 * (1.0 - root)).sqrt(), (0.5 * (1.0 + root)).sqrt()];
                // Where they meet, a rounding moves them by its root.
                all_close(frequencies(&modes), expected, (1e-14 / root).max(1e-13));
            } else {
                let root = (4.0 * product - 1.0).sqrt();
                close(modes[0].frequency(), product.sqrt().sqrt(), (1e-14 / root).max(1e-13));
                let mut growths = [modes[0].eigenvalue.re, modes[1].eigenvalue.re];
                growths.sort_by(f64::total_cmp);
                between(0.0, growths[1], 1.0);
                close(growths[0], -growths[1], 1e-9);
            }
        }
    }
}

/// Three free masses in a row with springs between them.
struct Train {
    c: f64,
    drag: f64,
}

#[lagrangian(coordinates = [x: [3]], jacobians)]
impl Train {
    #[point(mass = 0.1)]
    fn masses(&self, q: &Coordinates) -> [Vector1<f64>; 3] {
        q.x.map(Vector1::new)
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        q.x.windows(2).map(|pair| 0.35 * (pair[1] - pair[0]).powi(2)).sum()
    }

    #[dissipation]
    fn dampers(&self, v: &Velocities) -> f64 {
        let between: f64 = v.x.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        let along: f64 = v.x.iter().map(|v| v.powi(2)).sum();
        0.5 * (self.c * between + self.drag * along)
    }
}

#[test]
fn a_free_motion_counts_once_damped_or_not() {
    // λ² + (d + c s) λ / m + k s / m = 0 with s = 0, 1, 3.
    for (c, drag) in [(0.0, 0.0), (0.013, 0.0), (0.013, 0.07), (0.0, 0.07)] {
        let modes = at_rest(&Train { c, drag });
        let zeros: Vec<_> = modes.iter().filter(|mode| mode.frequency() == 0.0).collect();
        assert_eq!(zeros.len(), 1, "{modes:?}");
        for x in &zeros[0].shape {
            close(x.re, (1.0 / 0.3_f64).sqrt(), 1e-13);
            close(x.im, 0.0, 1e-13);
        }
        // Under drag a velocity that fades is a mode of its own.
        let decays = usize::from(drag > 0.0);
        assert_eq!(modes.len(), 3 + decays);
        if drag > 0.0 {
            close(modes[1].eigenvalue.re, -0.7, 1e-13);
        }
        for (mode, s) in modes[1 + decays..].iter().zip([1.0, 3.0]) {
            let decay = 0.5 * (drag + c * s) / 0.1;
            all_close([mode.eigenvalue.re, mode.frequency()], [-decay, (7.0_f64 * s).sqrt()], 1e-13);
        }
    }
}

#[test]
fn free_points_have_as_many_zeros_as_ways_to_go() {
    for c in [0.0, 0.3] {
        let modes = at_rest(&Slot { stiff: 0.0, soft: 0.0, c });
        let zeros: Vec<_> = modes.iter().filter(|mode| mode.frequency() == 0.0).collect();
        assert_eq!((zeros.len(), modes.len()), (2, 2 + usize::from(c > 0.0)));
        let determinant = zeros[0].shape[0] * zeros[1].shape[1] - zeros[0].shape[1] * zeros[1].shape[0];
        assert!(determinant.re.abs() > 0.1, "{determinant}");
    }
}

/// A bead on a ring in the plane, in Cartesian coordinates.
struct Ring;

#[lagrangian(coordinates = [x, y], jacobians)]
impl Ring {
    #[point(mass = 1.0)]
    fn bead(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn ring(&self, q: &Coordinates) -> f64 {
        q.x.powi(2) + q.y.powi(2) - 1.0
    }
}

#[test]
fn about_a_motion_the_equations_are_frozen() {
    // The bead goes round and does not oscillate, but (x, y) deviates along the momentary tangent by δẍ =
    // −(v/r)² δx.
    for angle in [0.0_f64, 0.3, 1.0, 2.0] {
        let state = State::new([angle.cos(), angle.sin()], [-2.0 * angle.sin(), 2.0 * angle.cos()]);
        let modes = Ring.modes(&state, &[]).unwrap();
        assert_eq!(modes.len(), 1);
        close(modes[0].frequency(), 2.0, 1e-14);
    }
}

//! Floquet multipliers: Mathieu's equation, the figure-eight orbit, a whirling support.

use std::f64::consts::TAU;

use lagrangian::{Dual, prelude::*};
use nalgebra::{Complex, DMatrix, DVector};

use crate::support::close::{close, close_on};

/// x″ + (a − 2q cos 2t) x = 0.
struct Mathieu {
    a: f64,
    q: f64,
}

#[lagrangian(coordinates = [x], sensitivities = [self.a])]
impl Mathieu {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn potential(&self, q: &Coordinates, t: f64) -> f64 {
        0.5 * (self.a - 2.0 * self.q * (2.0 * t).cos()) * q.x.powi(2)
    }
}

/// A boundary of stability by its series (McLachlan, *Theory and Application of Mathieu Functions*, § 2.25;
/// DLMF 28.6.1–28.6.6), with the entry of the state-transition matrix over half a period that is zero there,
/// and the multiplier.
struct Boundary {
    name: &'static str,
    series: fn(f64) -> f64,
    entry: [usize; 2],
    multiplier: f64,
}

const BOUNDARIES: [Boundary; 5] = [
    Boundary { name: "a0", series: a0, entry: [1, 0], multiplier: 1.0 },
    Boundary { name: "a1", series: a1, entry: [0, 0], multiplier: -1.0 },
    Boundary { name: "b1", series: |q| a1(-q), entry: [1, 1], multiplier: -1.0 },
    Boundary { name: "a2", series: a2, entry: [1, 0], multiplier: 1.0 },
    Boundary { name: "b2", series: b2, entry: [0, 1], multiplier: 1.0 },
];

fn a0(q: f64) -> f64 {
    let s = q * q;
    s * (-0.5 + s * (7.0 / 128.0 + s * (-29.0 / 2304.0 + s * 68687.0 / 18_874_368.0)))
}

fn a1(q: f64) -> f64 {
    let high = 49.0 / 589_824.0 + q * (-55.0 / 9_437_184.0 - q * 83.0 / 35_389_440.0);
    let low = -1.0 / 64.0 + q * (-1.0 / 1536.0 + q * (11.0 / 36_864.0 + q * high));
    1.0 + q * (1.0 + q * (-0.125 + q * low))
}

fn a2(q: f64) -> f64 {
    let s = q * q;
    let high = 1_002_401.0 / 79_626_240.0 - s * 1_669_068_401.0 / 458_647_142_400.0;
    4.0 + s * (5.0 / 12.0 + s * (-763.0 / 13_824.0 + s * high))
}

fn b2(q: f64) -> f64 {
    let s = q * q;
    let high = -289.0 / 79_626_240.0 + s * 21_391.0 / 458_647_142_400.0;
    4.0 + s * (-1.0 / 12.0 + s * (5.0 / 13_824.0 + s * high))
}

#[test]
fn boundaries_of_mathieus_equation() {
    let q = 0.05;
    for Boundary { name, series, entry: [row, column], multiplier } in BOUNDARIES {
        // Newton's method on the entry, whose derivative by a is a second derivative of the motion.
        type Second = Dual<Dual<f64, 1>, 2>;
        let number = |x: f64| Second::constant(Dual::constant(x));
        let mut a = series(q) + 1e-4;
        for _ in 0..6 {
            let over = Mathieu { a, q }.over(|value, listed| {
                Second::constant(listed.map_or(Dual::constant(value), |_| Dual::variable(value, 0)))
            });
            let start = State::new(
                [Dual::variable(Dual::constant(0.0), 0)],
                [Dual::variable(Dual::constant(0.0), 1)],
            );
            let mut motion = over.simulate(start).with_tolerance(number(f64::EPSILON));
            let end = motion.advance_to(number(0.5 * std::f64::consts::PI)).unwrap();
            let Dual { value, slopes: [slope] } = [end.q[0], end.v[0]][row].slopes[column];
            a -= value / slope;
        }
        println!("{name}");
        close_on(series(q).abs().max(1.0), a, series(q), 1e-13);
        let found =
            Mathieu { a, q }.variational().monodromy(State::at_rest([0.0]), std::f64::consts::PI).unwrap();
        // A double multiplier is known to the root of a rounding.
        for found in &found.multipliers {
            close_on(1.0, found.re, multiplier, 1e-7);
            close_on(1.0, found.im, 0.0, 1e-7);
        }
        // Inside the tongues unstable, outside stable with multipliers of modulus 1.
        let modulus = |a: f64| {
            let found = Mathieu { a, q }
                .variational()
                .monodromy(State::at_rest([0.0]), std::f64::consts::PI)
                .unwrap();
            found.multipliers[0].re.hypot(found.multipliers[0].im)
        };
        let inward = if matches!(name, "a0" | "a1" | "a2") { -1e-5 } else { 1e-5 };
        assert!(modulus(a + inward) > 1.0 + 1e-6, "{name}: unstable inside");
        close(modulus(a - inward), 1.0, 1e-13);
    }
}

/// Three bodies of mass 1 in a plane, G = 1.
struct Bodies;

#[lagrangian(coordinates = [r: [6]], jacobians)]
impl Bodies {
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        (0..6).map(|i| 0.5 * v.r[i].powi(2)).sum::<f64>()
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        let mut sum = 0.0;
        for i in 0..3 {
            for j in 0..i {
                sum -= 1.0 / Vector2::new(q.r[2 * i] - q.r[2 * j], q.r[2 * i + 1] - q.r[2 * j + 1]).norm();
            }
        }
        sum
    }
}

/// Bodies 1 and 2 opposite each other, the third one between them.
fn aligned([x, y, vx, vy]: [f64; 4]) -> State<f64, 6> {
    State::new([x, y, -x, -y, 0.0, 0.0], [vx, vy, vx, vy, -2.0 * vx, -2.0 * vy])
}

#[test]
fn the_figure_eight_is_stable() {
    // Chenciner and Montgomery, *A remarkable periodic solution of the three-body problem in the case of
    // equal masses*, Annals of Mathematics 152, 2000: eight digits, made sixteen by Newton's method with
    // the monodromy matrix.
    let mut start = [0.970_004_36, -0.243_087_53, 0.932_407_37 / 2.0, 0.864_731_46 / 2.0];
    let mut period = 6.325_913_98;
    let varied = Bodies.variational();
    let motion = |start, period: f64| {
        varied.motion(aligned(start)).unwrap().with_tolerance(f64::EPSILON).advance_to(period).unwrap()
    };
    let mut lack = f64::INFINITY;
    for _ in 0..3 {
        let found = motion(start, period);
        let begin = aligned(start);
        let lacks: Vec<f64> = found.state.iter().zip(begin.iter()).map(|(end, start)| end - start).collect();
        lack = lacks.iter().fold(0.0, |most, x| x.abs().max(most));
        let rates = Bodies.accelerations(&found.state).unwrap();
        let rate = |row: usize| if row < 6 { found.state.v[row] } else { rates[row - 6] };
        let columns: [State<f64, 6>; 4] =
            std::array::from_fn(|k| aligned(std::array::from_fn(|i| f64::from(u8::from(i == k)))));
        let slopes = DMatrix::from_fn(12, 5, |row, column| match columns.get(column) {
            None => rate(row),
            Some(direction) => {
                let moved = direction.iter().enumerate().map(|(j, x)| found.entry(row, j) * x).sum::<f64>();
                moved - direction.iter().nth(row).unwrap()
            }
        });
        // Orbits in other sizes and directions are as good: the nearest one.
        let change = slopes.svd(true, true).solve(&DVector::from_vec(lacks), 1e-6).unwrap();
        start = std::array::from_fn(|i| start[i] - change[i]);
        period -= change[4];
    }
    assert!(lack < 1e-13, "closed to {lack:e}");
    let found = varied.monodromy(aligned(start), period).unwrap().multipliers;
    // The state-transition matrix by a Taylor series of order 44 in numbers of 42 digits, written by hand for
    // these equations, about the orbit closed to 1e-35. Eight multipliers are 1, with Jordan blocks;
    // Roberts, *Linear stability analysis of the figure-eight orbit in the three-body problem*, Ergodic
    // Theory and Dynamical Systems 27, 2007, has these pairs to eight digits.
    for expected in [
        Complex::new(-0.297_596_667_518_712_9, 0.954_691_690_275_848_5),
        Complex::new(0.998_599_982_092_038_4, 0.052_896_840_792_060_63),
    ] {
        for expected in [expected, expected.conj()] {
            let distance = |x: &Complex<f64>| (x - expected).norm();
            let nearest = found.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
            close_on(1.0, nearest.re, expected.re, 1e-12);
            close_on(1.0, nearest.im, expected.im, 1e-12);
        }
    }
    let ones = found.iter().filter(|x| (*x - Complex::new(1.0, 0.0)).norm() < 1e-4).count();
    assert_eq!((found.len(), ones), (12, 8));
}

/// Kapitza's pendulum, whose support moves up and down: by its angle, and on a rod.
struct Shaken {
    amplitude: f64,
}

#[lagrangian(coordinates = [phi], jacobians)]
impl Shaken {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        Vector2::new(q.phi.sin(), self.amplitude * (20.0 * t).cos() + q.phi.cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates, t: f64) -> f64 {
        9.81 * self.bob(q, t).y
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities) -> f64 {
        0.05 * v.phi.powi(2)
    }
}

struct ShakenRod {
    amplitude: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl ShakenRod {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    fn arm(&self, q: &Coordinates, t: f64) -> Vector2<f64> {
        Vector2::new(q.x, q.y - self.amplitude * (20.0 * t).cos())
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates, t: f64) -> f64 {
        self.arm(q, t).norm() - 1.0
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * q.y
    }

    /// ½ c φ̇², with φ̇ = r × ṙ on the circle about the support.
    #[dissipation]
    fn bearing(&self, q: &Coordinates, v: &Velocities, t: f64) -> f64 {
        let up = v.y + 20.0 * self.amplitude * (20.0 * t).sin();
        let r = self.arm(q, t);
        0.05 * (r.y * v.x - r.x * up).powi(2)
    }
}

#[test]
fn a_shaken_support_holds_a_pendulum_upright() {
    let period = std::f64::consts::PI / 10.0;
    // Stable where the amplitude is above √(2 g l) / ω = 0.22, for small amplitudes.
    for (amplitude, is_stable) in [(0.1, false), (0.2, false), (0.26, true), (0.3, true)] {
        let by_angle = Shaken { amplitude }.variational().monodromy(State::at_rest([0.0]), period).unwrap();
        let start = State::new([0.0, 1.0 + amplitude], [0.0, 0.0]);
        let on_rod = ShakenRod { amplitude }.variational().monodromy(start, period).unwrap();
        assert_eq!((by_angle.multipliers.len(), on_rod.multipliers.len()), (2, 2));
        for (found, expected) in on_rod.multipliers.iter().zip(&by_angle.multipliers) {
            close(found.re, expected.re, 1e-12);
            close(found.im, expected.im, 1e-12);
        }
        let largest = by_angle.multipliers[0];
        assert_eq!(largest.re.hypot(largest.im) < 1.0, is_stable, "{amplitude}: {largest}");
        // Liouville: the product is exp(∫ trace) with damping c/m = 0.1.
        let product = by_angle.multipliers[0] * by_angle.multipliers[1];
        close(product.re, (-0.1 * period).exp(), 1e-13);
    }
}

/// A bob on a rod, in space.
struct Conical {
    length: f64,
    gravity: f64,
}

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Conical {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector3<f64> {
        Vector3::new(q.x, q.y, q.z)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.gravity * q.z
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

#[test]
fn multipliers_under_constraints_have_no_units() {
    // A conical pendulum at the angle θ has multipliers 1, 1 and exp(±2πi √(1 + 3 cos²θ)).
    let angle = 0.9_f64;
    let turn = TAU * (1.0 + 3.0 * angle.cos().powi(2)).sqrt();
    for second in [1.0, 1e3, 1e-3, 1e9, 1e-9, 1e15, 1e-15] {
        for metre in [1.0, 1e-9, 1e12] {
            let (length, gravity) = (1.3 * metre, 9.81 * metre / (second * second));
            let rate = (gravity / (length * angle.cos())).sqrt();
            let speed = rate * length * angle.sin();
            let state = State::new([length * angle.sin(), 0.0, -length * angle.cos()], [0.0, speed, 0.0]);
            let pendulum = Conical { length, gravity };
            let start = pendulum.consistent(state).unwrap();
            let found = pendulum.variational().monodromy(start, TAU / rate).unwrap().multipliers;
            for sign in [1.0, -1.0] {
                let expected = Complex::new(turn.cos(), sign * turn.sin());
                let nearest = found.iter().map(|x| (x - expected).norm()).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-13, "{second:e} {metre:e}: {found:?}");
            }
            // Equal multipliers are uncertain by the root of a rounding.
            let ones = found.iter().filter(|x| (*x - 1.0).norm() < 1e-6).count();
            assert_eq!(ones, 2, "{second:e} {metre:e}: {found:?}");
        }
    }
}

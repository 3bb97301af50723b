//! The true motion along a known curve of configurations q(s): energy gives the speed, quadrature the time.
//!
//! On a branch of its motions a linkage of one degree of freedom is a bead on a curve that is smooth even
//! where branches cross. With v = q′(s) ds/dt, T = m(s) (ds/dt)²/2 and dt = √(m(s) / 2(E − V(s))) ds. Nothing
//! of the library but the energies of the description is used.

use lagrangian::prelude::*;

use super::runs::Run;

/// Nodes and weights of Gauss and Legendre on (−1, 1), five on one side; Abramowitz and Stegun, table 25.4, n
/// = 10.
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];
/// The length of an interval of quadrature in s. Motions turn by parts of a radian in it, so ten nodes are
/// good to 1e-15, unless the motion comes close to rest.
const INTERVAL: f64 = 0.02;
/// How often an interval is halved where its halves differ from the whole.
const HALVINGS: u32 = 12;

/// A configuration and its derivative by the parameter.
pub type Point<const N: usize> = ([f64; N], [f64; N]);

/// A run that starts at s₀ with the rate ds/dt₀. After a share of its span [s] it is regular again. `None`
/// where the motion comes to rest.
pub fn run<S, const N: usize>(
    system: S,
    curve: impl Fn(f64) -> Point<N>,
    s0: f64,
    rate: f64,
    span: f64,
    share: f64,
) -> Option<Run<S, N>>
where
    S: System<N, 0, Scalar = f64>,
{
    let (start, regular) = motion(&system, &curve, s0, rate, share * span)?;
    let (_, end) = motion(&system, &curve, s0, rate, span)?;
    Some(Run { system, start, offset: s0, regular, end })
}

/// A motion that starts at s₀ with the rate ds/dt₀; its start, and its state at `span`. `None` where it comes
/// to rest before.
fn motion<S, const N: usize>(
    system: &S,
    curve: impl Fn(f64) -> Point<N>,
    s0: f64,
    rate: f64,
    span: f64,
) -> Option<(State<f64, N>, State<f64, N>)>
where
    S: System<N, 0, Scalar = f64>,
{
    let constants = system.constants();
    let energy = |q: &[f64; N], v: &[f64; N]| system.energy_at(&constants, 0.0, q, v);
    let (q, tangent) = curve(s0);
    let start = State::new(q, tangent.map(|x| x * rate));
    let total = energy(&start.q, &start.v);
    // |ds/dt|; NaN where the motion does not get.
    let speed = |s: f64| {
        let (q, tangent) = curve(s);
        let potential = energy(&q, &[0.0; N]);
        let mass = 2.0 * (energy(&q, &tangent) - potential);
        (2.0 * (total - potential) / mass).sqrt()
    };
    let time = |from: f64, to: f64| quadrature(&|s| 1.0 / speed(s), from, to, HALVINGS);
    let (mut s, mut left, direction) = (s0, span, rate.signum());
    loop {
        let next = s + direction * INTERVAL;
        let needed = time(s, next);
        if !needed.is_finite() || speed(next) < 0.05 * rate.abs() {
            return None;
        }
        if needed > left {
            break;
        }
        (s, left) = (next, left - needed);
    }
    // The end is in the next interval, and so are Newton's iterates. Beyond it speeds may be NaN.
    let (from, next) = (s, s + direction * INTERVAL);
    for _ in 0..20 {
        s += direction * speed(s) * (left - time(from, s));
        s = s.clamp(from.min(next), from.max(next));
    }
    let missed = (left - time(from, s)).abs();
    if missed.is_nan() || missed > 1e-14 * span.max(1.0) {
        return None;
    }
    let (q, tangent) = curve(s);
    let v = tangent.map(|x| x * direction * speed(s));
    Some((start, State::new(q, v).at_time(span)))
}

/// The integral of a function, whatever the direction: by halves where these differ from the whole.
fn quadrature(f: &impl Fn(f64) -> f64, from: f64, to: f64, halvings: u32) -> f64 {
    let rule = |from: f64, to: f64| {
        let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
        let pair = |(x, w): (f64, f64)| w * (f(middle + half * x) + f(middle - half * x));
        half.abs() * GAUSS.into_iter().map(pair).sum::<f64>()
    };
    let middle = (from + to) / 2.0;
    let (whole, halves) = (rule(from, to), rule(from, middle) + rule(middle, to));
    if halvings == 0 || (whole - halves).abs() <= 4.0 * f64::EPSILON * halves || !halves.is_finite() {
        return halves;
    }
    quadrature(f, from, middle, halvings - 1) + quadrature(f, middle, to, halvings - 1)
}

/// `count` numbers between 1e-8 and 0.1, log-spaced, on either side of zero in turn.
pub fn offsets(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| {
        let size = 10_f64.powf(-8.0 + 7.0 * i as f64 / (count.max(2) - 1) as f64);
        if i % 2 == 0 { size } else { -size }
    })
}

/// A sequence of numbers in [0, 1) that is the same every time (SplitMix64; Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    /// The next one.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The next one between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

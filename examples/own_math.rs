//! Math of your own: a pendulum in a scalar whose sine and cosine come from a CORDIC, as some
//! microcontrollers have in hardware. On such a processor the function `rotate` would write an angle into a
//! register and read two numbers.

use std::error::Error;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use lagrangian::pictures::Chart;
use lagrangian::prelude::*;
use lagrangian::{One, Zero};

/// A number in single precision with sines and cosines of its own.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Cordic(pub f32);

/// atan 2⁻ⁱ, where 2³² is a full turn.
const ANGLES: [i32; 28] = [
    536_870_912,
    316_933_406,
    167_458_907,
    85_004_756,
    42_667_331,
    21_354_465,
    10_679_838,
    5_340_245,
    2_670_163,
    1_335_087,
    667_544,
    333_772,
    166_886,
    83_443,
    41_722,
    20_861,
    10_430,
    5_215,
    2_608,
    1_304,
    652,
    326,
    163,
    81,
    41,
    20,
    10,
    5,
];

/// Π cos atan 2⁻ⁱ, in units of 2⁻³⁰.
const SHORTENED: i32 = 652_032_874;

/// Cosine and sine, in units of 2⁻³⁰, of an angle of which 2³² is a full turn: additions and shifts alone.
fn rotate(angle: u32) -> (i32, i32) {
    // Quarter turns are exact. What remains is within an eighth of a turn.
    let quarter = angle.wrapping_add(1 << 29) >> 30;
    let mut rest = angle.wrapping_sub(quarter << 30) as i32;
    let (mut x, mut y) = (SHORTENED, 0);
    for (i, step) in ANGLES.into_iter().enumerate() {
        let (dx, dy) = (y >> i, x >> i);
        if rest >= 0 {
            (x, y, rest) = (x - dx, y + dy, rest - step);
        } else {
            (x, y, rest) = (x + dx, y - dy, rest + step);
        }
    }
    match quarter {
        0 => (x, y),
        1 => (-y, x),
        2 => (-x, -y),
        _ => (y, -x),
    }
}

macro_rules! operators {
    ($($operation:ident $method:ident $assignment:ident $assign:ident $sign:tt;)*) => {$(
        impl $operation for Cordic {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        }
        impl $assignment for Cordic {
            fn $assign(&mut self, other: Self) {
                *self = *self $sign other;
            }
        }
    )*};
}

operators! {
    Add add AddAssign add_assign +;
    Sub sub SubAssign sub_assign -;
    Mul mul MulAssign mul_assign *;
    Div div DivAssign div_assign /;
}

impl Neg for Cordic {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Sum for Cordic {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        Self(terms.map(|term| term.0).sum())
    }
}

impl Zero for Cordic {
    fn zero() -> Self {
        Self(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Cordic {
    fn one() -> Self {
        Self(1.0)
    }
}

/// The functions that a scalar must have; all others have defaults. Those that the pendulum does not call are
/// those of `f32`.
impl Real for Cordic {
    type Lane = Self;

    fn sin_cos(self) -> (Self, Self) {
        /// Units of the angle in a radian.
        const UNITS: f64 = 4_294_967_296.0 / std::f64::consts::TAU;
        // Full turns wrap around.
        let angle = (f64::from(self.0) * UNITS) as i64 as u32;
        let (cos, sin) = rotate(angle);
        let number = |fixed: i32| Self(fixed as f32 / (1 << 30) as f32);
        (number(sin), number(cos))
    }

    fn splat(lane: Self) -> Self {
        lane
    }
    fn largest(self) -> Self {
        self
    }
    fn from_f64(literal: f64) -> Self {
        Self(literal as f32)
    }
    fn atan2(self, x: Self) -> Self {
        Self(self.0.atan2(x.0))
    }
    fn exp(self) -> Self {
        Self(self.0.exp())
    }
    fn ln(self) -> Self {
        Self(self.0.ln())
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn signum(self) -> Self {
        Self(self.0.signum())
    }
    fn epsilon() -> Self {
        Self(f32::EPSILON)
    }
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    fn is_positive(self) -> bool {
        self.0 > 0.0
    }
}

/// A mass on a massless rod, in any scalar.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum<R> {
    /// Length of the rod \[m].
    pub length: R,
    /// Gravitational acceleration \[m/s²].
    pub g: R,
}

#[lagrangian(coordinates = [theta])]
impl<R: Real> Pendulum<R> {
    #[point(mass = R::one())]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta.sin(), -q.theta.cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        self.g * self.bob(q).y
    }
}

/// The pendulum at 1 kHz: every hundredth state, and the energy that it has gained.
fn swing<R: Real>(length: R, g: R, angle: R) -> Result<(Vec<State<R, 1>>, R), MotionError<R>> {
    let pendulum = Pendulum { length, g };
    let mut motion = pendulum.stepper::<Jet<4>>(State::at_rest([angle]));
    let (released, mut states) = (motion.energy(), Vec::new());
    for step in 0..10_000 {
        if step % 100 == 0 {
            states.push(*motion.state());
        }
        motion.step(R::from_f64(1e-3), &[])?;
    }
    Ok((states, motion.energy() - released))
}

/// Swings in the scalar of the CORDIC and in double precision, and compares.
pub fn main() -> Result<(), Box<dyn Error>> {
    let numbers = [0.5, 9.81, 2.0];
    let [length, g, angle] = numbers.map(Cordic::from_f64);
    let (found, gained) = swing(length, g, angle).map_err(|error| format!("{error}"))?;
    // The same numbers as in single precision, so that the pendulums are equal.
    let [length, g, angle] = numbers.map(|number| f64::from(number as f32));
    let (exact, _) = swing(length, g, angle)?;

    println!("  t [s]   pole [rad]   error of the CORDIC [rad]");
    let mut worst = 0.0_f64;
    for (step, (found, exact)) in found.iter().zip(&exact).enumerate() {
        let error = f64::from(found.q[0].0) - exact.q[0];
        worst = worst.max(error.abs());
        if step % 10 == 0 {
            println!("{:7.2} {:12.6} {error:15.1e}", exact.t, exact.q[0]);
        }
    }
    println!("\nLargest error {worst:.1e} rad; gained energy {:.1e} J", gained.0);

    let angle = Chart::new("A pendulum with a CORDIC", "time [s]", "angle [rad]")
        .line("double precision", exact.iter().map(|state| (state.t, state.q[0])))
        .line("CORDIC", found.iter().map(|state| (f64::from(state.t.0), f64::from(state.q[0].0))));
    println!("Drawn: {}", angle.save("target/own_math.svg")?.display());

    assert!(worst < 2e-5, "the CORDIC is off by {worst} rad");
    assert!(gained.0.abs() < 1e-5, "the energy grew by {} J", gained.0);
    Ok(())
}

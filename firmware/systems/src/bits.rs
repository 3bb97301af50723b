//! The bits of motions. The library promises that they are equal on every target.

use core::fmt::{self, Write};

use lagrangian::prelude::*;
use lagrangian::{Adaptive, FixedStep, Held};

use crate::{CartPole, DoublePendulum, Experiment, Rod, Spring, Visitor, each, functions, run};

/// Steps of a motion.
const STEPS: u32 = 512;

/// The number of steps from one printed state to the next.
const PRINTED: u32 = 128;

/// Length of a step \[s]: a number without rounding.
const H: f64 = 1.0 / 128.0;

/// A scalar whose bits can be seen.
pub trait Bits: Ordered + fmt::Debug {
    /// Its name in the results.
    const NAME: &'static str;

    /// How many hexadecimal digits its bits have.
    const DIGITS: usize;

    /// The bits.
    fn bits(self) -> u64;

    /// The value as a double.
    fn value(self) -> f64;
}

impl Bits for f32 {
    const NAME: &'static str = "f32";
    const DIGITS: usize = 8;

    fn bits(self) -> u64 {
        self.to_bits().into()
    }

    fn value(self) -> f64 {
        self.into()
    }
}

impl Bits for f64 {
    const NAME: &'static str = "f64";
    const DIGITS: usize = 16;

    fn bits(self) -> u64 {
        self.to_bits()
    }

    fn value(self) -> f64 {
        self
    }
}

/// FNV-1a over the bits of numbers.
#[derive(Clone, Copy, Debug)]
pub struct Hash(u64);

impl Default for Hash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hash {
    /// Takes a number.
    pub fn add(&mut self, number: impl Bits) {
        for byte in number.bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Takes a state, with its time.
    pub fn add_state<R: Bits>(&mut self, state: &State<R, 2>) {
        self.add(state.t);
        for number in state.iter() {
            self.add(number);
        }
    }
}

impl fmt::Display for Hash {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{:016x}", self.0)
    }
}

/// Writes the bits of the elementary functions, and of motions of all systems but the puck. A motion has a
/// line for each printed state, and a line with the hash of all states.
///
/// # Errors
/// Where the text cannot be written.
pub fn report(out: &mut dyn Write) -> fmt::Result {
    scalar::<f32>(out)?;
    scalar::<f64>(out)
}

fn scalar<R: Bits>(out: &mut dyn Write) -> fmt::Result {
    functions::report::<R>(out)?;
    let mut lines = Lines(out);
    each::<R, _>(&mut lines)?;
    lines.visit::<Spring<R>, Leapfrog, 0>("leapfrog")?;
    lines.visit::<Spring<R>, Yoshida8, 0>("yoshida8")?;
    lines.visit::<Spring<R>, BlanesMoan6, 0>("blanes_moan6")?;
    lines.visit::<Spring<R>, Gauss6, 0>("gauss6")?;
    lines.adaptive::<DoublePendulum<R>, Jets, 0>("simulate")?;
    lines.adaptive::<Rod<R>, Jets, 0>("simulate")?;
    lines.adaptive::<CartPole<R>, Jets, 1>("simulate")?;
    lines.adaptive::<DoublePendulum<R>, Dop853, 0>("dop853")
}

struct Lines<'a>(&'a mut dyn Write);

impl<R: Bits> Visitor<R> for Lines<'_> {
    type Error = fmt::Error;

    // A function of its own for each motion: the stacks of all motions together are too large for a small
    // target.
    #[inline(never)]
    fn visit<S, M, const K: usize>(&mut self, method: &'static str) -> fmt::Result
    where
        S: Experiment<K, Scalar = R>,
        M: FixedStep<S, 2, K>,
    {
        let mut motion = Motion::new(self.0, S::NAME, method);
        let result = run::<S, M, K>(R::from_f64(H), STEPS, |state| motion.show(state));
        motion.end(result)
    }
}

impl Lines<'_> {
    /// A motion under error control, sampled at the instants of the fixed steps.
    #[inline(never)]
    fn adaptive<S, M, const K: usize>(&mut self, method: &'static str) -> fmt::Result
    where
        S: Experiment<K>,
        S::Scalar: Bits,
        M: Adaptive<S, Held<S::Scalar, K>, 2, K>,
    {
        let mut lines = Motion::new(self.0, S::NAME, method);
        let system = S::new();
        let mut motion = system.simulate_with::<M>(S::start());
        let result = motion
            .every(S::Scalar::from_f64(H))
            .skip(1)
            .take(STEPS as usize)
            .try_for_each(|state| state.map(|state| lines.show(&state)));
        lines.end(result)
    }
}

/// The lines of one motion.
struct Motion<'a> {
    out: &'a mut dyn Write,
    system: &'static str,
    method: &'static str,
    hash: Hash,
    shown: u32,
    result: fmt::Result,
}

impl<'a> Motion<'a> {
    fn new(out: &'a mut dyn Write, system: &'static str, method: &'static str) -> Self {
        Self { out, system, method, hash: Hash::default(), shown: 0, result: Ok(()) }
    }

    fn show<R: Bits>(&mut self, state: &State<R, 2>) {
        self.hash.add_state(state);
        self.shown += 1;
        if self.shown.is_multiple_of(PRINTED) {
            self.result = self.result.and_then(|()| self.line(state));
        }
    }

    fn line<R: Bits>(&mut self, state: &State<R, 2>) -> fmt::Result {
        write!(self.out, "{} {} {} step {}:", self.system, self.method, R::NAME, self.shown)?;
        for number in state.iter() {
            write!(self.out, " {:0width$x}", number.bits(), width = R::DIGITS)?;
        }
        writeln!(self.out)
    }

    fn end<R: Bits>(self, motion: Result<(), MotionError<R>>) -> fmt::Result {
        self.result?;
        let Self { out, system, method, hash, shown, .. } = self;
        match motion {
            Ok(()) => writeln!(out, "{system} {method} {} all {shown} steps: {hash}", R::NAME),
            Err(error) => {
                writeln!(out, "{system} {method} {} failed after {shown} steps: {error:?}", R::NAME)
            }
        }
    }
}

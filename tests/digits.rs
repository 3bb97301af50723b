//! The scalar of 31 digits: its functions against mpmath, constants of descriptions, and motions against
//! references.

use lagrangian::prelude::*;
use lagrangian::{Adaptive, DoubleDouble, Held};

fn number(text: &str) -> DoubleDouble {
    text.parse().expect("a decimal")
}

/// |value − expected| relative to what is expected.
fn error(value: DoubleDouble, expected: DoubleDouble) -> f64 {
    ((value - expected) / expected).high().abs()
}

/// Every function at arguments of all sizes: near zero, beside zeros, at the ends of the range.
/// `data/functions.py` made the table with mpmath.
#[test]
fn functions_agree_with_mpmath() {
    let mut count = 0;
    for line in include_str!("data/functions.txt").lines() {
        let mut fields: Vec<&str> = line.split(' ').collect();
        let expected = number(fields.pop().unwrap());
        let name = fields.remove(0);
        let parts: Vec<f64> = fields.iter().map(|field| field.parse().unwrap()).collect();
        let arguments: Vec<_> =
            parts.chunks(2).map(|part| DoubleDouble::from_sum(part[0], part[1])).collect();
        let x = arguments[0];
        let y = *arguments.last().unwrap();
        let value = match name {
            "sin" => x.sin(),
            "cos" => x.cos(),
            "tan" => x.tan(),
            "asin" => x.asin(),
            "acos" => x.acos(),
            "atan" => x.atan(),
            "atan2" => x.atan2(y),
            "sinh" => x.sinh(),
            "cosh" => x.cosh(),
            "tanh" => x.tanh(),
            "asinh" => x.asinh(),
            "acosh" => x.acosh(),
            "atanh" => x.atanh(),
            "exp" => x.exp(),
            "exp_m1" => x.exp_m1(),
            "ln" => x.ln(),
            "ln_1p" => x.ln_1p(),
            "sqrt" => x.sqrt(),
            "cbrt" => x.cbrt(),
            "powf" => x.powf(y),
            "hypot" => x.hypot(y),
            other => panic!("{other}"),
        };
        // A power has the error of its exponent, which is y ln x; all others are right to three units of
        // 2⁻¹⁰⁴.
        let condition = if name == "powf" { 1.0 + (y * x.abs().ln()).high().abs() } else { 1.0 };
        let bound = 3.0 * condition * DoubleDouble::epsilon().high();
        // A smaller result has lost digits of its low part to underflow.
        let lost = if expected.high().abs() < 1e-291 { 1e-323 / expected.high().abs() } else { 0.0 };
        assert!(error(value, expected) <= bound + lost, "{line}: {value:e}, {:e}", error(value, expected));
        count += 1;
    }
    assert_eq!(count, 820);
}

/// Constants that are no doubles, in positions that rewriting, folding and generated code each see.
struct Constants<R> {
    mass: R,
}

#[lagrangian(coordinates = [x])]
impl<R: Real> Constants<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        self.mass * v.x.powi(2) * R::from_f64(0.05)
    }

    /// The factor 1e-60 · 1e60 is made of numbers that no ratio of 128 bits holds.
    #[potential]
    fn potential(&self, q: &Coordinates<R>) -> R {
        self.one_third() * q.x + 0.3 * R::pi() * q.x * 1e-60 * 1e60 + R::pi() * R::pi() * q.x
    }

    fn one_third(&self) -> R {
        R::one() / 3.0
    }
}

/// Literals have all digits in functions that are called as ordinary Rust, too.
#[test]
fn literals_have_all_digits() {
    let system = Constants { mass: number("0.7") };
    let velocities = [number("1")].into();
    // 0.7 · 0.05 = 0.035.
    assert!(error(system.kinetic(&velocities), number("0.035")) < 4e-32);
    // −(1/3 + 0.3 π + π²)/(0.1 · 0.7), by mpmath with 50 digits.
    let expected = number(ACCELERATION);
    let accelerations = system.accelerations(&State::at_rest([number("0")])).unwrap();
    assert!(error(accelerations[0], expected) < 2e-31, "{}", accelerations[0]);
}

/// `nstr(-(mpf(1)/3 + pi*3/10 + pi**2)*1000/70, 40)`.
const ACCELERATION: &str = "-159.2202218642804274815231049741905047701";

/// A mass of 0.3 on a spring of 0.1.
struct Oscillator<R> {
    unit: R,
}

#[lagrangian(coordinates = [x])]
impl<R: Real> Oscillator<R> {
    #[kinetic]
    fn kinetic(&self, v: &Velocities<R>) -> R {
        0.15 * v.x.powi(2)
    }

    #[potential]
    fn potential(&self, q: &Coordinates<R>) -> R {
        0.05 * q.x.powi(2) / self.unit
    }
}

struct Kepler<R> {
    mu: R,
}

#[lagrangian(coordinates = [r: [2]])]
impl<R: Real> Kepler<R> {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.r[0], q.r[1])
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        -self.mu / self.planet(q).norm()
    }
}

struct DoublePendulum<R> {
    length: R,
}

#[lagrangian(coordinates = [theta: [2]])]
impl<R: Real> DoublePendulum<R> {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) * self.length
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        9.81 * (self.upper(q).y + self.lower(q).y)
    }
}

struct Cartesian<R> {
    length: R,
}

#[lagrangian(coordinates = [x, y])]
impl<R: Real> Cartesian<R> {
    #[point(mass = 0.7)]
    fn bob(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        0.7 * 9.81 * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates<R>) -> R {
        q.x.powi(2) + q.y.powi(2) - self.length.powi(2)
    }
}

/// The largest relative error of a motion at a time, at a tolerance. The numbers of a reference are
/// coordinates, then velocities.
fn deviation<S, const N: usize>(
    system: &S,
    start: State<DoubleDouble, N>,
    (t, tolerance): (i32, &str),
    reference: &[&str],
) -> f64
where
    S: System<N, Scalar = DoubleDouble>,
    S::Method: Adaptive<S, Held<DoubleDouble, 0>, N, 0>,
{
    let mut motion = system.simulate(start).with_tolerance(number(tolerance));
    let end = *motion.advance_to(DoubleDouble::from(t)).expect("a motion");
    assert_eq!(reference.len(), 2 * N);
    let values = end.q.into_iter().chain(end.v);
    values.zip(reference).map(|(value, text)| error(value, number(text))).fold(0.0, f64::max)
}

/// x = cos(t/√3): `data/motions.py`.
#[test]
fn harmonic_oscillator() {
    let start = State::at_rest([number("1")]);
    let reference =
        ["-0.6217202304626897360407972093500763032572", "0.4522034774425557059491989446441683367453"];
    let error = deviation(&Oscillator { unit: number("1") }, start, (7, "1e-30"), &reference);
    assert!(error < 1e-29, "{error:e}");
}

/// Three periods with e = 0.6, by Kepler's equation: `data/motions.py`.
#[test]
fn kepler_ellipse() {
    let start = State::new([number("0.4"), number("0")], [number("0"), number("2")]);
    let reference = [
        "-0.7700755784112404492717701985415769947592",
        "0.7883448169944243890645961243374850750966",
        "-0.8941837319886914970330716056332336820637",
        "-0.1234617641584409588118906993361540508961",
    ];
    let error = deviation(&Kepler { mu: number("1") }, start, (20, "1e-30"), &reference);
    assert!(error < 1e-28, "{error:e}");
}

/// Chaos: a change of the start by 1e-22 has grown to 7e-19 of a velocity, so one rounding is 3.5e-28 there
/// and 1e-28 of the other numbers. Each of 700 steps adds roundings: of 60 starts beside this one the median
/// error is 0.6 of that rounding and the largest eight, with steps half as long, too. Doubles are right to
/// 2e-12. By extrapolation with 50 digits: `data/motions.py`.
#[test]
fn double_pendulum() {
    let start = State::at_rest([number("2"), number("2")]);
    let reference = [
        "-0.6021626106658539874301883936488950121736",
        "-10.50147451571451986513217896630837992697",
        "-6.242167095019846521533168050800176676963",
        "-4.897969663163112078753658261787229001054",
    ];
    let error = deviation(&DoublePendulum { length: number("1") }, start, (10, "1e-32"), &reference);
    assert!(error < 8.0 * 3.5e-28, "{error:e}");
}

/// A pendulum in Cartesian coordinates, held by a constraint, against elliptic functions: `data/motions.py`.
#[test]
fn constrained_pendulum() {
    let angle = number("1.5");
    let start = State::at_rest([angle.sin(), -angle.cos()]);
    let reference = [
        "-0.3827821563328435205626760696768613607396",
        "-0.9238386335249130200590228802603716431562",
        "-3.779601013621592251992424858635185613222",
        "1.566035207416836710510996106409259899412",
    ];
    let pendulum = Cartesian { length: number("1") };
    let error = deviation(&pendulum, start, (10, "1e-30"), &reference);
    assert!(error < 1e-28, "{error:e}");
}

/// The digits of a motion in doubles are those that its tolerance promises, and no more than doubles have.
#[test]
fn digits_follow_the_tolerance() {
    let exact = DoublePendulum { length: number("1") };
    let mut motion =
        exact.simulate(State::at_rest([number("2"), number("2")])).with_tolerance(number("1e-25"));
    let reference = *motion.advance_to(number("2")).unwrap();
    let rough = DoublePendulum { length: 1.0 };
    let digits = |tolerance: f64| {
        let mut motion = rough.simulate(State::at_rest([2.0, 2.0])).with_tolerance(tolerance);
        motion.advance_to(2.0).unwrap().digits_in_common(&reference).least()
    };
    let [coarse, fine] = [1e-5, 1e-13].map(digits);
    assert!((2.5..8.0).contains(&coarse), "{coarse}");
    assert!((11.0..15.7).contains(&fine), "{fine}");
}

/// A mass on a rough floor that sticks until the load has grown to a newton.
struct Pulled<R> {
    rates: [R; 2],
    limit: R,
}

#[lagrangian(coordinates = [x, y])]
impl<R: Real + PartialOrd> Pulled<R> {
    #[point(mass = 1.0)]
    fn mass(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, q.y)
    }

    #[force(at = mass)]
    fn load(&self, t: R) -> Vector2<R> {
        Vector2::new(self.rates[0] * t, self.rates[1] * t)
    }

    #[friction(limit = self.limit)]
    fn slip(&self, v: &Velocities<R>) -> Vector2<R> {
        Vector2::new(v.x, v.y)
    }
}

#[test]
fn a_slip_in_two_directions_begins_under_a_growing_load() {
    for rates in [["0.5", "-0.18"], ["1.3", "0.7"], ["-0.6", "2.0"]] {
        let rates = rates.map(number);
        let size = rates[0].hypot(rates[1]);
        let pulled = Pulled { rates, limit: number("1") };
        let mut motion = pulled.simulate(State::at_rest([number("0"); 2])).with_tolerance(number("1e-9"));
        let slid = number("3") - size.recip();
        let state = motion.advance_to(number("3")).unwrap();
        for (q, rate) in state.q.into_iter().zip(rates) {
            assert!(error(q, rate * slid.powi(3) / number("6")) < 1e-8);
        }
    }
}

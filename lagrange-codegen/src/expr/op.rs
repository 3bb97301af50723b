//! The operator list: every elementary function of the language, once.
//!
//! Sums and products are node kinds of their own; what stands here is opaque to the algebra.
//! A new function needs a line in each `match` below and in those of derivatives, formulas, sides of
//! kinks, guards and steep functions. None of these has a default arm, so the compiler names them.

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Unary {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent.
    Tan,
    /// Inverse sine.
    Asin,
    /// Inverse cosine.
    Acos,
    /// Inverse tangent.
    Atan,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
    /// One over the hyperbolic cosine, which does not overflow. Derivatives have it, Rust has not.
    Sech,
    /// 1/(1 + e⁻ˣ), whose exponential may overflow. Reciprocals of 1 + eˣ become it, Rust has not.
    Logistic,
    /// Inverse hyperbolic sine.
    Asinh,
    /// Inverse hyperbolic cosine.
    Acosh,
    /// Inverse hyperbolic tangent.
    Atanh,
    /// Exponential.
    Exp,
    /// Exponential minus one, accurate near zero.
    ExpM1,
    /// Natural logarithm.
    Ln,
    /// Logarithm of one plus the argument, accurate near zero.
    Ln1p,
    /// Cube root.
    Cbrt,
    /// Absolute value.
    Abs,
    /// Sign: 1 for positive arguments, −1 for negative ones.
    Signum,
    /// The argument where it is positive, else zero.
    PositivePart,
    /// One where the argument is not negative, else zero. A condition, with [`Unary::Below`] as its opposite.
    Step,
    /// One where the argument is negative, else zero.
    Below,
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Binary {
    /// The angle of the point (x, y), called as `y.atan2(x)`.
    Atan2,
    /// A power that is no product: its exponent is not a constant, not a half-integer, or above 32 in size.
    Powf,
    /// A power times the logarithm of its base, xʸ ln x: the derivative of a power by its exponent, with its
    /// limit where the power is zero.
    PowfLn,
    /// A pivot: the first argument, or NaN where it is below the rounding errors of the second.
    Pivot,
}

impl Unary {
    /// All functions of one argument.
    pub const ALL: [Unary; 24] = [
        Unary::Sin,
        Unary::Cos,
        Unary::Tan,
        Unary::Asin,
        Unary::Acos,
        Unary::Atan,
        Unary::Sinh,
        Unary::Cosh,
        Unary::Tanh,
        Unary::Sech,
        Unary::Logistic,
        Unary::Asinh,
        Unary::Acosh,
        Unary::Atanh,
        Unary::Exp,
        Unary::ExpM1,
        Unary::Ln,
        Unary::Ln1p,
        Unary::Cbrt,
        Unary::Abs,
        Unary::Signum,
        Unary::PositivePart,
        Unary::Step,
        Unary::Below,
    ];

    /// The name of the method in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Unary::Sin => "sin",
            Unary::Cos => "cos",
            Unary::Tan => "tan",
            Unary::Asin => "asin",
            Unary::Acos => "acos",
            Unary::Atan => "atan",
            Unary::Sinh => "sinh",
            Unary::Cosh => "cosh",
            Unary::Tanh => "tanh",
            Unary::Sech => "sech",
            Unary::Logistic => "logistic",
            Unary::Asinh => "asinh",
            Unary::Acosh => "acosh",
            Unary::Atanh => "atanh",
            Unary::Exp => "exp",
            Unary::ExpM1 => "exp_m1",
            Unary::Ln => "ln",
            Unary::Ln1p => "ln_1p",
            Unary::Cbrt => "cbrt",
            Unary::Abs => "abs",
            Unary::Signum => "signum",
            Unary::PositivePart => "positive_part",
            Unary::Step => "step",
            Unary::Below => "below",
        }
    }

    /// The function on doubles.
    pub fn evaluate(self, x: f64) -> f64 {
        match self {
            Unary::Sin => x.sin(),
            Unary::Cos => x.cos(),
            Unary::Tan => x.tan(),
            Unary::Asin => x.asin(),
            Unary::Acos => x.acos(),
            Unary::Atan => x.atan(),
            Unary::Sinh => x.sinh(),
            Unary::Cosh => x.cosh(),
            Unary::Tanh => x.tanh(),
            Unary::Sech => x.cosh().recip(),
            Unary::Logistic => (1.0 + (-x).exp()).recip(),
            Unary::Asinh => x.asinh(),
            Unary::Acosh => x.acosh(),
            Unary::Atanh => x.atanh(),
            Unary::Exp => x.exp(),
            Unary::ExpM1 => x.exp_m1(),
            Unary::Ln => x.ln(),
            Unary::Ln1p => x.ln_1p(),
            Unary::Cbrt => x.cbrt(),
            Unary::Abs => x.abs(),
            Unary::Signum => x.signum(),
            Unary::PositivePart => x.max(0.0),
            Unary::Step | Unary::Below if x.is_nan() => x,
            Unary::Step => f64::from(u8::from(x >= 0.0)),
            Unary::Below => f64::from(u8::from(x < 0.0)),
        }
    }

    /// The exact value at 0, where it is rational.
    pub fn at_zero(self) -> Option<i128> {
        match self {
            Unary::Sin
            | Unary::Tan
            | Unary::Asin
            | Unary::Atan
            | Unary::Sinh
            | Unary::Tanh
            | Unary::Asinh
            | Unary::Atanh
            | Unary::ExpM1
            | Unary::Ln1p
            | Unary::Cbrt
            | Unary::Abs
            | Unary::PositivePart
            | Unary::Below => Some(0),
            Unary::Cos | Unary::Cosh | Unary::Sech | Unary::Exp | Unary::Step => Some(1),
            Unary::Acos | Unary::Acosh | Unary::Ln | Unary::Logistic | Unary::Signum => None,
        }
    }

    /// How the function answers to a negated argument.
    pub fn parity(self) -> Parity {
        match self {
            Unary::Sin
            | Unary::Tan
            | Unary::Asin
            | Unary::Atan
            | Unary::Sinh
            | Unary::Tanh
            | Unary::Asinh
            | Unary::Atanh
            | Unary::Cbrt
            | Unary::Signum => Parity::Odd,
            Unary::Cos | Unary::Cosh | Unary::Sech | Unary::Abs => Parity::Even,
            Unary::Acos
            | Unary::Acosh
            | Unary::Exp
            | Unary::ExpM1
            | Unary::Ln
            | Unary::Ln1p
            | Unary::Logistic
            | Unary::PositivePart
            | Unary::Step
            | Unary::Below => Parity::Neither,
        }
    }
}

/// Symmetry of a function under x → −x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// f(−x) = −f(x).
    Odd,
    /// f(−x) = f(x).
    Even,
    /// Neither.
    Neither,
}

impl Binary {
    /// The name of the method in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Binary::Atan2 => "atan2",
            Binary::Powf => "powf",
            Binary::PowfLn => "powf_ln",
            Binary::Pivot => "pivot",
        }
    }

    /// The function on doubles.
    pub fn evaluate(self, x: f64, y: f64) -> f64 {
        match self {
            Binary::Atan2 => x.atan2(y),
            Binary::Powf => x.powf(y),
            Binary::PowfLn => {
                let power = x.powf(y);
                if power == 0.0 { 0.0 } else { power * x.ln() }
            }
            Binary::Pivot => {
                if x > 8.0 * f64::EPSILON * y {
                    x
                } else {
                    f64::NAN
                }
            }
        }
    }
}

//! The function table of the oracle: names in Rust, values, slopes. Written without a look at the
//! engine's table, so that a wrong derivative there has nothing to agree with here.

use std::f64::consts;

use crate::number::Number;

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    ExpM1,
    Exp2,
    Ln,
    Ln1p,
    Log2,
    Log10,
    Sqrt,
    Cbrt,
    Recip,
    Abs,
    Signum,
    ToRadians,
}

impl Function {
    /// All functions.
    pub const ALL: [Function; 25] = [
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Asin,
        Function::Acos,
        Function::Atan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Asinh,
        Function::Acosh,
        Function::Atanh,
        Function::Exp,
        Function::ExpM1,
        Function::Exp2,
        Function::Ln,
        Function::Ln1p,
        Function::Log2,
        Function::Log10,
        Function::Sqrt,
        Function::Cbrt,
        Function::Recip,
        Function::Abs,
        Function::Signum,
        Function::ToRadians,
    ];

    /// The method in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Asin => "asin",
            Function::Acos => "acos",
            Function::Atan => "atan",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Asinh => "asinh",
            Function::Acosh => "acosh",
            Function::Atanh => "atanh",
            Function::Exp => "exp",
            Function::ExpM1 => "exp_m1",
            Function::Exp2 => "exp2",
            Function::Ln => "ln",
            Function::Ln1p => "ln_1p",
            Function::Log2 => "log2",
            Function::Log10 => "log10",
            Function::Sqrt => "sqrt",
            Function::Cbrt => "cbrt",
            Function::Recip => "recip",
            Function::Abs => "abs",
            Function::Signum => "signum",
            Function::ToRadians => "to_radians",
        }
    }

    /// f(x).
    pub fn value(self, x: f64) -> f64 {
        match self {
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Tan => x.tan(),
            Function::Asin => x.asin(),
            Function::Acos => x.acos(),
            Function::Atan => x.atan(),
            Function::Sinh => x.sinh(),
            Function::Cosh => x.cosh(),
            Function::Tanh => x.tanh(),
            Function::Asinh => x.asinh(),
            Function::Acosh => x.acosh(),
            Function::Atanh => x.atanh(),
            Function::Exp => x.exp(),
            Function::ExpM1 => x.exp_m1(),
            Function::Exp2 => x.exp2(),
            Function::Ln => x.ln(),
            Function::Ln1p => x.ln_1p(),
            Function::Log2 => x.log2(),
            Function::Log10 => x.log10(),
            Function::Sqrt => x.sqrt(),
            Function::Cbrt => x.cbrt(),
            Function::Recip => x.recip(),
            Function::Abs => x.abs(),
            Function::Signum => x.signum(),
            Function::ToRadians => x.to_radians(),
        }
    }

    /// f′(x).
    pub fn slope<T: Number>(self, x: T) -> T {
        let one = T::constant(1.0);
        let number = T::constant;
        match self {
            Function::Sin => x.apply(Function::Cos),
            Function::Cos => -x.apply(Function::Sin),
            Function::Tan => x.apply(Function::Cos).powi(-2),
            Function::Asin => (one - x * x).apply(Function::Sqrt).powi(-1),
            Function::Acos => -(one - x * x).apply(Function::Sqrt).powi(-1),
            Function::Atan => one / (one + x * x),
            Function::Sinh => x.apply(Function::Cosh),
            Function::Cosh => x.apply(Function::Sinh),
            // As the recurrence of a series has it: where the function saturates, the digits of 1 − y²
            // cancel.
            Function::Tanh => {
                let y = x.apply(Function::Tanh);
                one - y * y
            }
            Function::Asinh => (x * x + one).apply(Function::Sqrt).powi(-1),
            Function::Acosh => (x * x - one).apply(Function::Sqrt).powi(-1),
            Function::Atanh => one / (one - x * x),
            Function::Exp | Function::ExpM1 => x.apply(Function::Exp),
            Function::Exp2 => number(consts::LN_2) * x.apply(Function::Exp2),
            Function::Ln => one / x,
            Function::Ln1p => one / (one + x),
            Function::Log2 => one / (number(consts::LN_2) * x),
            Function::Log10 => one / (number(consts::LN_10) * x),
            Function::Sqrt => number(0.5) / x.apply(Function::Sqrt),
            Function::Cbrt => number(1.0 / 3.0) / x.apply(Function::Cbrt).powi(2),
            Function::Recip => -x.powi(-2),
            Function::Abs => x.apply(Function::Signum),
            Function::Signum => number(0.0),
            Function::ToRadians => number(consts::PI / 180.0),
        }
    }
}

/// A function of two arguments, the receiver first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pair {
    Atan2,
    Hypot,
    Powf,
    Log,
}

impl Pair {
    /// All functions.
    pub const ALL: [Pair; 4] = [Pair::Atan2, Pair::Hypot, Pair::Powf, Pair::Log];

    /// The method in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Pair::Atan2 => "atan2",
            Pair::Hypot => "hypot",
            Pair::Powf => "powf",
            Pair::Log => "log",
        }
    }

    /// f(x, y).
    pub fn value(self, x: f64, y: f64) -> f64 {
        match self {
            Pair::Atan2 => x.atan2(y),
            Pair::Hypot => x.hypot(y),
            Pair::Powf => x.powf(y),
            Pair::Log => x.log(y),
        }
    }

    /// ∂f/∂x and ∂f/∂y.
    pub fn slopes<T: Number>(self, x: T, y: T) -> (T, T) {
        match self {
            Pair::Atan2 => {
                let square = x * x + y * y;
                (y / square, -x / square)
            }
            Pair::Hypot => {
                let hypotenuse = x.combine(Pair::Hypot, y);
                (x / hypotenuse, y / hypotenuse)
            }
            Pair::Powf => {
                let lowered = x.combine(Pair::Powf, y - T::constant(1.0));
                (y * lowered, x.combine(Pair::Powf, y) * x.apply(Function::Ln))
            }
            Pair::Log => {
                let base = y.apply(Function::Ln);
                (T::constant(1.0) / (x * base), -x.apply(Function::Ln) / (y * base * base))
            }
        }
    }
}

//! Random scalars and vectors.

use proptest::prelude::*;

use crate::expression::{Body, Expr, Operator, Vector};
use crate::function::{Function, Pair};

/// The variables that an expression may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Coordinates, time, parameters and constants.
    Position,
    /// The same and the two arguments of a helper function.
    Helper,
    /// Position and velocities.
    Motion,
    /// Motion and inputs.
    Force,
}

/// A choice that is resolved where it is used. It is small, because shrinking halves it.
pub fn index() -> std::ops::Range<usize> {
    0..120
}

pub fn operation(operator: Operator, a: Expr, b: Expr) -> Expr {
    Expr::Operation(operator, Box::new(a), Box::new(b))
}

pub fn call(function: Function, a: Expr) -> Expr {
    Expr::Call(function, Box::new(a))
}

fn combine(pair: Pair, a: Expr, b: Expr) -> Expr {
    Expr::Combine(pair, Box::new(a), Box::new(b))
}

pub fn plus(a: Expr, b: Expr) -> Expr {
    operation(Operator::Add, a, b)
}

pub fn times(a: Expr, b: Expr) -> Expr {
    operation(Operator::Multiply, a, b)
}

pub fn number(value: f64) -> Expr {
    Expr::Number(value)
}

/// Positive constants, some of them exact in binary, some not.
pub fn constant() -> BoxedStrategy<Expr> {
    prop_oneof![
        (1_u32..=16).prop_map(|n| Expr::Number(f64::from(n) / 8.0)),
        (1_u32..=20).prop_map(|n| Expr::Number(f64::from(n) / 10.0)),
        Just(Expr::Number(3.0)),
        Just(Expr::Number(1.0 / 3.0)),
    ]
    .boxed()
}

/// Positive values that stay the same: masses, lengths, stiffnesses.
pub fn fixed() -> BoxedStrategy<Expr> {
    prop_oneof![
        2 => constant(),
        4 => index().prop_map(Expr::Parameter),
        1 => Just(Expr::Ratio),
        1 => (constant(), index()).prop_map(|(a, i)| times(a, Expr::Parameter(i))),
        1 => index().prop_map(|i| call(Function::Sqrt, Expr::Parameter(i))),
    ]
    .boxed()
}

fn leaf(reach: Reach) -> BoxedStrategy<Expr> {
    let coordinate = index().prop_map(Expr::Coordinate);
    let local = index().prop_map(Expr::Local);
    let position = prop_oneof![
        6 => coordinate,
        1 => Just(Expr::Time),
        2 => fixed(),
        2 => local,
    ];
    match reach {
        Reach::Position => position.boxed(),
        Reach::Helper => prop_oneof![2 => position, 3 => index().prop_map(Expr::Argument)].boxed(),
        Reach::Motion => prop_oneof![2 => position, 2 => index().prop_map(Expr::Velocity)].boxed(),
        Reach::Force => prop_oneof![
            3 => position,
            2 => index().prop_map(Expr::Velocity),
            2 => index().prop_map(Expr::Input),
        ]
        .boxed(),
    }
}

/// x ↦ a value in [−1, 1].
fn bounded(shape: usize, x: Expr) -> Expr {
    match shape % 4 {
        0 => call(Function::Sin, x),
        1 => call(Function::Cos, x),
        2 => call(Function::Tanh, x),
        _ => times(number(0.6), call(Function::Atan, x)),
    }
}

/// x ↦ a value well above 0.
pub fn positive(shape: usize, x: Expr) -> Expr {
    match shape % 4 {
        0 => plus(number(1.5), bounded(shape / 4, x)),
        1 => plus(number(1.0), Expr::Power(Box::new(x), 2)),
        2 => call(Function::Exp, times(number(0.5), bounded(shape / 4, x))),
        _ => plus(times(x.clone(), x), number(0.75)),
    }
}

/// A function of one argument with its argument brought into the domain.
fn within_domain(function: Function, shape: usize, x: Expr) -> Expr {
    let argument = match function {
        Function::Sin
        | Function::Cos
        | Function::Atan
        | Function::Tanh
        | Function::Asinh
        | Function::Abs
        | Function::Signum
        | Function::ToRadians => x,
        Function::Tan | Function::Asin | Function::Acos | Function::Atanh | Function::Ln1p => {
            times(number(0.7), bounded(shape, x))
        }
        Function::Sinh | Function::Cosh | Function::Exp | Function::ExpM1 | Function::Exp2 => {
            bounded(shape, x)
        }
        Function::Acosh => plus(number(1.25), positive(shape, x)),
        Function::Ln
        | Function::Log2
        | Function::Log10
        | Function::Sqrt
        | Function::Cbrt
        | Function::Recip => positive(shape, x),
    };
    call(function, argument)
}

fn two_arguments(pair: Pair, shape: usize, x: Expr, y: Expr) -> Expr {
    match pair {
        // Away from the origin, where the angle is not defined.
        Pair::Atan2 if shape.is_multiple_of(3) => combine(pair, positive(shape / 3, x), y),
        Pair::Atan2 => combine(pair, x, positive(shape / 3, y)),
        Pair::Hypot => combine(pair, x, positive(shape, y)),
        Pair::Powf => combine(pair, positive(shape, x), bounded(shape / 2, y)),
        Pair::Log => combine(pair, positive(shape, x), plus(number(1.25), positive(shape / 2, y))),
    }
}

/// Powers with a constant exponent: halves become products in the engine, others do not.
fn constant_power(shape: usize, x: Expr) -> Expr {
    const EXPONENTS: [f64; 10] = [0.5, 1.5, 2.5, 3.5, 2.0, 0.25, 1.3, 3.0, 1.0, 0.1];
    let exponent = number(EXPONENTS[shape % EXPONENTS.len()]);
    let exponent = if shape.is_multiple_of(3) { Expr::Negative(Box::new(exponent)) } else { exponent };
    combine(Pair::Powf, positive(shape / 32, x), exponent)
}

/// Forms that the engine's simplifications look for: like terms, common factors, squares of sines and
/// cosines, sums of angles, powers of roots, long products.
fn tangled(shape: usize, a: Expr, b: Expr, c: Expr) -> Expr {
    let (sine, cosine) = (call(Function::Sin, a.clone()), call(Function::Cos, a.clone()));
    let square = |x: &Expr| Expr::Power(Box::new(x.clone()), 2);
    let minus = |x: Expr, y: Expr| operation(Operator::Subtract, x, y);
    match shape % 16 {
        0 => plus(times(b.clone(), square(&sine)), times(b, square(&cosine))),
        1 => minus(b.clone(), times(b, square(&cosine))),
        2 => minus(number(1.0), times(sine.clone(), sine)),
        3 => times(times(b, Expr::Power(Box::new(sine), 3)), Expr::Power(Box::new(cosine), 2)),
        4 => plus(times(sine, call(Function::Cos, b.clone())), times(cosine, call(Function::Sin, b))),
        5 => times(call(Function::Sin, plus(a.clone(), b.clone())), call(Function::Cos, minus(b, a))),
        6 => plus(times(a.clone(), b), times(a, c)),
        7 => minus(plus(a, b.clone()), minus(b, c)),
        8 => {
            let root = call(Function::Sqrt, times(positive(shape, a), positive(shape / 4, b)));
            times(times(root.clone(), c.clone()), plus(root.clone(), times(root, c)))
        }
        9 => {
            let divisor = positive(shape, a);
            plus(
                operation(Operator::Divide, b, divisor.clone()),
                operation(Operator::Divide, c, Expr::Power(Box::new(divisor), 2)),
            )
        }
        10 => times(call(Function::Exp, sine.clone()), call(Function::Exp, Expr::Negative(Box::new(sine)))),
        11 => {
            let base = positive(shape, a);
            times(
                combine(Pair::Powf, base.clone(), number(1.5)),
                combine(Pair::Powf, base, Expr::Negative(Box::new(number(0.5)))),
            )
        }
        12 => Expr::Power(Box::new(times(times(sine, cosine), plus(b, c))), 4),
        13 => {
            let factor = |x: Expr| times(plus(x.clone(), number(0.5)), call(Function::Cos, x));
            times(
                times(factor(a.clone()), factor(b.clone())),
                times(factor(c.clone()), factor(plus(plus(a, b), c))),
            )
        }
        14 => call(Function::Sqrt, Expr::Power(Box::new(positive(shape, b)), 2)),
        _ => times(minus(a.clone(), b.clone()), minus(b, a)),
    }
}

/// A scalar of some depth.
pub fn scalar(reach: Reach) -> BoxedStrategy<Expr> {
    let recursive = leaf(reach).prop_recursive(3, 14, 3, move |inner| {
        let pair = || (inner.clone(), inner.clone());
        let function = prop::sample::select(Function::ALL.to_vec());
        let vectors = || (1_usize..=3, simple_vector(inner.clone()), simple_vector(inner.clone()));
        prop_oneof![
            8 => pair().prop_map(|(a, b)| plus(a, b)),
            6 => pair().prop_map(|(a, b)| operation(Operator::Subtract, a, b)),
            10 => pair().prop_map(|(a, b)| times(a, b)),
            3 => (index(), pair()).prop_map(|(s, (a, b))| operation(Operator::Divide, a, positive(s, b))),
            3 => inner.clone().prop_map(|a| Expr::Negative(Box::new(a))),
            4 => prop::sample::select(vec![Function::Sin, Function::Cos])
                .prop_flat_map({ let inner = inner.clone(); move |f| inner.clone().prop_map(move |a| call(f, a)) }),
            10 => (function, index(), inner.clone()).prop_map(|(f, s, a)| within_domain(f, s, a)),
            4 => (prop::sample::select(Pair::ALL.to_vec()), index(), pair())
                .prop_map(|(p, s, (a, b))| two_arguments(p, s, a, b)),
            3 => (index(), inner.clone()).prop_map(|(s, a)| constant_power(s, a)),
            4 => (0_i32..=4, inner.clone()).prop_map(|(n, a)| Expr::Power(Box::new(a), n)),
            2 => (-3_i32..0, index(), inner.clone()).prop_map(|(n, s, a)| Expr::Power(Box::new(positive(s, a)), n)),
            2 => (index(), pair()).prop_map(move |(i, (a, b))| match reach {
                Reach::Helper => plus(a, b),
                _ => Expr::Helper(i, Box::new(a), Box::new(b)),
            }),
            2 => (index(), inner.clone(), 0_usize..3).prop_map(move |(which, a, form)| match (reach, form) {
                (_, 0) => Expr::Sum(which, Box::new(times(Expr::Element, a))),
                (_, 1) => Expr::Sum(which, Box::new(call(Function::Cos, plus(Expr::Element, a)))),
                _ => Expr::Sum(which, Box::new(Expr::Power(Box::new(operation(Operator::Subtract, a, Expr::Element)), 2))),
            }),
            6 => (index(), pair(), inner.clone()).prop_map(|(s, (a, b), c)| tangled(s, a, b, c)),
            1 => vectors().prop_map(|(d, a, b)| Expr::Dot(d, Box::new(a), Box::new(b))),
            1 => vectors().prop_map(|(d, a, b)| Expr::Component(2, d, Box::new(Vector::Cross(Box::new(a), Box::new(b))))),
            1 => (index(), vectors()).prop_map(|(s, (d, a, _))| Expr::Norm(d, Box::new(nonzero(s, a)))),
        ]
    });
    recursive.boxed()
}

fn simple_vector(inner: impl Strategy<Value = Expr> + Clone + 'static) -> BoxedStrategy<Vector> {
    (inner.clone(), inner.clone(), inner)
        .prop_map(|(a, b, c)| Vector::New([Box::new(a), Box::new(b), Box::new(c)]))
        .boxed()
}

/// A vector whose first component is never zero.
fn nonzero(shape: usize, vector: Vector) -> Vector {
    match vector {
        Vector::New([x, y, z]) => Vector::New([Box::new(positive(shape, *x)), y, z]),
        other => other,
    }
}

/// A vector expression.
pub fn vector(reach: Reach) -> BoxedStrategy<Vector> {
    let leaf = prop_oneof![
        4 => simple_vector(scalar(reach)),
        1 => index().prop_map(Vector::Place),
    ];
    leaf.prop_recursive(2, 5, 2, move |inner| {
        let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        let factor = || scalar(reach).prop_map(Box::new);
        prop_oneof![
            2 => pair().prop_map(|(a, b)| Vector::Add(a, b)),
            1 => pair().prop_map(|(a, b)| Vector::Subtract(a, b)),
            1 => inner.clone().prop_map(|a| Vector::Negative(Box::new(a))),
            2 => (factor(), inner.clone()).prop_map(|(f, a)| Vector::Scale(f, Box::new(a))),
            1 => pair().prop_map(|(a, b)| Vector::Cross(a, b)),
            2 => (factor(), inner.clone()).prop_map(|(f, a)| Vector::Turn(f, Box::new(a))),
        ]
    })
    .boxed()
}

/// A function body with up to two `let`s.
pub fn body<R: Clone + std::fmt::Debug + 'static>(
    reach: Reach,
    result: impl Strategy<Value = R> + 'static,
) -> BoxedStrategy<Body<R>> {
    (prop::collection::vec(scalar(reach), 0..=2), result)
        .prop_map(|(lets, result)| Body { lets, result })
        .boxed()
}

//! Expressions of the random systems, and their values in any number.
//!
//! Indices are not resolved: `Coordinate(7)` of a system with three coordinates is the second one.
//! So an expression fits every system, and shrinking one part never breaks another.

use crate::function::{Function, Pair};
use crate::number::{Dual, Number};
use crate::system::{Place, System};

/// A scalar.
#[derive(Clone, Debug)]
pub enum Expr {
    Number(f64),
    Coordinate(usize),
    Velocity(usize),
    Time,
    Input(usize),
    Parameter(usize),
    /// The associated constant of the impl block.
    Ratio,
    /// An earlier `let` of the same function.
    Local(usize),
    /// An argument of a helper function.
    Argument(usize),
    /// The element that the enclosing [`Expr::Sum`] is at.
    Element,
    Negative(Box<Expr>),
    Operation(Operator, Box<Expr>, Box<Expr>),
    Call(Function, Box<Expr>),
    Combine(Pair, Box<Expr>, Box<Expr>),
    Power(Box<Expr>, i32),
    /// A helper function of two arguments.
    Helper(usize, Box<Expr>, Box<Expr>),
    /// A loop over an array of coordinates; the first number picks the array and the notation.
    Sum(usize, Box<Expr>),
    /// a·b in so many dimensions.
    Dot(usize, Box<Vector>, Box<Vector>),
    /// |a| of a vector that is never zero.
    Norm(usize, Box<Vector>),
    /// One component, and of how many.
    Component(usize, usize, Box<Vector>),
}

/// An infix operator.
#[derive(Clone, Copy, Debug)]
pub enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// A vector of one to three components. The place where it stands decides how many.
#[derive(Clone, Debug)]
pub enum Vector {
    New([Box<Expr>; 3]),
    /// The position of a particle or body that is declared before, if there is one.
    Place(usize),
    Negative(Box<Vector>),
    Add(Box<Vector>, Box<Vector>),
    Subtract(Box<Vector>, Box<Vector>),
    Scale(Box<Expr>, Box<Vector>),
    /// a × b in space, the sum elsewhere.
    Cross(Box<Vector>, Box<Vector>),
    /// A vector turned by an angle, in space about the z axis. On a line it stays as it is.
    Turn(Box<Expr>, Box<Vector>),
}

/// A function body: `let`s, then a result.
#[derive(Clone, Debug)]
pub struct Body<R> {
    pub lets: Vec<Expr>,
    pub result: R,
}

/// The value of [`Expr::Ratio`].
pub const RATIO: f64 = 0.75;

/// The value that stands for a position where no particle is declared.
pub const NOWHERE: f64 = 0.3;

/// Everything a function can depend on, at one instant.
#[derive(Clone, Debug)]
pub struct Instant<T> {
    pub q: Vec<T>,
    pub v: Vec<T>,
    pub t: T,
    pub u: Vec<T>,
    pub parameters: Vec<T>,
}

impl<T: Number> Instant<T> {
    /// The instant with its rates along a direction of (q, v, t).
    pub fn along(&self, q: impl Fn(usize) -> T, v: impl Fn(usize) -> T, t: f64) -> Instant<Dual<T>> {
        let still = |values: &[T]| values.iter().map(|&value| Dual::still(value)).collect();
        let moving = |(i, &value): (usize, &T), slope: &dyn Fn(usize) -> T| Dual { value, slope: slope(i) };
        Instant {
            q: self.q.iter().enumerate().map(|entry| moving(entry, &q)).collect(),
            v: self.v.iter().enumerate().map(|entry| moving(entry, &v)).collect(),
            t: Dual { value: self.t, slope: T::constant(t) },
            u: still(&self.u),
            parameters: still(&self.parameters),
        }
    }

    /// The instant as it moves by itself: along (q̇, 0, 1).
    pub fn in_motion(&self) -> Instant<Dual<T>> {
        self.along(|i| self.v[i], |_| T::constant(0.0), 1.0)
    }

    /// The instant with coordinate `i` moving.
    pub fn by_coordinate(&self, i: usize) -> Instant<Dual<T>> {
        self.along(|j| T::constant(f64::from(u8::from(i == j))), |_| T::constant(0.0), 0.0)
    }

    /// The instant with velocity `i` changing.
    pub fn by_velocity(&self, i: usize) -> Instant<Dual<T>> {
        self.along(|_| T::constant(0.0), |j| T::constant(f64::from(u8::from(i == j))), 0.0)
    }
}

/// The names that an expression can see.
pub struct Scope<'a, T> {
    pub system: &'a System,
    pub instant: &'a Instant<T>,
    /// Roles before this one can be called.
    pub visible: usize,
    pub locals: Vec<T>,
    pub arguments: [T; 2],
    pub element: T,
    /// A particle or body whose position is shifted where a constraint uses it, and by how much.
    pub shift: Option<&'a (Place, Vec<T>)>,
}

impl<'a, T: Number> Scope<'a, T> {
    /// What a function of the role at `visible` sees before its first `let`.
    pub fn new(system: &'a System, instant: &'a Instant<T>, visible: usize) -> Self {
        let nothing = T::constant(0.0);
        Scope {
            system,
            instant,
            visible,
            locals: Vec::new(),
            arguments: [nothing; 2],
            element: nothing,
            shift: None,
        }
    }

    /// The result of a function body, by the function that evaluates results.
    pub fn run<R, S>(mut self, body: &Body<R>, result: impl FnOnce(&Self, &R) -> S) -> S {
        for expr in &body.lets {
            let value = self.scalar(expr);
            self.locals.push(value);
        }
        result(&self, &body.result)
    }

    /// The value of a scalar.
    pub fn scalar(&self, expr: &Expr) -> T {
        let Instant { q, v, t, u, parameters } = self.instant;
        match expr {
            Expr::Number(value) => T::constant(*value),
            Expr::Coordinate(i) => q[i % q.len()],
            Expr::Velocity(i) => v[i % v.len()],
            Expr::Time => *t,
            Expr::Input(i) if u.is_empty() => parameters[i % parameters.len()],
            Expr::Input(i) => u[i % u.len()],
            Expr::Parameter(i) => parameters[i % parameters.len()],
            Expr::Ratio => T::constant(RATIO),
            Expr::Local(_) if self.locals.is_empty() => T::constant(RATIO),
            Expr::Local(i) => self.locals[i % self.locals.len()],
            Expr::Argument(i) => self.arguments[i % 2],
            Expr::Element => self.element,
            Expr::Negative(a) => -self.scalar(a),
            Expr::Operation(operator, a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                match operator {
                    Operator::Add => a + b,
                    Operator::Subtract => a - b,
                    Operator::Multiply => a * b,
                    Operator::Divide => a / b,
                }
            }
            Expr::Call(function, a) => self.scalar(a).apply(*function),
            Expr::Combine(pair, a, b) => self.scalar(a).combine(*pair, self.scalar(b)),
            Expr::Power(a, power) => self.scalar(a).powi(*power),
            Expr::Helper(i, a, b) => {
                let helper = &self.system.helpers[i % self.system.helpers.len()];
                let arguments = [self.scalar(a), self.scalar(b)];
                let scope = Scope { arguments, ..Scope::new(self.system, self.instant, 0) };
                scope.run(helper, |scope, result| scope.scalar(result))
            }
            Expr::Sum(which, body) => {
                let mut total = T::constant(0.0);
                for i in self.system.looped(*which).1 {
                    let locals = self.locals.clone();
                    let scope = Scope { locals, element: q[i], arguments: self.arguments, ..*self };
                    total = total + scope.scalar(body);
                }
                total
            }
            Expr::Dot(dimension, a, b) => {
                let (a, b) = (self.vector(a, *dimension), self.vector(b, *dimension));
                dot(&a, &b)
            }
            Expr::Norm(dimension, a) => {
                let a = self.vector(a, *dimension);
                dot(&a, &a).apply(Function::Sqrt)
            }
            Expr::Component(index, dimension, a) => self.vector(a, *dimension)[index % dimension],
        }
    }

    /// The value of a vector in so many dimensions.
    pub fn vector(&self, vector: &Vector, dimension: usize) -> Vec<T> {
        let zip = |a: &Vector, b: &Vector, f: fn(T, T) -> T| {
            let (a, b) = (self.vector(a, dimension), self.vector(b, dimension));
            a.into_iter().zip(b).map(|(a, b)| f(a, b)).collect()
        };
        match vector {
            Vector::New(components) => components[..dimension].iter().map(|c| self.scalar(c)).collect(),
            Vector::Place(which) => match self.system.place(*which, dimension, self.visible) {
                Some(place) => {
                    let position = self.system.positions(place.role, self.instant).swap_remove(place.index);
                    match self.shift {
                        Some((moved, by)) if *moved == place => {
                            position.into_iter().zip(by).map(|(x, &by)| x + by).collect()
                        }
                        _ => position,
                    }
                }
                None => vec![T::constant(NOWHERE); dimension],
            },
            Vector::Negative(a) => self.vector(a, dimension).into_iter().map(|a| -a).collect(),
            Vector::Add(a, b) => zip(a, b, |a, b| a + b),
            Vector::Subtract(a, b) => zip(a, b, |a, b| a - b),
            Vector::Scale(factor, a) => {
                let factor = self.scalar(factor);
                self.vector(a, dimension).into_iter().map(|a| factor * a).collect()
            }
            Vector::Cross(a, b) if dimension == 3 => {
                let (a, b) = (self.vector(a, 3), self.vector(b, 3));
                [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i]).to_vec()
            }
            Vector::Cross(a, b) => zip(a, b, |a, b| a + b),
            Vector::Turn(angle, a) => {
                let mut turned = self.vector(a, dimension);
                if dimension > 1 {
                    let angle = self.scalar(angle);
                    let (sine, cosine) = (angle.apply(Function::Sin), angle.apply(Function::Cos));
                    let (x, y) = (turned[0], turned[1]);
                    turned[0] = cosine * x - sine * y;
                    turned[1] = sine * x + cosine * y;
                }
                turned
            }
        }
    }
}

/// a·b.
pub fn dot<T: Number>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::constant(0.0), |sum, (&a, &b)| sum + a * b)
}

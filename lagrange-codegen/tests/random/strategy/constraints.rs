//! Random constraints. Each has a coordinate or velocity of its own that it depends on almost everywhere, so
//! that almost all gradients are independent at almost all states.

use proptest::prelude::*;

use super::expressions::{
    Reach, call, constant, fixed, index, number, operation, plus, positive, scalar, times,
};
use crate::constraint::{Kind, Rows};
use crate::expression::{Body, Expr, Operator, Vector};
use crate::function::Function;
use crate::system::Role;

/// A place that moves with one coordinate: its number in [`Vector::Place`], and its dimension.
pub type Carrier = (usize, usize);

/// One constraint function that does not know its coordinates yet.
#[derive(Clone, Debug)]
pub struct Restraint {
    kind: Kind,
    shape: Shape,
    name: usize,
    lets: Vec<Expr>,
    rows: Vec<Row>,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Scalar,
    Array,
    Vector,
    /// A vector turned by an angle, which mixes its components.
    Turned,
}

#[derive(Clone, Debug)]
struct Row {
    form: usize,
    size: Expr,
    place: Expr,
    other: Expr,
    moving: Expr,
}

/// The functions of one system.
pub fn restraints() -> BoxedStrategy<Vec<Restraint>> {
    let kind = || prop_oneof![4 => Just(Kind::Holonomic), 2 => Just(Kind::Affine), 1 => Just(Kind::Chetaev)];
    let shape = || prop_oneof![4 => Just(Shape::Scalar), 2 => Just(Shape::Array), 1 => Just(Shape::Vector), 1 => Just(Shape::Turned)];
    let one = (kind(), shape(), index(), prop::collection::vec(scalar(Reach::Position), 0..=1), row(), row())
        .prop_map(|(kind, shape, name, lets, first, second)| Restraint {
            kind,
            shape,
            name,
            lets,
            rows: vec![first, second],
        });
    prop_oneof![1 => Just(Vec::new()), 1 => prop::collection::vec(one, 1..=4)].boxed()
}

/// A constraint between each coordinate and the next, `count` of them: one depends on few coordinates, and
/// has one that those after it do not depend on.
pub fn links(count: usize) -> BoxedStrategy<Role> {
    let one = (fixed(), fixed(), index());
    (index(), prop::collection::vec(one, count))
        .prop_map(|(name, links)| {
            let link = |(i, (own, other, form)): (usize, (Expr, Expr, usize))| {
                let next = Expr::Coordinate(i + 1);
                let next = if form.is_multiple_of(2) {
                    call(Function::Sin, next)
                } else {
                    times(next.clone(), next)
                };
                plus(times(own, Expr::Coordinate(i)), times(other, next))
            };
            let rows = links.into_iter().enumerate().map(link).collect();
            Role::Constraint(Kind::Holonomic, name, Body { lets: Vec::new(), result: Rows::Array(rows) })
        })
        .boxed()
}

fn row() -> BoxedStrategy<Row> {
    (index(), constant(), scalar(Reach::Position), scalar(Reach::Position), scalar(Reach::Motion))
        .prop_map(|(form, size, place, other, moving)| Row { form, size, place, other, moving })
        .boxed()
}

impl Restraint {
    /// How many constraints this is.
    pub fn count(&self) -> usize {
        match self.shape {
            Shape::Scalar => 1,
            Shape::Array => 1 + self.name % 2,
            Shape::Vector | Shape::Turned => 2,
        }
    }

    /// Whether it restrains coordinates and not velocities alone.
    pub fn is_holonomic(&self) -> bool {
        self.kind == Kind::Holonomic
    }

    /// The role, with the first of its coordinates.
    pub fn role(self, first: usize, carrier: impl Fn(usize) -> Option<Carrier>) -> Role {
        let count = self.count();
        let mut rows: Vec<Expr> = self
            .rows
            .into_iter()
            .take(count)
            .enumerate()
            .map(|(number, row)| {
                let i = first + number;
                match self.kind {
                    Kind::Holonomic => row.holonomic(i, carrier(i)),
                    Kind::Affine => row.affine(i),
                    Kind::Chetaev => row.chetaev(i),
                }
            })
            .collect();
        let result = match self.shape {
            Shape::Scalar => Rows::Scalar(rows.remove(0)),
            Shape::Array => Rows::Array(rows),
            Shape::Vector | Shape::Turned => {
                let third = Box::new(number(0.0));
                let [first, second] = [0, 1].map(|i| Box::new(rows[i].clone()));
                let vector = Vector::New([first, second, third]);
                let angle = Box::new(Expr::Time);
                let turned = matches!(self.shape, Shape::Turned);
                Rows::Vector(2, if turned { Vector::Turn(angle, Box::new(vector)) } else { vector })
            }
        };
        Role::Constraint(self.kind, self.name, Body { lets: self.lets, result })
    }
}

fn minus(a: Expr, b: Expr) -> Expr {
    operation(Operator::Subtract, a, b)
}

fn square(a: Expr) -> Expr {
    Expr::Power(Box::new(a), 2)
}

/// A value of some tenths.
fn small(shape: usize, x: Expr) -> Expr {
    let function = [Function::Sin, Function::Cos, Function::Tanh, Function::Atan][shape % 4];
    times(number(0.3), call(function, x))
}

fn constants(values: [f64; 3]) -> Box<Vector> {
    Box::new(Vector::New(values.map(|value| Box::new(number(value)))))
}

impl Row {
    /// f(q, t).
    fn holonomic(self, i: usize, carrier: Option<Carrier>) -> Expr {
        let Row { form, size, place: x, other: y, .. } = self;
        let (shape, q) = (form / 8, Expr::Coordinate(i));
        match (form % 8, carrier) {
            (0, _) => {
                plus(times(size, q), minus(times(Expr::Ratio, Expr::Coordinate(i + 1 + shape)), Expr::Time))
            }
            (1, _) => times(positive(shape, x), plus(q, small(shape / 2, y))),
            (2, _) => {
                let parts = [plus(q, number(3.0)), small(shape, x), small(shape / 2, y)];
                minus(Expr::Norm(1 + shape % 2 + 1, Box::new(Vector::New(parts.map(Box::new)))), size)
            }
            (3, _) => plus(plus(q.clone(), times(number(0.2), Expr::Power(Box::new(q), 3))), small(shape, x)),
            // A constraint through the position of a particle alone.
            (4, Some((which, dimension))) => {
                let from = Vector::Subtract(Box::new(Vector::Place(which)), constants([4.0, 3.0, 2.0]));
                minus(Expr::Norm(dimension, Box::new(from)), plus(size, Expr::Time))
            }
            (5, Some((which, dimension))) => {
                // The other place may be the same one.
                let part = Vector::Scale(Box::new(number(0.37)), Box::new(Vector::Place(which + 1 + shape)));
                let other = Vector::Add(Box::new(part), constants([5.0, 6.0, 4.0]));
                let from = Vector::Subtract(Box::new(Vector::Place(which)), Box::new(other));
                minus(Expr::Dot(dimension, Box::new(from.clone()), Box::new(from)), size)
            }
            // A constraint through a position and, beside it, through coordinates.
            (6, Some((which, dimension))) => {
                let along =
                    Expr::Dot(dimension, Box::new(Vector::Place(which)), constants([1.0, 0.5, -0.25]));
                plus(times(size, along), small(shape, x))
            }
            _ => plus(times(size, q), small(shape, x)),
        }
    }

    /// g(q, v, t), affine in v.
    fn affine(self, i: usize) -> Expr {
        let Row { form, size, place: x, other: y, .. } = self;
        let (shape, v) = (form / 5, Expr::Velocity(i));
        let other = Expr::Velocity(i + 1 + shape);
        match form % 5 {
            0 => plus(plus(times(positive(shape, x), v), times(small(shape / 2, y.clone()), other)), y),
            1 => minus(plus(times(size, v), times(Expr::Ratio, other)), Expr::Time),
            2 => times(positive(shape, x), minus(v, times(small(shape / 2, y), other))),
            // Affine only after its terms have cancelled.
            3 => minus(square(plus(v.clone(), positive(shape, x))), square(v)),
            _ => minus(v, times(times(size, call(Function::Cos, Expr::Coordinate(i + shape))), other)),
        }
    }

    /// g(q, v, t) of any form.
    fn chetaev(self, i: usize) -> Expr {
        let Row { form, size, place: x, other: y, moving } = self;
        let (shape, v) = (form / 5, Expr::Velocity(i));
        let other = Expr::Velocity(i + 1 + shape);
        match form % 5 {
            0 => minus(plus(square(v), times(small(shape, x), other)), positive(shape / 2, y)),
            1 => minus(call(Function::Sqrt, plus(number(1.0), square(v))), plus(size, positive(shape, x))),
            2 => plus(v, times(small(shape, x), square(other))),
            3 => plus(times(size, v), small(shape, moving)),
            _ => plus(times(positive(shape, x), v), small(shape, y)),
        }
    }
}

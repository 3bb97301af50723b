//! Random roles.

use proptest::prelude::*;

use super::expressions::{
    Reach, body, call, constant, fixed, index, number, operation, plus, positive, scalar, times, vector,
};
use crate::expression::{Body, Expr, Operator, Vector};
use crate::function::{Function, Pair};
use crate::system::{Energy, Form, Inertia, Role, Rotation};

fn velocity(i: usize) -> Expr {
    Expr::Velocity(i)
}

fn square(a: Expr) -> Expr {
    Expr::Power(Box::new(a), 2)
}

fn of_result<R>(result: R) -> Body<R> {
    Body { lets: Vec::new(), result }
}

/// The role that gives one coordinate its inertia, so that the mass matrix is not singular.
#[derive(Clone, Debug)]
pub enum Base {
    /// ½ m v².
    Constant(Expr),
    /// ½ m(q, t) v².
    Varying(usize, Expr),
    /// A particle that moves with the coordinate on a line or in the plane.
    Point(Expr, Expr, usize),
    /// A Lagrangian that is not quadratic in v, or indefinite.
    Whole(usize, Expr),
}

/// The inertia of a system: quadratic forms alone, or any energy.
pub fn base(quadratic: bool) -> BoxedStrategy<Base> {
    let constant = fixed().prop_map(Base::Constant);
    let varying = (index(), scalar(Reach::Position)).prop_map(|(shape, x)| Base::Varying(shape, x));
    let point = (fixed(), scalar(Reach::Position), index())
        .prop_map(|(mass, offset, form)| Base::Point(mass, offset, form));
    let whole = (index(), scalar(Reach::Position)).prop_map(|(form, x)| Base::Whole(form, x));
    if quadratic {
        prop_oneof![3 => constant, 2 => varying, 3 => point].boxed()
    } else {
        prop_oneof![1 => constant, 1 => varying, 1 => point, 4 => whole].boxed()
    }
}

impl Base {
    /// The role for coordinate `i`.
    pub fn role(self, i: usize) -> Role {
        let half = |a: Expr| times(number(0.5), a);
        match self {
            Base::Constant(mass) => {
                Role::Energy(Energy::Kinetic, of_result(half(times(mass, square(velocity(i))))))
            }
            Base::Varying(shape, x) => {
                let mass = positive(shape, x);
                Role::Energy(Energy::Kinetic, of_result(half(times(mass, times(velocity(i), velocity(i))))))
            }
            Base::Point(mass, offset, form) => {
                let q = Expr::Coordinate(i);
                let small = times(number(0.1), call(Function::Sin, offset));
                let (x, y) = match form % 3 {
                    0 => (q, number(0.0)),
                    1 => (call(Function::Sin, q.clone()), call(Function::Cos, q)),
                    _ => (plus(q, small.clone()), small),
                };
                let position = Vector::New([x, y, number(0.0)].map(Box::new));
                let dimension = [1, 2, 3, 2][form / 3 % 4].max(1 + form % 3 % 2);
                Role::Point { dimension, mass, position: of_result(position) }
            }
            Base::Whole(form, x) => Role::Energy(Energy::Lagrangian, of_result(whole(form, i, x))),
        }
    }
}

/// Lagrangians that are not quadratic in the velocity of coordinate `i`, and one that is indefinite.
fn whole(form: usize, i: usize, x: Expr) -> Expr {
    let v = || velocity(i);
    let power = |a: Expr, exponent: f64| Expr::Combine(Pair::Powf, Box::new(a), Box::new(number(exponent)));
    let one_less = |a: Expr| operation(Operator::Subtract, number(1.0), a);
    match form % 6 {
        // The relativistic particle: −m c² √(1 − v²/c²), c = 4.
        0 => times(
            Expr::Negative(Box::new(positive(form / 6, x))),
            times(
                number(16.0),
                call(Function::Sqrt, one_less(operation(Operator::Divide, square(v()), number(16.0)))),
            ),
        ),
        1 => times(positive(form / 6, x), call(Function::Exp, times(number(0.2), square(v())))),
        2 => {
            plus(times(positive(form / 6, x), square(v())), times(number(0.1), Expr::Power(Box::new(v()), 4)))
        }
        3 => times(positive(form / 6, x), call(Function::Sqrt, plus(number(1.0), square(v())))),
        4 => plus(power(plus(number(1.0), square(v())), 1.5), times(times(x, number(0.1)), v())),
        // Indefinite: v w − 0.4 v², with w any velocity.
        _ => operation(
            Operator::Subtract,
            times(v(), velocity(i + 1 + form / 6)),
            times(number(0.4), square(v())),
        ),
    }
}

/// Roles beside the inertia. `ForceAt` and `Wrench` may have nothing to act on.
pub fn role(quadratic: bool) -> BoxedStrategy<Role> {
    let kinetic = body(Reach::Position, kinetic()).prop_map(|body| Role::Energy(Energy::Kinetic, body));
    let potential =
        body(Reach::Position, scalar(Reach::Position)).prop_map(|body| Role::Energy(Energy::Potential, body));
    let dissipation = body(Reach::Motion, prop_oneof![scalar(Reach::Motion), rayleigh()])
        .prop_map(|body| Role::Energy(Energy::Dissipation, body));
    let lagrangian =
        body(Reach::Motion, scalar(Reach::Motion).prop_map(|x| times(number(0.05), bounded_slope(x))))
            .prop_map(|body| Role::Energy(Energy::Lagrangian, body));
    let force_on =
        (index(), body(Reach::Force, scalar(Reach::Force))).prop_map(|(i, body)| Role::ForceOn(i, body));
    let force_on_all =
        body(Reach::Force, prop::collection::vec(scalar(Reach::Force), 1..=3)).prop_map(Role::ForceOnAll);
    let force_at =
        (index(), body(Reach::Force, vector(Reach::Force))).prop_map(|(i, body)| Role::ForceAt(i, body));
    let wrench = (index(), body(Reach::Force, (vector(Reach::Force), vector(Reach::Force))))
        .prop_map(|(i, body)| Role::Wrench(i, body));
    let quadratic_roles = prop_oneof![
        3 => point(),
        2 => planar(),
        2 => spatial(),
        1 => chain(),
        3 => kinetic,
        5 => potential,
        2 => dissipation,
        1 => force_on,
        1 => force_on_all,
        2 => force_at,
        2 => wrench,
    ];
    if quadratic {
        quadratic_roles.boxed()
    } else {
        prop_oneof![4 => quadratic_roles, 2 => lagrangian].boxed()
    }
}

/// A smooth function of x with values in [−1, 1].
fn bounded_slope(x: Expr) -> Expr {
    call(Function::Sin, x)
}

/// ½ c (a·v)² + b·v + T₀: positive semidefinite, with gyroscopic and prescribed parts.
fn kinetic() -> BoxedStrategy<Expr> {
    let form = (scalar(Reach::Position), index(), scalar(Reach::Position), index())
        .prop_map(|(a, i, b, j)| plus(times(a, velocity(i)), times(b, velocity(j))));
    let quadratic = (index(), scalar(Reach::Position), form.clone())
        .prop_map(|(shape, c, form)| times(times(number(0.5), positive(shape, c)), square(form)));
    let dot = (form.clone(), form.clone(), form.clone()).prop_map(|(a, b, c)| {
        let vector = || Box::new(Vector::New([a.clone(), b.clone(), c.clone()].map(Box::new)));
        times(number(0.5), Expr::Dot(2, vector(), vector()))
    });
    prop_oneof![
        3 => quadratic.clone(),
        1 => dot,
        1 => (quadratic.clone(), form).prop_map(|(quadratic, linear)| plus(quadratic, linear)),
        1 => (quadratic, scalar(Reach::Position)).prop_map(|(quadratic, rest)| plus(quadratic, rest)),
    ]
    .boxed()
}

/// ½ d v².
fn rayleigh() -> BoxedStrategy<Expr> {
    (fixed(), index()).prop_map(|(d, i)| times(times(number(0.5), d), square(velocity(i)))).boxed()
}

fn point() -> BoxedStrategy<Role> {
    (1_usize..=3, fixed(), body(Reach::Position, vector(Reach::Position)))
        .prop_map(|(dimension, mass, position)| Role::Point { dimension, mass, position })
        .boxed()
}

fn form() -> BoxedStrategy<Form> {
    prop_oneof![Just(Form::Isometry), Just(Form::Tuple)].boxed()
}

fn planar() -> BoxedStrategy<Role> {
    let pose = body(Reach::Position, (vector(Reach::Position), scalar(Reach::Position)));
    (fixed(), fixed(), pose, form())
        .prop_map(|(mass, inertia, pose, form)| Role::Planar { mass, inertia, pose, form })
        .boxed()
}

fn spatial() -> BoxedStrategy<Role> {
    let pose = body(Reach::Position, (vector(Reach::Position), rotation()));
    let inertia = ([fixed(), fixed(), fixed()], prop::option::weighted(0.3, constant()))
        .prop_map(|(moments, product)| Inertia { moments, product: product.map(|p| times(number(0.05), p)) });
    (fixed(), inertia, pose, form())
        .prop_map(|(mass, inertia, pose, form)| Role::Spatial { mass, inertia, pose, form })
        .boxed()
}

fn rotation() -> BoxedStrategy<Rotation> {
    let angle = || scalar(Reach::Position);
    let leaf = prop_oneof![
        4 => (0_usize..3, angle()).prop_map(|(axis, angle)| Rotation::Axis(axis, angle)),
        1 => angle().prop_map(Rotation::Tilted),
        1 => (angle(), angle(), angle()).prop_map(|(a, b, c)| Rotation::Euler(Box::new([a, b, c]))),
    ];
    leaf.prop_recursive(2, 4, 2, |inner| {
        prop_oneof![
            3 => (inner.clone(), inner.clone()).prop_map(|(a, b)| Rotation::Product(Box::new(a), Box::new(b))),
            1 => inner.clone().prop_map(|a| Rotation::Inverse(Box::new(a))),
            1 => inner.prop_map(|a| Rotation::Entries(Box::new(a))),
        ]
    })
    .boxed()
}

pub fn chain() -> BoxedStrategy<Role> {
    (index(), any::<bool>(), fixed(), fixed())
        .prop_map(|(which, relative, mass, length)| Role::Chain { which, relative, mass, length })
        .boxed()
}

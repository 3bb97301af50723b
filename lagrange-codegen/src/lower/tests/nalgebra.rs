//! Linear algebra: vectors, matrices, rotations and poses against written-out formulas.

use proc_macro2::TokenStream;
use quote::quote;

use super::{lowered, value};

/// The value of a body with q.x = 0.3, q.y = 0.7, t = 0.9 and every parameter 2.
fn run(body: TokenStream) -> f64 {
    let model = lowered(
        quote!(coordinates = [x, y]),
        quote! {
            impl System {
                #[lagrangian]
                fn energy(&self, q: &Coordinates, t: f64) -> f64 { #body }
                fn probe(&self, v: Vector3<f64>) -> f64 { v.x + 10.0 * v.y + 100.0 * v.z }
                fn flat(&self, v: Vector2<f64>) -> f64 { v.x + 10.0 * v.y }
            }
        },
    );
    let model = model.unwrap_or_else(|messages| panic!("{body}: {messages:?}"));
    value(&model, model.lagrangian[0].value, |_| 2.0)
}

const X: f64 = 0.3;
const Y: f64 = 0.7;
const T: f64 = 0.9;

fn probe(v: [f64; 3]) -> f64 {
    v[0] + 10.0 * v[1] + 100.0 * v[2]
}

fn flat(v: [f64; 2]) -> f64 {
    v[0] + 10.0 * v[1]
}

fn assert_value(body: TokenStream, expected: f64) {
    let found = run(body.clone());
    assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{body}: {found}, not {expected}");
}

#[test]
fn vectors() {
    assert_value(
        quote!(self.flat(Vector2::new(q.x, 1.0) * 2.0 - Vector2::y() / q.y)),
        flat([0.6, 2.0 - 1.0 / Y]),
    );
    assert_value(quote!(Vector2::new(q.x, q.y).dot(&vector![2.0, q.x])), 2.0 * X + Y * X);
    assert_value(quote!(self.probe(Vector3::new(q.x, q.y, 1.0).cross(&Vector3::x()))), probe([0.0, 1.0, -Y]));
    assert_value(
        quote!(Vector2::new(3.0 * q.x, 4.0 * q.x).norm() + Vector2::new(1.0, q.x).norm_squared()),
        5.0 * X + 1.0 + X * X,
    );
    assert_value(quote!(self.flat(Vector2::new(3.0, 4.0).normalize() * q.x)), flat([0.6 * X, 0.8 * X]));
    assert_value(quote!(self.probe(Vector3::new(q.x, 1.0, 2.0) + self.offset)), probe([X + 2.0, 3.0, 4.0]));
    assert_value(
        quote!(self.offset.dot(&Vector2::new(q.x, q.y)) + self.offset.x * q.x),
        2.0 * X + 2.0 * Y + 2.0 * X,
    );
    assert_value(
        quote!(let mut p = Vector2::zeros(); p += Vector2::new(q.x, 1.0); p *= 2.0; p.y -= q.y; p[0] = 5.0; self.flat(-p)),
        -flat([5.0, 2.0 - Y]),
    );
    assert_value(
        quote!(self.flat([Vector2::new(q.x, 1.0), Vector2::new(q.y, 2.0)].iter().sum())),
        flat([X + Y, 3.0]),
    );
    assert_value(quote!(self.flat([q.x, q.y].into())), flat([X, Y]));
    assert_value(quote!(self.flat(point![q.x, 1.0] - Point2::origin())), flat([X, 1.0]));
    assert_value(quote!(SVector::<f64, 2>::from_fn(|i, _| i as f64 * q.x).sum()), X);
}

#[test]
fn matrices() {
    assert_value(
        quote!(self.flat(matrix![q.x, 1.0; 2.0, q.y] * vector![3.0, 4.0])),
        flat([3.0 * X + 4.0, 6.0 + 4.0 * Y]),
    );
    assert_value(
        quote!(let m: Matrix2<f64> = self.m; self.flat(m * Vector2::new(q.x, q.y))),
        flat([2.0, 2.0]),
    );
    assert_value(
        quote!(let m = Matrix2::new(1.0, q.x, q.y, 4.0); m.determinant() + m.trace() + m.m12 + m[(1, 0)]),
        9.0 - X * Y + X + Y,
    );
    assert_value(
        quote!(let v = Vector2::new(q.x, q.y); (v.transpose() * Matrix2::identity() * v)[0]),
        X * X + Y * Y,
    );
    assert_value(
        quote!(self.probe(Matrix3::from_diagonal(&Vector3::new(q.x, 2.0, 3.0)) * Vector3::repeat(1.0))),
        probe([X, 2.0, 3.0]),
    );
    assert_value(
        quote!(self.flat(
            Matrix2::from_columns(&[Vector2::new(1.0, 2.0), Vector2::new(q.x, q.y)]).transpose()
                * Vector2::x()
        )),
        flat([1.0, X]),
    );
}

#[test]
fn rotations() {
    let turned = |angle: f64, v: [f64; 2]| {
        [angle.cos() * v[0] - angle.sin() * v[1], angle.sin() * v[0] + angle.cos() * v[1]]
    };
    assert_value(
        quote!(self.flat(Rotation2::new(q.x) * UnitComplex::new(q.y).inverse() * Vector2::new(1.0, 2.0))),
        flat(turned(X - Y, [1.0, 2.0])),
    );
    let z = turned(X, [1.0, 2.0]);
    assert_value(
        quote!(self.probe(Rotation3::from_axis_angle(&Vector3::z_axis(), q.x) * Vector3::new(1.0, 2.0, 3.0))),
        probe([z[0], z[1], 3.0]),
    );
    let x = turned(X, [2.0, 3.0]);
    assert_value(
        quote!(self.probe(Rotation3::new(Vector3::new(q.x, 0.0, 0.0)) * Vector3::new(1.0, 2.0, 3.0))),
        probe([1.0, x[0], x[1]]),
    );
    let y = turned(X, [3.0, 1.0]);
    assert_value(
        quote!(self.probe(UnitQuaternion::from_euler_angles(0.0, q.x, 0.0) * Vector3::new(1.0, 2.0, 3.0))),
        probe([y[1], 2.0, y[0]]),
    );
    // A rotation about (1, 1, 1) by a third of a turn permutes the axes.
    assert_value(
        quote!(let axis = Unit::new_normalize(Vector3::repeat(1.0));
            let third = Rotation3::from_axis_angle(&axis, std::f64::consts::TAU / 3.0);
            self.probe(third * Vector3::new(q.x, q.y, 1.0))),
        probe([1.0, X, Y]),
    );
}

#[test]
fn poses() {
    let moved = [X + T.cos() - 2.0 * T.sin(), Y + T.sin() + 2.0 * T.cos()];
    let pose = quote!(let pose = Isometry2::new(Vector2::new(q.x, q.y), t););
    assert_value(quote!(#pose self.flat((pose * Point2::new(1.0, 2.0)).coords)), flat(moved));
    assert_value(
        quote!(#pose self.flat(pose * Vector2::new(1.0, 0.0)) + pose.rotation.angle()),
        flat([T.cos(), T.sin()]) + T,
    );
    assert_value(
        quote!(#pose self.flat((pose.inverse() * (pose * Point2::new(1.0, q.y))).coords)),
        flat([1.0, Y]),
    );
    assert_value(
        quote!(#pose self.flat((pose * Isometry2::translation(1.0, 2.0)).translation.vector)),
        flat(moved),
    );
    assert_value(
        quote!(let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), t);
            let pose = Isometry3::from_parts(Translation3::new(q.x, q.y, 5.0), turn.into());
            self.probe(pose.transform_point(&Point3::new(1.0, 2.0, 1.0)).coords)),
        probe([moved[0], moved[1], 6.0]),
    );
}

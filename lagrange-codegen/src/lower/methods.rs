//! The methods that a kind of value has, as messages suggest them.

use super::value::{Turn, Value};
use super::{iterate, quaternion, scalar};

/// Methods of vectors, points and translations.
const VECTOR: [&str; 25] = [
    "dot",
    "cross",
    "perp",
    "norm",
    "norm_squared",
    "magnitude",
    "magnitude_squared",
    "normalize",
    "transpose",
    "component_mul",
    "component_div",
    "add_scalar",
    "scale",
    "distance",
    "metric_distance",
    "sum",
    "len",
    "iter",
    "map",
    "zip_map",
    "tr_mul",
    "to_scalar",
    "cross_matrix",
    "push",
    "xy",
];

/// Methods of matrices.
const MATRIX: [&str; 15] = [
    "transpose",
    "trace",
    "diagonal",
    "determinant",
    "iter",
    "row",
    "column",
    "tr_mul",
    "norm",
    "norm_squared",
    "sum",
    "component_mul",
    "dot",
    "scale",
    "map",
];

/// Methods of rotations. The first is one of rotations in a plane alone.
const ROTATION: [&str; 9] = [
    "angle",
    "inverse",
    "transpose",
    "matrix",
    "to_rotation_matrix",
    "transform_vector",
    "transform_point",
    "inverse_transform_vector",
    "inverse_transform_point",
];

/// Methods of poses.
const POSE: [&str; 5] =
    ["inverse", "transform_vector", "transform_point", "inverse_transform_vector", "inverse_transform_point"];

/// Methods of integers.
const INTEGER: [&str; 10] = [
    "abs",
    "pow",
    "min",
    "max",
    "rem_euclid",
    "div_euclid",
    "div_ceil",
    "abs_diff",
    "saturating_sub",
    "is_multiple_of",
];

/// What a misspelt method of a value may mean.
pub(super) fn of(receiver: &Value) -> &'static [&'static str] {
    match receiver {
        Value::Scalar(..) | Value::Parameter(_) => &scalar::METHODS,
        Value::Vector(_) | Value::Point(_) => &VECTOR,
        Value::Translation(_) => &["inverse"],
        Value::Matrix(_) => &MATRIX,
        Value::Rotation(Turn::Plane(_)) => &ROTATION,
        Value::Rotation(Turn::Space(_)) => &ROTATION[1..],
        Value::Isometry(..) => &POSE,
        Value::Array(_) => &iterate::METHODS,
        Value::Iterator(_) | Value::Range(..) => &iterate::METHODS[1..],
        Value::Twist(_) => &["at"],
        Value::Quaternion(_) => &quaternion::METHODS,
        Value::Record(_) => &["to_array", "as_vector"],
        Value::Integer(..) => &INTEGER,
        Value::Unknown
        | Value::Unit
        | Value::Boolean(_)
        | Value::Choice(_)
        | Value::PoseVelocity(..)
        | Value::Closure(_)
        | Value::Tuple(_) => &[],
    }
}

/// Whether a name is that of a method of vectors or matrices.
pub(super) fn is_of_vectors(name: &str) -> bool {
    VECTOR.contains(&name) || MATRIX.contains(&name)
}

/// The call of a method of matrices that rotations and quaternions do not have.
pub(super) fn of_matrices_alone(name: &str) -> Option<String> {
    if !MATRIX.contains(&name) || ROTATION.contains(&name) || quaternion::METHODS.contains(&name) {
        return None;
    }
    let has_arguments = matches!(name, "row" | "column" | "tr_mul" | "component_mul" | "scale" | "map");
    Some(format!("{name}({})", if has_arguments { "…" } else { "" }))
}

/// Whether a name is that of a method of rotations or poses.
pub(super) fn is_of_rotations(name: &str) -> bool {
    ROTATION.contains(&name) || POSE.contains(&name)
}

#[cfg(test)]
mod tests {
    use proc_macro2::TokenStream;
    use quote::quote;

    use super::super::construct::CONSTRUCTORS;
    use super::super::tests::lowered;
    use super::*;

    /// Lists of arguments, one of which each function takes.
    const ARGUMENTS: [&str; 30] = [
        "",
        "1",
        "2.0",
        "1.0, 2.0",
        "1.0, 2.0, 3.0",
        "1.0, 2.0, 3.0, 4.0",
        "1, 2.0",
        "&Vector2::new(q.x, 1.0)",
        "&Vector3::new(q.x, 1.0, 2.0)",
        "Vector3::x(), 0.5",
        "0.5 * Vector3::x()",
        "1.0, Vector3::x()",
        "&Point2::new(q.x, 1.0)",
        "&Point3::new(q.x, 1.0, 2.0)",
        "&Matrix2::identity()",
        "Matrix3::identity()",
        "Rotation2::new(0.3)",
        "Rotation3::identity()",
        "Translation3::identity(), UnitQuaternion::identity()",
        "Quaternion::identity()",
        "[1.0, 2.0]",
        "&[1.0, 2.0, 3.0, 4.0]",
        "&[Vector2::x(), Vector2::y()]",
        "&[Vector3::x(), Vector3::y(), Vector3::z()]",
        "|x| x",
        "|_| true",
        "|x| [x, x]",
        "0.0, |sum, x| sum + x",
        "&Vector2::x(), |x, y| x * y",
        "|_, _| 1.0",
    ];

    fn is_accepted(call: &str) -> bool {
        let call: TokenStream = call.parse().expect("tokens");
        let model = lowered(
            quote!(coordinates = [x, y]),
            quote! {
                impl System {
                    #[lagrangian]
                    fn energy(&self, q: &Coordinates, v: &Velocities) -> f64 {
                        let _probe = #call;
                        v.x * v.x + v.y * v.y
                    }
                    fn frame(&self, q: &Coordinates) -> Isometry2<f64> {
                        Isometry2::new(Vector2::new(q.x, q.y), q.x)
                    }
                }
            },
        );
        model.is_ok()
    }

    /// The names that cannot be called on any of the owners.
    fn refused<'a>(names: &[&'a str], owners: &[&str]) -> Vec<&'a str> {
        let calls = |name: &&str| {
            let call =
                |owner: &&str| ARGUMENTS.iter().any(|list| is_accepted(&format!("{owner}{name}({list})")));
            owners.iter().any(call)
        };
        names.iter().filter(|name| !calls(name)).copied().collect()
    }

    #[test]
    fn what_messages_suggest_is_accepted() {
        assert!(!is_accepted("Rotation2::new(q.x).rotate(&Vector2::x())"));
        let lists: [(&[&str], &[&str]); 13] = [
            (&scalar::METHODS, &["q.x."]),
            (&VECTOR, &["Vector3::new(q.x, q.y, 1.0).", "Vector2::new(q.x, q.y).", "Vector1::new(q.x)."]),
            (&["inverse"], &["Translation2::new(q.x, q.y)."]),
            (&MATRIX, &["Matrix2::new(q.x, q.y, 1.0, 2.0)."]),
            (&ROTATION, &["Rotation2::new(q.x)."]),
            (&ROTATION[1..], &["Rotation3::from_axis_angle(&Vector3::z_axis(), q.x)."]),
            (&POSE, &["Isometry2::new(Vector2::new(q.x, q.y), q.x)."]),
            (&iterate::METHODS, &["[1.0, q.x].", "[[1.0, q.x], [q.y, 2.0]]."]),
            (&iterate::METHODS[1..], &["[1.0, q.x].iter().", "[[1.0, q.x], [q.y, 2.0]].iter()."]),
            (&["at"], &["self.frame_velocity(q, v)."]),
            (&quaternion::METHODS, &["Quaternion::new(q.x, q.y, 1.0, 2.0)."]),
            (&["to_array", "as_vector"], &["q."]),
            (&INTEGER, &["7_i32."]),
        ];
        for (names, owners) in lists {
            assert_eq!(refused(names, owners), [""; 0], "{owners:?}");
        }
        let types = [
            "f64::",
            "Vector2::",
            "Vector3::",
            "Point2::",
            "Matrix2::",
            "Rotation2::",
            "Rotation3::",
            "UnitQuaternion::",
            "Quaternion::",
            "Isometry2::",
            "Isometry3::",
        ];
        assert_eq!(refused(&CONSTRUCTORS, &types), [""; 0]);
    }
}

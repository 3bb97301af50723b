//! The functions of velocities that a description uses. With them the description stays Rust that can be
//! called.

use proc_macro2::TokenStream;

use super::body::{self, Source};
use super::tokens::Parameters;
use super::{Emission, docs, names};
use crate::diagnostics::Diagnostics;
use crate::model::{Locals, Model, Quantity, Rates, Spin, Velocity};
use crate::simplify::simplify;
use crate::syntax::item::{Argument, Function};
use crate::syntax::types::{Type, TypeKind};
use crate::syntax::{Item, Record, constant};

/// Components of a position whose type cannot be read: a vector with every field.
pub(super) const UNKNOWN: usize = 3;

/// All of them as functions of the user's type.
pub(super) fn velocities(emission: &mut Emission<'_>, diagnostics: &Diagnostics) -> TokenStream {
    let velocities = emission.model.velocities.clone();
    if velocities.is_empty() {
        return TokenStream::new();
    }
    // The functions take all declared coordinates, eliminated ones included.
    let (coordinates, locals) = declared(emission.model);
    let parameters = Parameters::new(emission.model, diagnostics);
    let text: String = velocities.iter().map(|velocity| function(emission, velocity)).collect();
    let functions = parameters.parse(&text);
    emission.model.coordinates = coordinates;
    emission.model.locals = locals;
    functions
}

/// Gives a model all its declared coordinates and returns those that it had.
fn declared(model: &mut Model) -> (Vec<Quantity>, Locals) {
    let mut all = model.coordinates.clone();
    for eliminated in &model.eliminated {
        all.insert(eliminated.declared_index, eliminated.quantity.clone());
    }
    let coordinates = std::mem::replace(&mut model.coordinates, all);
    let locals = names::locals(model, model.locals.least);
    (coordinates, std::mem::replace(&mut model.locals, locals))
}

fn function(emission: &mut Emission<'_>, velocity: &Velocity) -> String {
    let function = &emission.item.functions[velocity.function];
    let nodes = velocity.rates.nodes();
    let nodes = simplify(&mut emission.model.graph, &mut emission.model.hints, &nodes);
    let scalar = emission.scalar.to_string();
    let count = emission.model.coordinates.len();
    let taken: String = [(Record::Coordinates, "q"), (Record::Velocities, "v")]
        .into_iter()
        .filter(|(record, _)| takes(function, Argument::Record(*record)))
        .map(|(record, name)| {
            if record == Record::Velocities && emission.item.has_orientations() {
                return "let v = &v.__rates(*q);\n".to_owned();
            }
            let ident = emission.item.record_ident(record);
            format!("let {name} = &<[{scalar}; {count}] as ::core::convert::From<{ident}<{scalar}>>>::from(*{name});\n")
        })
        .collect();
    let body = body::plain(emission.model, &emission.scalar, &nodes, Source::Slices, |values| {
        built(&velocity.rates, &scalar, &mut values.iter())
    });
    let doc = format!(
        "Velocity of what [`{}`](Self::{}) returns: {}.{}",
        function.name,
        function.name,
        described(&velocity.rates),
        match nodes.as_slice() {
            [single] => docs::equation(emission.model, "rate", *single),
            _ => String::new(),
        }
    );
    let signature =
        signature(emission.item, function, &velocity.name, &scalar, &type_of(&velocity.rates, &scalar));
    format!(
        "#[doc = {doc:?}]\n#[inline]\n#[allow(unused_variables)]\npub fn {signature} {{\n{taken}{body}\n}}\n"
    )
}

fn takes(function: &Function, argument: Argument) -> bool {
    function.velocity_arguments().unwrap_or_default().contains(&argument)
}

fn signature(item: &Item, function: &Function, name: &str, scalar: &str, output: &str) -> String {
    let own = function.receiver.then(|| "&self".to_owned());
    let arguments =
        function.velocity_arguments().unwrap_or_default().into_iter().map(|argument| match argument {
            Argument::Time => format!("t: {scalar}"),
            Argument::Record(record) => {
                let name = if record == Record::Velocities { "v" } else { "q" };
                format!("{name}: &{}<{scalar}>", item.record_ident(record))
            }
        });
    let arguments: Vec<String> = own.into_iter().chain(arguments).collect();
    format!("{name}({}) -> {output}", arguments.join(", "))
}

fn described(rates: &Rates) -> &'static str {
    match rates {
        Rates::Scalar(_) | Rates::Matrix(..) | Rates::Tuple(_) => "its derivative by time along the motion",
        Rates::Twist(_) => "that of the body, of its reference point and angular",
        Rates::Array(_) => "that of each element",
    }
}

fn type_of(rates: &Rates, scalar: &str) -> String {
    match rates {
        Rates::Scalar(_) => scalar.to_owned(),
        Rates::Matrix(rows, 1, _) => vector(*rows, scalar),
        Rates::Matrix(rows, columns, _) => {
            format!("lagrange::nalgebra::SMatrix<{scalar}, {rows}, {columns}>")
        }
        Rates::Twist(twist) => format!("lagrange::Twist{}<{scalar}>", twist.dimension()),
        Rates::Array(parts) => match parts.first() {
            Some(first) => format!("[{}; {}]", type_of(first, scalar), parts.len()),
            None => format!("[{scalar}; 0]"),
        },
        Rates::Tuple(parts) => {
            let parts: Vec<String> = parts.iter().map(|part| type_of(part, scalar)).collect();
            format!("({})", parts.join(", "))
        }
    }
}

fn vector(length: usize, scalar: &str) -> String {
    format!("lagrange::nalgebra::SVector<{scalar}, {length}>")
}

/// The value of a type from its numbers.
fn built<'v>(rates: &Rates, scalar: &str, values: &mut impl Iterator<Item = &'v String>) -> String {
    let mut take = |count: usize| values.by_ref().take(count).cloned().collect::<Vec<String>>().join(", ");
    let of_columns =
        |columns: String, ty: String| format!("<{ty} as ::core::convert::From<_>>::from([{columns}])");
    match rates {
        Rates::Scalar(_) => take(1),
        Rates::Matrix(rows, 1, _) => of_columns(take(*rows), vector(*rows, scalar)),
        Rates::Matrix(rows, columns, _) => {
            let entries: Vec<String> = values.by_ref().take(rows * columns).cloned().collect();
            let column = |column: usize| {
                let entries: Vec<&str> =
                    (0..*rows).map(|row| entries[row * columns + column].as_str()).collect();
                format!("[{}]", entries.join(", "))
            };
            of_columns((0..*columns).map(column).collect::<Vec<_>>().join(", "), type_of(rates, scalar))
        }
        Rates::Twist(twist) => {
            let size = twist.dimension();
            let mut part = |name: &str| format!("{name}: {}", of_columns(take(size), vector(size, scalar)));
            let mut fields = ["position", "velocity", "velocity_in_body"].map(&mut part).to_vec();
            match twist.spin {
                Spin::Plane(_) => fields.push(format!("angular_velocity: {}", take(1))),
                Spin::Space { .. } => {
                    fields.extend(["angular_velocity", "angular_velocity_in_body"].map(&mut part))
                }
            }
            format!("lagrange::Twist{size} {{ {} }}", fields.join(", "))
        }
        Rates::Array(parts) => {
            let parts: Vec<String> = parts.iter().map(|part| built(part, scalar, values)).collect();
            format!("[{}]", parts.join(", "))
        }
        Rates::Tuple(parts) => {
            let parts: Vec<String> = parts.iter().map(|part| built(part, scalar, values)).collect();
            format!("({})", parts.join(", "))
        }
    }
}

/// The same functions without content.
pub(super) fn stubs(item: &Item, scalar: &str) -> TokenStream {
    let stub = |velocity: &crate::syntax::Velocity| {
        let function = &item.functions[velocity.function];
        function.velocity_arguments()?;
        let known = function.output.as_ref().and_then(|output| declared_rate(item, output, scalar));
        let output = known.unwrap_or_else(|| vector(UNKNOWN, scalar));
        let text =
            format!("pub fn {} {{ loop {{}} }}", signature(item, function, &velocity.name, scalar, &output));
        text.parse::<TokenStream>().ok()
    };
    let stubs = item.velocities.iter().filter_map(stub);
    stubs.collect()
}

/// The type of the rate of a declared type.
fn declared_rate(item: &Item, ty: &Type, scalar: &str) -> Option<String> {
    let length =
        |expr| constant::integer(expr, &item.constants).and_then(|length| usize::try_from(length).ok());
    match &ty.kind {
        TypeKind::Scalar => Some(scalar.to_owned()),
        TypeKind::Vector(size) => Some(vector(length(size)?, scalar)),
        TypeKind::Point(size) | TypeKind::Translation(size) => Some(vector(*size, scalar)),
        TypeKind::Matrix(rows, columns) => {
            Some(format!("lagrange::nalgebra::SMatrix<{scalar}, {}, {}>", length(rows)?, length(columns)?))
        }
        TypeKind::Rotation(size) | TypeKind::Isometry(size) => {
            Some(format!("lagrange::Twist{size}<{scalar}>"))
        }
        TypeKind::Quaternion => Some(format!("lagrange::Twist3<{scalar}>")),
        TypeKind::Array(element, count) => {
            Some(format!("[{}; {}]", declared_rate(item, element, scalar)?, length(count)?))
        }
        TypeKind::Tuple(parts) => match parts.as_slice() {
            [Type { kind: TypeKind::Vector(size), .. }, turn] => {
                let size = length(size)?;
                let is_pose = match &turn.kind {
                    TypeKind::Scalar => size == 2,
                    TypeKind::Rotation(dimension) => *dimension == size,
                    TypeKind::Quaternion => size == 3,
                    _ => false,
                };
                is_pose.then(|| format!("lagrange::Twist{size}<{scalar}>"))
            }
            _ => None,
        },
        _ => None,
    }
}

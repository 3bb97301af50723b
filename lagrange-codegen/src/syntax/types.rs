//! Types that the language knows, read from signatures, annotations and paths.

use syn::{GenericArgument, PathArguments};

use super::body::{Expr, ExprKind, Name};
use super::integers::Integers;
use super::item::{Record, Scalar};
use super::translate::Translator;
use crate::diagnostics::Origin;

/// A type with its origin.
#[derive(Clone, Debug)]
pub struct Type {
    /// Where it stands.
    pub origin: Origin,
    /// The kind of the type.
    pub kind: TypeKind,
    /// The check that this is nalgebra's type of that name, or the velocity of a body.
    pub meaning: Option<Meaning>,
    /// As the user wrote it.
    pub written: Name,
}

/// A check that a type is nalgebra's, or the runtime's velocity of a body.
#[derive(Clone, Debug)]
pub struct Meaning {
    /// The path without generic arguments: each path is checked once.
    pub path: Name,
    /// A statement that compiles only if it is.
    pub statement: Name,
}

/// The types of the language. Lengths are expressions: literals or constants of the block.
#[derive(Clone, Debug)]
pub enum TypeKind {
    /// The scalar of the description.
    Scalar,
    /// An integer.
    Integer(Integers),
    /// A float of the other precision.
    OtherFloat,
    /// `bool`.
    Boolean,
    /// `()`.
    Unit,
    /// `Vector3`, `SVector`, `UnitVector3`, `Unit<…>`.
    Vector(Box<Expr>),
    /// `Point3`.
    Point(usize),
    /// `Matrix3`, `SMatrix`, `RowVector3`: rows and columns.
    Matrix(Box<Expr>, Box<Expr>),
    /// `Translation3`.
    Translation(usize),
    /// `Rotation2`, `UnitComplex` (2), `Rotation3`.
    Rotation(usize),
    /// `UnitQuaternion`.
    Quaternion,
    /// `Quaternion`, of any length.
    AnyQuaternion,
    /// `Isometry2`, `IsometryMatrix3`.
    Isometry(usize),
    /// `Twist2`, `Twist3`.
    Twist(usize),
    /// `[T; n]`.
    Array(Box<Type>, Box<Expr>),
    /// `[T]`.
    Slice(Box<Type>),
    /// `(A, B)`.
    Tuple(Vec<Type>),
    /// `Coordinates`, `Velocities`, `Inputs`.
    Record(Record),
    /// `_`.
    Infer,
    /// Any other type, as text.
    Other(Name),
}

impl Translator<'_> {
    /// Reads a type; references are transparent.
    pub fn ty(&mut self, ty: &syn::Type) -> Type {
        let kind = match ty {
            syn::Type::Reference(reference) => return self.ty(&reference.elem),
            syn::Type::Paren(paren) => return self.ty(&paren.elem),
            syn::Type::Group(group) => return self.ty(&group.elem),
            syn::Type::Array(array) => {
                let element = self.ty(&array.elem);
                TypeKind::Array(Box::new(element), Box::new(self.expression(&array.len)))
            }
            syn::Type::Slice(slice) => TypeKind::Slice(Box::new(self.ty(&slice.elem))),
            syn::Type::Tuple(tuple) if tuple.elems.is_empty() => TypeKind::Unit,
            syn::Type::Tuple(tuple) => TypeKind::Tuple(tuple.elems.iter().map(|t| self.ty(t)).collect()),
            syn::Type::Infer(_) => TypeKind::Infer,
            syn::Type::Path(path) if path.qself.is_none() => {
                return self.path_type(path.path.segments.iter(), &path.path);
            }
            _ => TypeKind::Other(self.text(ty)),
        };
        Type { origin: self.origin_of(ty), kind, meaning: None, written: self.text(ty) }
    }

    /// Reads the type named by some segments of a path.
    pub fn path_type<'a>(
        &mut self,
        segments: impl Iterator<Item = &'a syn::PathSegment>,
        whole: &syn::Path,
    ) -> Type {
        let segments: Vec<&syn::PathSegment> = segments.collect();
        let origin = self.origin_of(whole);
        let Some(last) = segments.last().filter(|_| !self.is_local(whole)) else {
            let written = self.text(whole);
            return Type { origin, kind: TypeKind::Other(written.clone()), meaning: None, written };
        };
        let arguments = generic_arguments(last);
        let kind = match self.path_kind(&last.ident.to_string(), &arguments, segments.len() == 1, origin) {
            Some(kind) => kind,
            None => TypeKind::Other(self.text(whole)),
        };
        let meaning = match kind {
            TypeKind::Vector(_)
            | TypeKind::Point(_)
            | TypeKind::Matrix(..)
            | TypeKind::Translation(_)
            | TypeKind::Rotation(_)
            | TypeKind::Quaternion
            | TypeKind::AnyQuaternion
            | TypeKind::Isometry(_)
            | TypeKind::Twist(_) => Some(self.meaning(&segments, whole)),
            _ => None,
        };
        Type { origin, kind, meaning, written: self.text(whole) }
    }

    /// A function that takes nalgebra's type of a name, assigned from a function that takes the user's type
    /// of that name. Inside an expression the compiler infers the generic arguments that the user left out.
    fn meaning(&mut self, segments: &[&syn::PathSegment], whole: &syn::Path) -> Meaning {
        // Without generic arguments, so that each type is checked once.
        let segments_only = segments.iter().map(|segment| syn::PathSegment::from(segment.ident.clone()));
        let path = syn::Path { leading_colon: whole.leading_colon, segments: segments_only.collect() };
        let ours = match segments.last() {
            Some(last) => self.ours(last),
            None => String::new(),
        };
        let text = self.text(&path);
        let function = match segments.last().map(|last| &last.arguments) {
            Some(PathArguments::AngleBracketed(_)) => {
                let segments = segments.iter().copied().cloned().collect();
                let full = syn::Path { leading_colon: whole.leading_colon, segments };
                format!("<{}>::clone", self.text(&full))
            }
            _ => format!("{text}::clone"),
        };
        let theirs = if whole.leading_colon.is_some() { function.into() } else { self.imported(&function) };
        let path = if whole.leading_colon.is_some() { text } else { self.imported(&text) };
        Meaning { path, statement: format!("let _: fn(&{ours}) -> {ours} = {theirs};").into() }
    }

    /// The type that a name should be: one of nalgebra, or the velocity of a body, with the generic arguments
    /// as written, or else the scalar.
    fn ours(&mut self, segment: &syn::PathSegment) -> String {
        let written = generic_arguments(segment);
        let arguments: Vec<String> = match written.as_slice() {
            [GenericArgument::Type(syn::Type::Path(inner))] if segment.ident == "Unit" => {
                inner.path.segments.last().map(|inner| self.ours(inner)).into_iter().collect()
            }
            [] => vec![self.scalar.to_string()],
            list => list.iter().map(|argument| self.text(argument).to_string()).collect(),
        };
        let own = matches!(segment.ident.to_string().as_str(), "Twist2" | "Twist3");
        let home = if own { "lagrange" } else { "lagrange::nalgebra" };
        format!("{home}::{}<{}>", segment.ident, arguments.join(", "))
    }

    fn path_kind(
        &mut self,
        name: &str,
        arguments: &[&GenericArgument],
        single: bool,
        origin: Origin,
    ) -> Option<TypeKind> {
        let constant = |value: usize| {
            Box::new(Expr {
                origin,
                kind: ExprKind::Integer(i128::try_from(value).unwrap_or(0), Integers::USIZE),
            })
        };
        if single && self.is_scalar(name) {
            return Some(TypeKind::Scalar);
        }
        let is_other = |argument: &GenericArgument| {
            matches!(argument, GenericArgument::Type(syn::Type::Path(path))
                if path.path.get_ident().is_some_and(|name| name == self.other_float()))
        };
        if arguments.first().is_some_and(|argument| is_other(argument)) {
            return Some(TypeKind::OtherFloat);
        }
        if let Some(types) = Integers::named(name) {
            return Some(TypeKind::Integer(types));
        }
        match name {
            "f32" | "f64" if name == self.other_float() => return Some(TypeKind::OtherFloat),
            "f32" | "f64" => return Some(TypeKind::Scalar),
            "bool" => return Some(TypeKind::Boolean),
            "Rotation2" | "UnitComplex" => return Some(TypeKind::Rotation(2)),
            "Rotation3" => return Some(TypeKind::Rotation(3)),
            "UnitQuaternion" => return Some(TypeKind::Quaternion),
            "Quaternion" => return Some(TypeKind::AnyQuaternion),
            "Isometry2" | "IsometryMatrix2" => return Some(TypeKind::Isometry(2)),
            "Isometry3" | "IsometryMatrix3" => return Some(TypeKind::Isometry(3)),
            "Twist2" => return Some(TypeKind::Twist(2)),
            "Twist3" => return Some(TypeKind::Twist(3)),
            "Unit" => {
                let Some(GenericArgument::Type(inner)) = arguments.first() else { return None };
                return Some(self.ty(inner).kind);
            }
            "SVector" => {
                return Some(TypeKind::Vector(Box::new(self.length(arguments.get(1)?)?)));
            }
            "SMatrix" => {
                let rows = self.length(arguments.get(1)?)?;
                let columns = self.length(arguments.get(2)?)?;
                return Some(TypeKind::Matrix(Box::new(rows), Box::new(columns)));
            }
            _ => {}
        }
        if single && let Some(record) = Record::named(name) {
            return Some(TypeKind::Record(record));
        }
        let split = name.find(|c: char| c.is_ascii_digit())?;
        let (family, size) = name.split_at(split);
        match family {
            "Vector" | "UnitVector" => Some(TypeKind::Vector(constant(size.parse().ok()?))),
            "RowVector" => Some(TypeKind::Matrix(constant(1), constant(size.parse().ok()?))),
            "Point" => Some(TypeKind::Point(size.parse().ok()?)),
            "Translation" => Some(TypeKind::Translation(size.parse().ok()?)),
            "Matrix" => {
                let (rows, columns) = size.split_once('x').unwrap_or((size, size));
                Some(TypeKind::Matrix(constant(rows.parse().ok()?), constant(columns.parse().ok()?)))
            }
            _ => None,
        }
    }

    /// The float of the other precision. A generic scalar takes its constants from doubles.
    fn other_float(&self) -> &'static str {
        match &self.scalar {
            _ if self.mixed => "",
            Scalar::F32 => "f64",
            Scalar::F64 | Scalar::Generic(_) => "f32",
        }
    }

    /// A const argument: a literal, a block, or a name that parses as a type.
    fn length(&mut self, argument: &GenericArgument) -> Option<Expr> {
        match argument {
            GenericArgument::Const(value) => Some(self.expression(value)),
            GenericArgument::Type(syn::Type::Path(path)) => {
                let value = syn::Expr::Path(syn::ExprPath {
                    attrs: Vec::new(),
                    qself: None,
                    path: path.path.clone(),
                });
                Some(self.expression(&value))
            }
            _ => None,
        }
    }
}

fn generic_arguments(segment: &syn::PathSegment) -> Vec<&GenericArgument> {
    match &segment.arguments {
        PathArguments::AngleBracketed(arguments) => arguments
            .args
            .iter()
            .filter(|argument| !matches!(argument, GenericArgument::Lifetime(_)))
            .collect(),
        PathArguments::None | PathArguments::Parenthesized(_) => Vec::new(),
    }
}

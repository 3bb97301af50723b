//! Types that the language knows, read from signatures, annotations and paths.

use std::rc::Rc;

use syn::{GenericArgument, PathArguments};

use super::body::{Expr, ExprKind, Name};
use super::item::Record;
use super::translate::Translator;
use crate::diagnostics::Origin;

/// A type with its place.
#[derive(Clone, Debug)]
pub struct Type {
    /// Where it stands.
    pub origin: Origin,
    /// What it is.
    pub kind: TypeKind,
}

/// The types of the language. Lengths are expressions: literals or constants of the block.
#[derive(Clone, Debug)]
pub enum TypeKind {
    /// The scalar of the description.
    Scalar,
    /// Any integer.
    Integer,
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
    /// `Isometry2`, `IsometryMatrix3`.
    Isometry(usize),
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
        Type { origin: self.place(ty), kind }
    }

    /// Reads the type named by some segments of a path.
    pub fn path_type<'a>(
        &mut self,
        segments: impl Iterator<Item = &'a syn::PathSegment>,
        whole: &syn::Path,
    ) -> Type {
        let segments: Vec<&syn::PathSegment> = segments.collect();
        let origin = self.place(whole);
        let Some(last) = segments.last() else {
            return Type { origin, kind: TypeKind::Other(Rc::from("")) };
        };
        let arguments = generic_arguments(last);
        let kind = match self.path_kind(&last.ident.to_string(), &arguments, segments.len() == 1, origin) {
            Some(kind) => kind,
            None => TypeKind::Other(self.text(whole)),
        };
        Type { origin, kind }
    }

    fn path_kind(
        &mut self,
        name: &str,
        arguments: &[&GenericArgument],
        single: bool,
        origin: Origin,
    ) -> Option<TypeKind> {
        let constant = |value: usize| {
            Box::new(Expr { origin, kind: ExprKind::Integer(i128::try_from(value).unwrap_or(0)) })
        };
        if single && self.is_scalar(name) {
            return Some(TypeKind::Scalar);
        }
        match name {
            "f32" | "f64" => return Some(TypeKind::Scalar),
            "i8" | "i16" | "i32" | "i64" | "i128" | "isize" | "u8" | "u16" | "u32" | "u64" | "u128"
            | "usize" => {
                return Some(TypeKind::Integer);
            }
            "bool" => return Some(TypeKind::Boolean),
            "Rotation2" | "UnitComplex" => return Some(TypeKind::Rotation(2)),
            "Rotation3" => return Some(TypeKind::Rotation(3)),
            "UnitQuaternion" => return Some(TypeKind::Quaternion),
            "Isometry2" | "IsometryMatrix2" => return Some(TypeKind::Isometry(2)),
            "Isometry3" | "IsometryMatrix3" => return Some(TypeKind::Isometry(3)),
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

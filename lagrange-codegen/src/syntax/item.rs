//! A description as the user wrote it: names, roles and function bodies, before any meaning.

use std::fmt;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::args::LINTS;
use super::body::{Block, Constant, Expr, Name, Pattern, Word};
use super::constant;
pub use super::friction::{Friction, Normal};
use super::translate::bare;
use super::types::{Type, TypeKind};
use crate::diagnostics::Origin;

/// A parsed `#[lagrangian(…)] impl … { … }`.
#[derive(Debug)]
pub struct Item {
    /// The last segment of the type.
    pub title: Ident,
    /// The name from which those of generated types are made.
    pub name: Ident,
    /// The type of the impl block.
    pub self_ty: syn::Type,
    /// The generics of the impl block.
    pub generics: syn::Generics,
    /// The scalar type.
    pub scalar: Scalar,
    /// Generalized coordinates in declaration order.
    pub coordinates: Vec<Group>,
    /// Inputs in declaration order.
    pub inputs: Vec<Group>,
    /// The crate that generated code names.
    pub crate_path: syn::Path,
    /// Whether derivatives of the equations are generated.
    pub jacobians: bool,
    /// Parameters by which derivatives are taken.
    pub sensitivities: Vec<Expr>,
    /// Whether the analyses are generated: conserved quantities, parts of the energy, verification.
    pub analysis: bool,
    /// Whether the equations are written in LaTeX and MathML, too.
    pub formulas: bool,
    /// The fewest alike values that stand in an array and are computed by a loop.
    pub least_loop: usize,
    /// The system that a generated test verifies.
    pub verify: Option<syn::Expr>,
    /// The rate of Baumgarte's stabilisation, if the attribute has it.
    pub baumgarte: Option<Expr>,
    /// Lints switched off with `allow(…)`.
    pub allowed: Vec<&'static str>,
    /// The impl block that is emitted again.
    pub cleaned: TokenStream,
    /// Functions with and without a role, in order.
    pub functions: Vec<Function>,
    /// Velocities for which the macro writes functions.
    pub velocities: Vec<Velocity>,
    /// Associated constants.
    pub constants: Vec<Constant>,
    /// The origin of the type's name.
    pub origin: Origin,
    /// Why nothing can be derived, though some declarations are known.
    pub incomplete: Option<Incomplete>,
}

/// Why an item has declarations at most.
#[derive(Debug)]
pub enum Incomplete {
    /// Arguments of the attribute cannot be read, or functions have one name. The mistake is reported.
    Declarations,
    /// The item does not parse, for this reason. The compiler has said so if it comes from a source file.
    Form(String),
}

impl Item {
    /// Whether a lint was switched off.
    pub fn allows(&self, lint: &str) -> bool {
        debug_assert!(LINTS.contains(&lint), "item: a lint that is not in the list");
        self.allowed.contains(&lint)
    }

    /// Whether a coordinate is an orientation or a pose.
    pub fn has_orientations(&self) -> bool {
        self.coordinates.iter().any(|group| group.kind != Kind::Scalar)
    }

    /// The number of scalar coordinates that roles ask to eliminate.
    pub fn eliminated(&self) -> usize {
        let eliminates = |kind: &RoleKind| matches!(kind, RoleKind::Holonomic { eliminate: Some(_) });
        let functions = self.functions.iter().filter(|function| function.meant().is_some_and(eliminates));
        functions.map(|function| self.components(function).unwrap_or(1)).sum()
    }

    /// Whether a function is a constraint with a multiplier.
    pub fn is_kept_constraint(&self, function: &Function) -> bool {
        let kind = function.meant();
        matches!(kind, Some(RoleKind::Holonomic { eliminate: None } | RoleKind::Nonholonomic { .. }))
    }

    /// Whether a function has a multiplier, be it at times only.
    pub fn has_multiplier(&self, function: &Function) -> bool {
        self.is_kept_constraint(function)
            || matches!(function.meant(), Some(RoleKind::Unilateral { .. } | RoleKind::Friction(_)))
    }

    /// The number of components of a function's result, if it is an array or a vector.
    pub fn components(&self, function: &Function) -> Option<usize> {
        match function.output.as_ref().map(|ty| &ty.kind) {
            Some(TypeKind::Array(_, length) | TypeKind::Vector(length)) => {
                constant::integer(length, &self.constants).and_then(|length| length.try_into().ok())
            }
            _ => None,
        }
    }

    /// The name of a generated struct, such as `ChainCoordinates`.
    pub fn record_ident(&self, record: Record) -> Ident {
        record.ident(&self.name)
    }
}

/// The kind of a declared coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    Scalar,
    /// An orientation in space: three numbers of a state.
    Rotation,
    /// A position and an orientation in space: three numbers of a state each.
    Pose,
}

impl Kind {
    /// Scalar coordinates of an element.
    pub fn width(self) -> usize {
        match self {
            Kind::Scalar => 1,
            Kind::Rotation => 3,
            Kind::Pose => 6,
        }
    }

    /// The type of an element in a record over the scalar `R`; `path` leads to the facade.
    pub fn element(self, record: Record, path: &syn::Path) -> TokenStream {
        let is_velocity = record == Record::Velocities;
        match (self, is_velocity) {
            (Kind::Scalar, _) => quote!(R),
            (Kind::Rotation, false) => quote!(#path::__private::nalgebra::UnitQuaternion<R>),
            (Kind::Rotation, true) => quote!(#path::__private::nalgebra::Vector3<R>),
            (Kind::Pose, false) => quote!(#path::__private::nalgebra::Isometry3<R>),
            (Kind::Pose, true) => quote!(#path::__private::attitude::PoseVelocity<R>),
        }
    }
}

/// A declared coordinate or input.
#[derive(Clone, Debug)]
pub struct Group {
    /// The name, possibly raw.
    pub ident: Ident,
    /// The kind of each element.
    pub kind: Kind,
    /// The length of an array.
    pub length: Option<usize>,
    /// Where it was declared.
    pub origin: Origin,
}

impl Group {
    /// The name without a raw prefix.
    pub fn name(&self) -> Name {
        bare(&self.ident)
    }

    /// Scalar coordinates of all elements.
    pub fn size(&self) -> usize {
        self.kind.width() * self.length.unwrap_or(1)
    }
}

/// The type of all quantities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// `f64`.
    F64,
    /// `f32`.
    F32,
    /// A type parameter with the bound `Real`.
    Generic(Ident),
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Scalar::F64 => f.write_str("f64"),
            Scalar::F32 => f.write_str("f32"),
            Scalar::Generic(ident) => write!(f, "{ident}"),
        }
    }
}

/// A struct that the macro generates for the arguments of the user's functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Record {
    /// Generalized coordinates.
    Coordinates,
    /// Generalized velocities.
    Velocities,
    /// Inputs.
    Inputs,
}

impl Record {
    /// All of them.
    pub const ALL: [Record; 3] = [Record::Coordinates, Record::Velocities, Record::Inputs];

    /// The name that the user writes.
    pub fn name(self) -> &'static str {
        match self {
            Record::Coordinates => "Coordinates",
            Record::Velocities => "Velocities",
            Record::Inputs => "Inputs",
        }
    }

    /// The record of a name.
    pub fn named(name: &str) -> Option<Record> {
        Record::ALL.into_iter().find(|record| record.name() == name)
    }

    /// The name of the generated struct.
    pub fn ident(self, type_name: &Ident) -> Ident {
        format_ident!("{}{}", type_name, self.name(), span = type_name.span())
    }
}

/// A function of the impl block.
#[derive(Clone, Debug)]
pub struct Function {
    /// Its name.
    pub name: Name,
    /// Where the name stands.
    pub origin: Origin,
    /// Its role, if it has one.
    pub role: Option<Role>,
    /// The role, if its arguments cannot be read. The mistake is reported.
    pub unread: Option<RoleKind>,
    /// Whether it takes `self`.
    pub receiver: bool,
    /// Its const parameters that count something, which only helpers may have.
    pub lengths: Vec<Name>,
    /// The parameters after `self`.
    pub parameters: Vec<Parameter>,
    /// The return type.
    pub output: Option<Type>,
    /// The body.
    pub body: Block,
    /// A `cfg` on the function or inside it.
    pub conditional: Option<Origin>,
}

/// A parameter of a function.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The pattern.
    pub pattern: Pattern,
    /// The type.
    pub ty: Type,
    /// How many references stand before it.
    pub references: usize,
    /// The argument that a role passes for it; `None` for other parameters, which only helpers may have.
    pub argument: Option<Argument>,
}

/// An argument that a role function can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// One of the generated structs.
    Record(Record),
    /// Time.
    Time,
}

impl Function {
    /// The kind of the role, with blank arguments if they cannot be read.
    pub fn meant(&self) -> Option<&RoleKind> {
        self.role.as_ref().map(|role| &role.kind).or(self.unread.as_ref())
    }

    /// The arguments of the function's velocity, in order; `None` if the function depends on more than
    /// coordinates and time.
    pub fn velocity_arguments(&self) -> Option<Vec<Argument>> {
        let mut arguments = Vec::new();
        for parameter in &self.parameters {
            match parameter.argument? {
                Argument::Record(Record::Coordinates) => {
                    arguments.extend([Record::Coordinates, Record::Velocities].map(Argument::Record));
                }
                Argument::Time => arguments.push(Argument::Time),
                Argument::Record(Record::Velocities | Record::Inputs) => return None,
            }
        }
        Some(arguments)
    }
}

/// A velocity that the description calls for.
#[derive(Clone, Debug)]
pub struct Velocity {
    /// The index of the function.
    pub function: usize,
    /// Its own name.
    pub name: Name,
    /// Where it is first called.
    pub origin: Origin,
}

/// The meaning of a function.
#[derive(Clone, Debug)]
pub struct Role {
    /// Its kind and arguments.
    pub kind: RoleKind,
    /// The arguments as Rust evaluates them, by name.
    pub written: Vec<(String, syn::Expr)>,
    /// The attribute.
    pub origin: Origin,
}

/// The kinds of roles.
#[derive(Clone, Debug)]
pub enum RoleKind {
    /// `#[point(mass = …)]`.
    Point {
        /// The mass.
        mass: Expr,
    },
    /// `#[body(mass = …, inertia = …)]`.
    Body {
        /// The mass.
        mass: Expr,
        /// The moments of inertia about the centre of mass.
        inertia: Expr,
    },
    /// `#[kinetic]`.
    Kinetic,
    /// `#[potential]`.
    Potential,
    /// `#[lagrangian]`.
    Lagrangian,
    /// `#[dissipation]`.
    Dissipation,
    /// `#[force]`.
    Force(Target),
    /// `#[holonomic]`.
    Holonomic {
        /// `#[holonomic(eliminate = x)]`: solved for a coordinate, so that no multiplier is kept.
        eliminate: Option<Eliminate>,
    },
    /// `#[nonholonomic]`.
    Nonholonomic {
        /// `#[nonholonomic(chetaev)]`: it need not be affine in the velocities.
        chetaev: bool,
    },
    /// `#[unilateral(restitution = …, law = …)]`.
    Unilateral {
        /// The coefficient; without one an impact is plastic.
        restitution: Option<Expr>,
        /// Whether the law is Poisson's instead of Newton's.
        poisson: bool,
    },
    /// `#[friction(coefficient = …, normal = …)]` or `#[friction(limit = …)]`.
    Friction(Box<Friction>),
    /// `#[event]`.
    Event,
}

/// The coordinates that a constraint is solved for.
#[derive(Clone, Debug)]
pub struct Eliminate {
    /// `x` or `theta[1]`, if the user names them.
    pub coordinate: Option<(Word, Option<Expr>)>,
    /// The origin of the request.
    pub origin: Origin,
}

/// The place or coordinate that a force acts on.
#[derive(Clone, Debug)]
pub enum Target {
    /// `#[force]`: all coordinates in order.
    Generalized,
    /// `#[force(at = joints[3])]`: a place, such as a point or body.
    At(Word, Option<Expr>),
    /// `#[force(on = theta[1])]`: a coordinate.
    On(Word, Option<Expr>),
}

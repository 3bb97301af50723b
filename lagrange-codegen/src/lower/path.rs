//! Names and paths: variables, constants, and what lies outside the macro's sight.

use super::construct::CONSTRUCTORS;
use super::interpreter::Interpreter;
use super::rounded::Rounded;
use super::scalar;
use super::value::{Callable, Value};
use crate::diagnostics::{Origin, catalogue};
use crate::expr::Dependence;
use crate::number::Number;
use crate::syntax::Scalar;
use crate::syntax::body::{Expr, ExprKind, Name, Owner, Path, Word};
use crate::syntax::hygiene::written;
use crate::syntax::types::{Type, TypeKind};

impl<'a> Interpreter<'a> {
    /// The value of a path.
    pub fn path(&mut self, path: &'a Path) -> Value {
        match &path.owner {
            Owner::None => {
                if self.later.iter().any(|later| ***later == *written(&path.last)) {
                    return self.refuse(path.origin, catalogue::later_constant(written(&path.last)));
                }
                let slot = self.scope.find(&path.last);
                if is_constant_name(&path.last) && slot.is_some_and(|slot| self.scope.is_globbed(slot)) {
                    return self.refuse(path.origin, catalogue::hidden_by_import(written(&path.last)));
                }
                if let Some(slot) = slot {
                    return self.scope.slot(slot).clone();
                }
                if &*path.last == "self" {
                    return Value::Parameter(self.self_parameter(path.origin));
                }
                if is_constant_name(&path.last) {
                    return self.foreign_constant(path);
                }
                self.unknown_name(path)
            }
            Owner::Local(name) => match self.scope.get(&path.last) {
                // Where a local type and a variable share a name, the word alone is the variable.
                Some(value) if !path.text.contains("::") => value.clone(),
                _ => self.refuse(path.origin, catalogue::local_item(name)),
            },
            Owner::SelfType => match self.associated_constant(&path.last) {
                Some(value) => value,
                None if self.is_helper(&path.last) => self.kept(Callable::Path(path)),
                None if is_constant_name(&path.last) => self.foreign_constant(path),
                None => {
                    let names: Vec<Name> = self.item.constants.iter().map(|c| c.name.clone()).collect();
                    let near = self.near(&path.last, &names);
                    self.refuse(path.origin, catalogue::unknown_path(&path.text, near))
                }
            },
            Owner::Other(module) if &**module == "consts" => match Number::named(&path.last) {
                Some(number) => self.known_constant(path, number, &format!("{:?}", number.value())),
                None => self.foreign_constant(path),
            },
            // A bound that bounds nothing is seen to do so.
            Owner::Type(Type { kind: TypeKind::Scalar | TypeKind::OtherFloat, .. }) => match &*path.last {
                "INFINITY" => self.known_constant(path, Number::Float(f64::INFINITY, 0.0), "1.0 / 0.0"),
                "NEG_INFINITY" => {
                    self.known_constant(path, Number::Float(f64::NEG_INFINITY, 0.0), "-1.0 / 0.0")
                }
                name if scalar::METHODS.contains(&name) => self.kept(Callable::Path(path)),
                _ => self.other_path(path),
            },
            Owner::Type(_) | Owner::Other(_) => self.other_path(path),
        }
    }

    /// Whether a function of the block can be called without `self`.
    fn is_helper(&self, name: &str) -> bool {
        self.item.functions.iter().any(|function| *function.name == *name && !function.receiver)
    }

    /// What stands in a type or module that the macro cannot see.
    fn other_path(&mut self, path: &Path) -> Value {
        if is_constant_name(&path.last) {
            return self.foreign_constant(path);
        }
        self.refuse(path.origin, catalogue::unknown_path(&path.text, None))
    }

    /// A constant of the standard library. That its path means this number, written in Rust, is asserted.
    fn known_constant(&mut self, path: &Path, number: Number, written: &str) -> Value {
        let (code, message) = (&path.code, catalogue::other_constant(&path.text));
        self.meaning(
            format!("const _: () = ::core::assert!({code} == {written}, {message:?});"),
            path.origin,
        );
        self.constant(number)
    }

    /// A constant that the macro cannot see: a parameter of the description.
    fn foreign_constant(&mut self, path: &Path) -> Value {
        let label = written(&path.last).to_lowercase();
        Value::Parameter(self.parameters.intern(path.code.to_string(), label, path.origin))
    }

    /// A constant of the impl block.
    pub fn associated_constant(&mut self, name: &str) -> Option<Value> {
        let item = self.item;
        let index = item.constants.iter().position(|constant| *constant.name == *name)?;
        if let Some(value) = &self.constants[index] {
            return Some(value.clone());
        }
        // A constant that needs itself finds `Unknown` here. rustc reports the cycle.
        self.constants[index] = Some(Value::Unknown);
        let constant = &item.constants[index];
        if let Some(origin) = constant.conditional {
            return Some(self.refuse(origin, catalogue::conditional_code()));
        }
        let (mark, later) = (self.scope.enter(), std::mem::take(&mut self.later));
        let value = self.expression_of_type(&constant.value, &constant.ty);
        self.scope.leave(mark);
        self.later = later;
        self.constants[index] = Some(value.clone());
        Some(value)
    }

    /// `value as type`.
    pub fn cast(&mut self, value: &'a Expr, ty: &'a Type, origin: Origin) -> Value {
        let value = self.convertible(value);
        match (&value, &ty.kind) {
            (Value::Unknown, _) => Value::Unknown,
            (Value::Integer(integer, _), TypeKind::Scalar) => {
                let number = Number::cast(*integer, matches!(self.item.scalar, Scalar::F32));
                Value::Scalar(self.graph().constant(number), Rounded::integer(*integer))
            }
            (Value::Scalar(..), TypeKind::Scalar) => value,
            (Value::Integer(integer, _), TypeKind::Integer(types)) => match types.cast(*integer) {
                Some(integer) => self.integer(integer, *types, origin),
                None => self.refuse(origin, catalogue::width_decides()),
            },
            (Value::Scalar(node, rounded), TypeKind::Integer(types))
                if self.model.graph.dependence(*node) == Dependence::NONE =>
            {
                let Some(value) = rounded.value(&self.item.scalar) else {
                    return self.refuse(origin, catalogue::rounding_decides());
                };
                match types.saturated(value) {
                    Some(integer) => self.integer(integer, *types, origin),
                    None => self.refuse(origin, catalogue::integer_overflow()),
                }
            }
            (Value::Boolean(truth), TypeKind::Integer(types)) => Value::Integer(i128::from(*truth), *types),
            (Value::Parameter(id), TypeKind::Scalar | TypeKind::Integer(_) | TypeKind::OtherFloat) => {
                let text = format!("({} as {})", self.parameters.text(*id), ty.written);
                let label = self.parameters.label(*id).to_string();
                let id = self.parameters.intern(text, label, origin);
                match ty.kind {
                    TypeKind::Integer(_) => self.known_integer(id),
                    _ => Value::Parameter(id),
                }
            }
            (Value::Choice(_), TypeKind::Scalar | TypeKind::Integer(_)) => self.condition_as_number(origin),
            (_, TypeKind::OtherFloat) => {
                let scalar = self.item.scalar.to_string();
                self.refuse(origin, catalogue::other_precision(scalar))
            }
            _ => self.refuse(origin, catalogue::bad_cast(value.describe())),
        }
    }

    /// `path(arguments)`.
    pub fn call_path(&mut self, path: &'a Path, arguments: &'a [Expr], origin: Origin) -> Value {
        if &*path.last == "from_fn" {
            return self.by_function(path, arguments, origin);
        }
        if let Owner::SelfType = path.owner {
            // `Self::f(self, …)` and `Self::f(…)`.
            let with_self = arguments.first().is_some_and(Self::is_self);
            let values = self.arguments(&path.last, &arguments[usize::from(with_self)..]);
            if values.iter().any(Value::is_unknown) {
                return Value::Unknown;
            }
            let word = Word { name: path.last.clone(), origin: path.origin };
            return self.call_helper(&word, values, with_self, origin);
        }
        if let Owner::Local(name) = &path.owner {
            return self.refuse(path.origin, catalogue::local_item(name));
        }
        let is_number =
            |ty: &Type| matches!(ty.kind, TypeKind::Scalar | TypeKind::OtherFloat | TypeKind::Integer(_));
        let values = match (&path.owner, arguments) {
            (Owner::Type(ty), [argument]) if is_number(ty) && path.last.starts_with("from") => {
                vec![self.convertible(argument)]
            }
            _ => self.expressions(arguments),
        };
        if let Some(value) = self.function_of_fields(path, &values, origin) {
            return value;
        }
        if let Some(id) = self.closure_of(path) {
            return match values.iter().any(Value::is_unknown) {
                true => Value::Unknown,
                false => self.apply_stored(id, values, origin),
            };
        }
        if let Owner::None = path.owner
            && self.item.functions.iter().all(|function| function.name != path.last)
        {
            return self.free_call(path, arguments);
        }
        if let (Owner::Type(ty), "new") = (&path.owner, &*path.last)
            && matches!(ty.kind, TypeKind::Vector(_) | TypeKind::Point(_) | TypeKind::Translation(_))
        {
            let reports = self.reports;
            for (value, argument) in values.iter().zip(arguments) {
                if let Value::Integer(number, ..) = value {
                    self.integer_as_number(*number, argument);
                }
            }
            if self.reports > reports {
                return Value::Unknown;
            }
        }
        match values.iter().any(Value::is_unknown) {
            true => Value::Unknown,
            false => self.call_values(path, values, origin),
        }
    }

    /// A call whose arguments are known.
    pub fn call_values(&mut self, path: &'a Path, arguments: Vec<Value>, origin: Origin) -> Value {
        let word = Word { name: path.last.clone(), origin: path.origin };
        if let Some(id) = self.closure_of(path) {
            return self.apply_stored(id, arguments, origin);
        }
        match &path.owner {
            Owner::SelfType => self.call_helper(&word, arguments, false, origin),
            Owner::None => {
                let known = self.item.functions.iter().any(|function| function.name == path.last);
                let message = if known {
                    catalogue::helper_without_self(&path.last)
                } else {
                    catalogue::free_function(&path.last)
                };
                self.refuse(path.origin, message)
            }
            Owner::Local(name) => self.refuse(path.origin, catalogue::local_item(name)),
            Owner::Type(ty) => self.construct(ty, &word, arguments, origin),
            Owner::Other(owner) => match (&**owner, &*path.last) {
                ("Unit", "new_normalize") => self.first_method(arguments, &word, "normalize", origin),
                // A constant axis is normalised: angular velocities are taken about unit axes.
                ("Unit", "new_unchecked") if self.is_fixed_vector(&arguments) => {
                    self.first_method(arguments, &word, "normalize", origin)
                }
                ("Unit", "new_unchecked") | ("convert", "identity") => {
                    arguments.into_iter().next().unwrap_or(Value::Unknown)
                }
                ("Translation", "from") => match arguments.first() {
                    Some(Value::Vector(nodes)) => Value::Translation(nodes.clone()),
                    _ => self.refuse(path.origin, catalogue::free_function(&path.text)),
                },
                (
                    "Real" | "Float" | "RealField" | "ComplexField" | "SimdRealField" | "SimdComplexField",
                    _,
                ) => self.scalar_function(&word, arguments, origin),
                ("Iterator" | "IntoIterator" | "Clone" | "Into", name) => {
                    let name = name.to_string();
                    self.first_method(arguments, &word, &name, origin)
                }
                // A type of nalgebra under a name that a `use` or a `type` outside the block gave it.
                (owner, name) if owner.starts_with(char::is_uppercase) && CONSTRUCTORS.contains(&name) => {
                    self.refuse(path.origin, catalogue::unknown_type(&path.text))
                }
                _ => self.refuse(path.origin, catalogue::free_function(&path.text)),
            },
        }
    }

    fn is_fixed_vector(&self, arguments: &[Value]) -> bool {
        matches!(arguments, [Value::Vector(nodes)]
            if nodes.iter().all(|&node| self.model.graph.dependence(node).is_fixed()))
    }

    /// `Type::method(receiver, …)` as `receiver.method(…)`.
    pub fn first_method(
        &mut self,
        mut arguments: Vec<Value>,
        word: &Word,
        method: &str,
        origin: Origin,
    ) -> Value {
        if arguments.is_empty() {
            return self.refuse(word.origin, catalogue::unknown_function(&word.name, None));
        }
        let receiver = arguments.remove(0);
        let word = Word { name: method.into(), origin: word.origin };
        self.plain_method(receiver, &word, arguments, origin)
    }

    /// An associated function of the scalar type: `f64::from(x)`, `R::pi()`, `f64::sin(x)`.
    pub fn scalar_function(&mut self, word: &Word, arguments: Vec<Value>, origin: Origin) -> Value {
        let number = match (&*word.name, arguments.as_slice()) {
            ("zero", []) => Some(Number::ZERO),
            ("one", []) => Some(Number::ONE),
            ("pi", []) => Number::named("PI"),
            ("two_pi", []) => Number::named("TAU"),
            ("frac_pi_2", []) => Number::named("FRAC_PI_2"),
            ("frac_pi_3", []) => Number::named("FRAC_PI_3"),
            ("frac_pi_4", []) => Number::named("FRAC_PI_4"),
            ("frac_pi_6", []) => Number::named("FRAC_PI_6"),
            ("frac_pi_8", []) => Number::named("FRAC_PI_8"),
            ("e", []) => Number::named("E"),
            ("from" | "from_f64" | "from_f32" | "from_subset" | "lit", [value]) => {
                return self.converted(&word.name, value.clone(), origin);
            }
            _ => None,
        };
        match number {
            Some(number) => self.constant(number),
            None => self.first_method(arguments, word, &word.name, origin),
        }
    }

    /// A conversion into the scalar: exact for constants, part of the path for parameters.
    fn converted(&mut self, function: &str, value: Value, origin: Origin) -> Value {
        match value {
            Value::Integer(integer, ..) => {
                Value::Scalar(self.graph().integer(integer), Rounded::integer(integer))
            }
            Value::Parameter(id) => {
                let text = self.parameters.text(id);
                let text = match (&self.item.scalar, function) {
                    (scalar @ Scalar::Generic(_), "from_f64") => {
                        format!("<{scalar} as {}::Real>::from_f64({text})", self.crate_text())
                    }
                    (scalar, function) => format!("{scalar}::{function}({text})"),
                };
                let label = self.parameters.label(id).to_string();
                Value::Parameter(self.parameters.intern(text, label, origin))
            }
            Value::Scalar(node, rounded) => {
                let generic = matches!(self.item.scalar, Scalar::Generic(_));
                if generic && !self.graph().dependence(node).is_fixed() {
                    return self.refuse(origin, catalogue::conversion_of_variable(function));
                }
                if generic && self.graph().as_constant(node).is_none() {
                    return self.refuse(origin, catalogue::conversion_of_formula(function));
                }
                Value::Scalar(node, if generic { rounded.converted() } else { rounded })
            }
            Value::Boolean(truth) => {
                let number = i128::from(truth);
                Value::Scalar(self.graph().integer(number), Rounded::integer(number))
            }
            Value::Choice(_) => self.condition_as_number(origin),
            other => self.refuse(origin, catalogue::wrong_shape("a scalar", other.describe())),
        }
    }

    /// Refuses the conversion of a condition on the state, which is no number in the language.
    fn condition_as_number(&mut self, origin: Origin) -> Value {
        let [one, zero] = match &self.item.scalar {
            Scalar::Generic(name) => [format!("{name}::one()"), format!("{name}::zero()")],
            Scalar::F32 | Scalar::F64 => ["1.0".to_string(), "0.0".to_string()],
        };
        self.refuse(origin, catalogue::condition_as_number(one, zero))
    }

    /// The path of the crate that generated code names, as text.
    pub fn crate_text(&self) -> String {
        let path = &self.item.crate_path;
        quote::quote!(#path).to_string().replace(' ', "")
    }

    /// Whether an expression is `[..]`, the whole of an array.
    pub fn is_whole(expr: &Expr) -> bool {
        matches!(&expr.kind, ExprKind::Range(range) if range.start.is_none() && range.end.is_none())
    }
}

/// Constants are written in capitals.
pub fn is_constant_name(name: &str) -> bool {
    let name = written(name);
    name.chars().any(char::is_alphabetic) && !name.chars().any(char::is_lowercase)
}

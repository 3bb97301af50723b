//! Function bodies as lowering sees them: a small tree in which every expression has its origin.
//!
//! References, parentheses and groups are gone, and so are dereferences of anything but fields of `self`.
//! What the language does not know is an [`ExprKind::Unsupported`] with its message. It is reported only if
//! a role reaches it, since other functions of the block may use all of Rust.

use std::rc::Rc;

use super::integers::Integers;
use super::types::Type;
use crate::diagnostics::Origin;
use crate::number::Number;

/// An identifier without its raw prefix. A local variable of another macro than the block itself has a mark
/// behind its name, see [`super::hygiene`].
pub type Name = Rc<str>;

/// An expression.
#[derive(Clone, Debug)]
pub struct Expr {
    /// Where it stands.
    pub origin: Origin,
    /// The kind of the expression.
    pub kind: ExprKind,
}

/// The forms of an expression.
#[derive(Clone, Debug)]
pub enum ExprKind {
    /// A literal with a decimal point, an exponent or a float suffix.
    Float(Number),
    /// A literal without any of these, and the types that its suffix allows.
    Integer(i128, Integers),
    /// `true` or `false`.
    Boolean(bool),
    /// A variable, a constant, or the name of a function.
    Path(Path),
    /// `-x`, `!x`.
    Unary(UnaryOperator, Box<Expr>),
    /// `a + b`.
    Binary(BinaryOperator, Box<Expr>, Box<Expr>),
    /// `a = b`.
    Assign(Box<Expr>, Box<Expr>),
    /// `a += b`.
    Update(BinaryOperator, Box<Expr>, Box<Expr>),
    /// `a as f64`.
    Cast(Box<Expr>, Type),
    /// `a.x`, `a.0`.
    Field(Box<Expr>, Word),
    /// `*self.a`.
    Pointee(Box<Expr>),
    /// `a[i]`.
    Index(Box<Expr>, Box<Expr>),
    /// `f(a)`.
    Call(Path, Vec<Expr>),
    /// `a.f(b)`.
    Method(Box<MethodCall>),
    /// `(a, b)`.
    Tuple(Vec<Expr>),
    /// `[a, b]`.
    Array(Vec<Expr>),
    /// `[a; n]`.
    Repeat(Box<Expr>, Box<Expr>),
    /// `vector![a, b]`.
    Vector(Vec<Expr>),
    /// `matrix![a, b; c, d]`, row by row.
    Matrix(Vec<Vec<Expr>>),
    /// `point![a, b]`.
    Point(Vec<Expr>),
    /// `a..b`.
    Range(RangeExpr),
    /// `{ … }`.
    Block(Block),
    /// `if … else …`.
    If(Box<If>),
    /// `match … { … }`.
    Match(Box<Expr>, Vec<Arm>),
    /// `for … in … { … }`.
    For(Box<For>),
    /// `return a`.
    Return(Option<Box<Expr>>),
    /// `break 'label`.
    Break(Option<Name>),
    /// `continue 'label`.
    Continue(Option<Name>),
    /// `|x| …`.
    Closure(Box<Closure>),
    /// `_`, to which any value may be assigned.
    Wild,
    /// Anything else, with the message that says so.
    Unsupported(String),
}

/// A name with its origin.
#[derive(Clone, Debug)]
pub struct Word {
    /// The name.
    pub name: Name,
    /// Where it stands.
    pub origin: Origin,
}

/// A path in an expression.
#[derive(Clone, Debug)]
pub struct Path {
    /// Where it stands.
    pub origin: Origin,
    /// The whole path as the user wrote it.
    pub text: Rc<str>,
    /// Rust text of the same meaning outside the function, with the imports in force inside.
    pub code: Rc<str>,
    /// The last segment.
    pub last: Name,
    /// The part before the last segment.
    pub owner: Owner,
}

/// The part of a path before its last segment.
#[derive(Clone, Debug)]
pub enum Owner {
    /// Nothing.
    None,
    /// `Self` or the name of the type.
    SelfType,
    /// A type that the language knows.
    Type(Type),
    /// A module, a trait or an unknown type, by its last segment.
    Other(Name),
    /// Something declared inside the function, by its name.
    Local(Name),
}

/// A method call.
#[derive(Clone, Debug)]
pub struct MethodCall {
    /// Before the dot.
    pub receiver: Expr,
    /// The method.
    pub method: Word,
    /// The first type argument, as in `sum::<f64>()`.
    pub generic: Option<Type>,
    /// The arguments.
    pub arguments: Vec<Expr>,
}

/// A range.
#[derive(Clone, Debug)]
pub struct RangeExpr {
    /// The first value.
    pub start: Option<Box<Expr>>,
    /// The bound.
    pub end: Option<Box<Expr>>,
    /// `..=`.
    pub inclusive: bool,
}

/// Statements with the value of the last expression.
#[derive(Clone, Debug)]
pub struct Block {
    /// The statements.
    pub statements: Vec<Statement>,
    /// The last expression, without semicolon.
    pub value: Option<Box<Expr>>,
}

/// A statement.
#[derive(Clone, Debug)]
pub enum Statement {
    /// `let pattern: type = value;`
    Let(Pattern, Option<Expr>),
    /// `const NAME: type = value;`
    Constant(Constant),
    /// `use a::B as C;` gives the local name and the path.
    Use(Name, Path),
    /// `use a::*;`, which may hide constants declared further out.
    Glob,
    /// `expression;`
    Expression(Expr),
}

/// A constant of the block or of a function body.
#[derive(Clone, Debug)]
pub struct Constant {
    /// Its name.
    pub name: Name,
    /// Its type.
    pub ty: Type,
    /// Its value.
    pub value: Expr,
    /// The `cfg` that decides whether it is there.
    pub conditional: Option<Origin>,
}

/// A conditional.
#[derive(Clone, Debug)]
pub struct If {
    /// The condition.
    pub condition: Expr,
    /// When it holds.
    pub then: Block,
    /// When it does not.
    pub otherwise: Option<Expr>,
}

/// One arm of a `match`.
#[derive(Clone, Debug)]
pub struct Arm {
    /// The pattern.
    pub pattern: Pattern,
    /// The condition after `if`.
    pub guard: Option<Expr>,
    /// The value.
    pub body: Expr,
}

/// A loop over constants.
#[derive(Clone, Debug)]
pub struct For {
    /// `'label:`.
    pub label: Option<Name>,
    /// The loop variable.
    pub pattern: Pattern,
    /// The elements that it runs over.
    pub over: Expr,
    /// The body.
    pub body: Block,
}

/// A closure.
#[derive(Clone, Debug)]
pub struct Closure {
    /// The parameters.
    pub parameters: Vec<Pattern>,
    /// The body.
    pub body: Expr,
    /// `move`.
    pub is_move: bool,
}

/// A pattern.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Where it stands.
    pub origin: Origin,
    /// The kind of the pattern.
    pub kind: PatternKind,
}

/// The forms of a pattern.
#[derive(Clone, Debug)]
pub enum PatternKind {
    /// `_`.
    Wild,
    /// `x`, `mut x`; in a `match` possibly a constant.
    Name(Name),
    /// `..` within a tuple or slice.
    Rest,
    /// `(a, b)`.
    Tuple(Vec<Pattern>),
    /// `[a, b]`.
    Slice(Vec<Pattern>),
    /// `Coordinates { x, theta: angles, .. }`.
    Record(Vec<(Word, Pattern)>),
    /// `p: T`.
    Typed(Box<Pattern>, Type),
    /// A literal or the path of a constant.
    Constant(Expr),
    /// `1..=3`.
    Range(RangeExpr),
    /// `1 | 2`.
    Or(Vec<Pattern>),
    /// Anything else, with the message that says so and the names it would bind.
    Unsupported(String, Vec<Name>),
}

/// An operator of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOperator {
    /// `-`.
    Negate,
    /// `!`.
    Not,
}

impl UnaryOperator {
    /// As Rust writes it.
    pub fn sign(self) -> &'static str {
        match self {
            UnaryOperator::Negate => "-",
            UnaryOperator::Not => "!",
        }
    }
}

/// An operator of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryOperator {
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
    /// `%`.
    Remainder,
    /// `&&`.
    And,
    /// `||`.
    Or,
    /// `==`.
    Equal,
    /// `!=`.
    NotEqual,
    /// `<`.
    Less,
    /// `<=`.
    LessEqual,
    /// `>`.
    Greater,
    /// `>=`.
    GreaterEqual,
}

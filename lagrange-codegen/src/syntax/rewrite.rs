//! The impl block that is emitted again: the user's functions stay ordinary, callable Rust.
//!
//! Role attributes go, and `Coordinates` becomes `ChainCoordinates` (with the user's span). In a generic
//! block, literals take the precision of the scalar, and the few functions of nalgebra that ask more of a
//! number than `Real` offers are replaced by the runtime's own.

use proc_macro2::{Ident, Literal, TokenStream, TokenTree};
use quote::{ToTokens, quote, quote_spanned};
use syn::visit_mut::{self, VisitMut};
use syn::{Expr, ImplItem, ItemImpl, Lit};

use super::item::{Record, Scalar};
use super::{role, velocity};
use crate::number::Number;

/// The cleaned impl block. `rate` is an expression from the attribute of the block.
pub fn clean(
    block: &ItemImpl,
    name: &Ident,
    scalar: &Scalar,
    crate_path: &syn::Path,
    rate: Option<&Expr>,
) -> TokenStream {
    let mut block = block.clone();
    let mut used = names_in_attributes(&block, rate);
    // A function whose velocity is used counts as used.
    let velocities = velocity::mentioned(&block, false).into_iter();
    used.extend(velocities.filter_map(|(name, _)| Some(name.strip_suffix(velocity::SUFFIX)?.to_owned())));
    for item in &mut block.items {
        match item {
            ImplItem::Fn(function) => {
                let before = function.attrs.len();
                function.attrs.retain(|attribute| !role::is_role(attribute));
                if function.attrs.len() < before || used.contains(&function.sig.ident.to_string()) {
                    function.attrs.push(syn::parse_quote!(#[allow(dead_code)]));
                }
            }
            // The length of a declared array may be its only use.
            ImplItem::Const(constant) => {
                constant.attrs.push(syn::parse_quote!(#[allow(dead_code)]));
            }
            _ => {}
        }
    }
    block = rename(block, name, scalar);
    if let Scalar::Generic(parameter) = scalar {
        for item in &mut block.items {
            if let ImplItem::Fn(function) = item
                && !mentions_floats(&function.sig)
            {
                Generalizer { parameter, crate_path }.visit_block_mut(&mut function.block);
            }
        }
    }
    block.into_token_stream()
}

/// An expression of an attribute, ready to be evaluated in the impl block.
pub fn expression(expr: &Expr, scalar: &Scalar, crate_path: &syn::Path) -> TokenStream {
    let mut expr = expr.clone();
    if let Scalar::Generic(parameter) = scalar {
        Generalizer { parameter, crate_path }.visit_expr_mut(&mut expr);
    }
    expr.into_token_stream()
}

/// The impl block with the full names of the generated structs.
pub fn rename(mut block: ItemImpl, name: &Ident, scalar: &Scalar) -> ItemImpl {
    for item in &mut block.items {
        // `role::refuse_on_item` has reported these. rustc does not know them.
        match item {
            ImplItem::Const(constant) => constant.attrs.retain(|attribute| !role::is_role(attribute)),
            ImplItem::Type(ty) => ty.attrs.retain(|attribute| !role::is_role(attribute)),
            _ => {}
        }
    }
    Renamer { name, scalar }.visit_item_impl_mut(&mut block);
    block
}

/// Identifiers in attributes. They are uses that rustc cannot see.
fn names_in_attributes(block: &ItemImpl, rate: Option<&Expr>) -> Vec<String> {
    let mut names = Vec::new();
    let mut stack: Vec<TokenStream> = rate.map(ToTokens::to_token_stream).into_iter().collect();
    for item in &block.items {
        let ImplItem::Fn(function) = item else { continue };
        let roles = function.attrs.iter().filter(|attribute| role::is_role(attribute));
        stack.extend(roles.map(|attribute| attribute.meta.to_token_stream()));
    }
    while let Some(stream) = stack.pop() {
        for tree in stream {
            match tree {
                TokenTree::Ident(ident) => names.push(ident.to_string()),
                TokenTree::Group(group) => stack.push(group.stream()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    names
}

/// Whether a signature names a concrete float. Literals of such a function are not of the scalar type.
fn mentions_floats(signature: &syn::Signature) -> bool {
    let mut stack = vec![signature.to_token_stream()];
    while let Some(stream) = stack.pop() {
        for tree in stream {
            match tree {
                TokenTree::Ident(ident) if ident == "f32" || ident == "f64" => return true,
                TokenTree::Group(group) => stack.push(group.stream()),
                TokenTree::Ident(_) | TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    false
}

/// Gives the generated structs their full names.
struct Renamer<'a> {
    name: &'a Ident,
    scalar: &'a Scalar,
}

impl Renamer<'_> {
    fn rename(&self, path: &mut syn::Path) {
        if path.leading_colon.is_some() {
            return;
        }
        let Some(first) = path.segments.first_mut() else { return };
        let Some(record) = Record::named(&first.ident.to_string()) else { return };
        let span = first.ident.span();
        first.ident = record.ident(self.name);
        first.ident.set_span(span);
    }
}

impl VisitMut for Renamer<'_> {
    /// An operand from a `macro_rules` macro, such as `a + b` passed as `$x:expr`, gets parentheses: rustc
    /// forgets invisible groups that come out of a procedural macro.
    fn visit_expr_mut(&mut self, expr: &mut Expr) {
        visit_mut::visit_expr_mut(self, expr);
        if let Expr::Group(group) = expr
            && !matches!(*group.expr, Expr::Lit(_) | Expr::Path(_) | Expr::Paren(_) | Expr::Group(_))
        {
            let inner = &group.expr;
            *expr = syn::parse_quote!((#inner));
        }
    }

    fn visit_type_path_mut(&mut self, ty: &mut syn::TypePath) {
        visit_mut::visit_type_path_mut(self, ty);
        // The visit above has renamed the path. The scalar argument is still missing.
        if ty.qself.is_none()
            && let [segment] = ty.path.segments.iter_mut().collect::<Vec<_>>().as_mut_slice()
            && segment.arguments.is_none()
            && Record::ALL.iter().any(|record| segment.ident == record.ident(self.name))
        {
            match self.scalar {
                Scalar::F64 => {}
                Scalar::F32 => {
                    segment.arguments = syn::PathArguments::AngleBracketed(syn::parse_quote!(<f32>))
                }
                Scalar::Generic(parameter) => {
                    segment.arguments = syn::PathArguments::AngleBracketed(syn::parse_quote!(<#parameter>));
                }
            }
        }
    }

    fn visit_path_mut(&mut self, path: &mut syn::Path) {
        visit_mut::visit_path_mut(self, path);
        self.rename(path);
    }
}

/// Makes literals and some calls work for any scalar.
struct Generalizer<'a> {
    parameter: &'a Ident,
    crate_path: &'a syn::Path,
}

impl Generalizer<'_> {
    /// A literal with all digits that the scalar can hold.
    fn literal(&self, literal: &Lit) -> TokenStream {
        let (parameter, path) = (self.parameter, self.crate_path);
        self.exact(literal).unwrap_or_else(
            || quote_spanned!(literal.span()=> <#parameter as #path::Real>::from_f64(#literal)),
        )
    }

    /// A literal that no double equals, in two parts; `None` for others.
    fn exact(&self, literal: &Lit) -> Option<TokenStream> {
        let digits = match literal {
            Lit::Float(float) => float.base10_digits(),
            Lit::Int(int) => int.base10_digits(),
            _ => return None,
        };
        let (_, rest) = Number::parse(digits)?.parts();
        let size: Literal = format!("{:?}", rest.abs()).parse().ok()?;
        let sign = (rest < 0.0).then(|| quote!(-));
        let (parameter, path) = (self.parameter, self.crate_path);
        let exact =
            quote_spanned!(literal.span()=> <#parameter as #path::Real>::from_parts(#literal, #sign #size));
        (rest != 0.0).then_some(exact)
    }

    /// `R::from_f64(0.1)` and `R::from(0.1)` mean the decimal, as everywhere in a description.
    fn conversion(&self, call: &syn::ExprCall) -> Option<Expr> {
        let Expr::Path(function) = &*call.func else { return None };
        let names: Vec<String> =
            function.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        let of_scalar =
            matches!(names.as_slice(), [owner, name] if self.parameter == owner && name != "from_f32");
        match call.args.first()? {
            Expr::Lit(literal)
                if of_scalar && call.args.len() == 1 && matches!(literal.lit, Lit::Float(_)) =>
            {
                let tokens = self.exact(&literal.lit)?;
                Some(syn::parse_quote!(#tokens))
            }
            _ => None,
        }
    }

    /// The runtime's function for a method of nalgebra's vectors.
    fn redirected_method(&self, call: &syn::ExprMethodCall) -> Option<Expr> {
        let method = match call.method.to_string().as_str() {
            "norm" | "magnitude" => "norm",
            "norm_squared" | "magnitude_squared" => "norm_squared",
            "normalize" => "normalize",
            "metric_distance" => "distance",
            "to_rotation_matrix" => "rotation_matrix",
            _ => return None,
        };
        let takes = usize::from(method == "distance");
        let is_helper = matches!(&*call.receiver, Expr::Path(path) if path.path.is_ident("self"));
        if call.args.len() != takes || is_helper {
            return None;
        }
        let function = Ident::new(method, call.method.span());
        let (path, receiver, arguments) = (self.crate_path, &call.receiver, &call.args);
        Some(syn::parse_quote!(#path::__private::algebra::#function(&(#receiver), #arguments)))
    }

    /// The runtime's function for a constructor of nalgebra's rotations.
    fn redirected_call(&self, path: &syn::Path) -> Option<Expr> {
        let mut last = path.segments.iter().rev();
        let (function, owner) = (last.next()?, last.next()?);
        let name = match (owner.ident.to_string().as_str(), function.ident.to_string().as_str()) {
            ("Rotation2", "new") => "rotation2",
            ("Rotation3", "from_axis_angle") => "rotation3_axis_angle",
            ("Rotation3", "from_euler_angles") => "rotation3_euler_angles",
            ("Isometry2" | "Isometry3" | "IsometryMatrix2" | "IsometryMatrix3", "from_parts") => "pose",
            _ => return None,
        };
        let name = Ident::new(name, function.ident.span());
        let path = self.crate_path;
        Some(syn::parse_quote!(#path::__private::algebra::#name))
    }

    /// Float literals within a macro call, whatever its grammar.
    fn tokens(&self, tokens: TokenStream) -> TokenStream {
        let trees = tokens.into_iter().map(|tree| match tree {
            TokenTree::Group(group) => {
                let mut inner = proc_macro2::Group::new(group.delimiter(), self.tokens(group.stream()));
                inner.set_span(group.span());
                TokenTree::Group(inner).into()
            }
            TokenTree::Literal(literal) if is_float(&Lit::new(literal.clone())) => {
                self.literal(&Lit::new(literal))
            }
            other => TokenStream::from(other),
        });
        trees.collect()
    }
}

fn is_float(literal: &Lit) -> bool {
    match literal {
        Lit::Float(_) => true,
        Lit::Int(int) => matches!(int.suffix(), "f32" | "f64"),
        _ => false,
    }
}

/// Functions whose argument is a concrete float even in a generic block.
const FLOAT_FUNCTIONS: [&str; 3] = ["from_f64", "from_f32", "from"];

impl VisitMut for Generalizer<'_> {
    fn visit_expr_mut(&mut self, expr: &mut Expr) {
        match expr {
            Expr::Lit(literal) => {
                if is_float(&literal.lit) {
                    let tokens = self.literal(&literal.lit);
                    *expr = syn::parse_quote!(#tokens);
                }
                return;
            }
            Expr::Call(call) => {
                if let Expr::Path(path) = call.func.as_mut() {
                    let last = path.path.segments.last().map(|segment| segment.ident.to_string());
                    if last.is_some_and(|last| FLOAT_FUNCTIONS.contains(&last.as_str())) {
                        if let Some(exact) = self.conversion(call) {
                            *expr = exact;
                        }
                        return;
                    }
                    if let Some(function) = self.redirected_call(&path.path) {
                        *call.func = function;
                    }
                }
            }
            _ => {}
        }
        visit_mut::visit_expr_mut(self, expr);
        if let Expr::MethodCall(call) = expr
            && let Some(redirected) = self.redirected_method(call)
        {
            *expr = redirected;
        }
    }

    fn visit_macro_mut(&mut self, call: &mut syn::Macro) {
        call.tokens = self.tokens(call.tokens.clone());
    }

    /// Constants of a body have a concrete type.
    fn visit_item_mut(&mut self, _: &mut syn::Item) {}

    /// Patterns hold no expressions that could be converted.
    fn visit_pat_mut(&mut self, _: &mut syn::Pat) {}
}

//! The arguments of the attribute: `coordinates = […], inputs = […], jacobians, sensitivities = […],
//! analysis, verify = …, baumgarte = …, crate = …, allow(…)`.

mod loose;

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream, Parser};
use syn::punctuated::Punctuated;
use syn::{Token, bracketed, parenthesized};

use super::body::{Constant, Name};
use super::constant;
use super::item::{Group, Kind};
use super::suggest::nearest;
use super::translate::{Translator, bare};
use crate::diagnostics::{Diagnostics, catalogue};

/// The checks that `allow(…)` can switch off.
pub const LINTS: [&str; 5] = ["unused_input", "no_effect", "redundant", "integrable", "misread"];

const KNOWN: [&str; 9] = [
    "coordinates",
    "inputs",
    "jacobians",
    "sensitivities",
    "analysis",
    "verify",
    "baumgarte",
    "crate",
    "allow",
];

/// Arguments that are a word alone.
const WORDS: [&str; 2] = ["jacobians", "analysis"];

/// The parsed arguments.
#[derive(Default)]
pub struct Args {
    /// Declared coordinates.
    pub coordinates: Vec<Declaration>,
    /// Declared inputs.
    pub inputs: Vec<Declaration>,
    /// Whether the `jacobians` argument is there.
    pub jacobians: bool,
    /// The `sensitivities` argument.
    pub sensitivities: Vec<syn::Expr>,
    /// Whether the `analysis` argument is there.
    pub analysis: bool,
    /// The `verify` argument.
    pub verify: Option<syn::Expr>,
    /// The `baumgarte` argument.
    pub baumgarte: Option<syn::Expr>,
    /// The `crate` argument.
    pub crate_path: Option<syn::Path>,
    /// The `allow` argument.
    pub allowed: Vec<&'static str>,
    /// Whether an argument cannot be read. The mistake is reported.
    pub unread: bool,
}

/// A declared name with its kind and the length as written.
pub struct Declaration {
    /// The name.
    pub ident: Ident,
    /// The kind of each element.
    pub kind: Kind,
    /// The length of an array.
    pub length: Option<syn::Expr>,
}

impl Parse for Declaration {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let ident = input.call(Ident::parse_any)?;
        let (mut kind, mut length) = (Kind::Scalar, None);
        if input.parse::<Option<Token![:]>>()?.is_some() {
            if input.peek(syn::token::Bracket) {
                let content;
                bracketed!(content in input);
                if content.peek(syn::Ident) && content.peek2(Token![;]) {
                    kind = content.parse()?;
                    content.parse::<Token![;]>()?;
                }
                length = Some(content.parse()?);
            } else {
                kind = input.parse()?;
            }
        }
        Ok(Declaration { ident, kind, length })
    }
}

impl Parse for Kind {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let word = input.parse::<TokenTree>()?;
        match word.to_string().as_str() {
            "Rotation" => Ok(Kind::Rotation),
            "Pose" => Ok(Kind::Pose),
            other => Err(syn::Error::new(word.span(), catalogue::unknown_coordinate_kind(other))),
        }
    }
}

/// One argument as written.
enum Argument {
    Names(Ident, Vec<Declaration>),
    Word(Ident),
    Sensitivities(Ident, Vec<syn::Expr>),
    Verify(Ident, syn::Expr),
    Baumgarte(Ident, syn::Expr),
    Crate(Ident, syn::Path),
    Allow(Ident, Vec<Ident>),
    /// A word with a value that it does not take.
    Valued(Ident),
    Unknown(Ident),
}

impl Argument {
    fn key(&self) -> &Ident {
        match self {
            Argument::Names(key, _)
            | Argument::Word(key)
            | Argument::Sensitivities(key, _)
            | Argument::Verify(key, _)
            | Argument::Baumgarte(key, _)
            | Argument::Crate(key, _)
            | Argument::Allow(key, _)
            | Argument::Valued(key)
            | Argument::Unknown(key) => key,
        }
    }
}

impl Parse for Argument {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let key = input.call(Ident::parse_any)?;
        match key.to_string().as_str() {
            "coordinates" | "inputs" => {
                input.parse::<Token![=]>()?;
                let content;
                bracketed!(content in input);
                let names = Punctuated::<Declaration, Token![,]>::parse_terminated(&content)?;
                Ok(Argument::Names(key, names.into_iter().collect()))
            }
            word if WORDS.contains(&word) && (input.is_empty() || input.peek(Token![,])) => {
                Ok(Argument::Word(key))
            }
            "sensitivities" => {
                input.parse::<Token![=]>()?;
                let content;
                bracketed!(content in input);
                let parameters = Punctuated::<syn::Expr, Token![,]>::parse_terminated(&content)?;
                Ok(Argument::Sensitivities(key, parameters.into_iter().collect()))
            }
            "verify" => {
                input.parse::<Token![=]>()?;
                Ok(Argument::Verify(key, input.parse()?))
            }
            "baumgarte" => {
                input.parse::<Token![=]>()?;
                Ok(Argument::Baumgarte(key, input.parse()?))
            }
            "crate" => {
                input.parse::<Token![=]>()?;
                Ok(Argument::Crate(key, syn::Path::parse_mod_style(input)?))
            }
            "allow" => {
                let content;
                parenthesized!(content in input);
                let names = Punctuated::<Ident, Token![,]>::parse_terminated(&content)?;
                Ok(Argument::Allow(key, names.into_iter().collect()))
            }
            _ => {
                // The rest of the argument is skipped, so that the other arguments are checked, too.
                while !input.is_empty() && !input.peek(Token![,]) {
                    input.parse::<TokenTree>()?;
                }
                let known = WORDS.iter().any(|word| key == word);
                Ok(if known { Argument::Valued(key) } else { Argument::Unknown(key) })
            }
        }
    }
}

/// Parses the arguments. Mistakes are reported, and the rest is returned.
pub fn parse(tokens: TokenStream, diagnostics: &mut Diagnostics) -> Args {
    let mut args = Args::default();
    let mut list = match Punctuated::<Argument, Token![,]>::parse_terminated.parse2(tokens.clone()) {
        Ok(list) => Vec::from_iter(list),
        Err(error) => {
            diagnostics.error(error.span(), catalogue::bad_attribute(&error));
            args.unread = true;
            loose::arguments(tokens.clone())
        }
    };
    // An unknown key may be a misspelt one, with declarations behind it.
    if list.iter().any(|argument| matches!(argument, Argument::Unknown(_))) {
        let known = |key: &Ident| list.iter().any(|argument| argument.key() == key);
        let hidden: Vec<_> =
            loose::arguments(tokens).into_iter().filter(|argument| !known(argument.key())).collect();
        args.unread |= !hidden.is_empty();
        list.extend(hidden);
    }
    let mut seen: Vec<String> = Vec::new();
    let mut declared = false;
    for argument in list {
        let name = argument.key().to_string();
        if seen.contains(&name) {
            diagnostics.error(argument.key().span(), catalogue::duplicate_argument(&name));
            continue;
        }
        seen.push(name);
        match argument {
            Argument::Names(key, names) => {
                let target = if key == "inputs" {
                    &mut args.inputs
                } else {
                    declared = true;
                    &mut args.coordinates
                };
                target.extend(names);
            }
            Argument::Word(key) if key == "jacobians" => args.jacobians = true,
            Argument::Word(_) => args.analysis = true,
            Argument::Sensitivities(_, parameters) => args.sensitivities = parameters,
            Argument::Verify(_, example) => args.verify = Some(example),
            Argument::Baumgarte(_, rate) => args.baumgarte = Some(rate),
            Argument::Crate(_, path) => args.crate_path = Some(path),
            Argument::Allow(_, names) => {
                for name in names {
                    match LINTS.into_iter().find(|lint| name == lint) {
                        Some(lint) => args.allowed.push(lint),
                        None => {
                            let text = name.to_string();
                            let near = nearest(&text, LINTS).map(String::from);
                            let message = catalogue::unknown_lint(&text, LINTS.join("`, `"), near);
                            diagnostics.error(name.span(), message);
                        }
                    }
                }
            }
            Argument::Valued(key) => {
                diagnostics.error(key.span(), catalogue::argument_with_value(&key));
            }
            Argument::Unknown(key) => {
                let text = key.to_string();
                let near = nearest(&text, KNOWN).map(String::from);
                diagnostics.error(key.span(), catalogue::unknown_attribute_argument(&text, near));
            }
        }
    }
    if args.unread {
        return args;
    }
    if args.coordinates.is_empty() && !diagnostics.has_errors() {
        let message =
            if declared { catalogue::empty_coordinates() } else { catalogue::missing_coordinates() };
        diagnostics.error(Span::call_site(), message);
    }
    check_names(&args, diagnostics);
    for input in args.inputs.iter_mut().filter(|input| input.kind != Kind::Scalar) {
        diagnostics.error(input.ident.span(), catalogue::input_not_scalar(&input.ident));
        input.kind = Kind::Scalar;
    }
    args
}

/// Evaluates the lengths of the declared arrays, which may be constants of the impl block. A wrong length is
/// reported and counts as one, so that the declared names exist.
pub fn groups(
    declarations: &[Declaration],
    constants: &[Constant],
    translator: &mut Translator,
) -> Vec<Group> {
    declarations
        .iter()
        .map(|declaration| {
            let settled = |expr| length(&declaration.ident, expr, constants, translator).unwrap_or(1);
            let length = declaration.length.as_ref().map(settled);
            let origin = translator.origin(declaration.ident.span());
            Group { ident: declaration.ident.clone(), kind: declaration.kind, length, origin }
        })
        .collect()
}

/// The most elements of a declared array. A macro could not expand more within reason.
const LONGEST: usize = 10_000;

fn length(
    ident: &Ident,
    expr: &syn::Expr,
    constants: &[Constant],
    translator: &mut Translator,
) -> Option<usize> {
    let expr = translator.expression(expr);
    let message = match constant::integer(&expr, constants).map(usize::try_from) {
        Some(Ok(0)) => catalogue::empty_array(ident),
        Some(Ok(length)) if length <= LONGEST => return Some(length),
        Some(Ok(_) | Err(_)) => catalogue::array_too_long(ident, LONGEST),
        None => catalogue::length_not_constant(ident),
    };
    translator.diagnostics.at(expr.origin, message);
    None
}

/// Reports names that are keywords or declared twice.
fn check_names(args: &Args, diagnostics: &mut Diagnostics) {
    let mut seen: Vec<(Name, &str)> = Vec::new();
    let coordinates = args.coordinates.iter().map(|declaration| (declaration, "coordinate"));
    let inputs = args.inputs.iter().map(|declaration| (declaration, "input"));
    for (declaration, kind) in coordinates.chain(inputs) {
        let name = bare(&declaration.ident);
        let span = declaration.ident.span();
        // `parse_any` lets keywords through. Raw identifiers are names.
        if syn::parse_str::<Ident>(&declaration.ident.to_string()).is_err() {
            diagnostics.error(
                span,
                match &*name {
                    "self" | "Self" | "super" | "crate" => catalogue::reserved_name(&name),
                    _ => catalogue::keyword_name(&name),
                },
            );
        }
        match seen.iter().find(|(other, _)| *other == name) {
            Some((_, earlier)) if *earlier == kind => {
                diagnostics.error(span, catalogue::declared_twice(kind, &name));
            }
            Some(_) => diagnostics.error(span, catalogue::coordinate_and_input(&name)),
            None => seen.push((name, kind)),
        }
    }
}

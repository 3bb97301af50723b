//! Role attributes: the meaning of functions.

use proc_macro2::TokenTree;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, Ident, Meta, Token};

use super::body::{ExprKind, Owner, Word};
use super::hygiene;
use super::item::{Eliminate, Friction, Normal, Role, RoleKind, Target};
use super::spans;
use super::suggest::nearest;
use super::translate::{Translator, bare};
use crate::diagnostics::{Origin, catalogue};

/// Roles of the language.
const SUPPORTED: [&str; 12] = [
    "point",
    "body",
    "kinetic",
    "potential",
    "lagrangian",
    "dissipation",
    "force",
    "holonomic",
    "nonholonomic",
    "unilateral",
    "friction",
    "event",
];

/// Words that others use for roles.
const SYNONYMS: [(&str, &str); 10] = [
    ("particle", "point"),
    ("rigid_body", "body"),
    ("gravity", "potential"),
    ("spring", "potential"),
    ("damping", "dissipation"),
    ("damper", "dissipation"),
    ("torque", "force"),
    ("constraint", "holonomic"),
    ("contact", "unilateral"),
    ("guard", "event"),
];

/// Arguments of roles that may stand without a value.
const FLAGS: [&str; 2] = ["eliminate", "chetaev"];

/// Attributes of the language and of common tools. They are no misspelt roles.
const FOREIGN: [&str; 16] = [
    "allow",
    "expect",
    "warn",
    "deny",
    "forbid",
    "doc",
    "inline",
    "cold",
    "cfg",
    "cfg_attr",
    "must_use",
    "deprecated",
    "track_caller",
    "rustfmt",
    "clippy",
    "test",
];

/// Whether an attribute is one of ours, misspelt ones and a `cfg_attr` around one included.
pub fn is_role(attribute: &Attribute) -> bool {
    let conditional = || attribute.path().is_ident("cfg_attr") && mentions_role(attribute);
    name(attribute).is_some_and(|name| known(&name) || misspelt(&name).is_some()) || conditional()
}

/// The name of an attribute. The crate of `::point` cannot be an attribute, so the word after `::` counts.
fn name(attribute: &Attribute) -> Option<String> {
    let segments = &attribute.path().segments;
    (segments.len() == 1).then(|| segments[0].ident.to_string())
}

fn known(name: &str) -> bool {
    SUPPORTED.contains(&name)
}

fn misspelt(name: &str) -> Option<&'static str> {
    if FOREIGN.contains(&name) {
        return None;
    }
    nearest(&name.to_lowercase(), SUPPORTED)
        .or_else(|| SUPPORTED.into_iter().find(|role| *role == name.to_lowercase() && *role != name))
        .or_else(|| SYNONYMS.into_iter().find(|(word, _)| *word == name).map(|(_, role)| role))
}

/// Whether the arguments of an attribute contain the name of a role.
fn mentions_role(attribute: &Attribute) -> bool {
    mentions(attribute, known)
}

/// Whether the arguments of an attribute contain a word.
fn mentions(attribute: &Attribute, is_meant: impl Fn(&str) -> bool) -> bool {
    let Meta::List(list) = &attribute.meta else { return false };
    let is_meant = |tree: TokenTree| matches!(tree, TokenTree::Ident(ident) if is_meant(&ident.to_string()));
    list.tokens.clone().into_iter().any(is_meant)
}

/// Reports roles on anything but a function.
pub fn refuse_on_item(item: &syn::ImplItem, translator: &mut Translator) {
    let attributes = match item {
        syn::ImplItem::Const(constant) => &constant.attrs,
        syn::ImplItem::Type(ty) => &ty.attrs,
        _ => return,
    };
    for attribute in attributes.iter().filter(|attribute| is_role(attribute)) {
        let name = name(attribute).unwrap_or_default();
        translator.diagnostics.error(spans::span(attribute.path()), catalogue::role_on_item(name));
    }
}

/// Reads the role of a function from its attributes. Mistakes are reported. The second result is the kind of
/// a role whose arguments are wrong, or of the first of two.
pub fn parse(attributes: &[Attribute], translator: &mut Translator) -> (Option<Role>, Option<RoleKind>) {
    let mut role: Option<(Role, String)> = None;
    let mut unread = None;
    for attribute in attributes {
        let Some(name) = name(attribute) else { continue };
        let span = spans::span(attribute.path());
        if name == "cfg_attr" && mentions_role(attribute) {
            translator.diagnostics.error(span, catalogue::conditional_attribute());
            continue;
        }
        if !known(&name) {
            if let Some(near) = misspelt(&name) {
                translator.diagnostics.error(span, catalogue::unknown_role(&name, near));
            }
            continue;
        }
        if let Some((first, first_name)) = &role {
            translator.diagnostics.error(span, catalogue::two_roles(first_name, &name));
            // Which of them is meant is unknown, so nothing is asked of the function.
            unread = Some(first.kind.clone());
            role = None;
            break;
        }
        let origin = translator.origin(span);
        match kind(&name, attribute, translator) {
            Some((kind, written)) => role = Some((Role { kind, written, origin }, name)),
            None => unread = Some(blank(&name, attribute, origin)),
        }
    }
    let role = role.map(|(role, _)| role);
    let unread = unread.filter(|_| role.is_none());
    (role, unread)
}

/// A role by its name alone.
fn blank(name: &str, attribute: &Attribute, origin: Origin) -> RoleKind {
    let nothing = || super::body::Expr { origin, kind: ExprKind::Tuple(Vec::new()) };
    match name {
        "point" => RoleKind::Point { mass: nothing() },
        "body" => RoleKind::Body { mass: nothing(), inertia: nothing() },
        "kinetic" => RoleKind::Kinetic,
        "potential" => RoleKind::Potential,
        "lagrangian" => RoleKind::Lagrangian,
        "dissipation" => RoleKind::Dissipation,
        "holonomic" => {
            let eliminates = mentions(attribute, |word| word == "eliminate");
            RoleKind::Holonomic { eliminate: eliminates.then_some(Eliminate { coordinate: None, origin }) }
        }
        "nonholonomic" => RoleKind::Nonholonomic { chetaev: false },
        "unilateral" => RoleKind::Unilateral { restitution: None, poisson: false },
        "friction" => {
            RoleKind::Friction(Box::new(Friction { kinetic: nothing(), fixed: None, normal: None }))
        }
        "event" => RoleKind::Event,
        _ => RoleKind::Force(Target::Generalized),
    }
}

fn kind(
    name: &str,
    attribute: &Attribute,
    translator: &mut Translator,
) -> Option<(RoleKind, Vec<(String, Expr)>)> {
    let accepted: &[&str] = match name {
        "point" => &["mass"],
        "body" => &["mass", "inertia"],
        "force" => &["at", "on"],
        "holonomic" => &["eliminate"],
        "nonholonomic" => &["chetaev"],
        "unilateral" => &["restitution", "law"],
        "friction" => &["coefficient", "static_coefficient", "limit", "static_limit", "normal"],
        _ => &[],
    };
    let given = arguments(name, attribute, accepted, translator)?;
    let find = |key: &str| given.iter().find(|given| given.key == key);
    let take = |key: &str| find(key).and_then(|given| given.value.as_ref());
    let required = |key: &str, translator: &mut Translator| {
        let expr = take(key);
        if expr.is_none() {
            let span = spans::span(attribute.path());
            translator.diagnostics.error(span, catalogue::missing_role_argument(name, key));
        }
        expr.map(|expr| translator.expression(expr))
    };
    let written =
        given.iter().filter_map(|given| Some((given.key.to_string(), given.value.clone()?))).collect();
    let kind = match name {
        "point" => Some(RoleKind::Point { mass: required("mass", translator)? }),
        "body" => {
            let (mass, inertia) = (required("mass", translator), required("inertia", translator));
            Some(RoleKind::Body { mass: mass?, inertia: inertia? })
        }
        "kinetic" => Some(RoleKind::Kinetic),
        "potential" => Some(RoleKind::Potential),
        "lagrangian" => Some(RoleKind::Lagrangian),
        "dissipation" => Some(RoleKind::Dissipation),
        "holonomic" => {
            let Some(KeyValue { key, value }) = find("eliminate") else {
                return Some((RoleKind::Holonomic { eliminate: None }, written));
            };
            let coordinate = match value {
                Some(value) => Some(target(value, "eliminate", translator)?),
                None => None,
            };
            let origin = translator.origin(key.span());
            Some(RoleKind::Holonomic { eliminate: Some(Eliminate { coordinate, origin }) })
        }
        "nonholonomic" => Some(RoleKind::Nonholonomic { chetaev: find("chetaev").is_some() }),
        "unilateral" => {
            let restitution = take("restitution").map(|expr| translator.expression(expr));
            let law = match take("law") {
                Some(law) => Some(target(law, "law", translator)?.0),
                None => None,
            };
            let named = law.as_ref().map_or("newton", |law| &*law.name);
            let fault = match (named, &restitution) {
                ("newton" | "poisson", _) => None,
                ("plastic", None) => None,
                ("plastic", Some(_)) => Some(catalogue::plastic_with_restitution()),
                (other, _) => Some(catalogue::unknown_law(other)),
            };
            if let (Some(fault), Some(law)) = (fault, &law) {
                translator.diagnostics.at(law.origin, fault);
                return None;
            }
            Some(RoleKind::Unilateral { restitution, poisson: named == "poisson" })
        }
        "friction" => {
            let span = spans::span(attribute.path());
            let (size, fixed, kinetic) = match (take("limit"), take("coefficient")) {
                (Some(limit), _) => ("limit", "static_limit", limit),
                (None, Some(coefficient)) => ("coefficient", "static_coefficient", coefficient),
                (None, None) => {
                    translator.diagnostics.error(span, catalogue::friction_without_limit());
                    return None;
                }
            };
            let allowed = |key: &str| key == size || key == fixed || (key == "normal" && size != "limit");
            if let Some(other) = given.iter().find(|given| !allowed(&given.key.to_string())) {
                translator.diagnostics.error(other.key.span(), catalogue::mixed_friction());
                return None;
            }
            let kinetic = translator.expression(kinetic);
            let fixed = take(fixed).map(|expr| translator.expression(expr));
            let normal = match take("normal") {
                Some(normal) => Some(limiting(normal, translator)?),
                None if size == "limit" => None,
                None => {
                    translator.diagnostics.error(span, catalogue::friction_without_normal());
                    return None;
                }
            };
            Some(RoleKind::Friction(Box::new(Friction { kinetic, fixed, normal })))
        }
        "event" => Some(RoleKind::Event),
        _ => match (take("at"), take("on")) {
            (Some(_), Some(on)) => {
                translator.diagnostics.error(spans::expression(on), catalogue::force_at_and_on());
                None
            }
            (Some(at), None) => target(at, "at", translator).map(|(w, i)| RoleKind::Force(Target::At(w, i))),
            (None, Some(on)) => target(on, "on", translator).map(|(w, i)| RoleKind::Force(Target::On(w, i))),
            (None, None) => Some(RoleKind::Force(Target::Generalized)),
        },
    };
    kind.map(|kind| (kind, written))
}

struct KeyValue {
    key: Ident,
    value: Option<Expr>,
}

impl Parse for KeyValue {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let key = input.call(Ident::parse_any)?;
        if input.is_empty() || input.peek(Token![,]) {
            return Ok(KeyValue { key, value: None });
        }
        input.parse::<Token![=]>()?;
        Ok(KeyValue { key, value: Some(input.parse()?) })
    }
}

fn arguments(
    role: &str,
    attribute: &Attribute,
    accepted: &[&str],
    translator: &mut Translator,
) -> Option<Vec<KeyValue>> {
    let list = match &attribute.meta {
        Meta::Path(_) => return Some(Vec::new()),
        Meta::NameValue(pair) => {
            let form = match accepted {
                ["at", ..] => "#[force]` or `#[force(at = …)]".to_string(),
                [flag] if FLAGS.contains(flag) => format!("#[{role}]` or `#[{role}({flag})]"),
                [] => format!("#[{role}]"),
                _ => format!("#[{role}({} = …)]", accepted.join(" = …, ")),
            };
            let message = catalogue::role_form(role, form);
            translator.diagnostics.error(spans::expression(&pair.value), message);
            return None;
        }
        Meta::List(list) => list,
    };
    let parsed = list.parse_args_with(Punctuated::<KeyValue, Token![,]>::parse_terminated);
    let pairs = match parsed {
        Ok(pairs) => pairs,
        Err(error) => {
            let message = catalogue::bad_role_arguments(role, error);
            translator.diagnostics.error(list.delimiter.span().open(), message);
            return None;
        }
    };
    let mut given: Vec<KeyValue> = Vec::new();
    let mut valid = true;
    for KeyValue { key, value } in pairs {
        let text = bare(&key).to_string();
        if !accepted.contains(&text.as_str()) {
            let near = nearest(&text, accepted.iter().copied());
            let message = match (near, accepted) {
                (Some(near), _) => catalogue::misspelt_role_argument(role, &text, near),
                (None, []) => catalogue::role_without_arguments(role),
                (None, _) => catalogue::unknown_role_argument(role, &text, accepted.join("`, `")),
            };
            translator.diagnostics.error(key.span(), message);
            valid = false;
        } else if given.iter().any(|other| other.key == key) {
            translator.diagnostics.error(key.span(), catalogue::duplicate_argument(&text));
            valid = false;
        } else if value.is_none() && !FLAGS.contains(&text.as_str()) {
            translator.diagnostics.error(key.span(), catalogue::bad_role_arguments(role, "expected `=`"));
            valid = false;
        } else if text == "chetaev" && value.is_some() {
            translator.diagnostics.error(key.span(), catalogue::argument_with_value(&text));
            valid = false;
        } else {
            given.push(KeyValue { key, value });
        }
    }
    valid.then_some(given)
}

/// The reactions that limit a friction: one name, or a list of several.
fn limiting(expr: &Expr, translator: &mut Translator) -> Option<Normal> {
    let Expr::Array(list) = expr else {
        return target(expr, "normal", translator).map(|(word, element)| Normal::One(word, element));
    };
    let origin = translator.origin(spans::expression(expr));
    let names: Vec<_> = list.elems.iter().map(|name| target(name, "normal", translator)).collect();
    names.into_iter().collect::<Option<Vec<_>>>().map(|names| Normal::Together(names, origin))
}

/// `name` or `name[index]`.
fn target(expr: &Expr, key: &str, translator: &mut Translator) -> Option<(Word, Option<super::body::Expr>)> {
    let translated = translator.expression(expr);
    let (base, index) = match translated.kind {
        ExprKind::Index(base, index) => (*base, Some(*index)),
        _ => (translated, None),
    };
    match base.kind {
        ExprKind::Path(path) if matches!(path.owner, Owner::None | Owner::SelfType) => {
            // Functions have one name in all syntax contexts.
            Some((Word { name: hygiene::written(&path.last).into(), origin: path.origin }, index))
        }
        _ => {
            translator.diagnostics.at(base.origin, catalogue::bad_target(key));
            None
        }
    }
}

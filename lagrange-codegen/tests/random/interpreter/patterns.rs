//! Patterns of `let`s and parameters.

use quote::ToTokens;
use syn::{FnArg, ImplItemFn, Pat, PatStruct};

use super::Locals;
use super::value::{Run, Value, unknown};

/// The names of all parameters, the receiver included.
pub fn parameters(function: &ImplItemFn) -> Run<Vec<String>> {
    let name = |argument: &FnArg| match argument {
        FnArg::Receiver(_) => Ok("self".to_owned()),
        FnArg::Typed(typed) => match &*typed.pat {
            Pat::Ident(name) => Ok(name.ident.to_string()),
            other => unknown(format!("the parameter `{}`", other.to_token_stream())),
        },
    };
    function.sig.inputs.iter().map(name).collect()
}

/// Binds the names of a pattern; a name that stands twice in it is an error, as for rustc.
pub fn bind(pattern: &Pat, value: Value, locals: &mut Locals) -> Run<()> {
    let mut bound = Vec::new();
    take_apart(pattern, value, &mut bound)?;
    for (position, (name, _)) in bound.iter().enumerate() {
        if bound[..position].iter().any(|(earlier, _)| earlier == name) {
            return unknown(format!("`{name}` is bound twice in one pattern"));
        }
    }
    locals.extend(bound);
    Ok(())
}

fn take_apart(pattern: &Pat, value: Value, bound: &mut Vec<(String, Value)>) -> Run<()> {
    let elements = match pattern {
        Pat::Wild(_) => return Ok(()),
        Pat::Ident(name) => {
            bound.push((name.ident.to_string(), value));
            return Ok(());
        }
        Pat::Type(typed) => return take_apart(&typed.pat, value, bound),
        Pat::Struct(parts) => return take_record_apart(parts, &value, bound),
        // A value that is missing has ended the run already, so `Some` matches.
        Pat::TupleStruct(some) if some.path.segments.last().is_some_and(|last| last.ident == "Some") => {
            return some.elems.first().map_or(Ok(()), |inner| take_apart(inner, value, bound));
        }
        Pat::Slice(slice) => &slice.elems,
        Pat::Tuple(tuple) => &tuple.elems,
        other => return unknown(format!("the pattern `{}`", other.to_token_stream())),
    };
    match value {
        Value::List(values) if values.len() == elements.len() => {
            elements.iter().zip(values).try_for_each(|(pattern, value)| take_apart(pattern, value, bound))
        }
        other => unknown(format!("`{}` for {other:?}", pattern.to_token_stream())),
    }
}

/// All fields must be named, as for rustc.
fn take_record_apart(pattern: &PatStruct, value: &Value, bound: &mut Vec<(String, Value)>) -> Run<()> {
    match value {
        Value::Record(fields) if fields.len() == pattern.fields.len() => {}
        other => return unknown(format!("`{}` for {other:?}", pattern.to_token_stream())),
    }
    pattern.fields.iter().try_for_each(|field| {
        let name = field.member.to_token_stream().to_string();
        take_apart(&field.pat, value.field(&name)?.clone(), bound)
    })
}

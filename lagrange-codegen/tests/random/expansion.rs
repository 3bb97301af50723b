//! The emitted methods of one system, found in the tokens of its expansion.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use syn::{Expr, ImplItem, ImplItemFn, Item, ItemImpl, Stmt};

use lagrange_codegen::Settings;

use crate::source::Source;

/// Emitted functions by name.
pub type Functions = BTreeMap<String, ImplItemFn>;

/// The engine's expansion of one system.
#[derive(Clone, Default)]
pub struct Expansion {
    /// Inherent methods.
    pub methods: Functions,
    /// The items of `impl System`.
    pub system: Functions,
    /// The items of `impl Surface`, which systems with constraints have.
    pub surface: Functions,
    /// The items of `impl Smooth`.
    pub smooth: Functions,
    /// The functions of `impl Linearized`, `Carried`, `Tangent`, `Parametric` and `Sensitive`, where they are
    /// asked for.
    pub derivatives: Functions,
    /// The constants of these and of `Surface`.
    pub constants: BTreeMap<String, Expr>,
}

impl Expansion {
    /// Expands a description and takes the expansion apart.
    pub fn of(source: &Source) -> Result<Expansion, String> {
        Expansion::parse(tokens(source)?)
    }

    /// The same with as many loops as there are: two alike instructions make one.
    pub fn in_loops(source: &Source) -> Result<Expansion, String> {
        Expansion::parse(tokens_with(source, Settings { least_loop: Some(2), ..Settings::default() })?)
    }

    fn parse(tokens: TokenStream) -> Result<Expansion, String> {
        let file: syn::File =
            syn::parse2(tokens).map_err(|error| format!("the expansion is not Rust: {error}"))?;
        let mut blocks = Vec::new();
        for item in file.items {
            match item {
                Item::Macro(call) => return Err(format!("refused: {}", call.mac.tokens)),
                Item::Const(constant) => match *constant.expr {
                    Expr::Block(block) => blocks.extend(block.block.stmts),
                    _ => return Err("a constant that is no block".to_owned()),
                },
                _ => {}
            }
        }
        let mut expansion = Expansion::default();
        for statement in blocks {
            if let Stmt::Item(Item::Impl(block)) = statement {
                // The same code once more, for any scalar.
                if matches!(&*block.self_ty, syn::Type::Path(ty) if ["__Over", "__InRegime"].contains(&&*last_segment(&ty.path)))
                {
                    continue;
                }
                let name = block.trait_.as_ref().map(|(path, _)| last_segment(path));
                match name.as_deref() {
                    None => collect(block, &mut expansion.methods)?,
                    Some("System") => collect(block, &mut expansion.system)?,
                    Some("Surface") => {
                        expansion.constants.extend(constants(&block));
                        collect(block, &mut expansion.surface)?;
                    }
                    Some("Linearized" | "Carried" | "Tangent" | "Parametric" | "Sensitive") => {
                        expansion.constants.extend(constants(&block));
                        collect(block, &mut expansion.derivatives)?;
                    }
                    Some("Smooth") => collect(block, &mut expansion.smooth)?,
                    // Proofs have tests of their own.
                    Some(_) => {}
                }
            }
        }
        Ok(expansion)
    }
}

fn last_segment(path: &syn::Path) -> String {
    path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default()
}

/// The expansion as tokens.
pub fn tokens(source: &Source) -> Result<TokenStream, String> {
    tokens_with(source, Settings::default())
}

fn tokens_with(source: &Source, settings: Settings) -> Result<TokenStream, String> {
    let parse = |text: &str| {
        text.parse::<TokenStream>().map_err(|error| format!("the source has no tokens: {error}"))
    };
    let (arguments, item) = (parse(&source.arguments)?, parse(&source.item)?);
    Ok(lagrange_codegen::expand_with(arguments, item, "::lagrangian", settings))
}

fn collect(block: ItemImpl, target: &mut Functions) -> Result<(), String> {
    for item in block.items {
        if let ImplItem::Fn(function) = item {
            let name = function.sig.ident.to_string();
            if target.insert(name.clone(), function).is_some() {
                return Err(format!("`{name}` is emitted twice"));
            }
        }
    }
    Ok(())
}

fn constants(block: &ItemImpl) -> impl Iterator<Item = (String, Expr)> + '_ {
    block.items.iter().filter_map(|item| match item {
        ImplItem::Const(constant) => Some((constant.ident.to_string(), constant.expr.clone())),
        _ => None,
    })
}

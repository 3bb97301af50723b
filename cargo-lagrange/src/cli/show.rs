//! `equations`, `structure`, `cost` and `expand`: what the macro makes of the models of a package.

use cargo_lagrange::models::{Expansion, Model};
use clap::Args;
use serde_json::{Value, json};

use super::package::Selection;
use super::print;

/// Prints the equations of motion.
#[derive(Args)]
pub struct EquationsArguments {
    #[command(flatten)]
    selection: Selection,
    /// In LaTeX, an `aligned` environment.
    #[arg(long)]
    latex: bool,
    /// In MathML, a `math` element that browsers set and screen readers read.
    #[arg(long, conflicts_with = "latex")]
    mathml: bool,
    /// As JSON, with all forms.
    #[arg(long, conflicts_with_all = ["latex", "mathml"])]
    json: bool,
}

#[derive(Args)]
pub struct ModelArguments {
    #[command(flatten)]
    selection: Selection,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

/// Prints the generated code of a model, or of one of its functions.
#[derive(Args)]
pub struct ExpandArguments {
    /// The generated function, such as `accelerations_at`; without it the whole expansion.
    function: Option<String>,
    #[command(flatten)]
    selection: Selection,
}

/// Runs `equations`.
pub fn equations(arguments: &EquationsArguments) -> Result<(), String> {
    let has_formulas = arguments.latex || arguments.mathml || arguments.json;
    let text = |_: &Model, expansion: &Expansion| match &expansion.formulas {
        Some(formulas) if arguments.latex => formulas.latex.clone(),
        Some(formulas) if arguments.mathml => formulas.mathml.clone(),
        _ => expansion.equations.clone(),
    };
    let value = |expansion: &Expansion| {
        let formulas = expansion.formulas.as_ref();
        json!({
            "text": expansion.equations,
            "latex": formulas.map(|formulas| &formulas.latex),
            "mathml": formulas.map(|formulas| &formulas.mathml),
        })
    };
    show(&arguments.selection, has_formulas, arguments.json, text, value)
}

/// Runs `structure`.
pub fn structure(arguments: &ModelArguments) -> Result<(), String> {
    let text = |_: &Model, expansion: &Expansion| {
        let structure = &expansion.structure;
        let mut text = format!("mass matrix: {}", structure.mass_matrix);
        for (title, phrases) in [("facts", &structure.facts), ("skipped", &structure.skipped)] {
            if !phrases.is_empty() {
                text += &format!("\n{title}:\n  - {}", phrases.join("\n  - "));
            }
        }
        text
    };
    let value = |expansion: &Expansion| {
        let structure = &expansion.structure;
        json!({ "mass_matrix": structure.mass_matrix, "facts": structure.facts, "skipped": structure.skipped })
    };
    show(&arguments.selection, false, arguments.json, text, value)
}

/// The kinds of operations, in the order of the counts.
const OPERATIONS: [&str; 5] = ["additions", "multiplications", "divisions", "square roots", "functions"];

/// Runs `cost`.
pub fn cost(arguments: &ModelArguments) -> Result<(), String> {
    let text = |_: &Model, expansion: &Expansion| {
        let line = |counts: &[u64; 5]| {
            let counts = counts.iter().zip(OPERATIONS).map(|(count, kind)| format!("{count} {kind}"));
            counts.collect::<Vec<_>>().join(", ")
        };
        let costs = &expansion.costs;
        format!(
            "one evaluation of the accelerations\n  as derived: {}\n  as emitted: {}",
            line(&costs.before),
            line(&costs.after)
        )
    };
    let value = |expansion: &Expansion| {
        let counts = |counts: &[u64; 5]| -> Value {
            OPERATIONS
                .iter()
                .zip(counts)
                .map(|(kind, &count)| (kind.replace(' ', "_"), json!(count)))
                .collect()
        };
        json!({ "before": counts(&expansion.costs.before), "after": counts(&expansion.costs.after) })
    };
    show(&arguments.selection, false, arguments.json, text, value)
}

/// Runs `expand`.
pub fn expand(arguments: &ExpandArguments) -> Result<(), String> {
    let models = arguments.selection.models()?;
    let mut texts = Vec::new();
    for (model, expansion) in expanded(&models, false)? {
        let text = match &arguments.function {
            None => expansion.text(),
            Some(name) => expansion.method(name).ok_or_else(|| {
                let methods = expansion.methods().join(", ");
                format!("error: {model}: no generated function `{name}`; there are {methods}")
            })?,
        };
        texts.push(format!("// {model}\n{text}"));
    }
    print(&texts.join("\n"))
}

/// Prints something of each model: under its name where there are several, or a JSON array of objects.
fn show(
    selection: &Selection,
    formulas: bool,
    as_json: bool,
    text: impl Fn(&Model, &Expansion) -> String,
    value: impl Fn(&Expansion) -> Value,
) -> Result<(), String> {
    let models = selection.models()?;
    let expanded = expanded(&models, formulas)?;
    if as_json {
        let values = expanded.iter().map(|(model, expansion)| {
            let mut value = value(expansion);
            value["model"] = json!(model.name);
            value["file"] = json!(model.file);
            value["line"] = json!(model.line);
            value
        });
        return print(&format!("{:#}\n", values.collect::<Value>()));
    }
    let texts = expanded.iter().map(|(model, expansion)| match &expanded[..] {
        [_] => format!("{}\n", text(model, expansion).trim_end()),
        _ => format!("{model}\n\n{}\n", text(model, expansion).trim_end()),
    });
    print(&texts.collect::<Vec<_>>().join("\n"))
}

/// The expansions, or all mistakes of all models.
fn expanded(models: &[Model], formulas: bool) -> Result<Vec<(&Model, Expansion)>, String> {
    let mut expansions = Vec::new();
    let mut mistakes = Vec::new();
    for model in models {
        match model.expand(formulas) {
            Ok(expansion) => expansions.push((model, expansion)),
            Err(more) => mistakes.extend(more.iter().map(ToString::to_string)),
        }
    }
    if mistakes.is_empty() { Ok(expansions) } else { Err(mistakes.join("\n")) }
}

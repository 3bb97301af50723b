//! The engine's expansion of a model: its constants as values, its methods as text.

use lagrange_codegen::Settings;
use syn::spanned::Spanned;
use syn::visit::Visit;
use syn::{Expr, ExprLit, ImplItem, ImplItemConst, Item, ItemImpl, ItemMacro, Lit};

use super::{Mistake, Model};

/// An expanded model.
pub struct Expansion {
    file: syn::File,
    /// The equations of motion as text.
    pub equations: String,
    /// The equations in LaTeX and MathML, if they were asked for.
    pub formulas: Option<Formulas>,
    /// The properties found, and the work left out.
    pub structure: Structure,
    /// Operations of one evaluation of the accelerations.
    pub costs: Costs,
}

/// The equations as they are typeset.
#[derive(Default)]
pub struct Formulas {
    /// An `aligned` environment of LaTeX.
    pub latex: String,
    /// A `math` element.
    pub mathml: String,
}

/// The constant `STRUCTURE`.
#[derive(Default)]
pub struct Structure {
    /// Form of the mass matrix.
    pub mass_matrix: String,
    /// Proven properties.
    pub facts: Vec<String>,
    /// The work that the code leaves out.
    pub skipped: Vec<String>,
}

/// The constant `COST`: additions, multiplications, divisions, square roots, functions.
#[derive(Default)]
pub struct Costs {
    /// As derived.
    pub before: [u64; 5],
    /// As emitted.
    pub after: [u64; 5],
}

impl Model {
    /// Expands the model, with formulas if `formulas` says so.
    ///
    /// # Errors
    ///
    /// The messages of the macro.
    pub fn expand(&self, formulas: bool) -> Result<Expansion, Vec<Mistake>> {
        let settings = Settings { formulas, ..Settings::default() };
        let (arguments, block) = (self.arguments.clone(), self.block.clone());
        let tokens = lagrange_codegen::expand_with(arguments, block, "::lagrangian", settings);
        let at_attribute =
            |message: String| Mistake { file: self.file.clone(), line: self.line, column: 1, message };
        let file: syn::File = syn::parse2(tokens)
            .map_err(|error| vec![at_attribute(format!("the expansion is not Rust: {error}"))])?;
        let mut reader = Reader::of(self);
        reader.visit_file(&file);
        if !reader.mistakes.is_empty() {
            return Err(reader.mistakes);
        }
        let Reader { equations, formulas, structure, costs, .. } = reader;
        Ok(Expansion { file, equations, formulas, structure, costs })
    }
}

impl Expansion {
    /// The whole expansion, formatted.
    #[must_use]
    pub fn text(&self) -> String {
        prettyplease::unparse(&self.file)
    }

    /// The generated functions of this name, formatted, each in the `impl` block that holds it. `None` if no
    /// function has the name.
    #[must_use]
    pub fn method(&self, name: &str) -> Option<String> {
        let mut blocks = Blocks::default();
        blocks.visit_file(&self.file);
        let items: Vec<Item> =
            blocks.found.into_iter().filter_map(|block| only(block, name)).map(Item::Impl).collect();
        let file = syn::File { shebang: None, frontmatter: None, attrs: Vec::new(), items };
        (!file.items.is_empty()).then(|| prettyplease::unparse(&file))
    }

    /// The names of all generated functions, sorted, without those that begin with `__`.
    #[must_use]
    pub fn methods(&self) -> Vec<String> {
        let mut blocks = Blocks::default();
        blocks.visit_file(&self.file);
        let mut names: Vec<String> = blocks
            .found
            .iter()
            .flat_map(|block| &block.items)
            .filter_map(|item| match item {
                ImplItem::Fn(function) => Some(function.sig.ident.to_string()),
                _ => None,
            })
            .filter(|name| !name.starts_with("__"))
            .collect();
        names.sort();
        names.dedup();
        names
    }
}

/// A block with the functions of this name alone.
fn only(mut block: ItemImpl, name: &str) -> Option<ItemImpl> {
    block.items.retain(|item| matches!(item, ImplItem::Fn(function) if function.sig.ident == name));
    (!block.items.is_empty()).then_some(block)
}

/// All `impl` blocks, those inside of `const _: () = { … }` included.
#[derive(Default)]
struct Blocks {
    found: Vec<ItemImpl>,
}

impl<'ast> Visit<'ast> for Blocks {
    fn visit_item_impl(&mut self, block: &'ast ItemImpl) {
        self.found.push(block.clone());
    }
}

/// Reads the constants and the messages of an expansion.
struct Reader<'a> {
    model: &'a Model,
    equations: String,
    formulas: Option<Formulas>,
    structure: Structure,
    costs: Costs,
    mistakes: Vec<Mistake>,
}

impl<'a> Reader<'a> {
    fn of(model: &'a Model) -> Reader<'a> {
        Reader {
            model,
            equations: String::new(),
            formulas: None,
            structure: Structure::default(),
            costs: Costs::default(),
            mistakes: Vec::new(),
        }
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item_macro(&mut self, item: &'ast ItemMacro) {
        let is_message =
            item.mac.path.segments.last().is_some_and(|segment| segment.ident == "compile_error");
        let Ok(message) = item.mac.parse_body::<syn::LitStr>() else { return };
        if is_message {
            // The engine gives the call the span of the mistake, and the text none.
            let start = item.mac.path.span().start();
            // `call_site` stands for the attribute; here it is the first line of the file.
            let (line, column) = match (start.line, start.column) {
                (..=1, 0) => (self.model.line, 1),
                (line, column) => (line, column + 1),
            };
            self.mistakes.push(Mistake {
                file: self.model.file.clone(),
                line,
                column,
                message: message.value(),
            });
        }
    }

    fn visit_impl_item_const(&mut self, constant: &'ast ImplItemConst) {
        let value = &constant.expr;
        match constant.ident.to_string().as_str() {
            "EQUATIONS" => self.equations = strings(value).concat(),
            "EQUATIONS_LATEX" => self.formulas.get_or_insert_default().latex = strings(value).concat(),
            "EQUATIONS_MATHML" => self.formulas.get_or_insert_default().mathml = strings(value).concat(),
            "STRUCTURE" => {
                for (name, value) in fields(value) {
                    match name.as_str() {
                        "mass_matrix" => self.structure.mass_matrix = strings(value).concat(),
                        "facts" => self.structure.facts = strings(value),
                        "skipped" => self.structure.skipped = strings(value),
                        _ => {}
                    }
                }
            }
            "COST" => {
                for (name, value) in fields(value) {
                    match name.as_str() {
                        "before" => self.costs.before = counts(value),
                        "after" => self.costs.after = counts(value),
                        _ => {}
                    }
                }
            }
            _ => {}
        }
    }
}

/// The fields of a struct expression.
fn fields(value: &Expr) -> Vec<(String, &Expr)> {
    let Expr::Struct(value) = value else { return Vec::new() };
    let name = |member: &syn::Member| match member {
        syn::Member::Named(name) => name.to_string(),
        syn::Member::Unnamed(index) => index.index.to_string(),
    };
    value.fields.iter().map(|field| (name(&field.member), &field.expr)).collect()
}

/// The string literals of an expression, in order.
fn strings(value: &Expr) -> Vec<String> {
    struct Strings(Vec<String>);
    impl<'ast> Visit<'ast> for Strings {
        fn visit_expr_lit(&mut self, literal: &'ast ExprLit) {
            if let Lit::Str(text) = &literal.lit {
                self.0.push(text.value());
            }
        }
    }
    let mut strings = Strings(Vec::new());
    strings.visit_expr(value);
    strings.0
}

/// The numbers of a call `Cost::new(…)`.
fn counts(value: &Expr) -> [u64; 5] {
    struct Counts(Vec<u64>);
    impl<'ast> Visit<'ast> for Counts {
        fn visit_expr_lit(&mut self, literal: &'ast ExprLit) {
            if let Lit::Int(number) = &literal.lit {
                self.0.extend(number.base10_parse::<u64>());
            }
        }
    }
    let mut counts = Counts(Vec::new());
    counts.visit_expr(value);
    let mut result = [0; 5];
    for (place, count) in result.iter_mut().zip(counts.0) {
        *place = count;
    }
    result
}

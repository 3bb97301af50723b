//! The nesting of expressions. Every stage, from the parser to those of rustc, recurses into them, and
//! nothing but the operating system guards its stack.

use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};

/// The deepest nesting that is accepted. A level of parentheses takes up to 13 kB in `syn` and in the stages
/// after it, in an engine without optimisation, so this many fit on half of the 8 MiB stack of a compiler
/// thread. A sum of as many terms is as deep.
pub const DEEPEST: usize = 300;

/// The span of something nested deeper than [`DEEPEST`], if there is any.
pub fn too_deep(tokens: TokenStream) -> Option<Span> {
    let mut stack = vec![(tokens, 0)];
    while let Some((stream, outside)) = stack.pop() {
        let mut run = Run::new(outside);
        let mut trees = stream.into_iter().peekable();
        while let Some(tree) = trees.next() {
            let ends = match &tree {
                TokenTree::Punct(punct) => matches!(punct.as_char(), ',' | ';' | '#'),
                // The end of a function or of a statement, unless it goes on.
                TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => match trees.peek() {
                    Some(TokenTree::Ident(next)) => next != "else",
                    Some(TokenTree::Punct(next)) => next.as_char() == '#',
                    Some(TokenTree::Group(_) | TokenTree::Literal(_)) | None => true,
                },
                TokenTree::Group(_) | TokenTree::Ident(_) | TokenTree::Literal(_) => false,
            };
            run.take(tree);
            if run.depth() > DEEPEST {
                return run.span;
            }
            if ends {
                stack.extend(run.inner());
                run = Run::new(outside);
            }
        }
        stack.extend(run.inner());
    }
    None
}

/// Tokens without a separator, which form one expression at most.
struct Run {
    outside: usize,
    /// Additions and subtractions: each nests all terms before it.
    sums: usize,
    /// Other nesting in the present term.
    term: usize,
    deepest: usize,
    groups: Vec<TokenStream>,
    span: Option<Span>,
}

impl Run {
    fn new(outside: usize) -> Run {
        Run { outside, sums: 0, term: 0, deepest: 0, groups: Vec::new(), span: None }
    }

    fn take(&mut self, tree: TokenTree) {
        self.span = Some(tree.span());
        match tree {
            TokenTree::Punct(punct) => match punct.as_char() {
                '+' | '-' => {
                    self.sums += 1;
                    self.term = 0;
                }
                // Parts of paths and lifetimes, and separators, nest nothing.
                ':' | '\'' | ',' | ';' | '#' => {}
                _ => self.term += 1,
            },
            TokenTree::Group(group) => {
                self.term += 1;
                self.groups.push(group.stream());
            }
            TokenTree::Ident(ident) => {
                let nests =
                    ["as", "else", "return", "break", "move", "if", "match"].iter().any(|word| ident == word);
                self.term += usize::from(nests);
            }
            TokenTree::Literal(_) => {}
        }
        self.deepest = self.deepest.max(self.term);
    }

    fn depth(&self) -> usize {
        self.outside + self.sums + self.deepest
    }

    /// The groups, each with the depth at which it lies.
    fn inner(self) -> impl Iterator<Item = (TokenStream, usize)> {
        let depth = self.depth();
        self.groups.into_iter().map(move |group| (group, depth))
    }
}

//! How deep expressions may be nested: every stage from the parser to rustc's own descends into them on the
//! stack, which nobody but the operating system guards.

use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};

/// Levels of nesting that fit on half of the stack of a compiler thread, 8 MiB, with an engine without
/// optimisation: a level of parentheses takes up to 13 kB in `syn` and in the stages after it. A sum of as
/// many terms is as deep.
pub const DEEPEST: usize = 300;

/// A place that is nested deeper than [`DEEPEST`], if there is one.
pub fn too_deep(tokens: TokenStream) -> Option<Span> {
    let mut stack = vec![(tokens, 0)];
    while let Some((stream, outside)) = stack.pop() {
        let mut run = Run::new(outside);
        let mut trees = stream.into_iter().peekable();
        while let Some(tree) = trees.next() {
            let ends = match &tree {
                TokenTree::Punct(punct) => matches!(punct.as_char(), ',' | ';' | '#'),
                // A function or a statement, unless it goes on.
                TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => match trees.peek() {
                    Some(TokenTree::Ident(next)) => next != "else",
                    Some(TokenTree::Punct(next)) => next.as_char() == '#',
                    Some(TokenTree::Group(_) | TokenTree::Literal(_)) | None => true,
                },
                TokenTree::Group(_) | TokenTree::Ident(_) | TokenTree::Literal(_) => false,
            };
            run.take(tree);
            if run.depth() > DEEPEST {
                return run.place;
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

/// Tokens without a separator: at most one expression.
struct Run {
    outside: usize,
    /// Additions and subtractions, each of which holds all before it.
    sums: usize,
    /// What else nests in the present term, and in the deepest one.
    term: usize,
    deepest: usize,
    groups: Vec<TokenStream>,
    place: Option<Span>,
}

impl Run {
    fn new(outside: usize) -> Run {
        Run { outside, sums: 0, term: 0, deepest: 0, groups: Vec::new(), place: None }
    }

    fn take(&mut self, tree: TokenTree) {
        self.place = Some(tree.span());
        match tree {
            TokenTree::Punct(punct) => match punct.as_char() {
                '+' | '-' => {
                    self.sums += 1;
                    self.term = 0;
                }
                // Paths, lifetimes and separators.
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

    /// The groups with the depth that they lie at.
    fn inner(self) -> impl Iterator<Item = (TokenStream, usize)> {
        let depth = self.depth();
        self.groups.into_iter().map(move |group| (group, depth))
    }
}

//! One token less or one more, somewhere in a description.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use crate::mutation::{Random, word};

/// Where a description is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// The arguments of the attribute.
    Arguments,
    /// Roles and signatures.
    Declaration,
    /// The body of a function or the value of a constant.
    Body,
}

/// A description with a token deleted or inserted.
pub struct Damaged {
    /// The arguments of the attribute.
    pub args: TokenStream,
    /// The block.
    pub item: TokenStream,
    /// Where the token stands.
    pub part: Part,
    /// The word that is gone, if a word was deleted.
    pub gone: Option<String>,
}

/// Deletes or inserts a token. The header of the block stays: if it does not parse, the compiler calls no
/// macro. Delimiters stay, too: without them there is no token tree.
pub fn damaged(args: TokenStream, item: TokenStream, random: &mut Random) -> Damaged {
    let mut trees: Vec<TokenTree> = item.into_iter().collect();
    let Some(TokenTree::Group(block)) = trees.pop() else { panic!("a block ends with its body") };
    let (leaves, outside) = (leaves(&block.stream()), leaves(&args));
    let place = random.below(leaves + outside);
    let mut change = Change { place, random, part: Part::Arguments, gone: None };
    let (mut args, mut inner) = (args, block.stream());
    if place < outside {
        args = change.within(args);
    } else {
        change.place -= outside;
        change.part = Part::Declaration;
        inner = change.within(inner);
    }
    let (part, gone) = (change.part, change.gone);
    trees.push(proc_macro2::Group::new(Delimiter::Brace, inner).into());
    Damaged { args, item: trees.into_iter().collect(), part, gone }
}

fn leaves(tokens: &TokenStream) -> usize {
    let inner = |tree: TokenTree| match tree {
        TokenTree::Group(group) => leaves(&group.stream()),
        _ => 1,
    };
    tokens.clone().into_iter().map(inner).sum()
}

struct Change<'r> {
    /// The number of leaves before the changed one.
    place: usize,
    random: &'r mut Random,
    part: Part,
    gone: Option<String>,
}

impl Change<'_> {
    fn within(&mut self, tokens: TokenStream) -> TokenStream {
        let mut out: Vec<TokenTree> = Vec::new();
        let mut is_done = false;
        for tree in tokens {
            match tree {
                other if is_done => out.push(other),
                TokenTree::Group(group) => {
                    let inside = leaves(&group.stream());
                    if self.place >= inside {
                        self.place -= inside;
                        out.push(group.into());
                        continue;
                    }
                    if self.part == Part::Declaration && group.delimiter() == Delimiter::Brace {
                        self.part = Part::Body;
                    }
                    let changed = self.within(group.stream());
                    out.push(proc_macro2::Group::new(group.delimiter(), changed).into());
                    is_done = true;
                }
                leaf if self.place == 0 => {
                    if self.random.below(2) == 0 {
                        out.extend(word(self.random));
                        out.push(leaf);
                    } else if let TokenTree::Ident(word) = leaf {
                        self.gone = Some(word.to_string());
                    }
                    is_done = true;
                }
                leaf => {
                    self.place -= 1;
                    out.push(leaf);
                }
            }
        }
        out.into_iter().collect()
    }
}

//! Reads the attributes `free_energy` and `viscosity` into syntax trees.
//!
//! Nothing here fails: what cannot be read is reported and left out, so that all attributes are
//! seen and an implementation of the trait can be written whatever happens.

mod control_flow;
mod depth;

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt as _;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative as _;
use syn::punctuated::Punctuated;
use syn::{Attribute, DeriveInput, Expr, ExprClosure, Meta, Path, Token, parse_quote};

use crate::ast;
use crate::ctxt::{Ctxt, precedes};
use crate::dialect::Dialect;
use crate::message::attribute as message;
use crate::message::{Message, expression, text};

/// The attributes of one item.
pub(crate) struct Attributes {
    /// The path of the crate `eem`; `::eem` unless the item says otherwise.
    pub(crate) krate: Path,
    /// The closure of `#[free_energy(…)]`, if there is exactly one that can be read.
    pub(crate) closure: Option<ExprClosure>,
    /// The laws of all `#[viscosity(…)]`.
    pub(crate) laws: Vec<(Ident, Expr)>,
    /// Whether every `#[viscosity(…)]` could be read.
    pub(crate) laws_complete: bool,
}

/// One entry of `#[free_energy(…)]`.
enum Entry {
    Crate(Token![crate], Path),
    /// `crate = …` with something else than a path.
    WrongCrate(Span),
    /// `name = …` with another name.
    Option(Ident),
    Closure(ExprClosure),
    Other(Expr),
}

impl Attributes {
    /// Reads all attributes of `input`.
    pub(crate) fn from_syn(cx: &Ctxt, input: &DeriveInput) -> Self {
        let mut energy = FreeEnergy::default();
        let (mut laws, mut laws_complete) = (Vec::new(), true);
        for attribute in &input.attrs {
            if attribute.path().is_ident("free_energy") {
                energy.read(cx, attribute);
            } else if attribute.path().is_ident("viscosity") {
                match read_laws(cx, attribute) {
                    Some(read) => laws.extend(read),
                    None => laws_complete = false,
                }
            }
        }
        if energy.closure.is_none() && !energy.failed {
            cx.error(&input.ident, &message::missing_free_energy(&input.ident));
        }
        Self {
            krate: energy.krate.unwrap_or_else(|| parse_quote!(::eem)),
            closure: energy.closure,
            laws,
            laws_complete,
        }
    }
}

/// The content of the attributes `free_energy` that have been read so far.
#[derive(Default)]
struct FreeEnergy {
    krate: Option<Path>,
    closure: Option<ExprClosure>,
    /// Whether an error has been reported that explains a missing closure.
    failed: bool,
}

impl FreeEnergy {
    fn read(&mut self, cx: &Ctxt, attribute: &Attribute) {
        if is_too_deep(cx, attribute) {
            self.failed = true;
            return;
        }
        let entries = match entries(attribute) {
            Ok(entries) => entries,
            Err(error) => {
                self.failed = true;
                let message = if has_closure(attribute) {
                    message::unreadable_formula(&error)
                } else {
                    message::unreadable_free_energy(&error)
                };
                return report_unreadable(cx, attribute, &error, &message);
            }
        };
        if entries.is_empty() {
            self.failed = true;
            cx.error(attribute.path(), &message::empty_free_energy());
        }
        for entry in entries {
            self.set(cx, attribute, entry);
        }
    }

    fn set(&mut self, cx: &Ctxt, attribute: &Attribute, entry: Entry) {
        match entry {
            Entry::Crate(token, _) if cx.dialect() == Dialect::Text => {
                self.failed = true;
                cx.error(token, &message::unknown_option("crate"));
            }
            Entry::WrongCrate(span) if cx.dialect() == Dialect::Text => {
                self.failed = true;
                cx.error_at(span, &message::unknown_option("crate"));
            }
            Entry::Crate(token, _) if self.krate.is_some() => {
                cx.error(token, &message::second_crate());
            }
            Entry::Crate(_, path) => self.krate = Some(path),
            Entry::WrongCrate(span) => {
                self.failed = true;
                cx.error_at(span, &message::crate_is_not_a_path());
            }
            Entry::Closure(_) if self.closure.is_some() => {
                cx.error(attribute.path(), &message::second_free_energy());
            }
            Entry::Closure(closure) => self.closure = Some(closure),
            Entry::Option(name) => {
                self.failed = true;
                cx.error(&name, &message::unknown_option(&name));
            }
            Entry::Other(expr) if self.closure.is_some() => {
                cx.error(expr, &message::after_the_closure());
            }
            Entry::Other(expr) => {
                self.failed = true;
                cx.error(expr, &message::free_energy_is_not_a_closure());
            }
        }
    }
}

/// Reports an attribute that the parser has refused: an `if` or `match` in it by its name, and the
/// error of the parser, unless that may be a consequence of the keyword.
fn report_unreadable(cx: &Ctxt, attribute: &Attribute, error: &syn::Error, message: &Message) {
    let keyword = control_flow::first(tokens(attribute));
    if let Some(keyword) = &keyword {
        let name = keyword.to_string();
        cx.error(keyword, &expression::syntax::not_allowed(&name));
    }
    if keyword.is_none_or(|keyword| precedes(error.span(), keyword.span())) {
        cx.error_at(error.span(), message);
    }
}

fn is_too_deep(cx: &Ctxt, attribute: &Attribute) -> bool {
    let limit = cx.dialect().choose(depth::LIMIT, depth::LIMIT_OF_TEXT);
    let place = depth::too_deep(tokens(attribute), limit);
    if let Some((span, excess)) = place {
        let message = match excess {
            depth::Excess::Terms(terms) => message::too_many_terms(terms, limit),
            depth::Excess::Nesting => message::too_deep(),
        };
        cx.error_at(span, &message);
    }
    place.is_some()
}

/// Whether there is a `|` in the attribute, so that it is meant to be a closure.
fn has_closure(attribute: &Attribute) -> bool {
    tokens(attribute)
        .into_iter()
        .any(|token| is_punct(&token, '|'))
}

/// Whether the attribute begins with `name =`, so that it is meant to be a law.
fn has_law(attribute: &Attribute) -> bool {
    let mut tokens = tokens(attribute).into_iter();
    let name = tokens.next();
    matches!(name, Some(TokenTree::Ident(_))) && tokens.next().is_some_and(|t| is_punct(&t, '='))
}

fn tokens(attribute: &Attribute) -> TokenStream {
    match &attribute.meta {
        Meta::List(list) => list.tokens.clone(),
        Meta::Path(_) | Meta::NameValue(_) => TokenStream::new(),
    }
}

fn is_punct(token: &TokenTree, character: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == character)
}

fn entries(attribute: &Attribute) -> syn::Result<Punctuated<Entry, Token![,]>> {
    if let Meta::Path(_) = attribute.meta {
        return Ok(Punctuated::new());
    }
    attribute.parse_args_with(|input: ParseStream<'_>| {
        Punctuated::parse_terminated_with(input, parse_entry)
    })
}

fn parse_entry(input: ParseStream<'_>) -> syn::Result<Entry> {
    if input.peek(Token![crate]) && input.peek2(Token![=]) {
        let token = input.parse()?;
        input.parse::<Token![=]>()?;
        let ahead = input.fork();
        let path = Path::parse_mod_style(&ahead);
        return match path {
            Ok(path) if ahead.is_empty() || ahead.peek(Token![,]) => {
                input.advance_to(&ahead);
                Ok(Entry::Crate(token, path))
            }
            _ => Ok(Entry::WrongCrate(skip_entry(input)?)),
        };
    }
    if input.peek(Ident::peek_any) && input.peek2(Token![=]) && !input.peek2(Token![==]) {
        let name = Ident::parse_any(input)?;
        input.parse::<Token![=]>()?;
        input.parse::<Expr>()?;
        return Ok(Entry::Option(name));
    }
    Ok(match input.parse()? {
        Expr::Closure(closure) => Entry::Closure(closure),
        expr => Entry::Other(expr),
    })
}

/// Skips to the comma that ends an entry; a closure without a comma before it belongs to the entry.
fn skip_entry(input: ParseStream<'_>) -> syn::Result<Span> {
    let span = input.span();
    let mut closure = false;
    while !input.is_empty() && (closure || !input.peek(Token![,])) {
        closure |= is_punct(&input.parse()?, '|');
    }
    Ok(span)
}

/// The laws of one attribute; `None` if they cannot be read.
fn read_laws(cx: &Ctxt, attribute: &Attribute) -> Option<Vec<(Ident, Expr)>> {
    if is_too_deep(cx, attribute) {
        return None;
    }
    match laws(attribute) {
        Ok(laws) if laws.is_empty() => {
            cx.error(attribute.path(), &message::empty_viscosity());
            None
        }
        Ok(laws) => {
            if let (Dialect::Text, Some((second, _))) = (cx.dialect(), laws.iter().nth(1)) {
                cx.error(second, &text::second_law(&ast::name(second)));
            }
            Some(laws.into_iter().collect())
        }
        Err(error) => {
            let message = if has_law(attribute) {
                message::unreadable_formula(&error)
            } else {
                message::unreadable_viscosity(&error)
            };
            report_unreadable(cx, attribute, &error, &message);
            None
        }
    }
}

fn laws(attribute: &Attribute) -> syn::Result<Punctuated<(Ident, Expr), Token![,]>> {
    if let Meta::Path(_) = attribute.meta {
        return Ok(Punctuated::new());
    }
    attribute.parse_args_with(|input: ParseStream<'_>| {
        Punctuated::parse_terminated_with(input, parse_law)
    })
}

fn parse_law(input: ParseStream<'_>) -> syn::Result<(Ident, Expr)> {
    let dashpot = input.parse()?;
    input.parse::<Token![=]>()?;
    Ok((dashpot, input.parse()?))
}

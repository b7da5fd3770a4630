//! Reads the parts of a source into the item that the derive would see, and finds the places of its tokens again.

use std::collections::{BTreeMap, BTreeSet};
use std::mem;

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::quote;
use syn::token::Paren;
use syn::{AttrStyle, Attribute, DeriveInput, LitInt, LitStr, MacroDelimiter};
use syn::{Meta, MetaList, parse_quote};

use super::fault::{Drawing, Fault, Faults, Level};
use super::part::{Part, short};
use super::source::{LONGEST, Source};
use crate::ast;
use crate::dialect::Dialect;
use crate::message::{Message, text as message};

/// Reads texts, remembers where their tokens are and collects faults.
pub(super) struct Reader<'s> {
    dialect: Dialect,
    parts: Vec<(Part, Vec<&'s str>)>,
    /// The part to which the tokens of each file of `proc-macro2` belong.
    files: BTreeMap<String, usize>,
    /// Faults with the index of their part.
    faults: Vec<(usize, Fault)>,
}

/// Bytes that a name or a unit may have; the parentheses of a unit may be nested.
const LONGEST_NAME: usize = 256;

/// A place in a part; lines and columns count from 0.
struct Place {
    line: usize,
    column: usize,
    width: usize,
}

/// A name and the length of its array.
type Name = (Ident, Option<LitInt>);

impl<'s> Reader<'s> {
    pub(super) fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            parts: Vec::new(),
            files: BTreeMap::new(),
            faults: Vec::new(),
        }
    }

    /// The item that the derive would see. `None` if a text is not made of tokens or a name is invalid; all such
    /// texts are reported.
    pub(super) fn read(&mut self, source: &'s Source) -> Option<DeriveInput> {
        let mut attributes = Vec::new();
        if let Some(psi) = self.part(Part::FreeEnergy, &source.free_energy, &source.free_energy) {
            let end = psi.delim_span();
            attributes.push(attribute(
                "free_energy",
                &psi,
                Paren { span: end },
                psi.stream(),
            ));
        }
        for (dashpot, law) in source.viscosities() {
            let name = self.name(Part::Dashpot(dashpot.to_owned()), dashpot);
            let law = self.part(Part::Viscosity(dashpot.to_owned()), law, law);
            if let (Some((name, None)), Some(law)) = (name, law) {
                let tokens = law.stream();
                let mut end = Group::new(Delimiter::Parenthesis, TokenStream::new());
                end.set_span(law.span_close());
                let end = end.delim_span();
                let tokens = quote! { #name = #tokens };
                attributes.push(attribute("viscosity", &law, Paren { span: end }, tokens));
            }
        }
        let (mut fields, mut names) = (Vec::new(), BTreeSet::new());
        for (name, unit) in source.parameters() {
            let read = self.name(Part::Parameter(name.to_owned()), name);
            let part = self.parts.len() - 1;
            let unit = unit.and_then(|unit| self.unit(Part::Unit(name.to_owned()), unit));
            let Some((ident, length)) = read else {
                continue;
            };
            if !names.insert(ast::name(&ident)) {
                self.report_part(part, &message::second_parameter(&ast::name(&ident)));
            }
            let unit = unit.map(|unit| quote! { #[unit(#unit)] });
            let ty = length.map_or_else(|| quote!(f64), |length| quote!([f64; #length]));
            fields.push(quote! { #unit #ident: #ty });
        }
        if !self.faults.is_empty() {
            return None;
        }
        let mut input: DeriveInput = parse_quote! { struct Text { #(#fields,)* } };
        // Set directly: a parser would recurse as deep as the formulas are nested.
        input.attrs = attributes;
        Some(input)
    }

    /// The tokens of a part in parentheses, whose spans later stand for the whole part and for its end.
    fn part(&mut self, part: Part, text: &'s str, tokens: &str) -> Option<Group> {
        self.parts.push((part, text.split('\n').collect()));
        let index = self.parts.len() - 1;
        let most = match self.parts[index].0 {
            Part::FreeEnergy | Part::Viscosity(_) => LONGEST,
            Part::Dashpot(_) | Part::Parameter(_) | Part::Unit(_) => LONGEST_NAME,
        };
        if text.len() > most {
            self.report_part(index, &message::too_long(text.len(), most));
            return None;
        }
        // The parentheses have lines of their own, because a comment extends to the end of its line.
        let whole = format!("(\n{tokens}\n)").parse::<TokenStream>();
        let mut whole = whole.into_iter().flatten();
        let (Some(TokenTree::Group(group)), None) = (whole.next(), whole.next()) else {
            self.report_unreadable(index, text);
            return None;
        };
        self.files.insert(group.span_open().file(), index);
        Some(group)
    }

    /// Reports why a text is not made of tokens.
    fn report_unreadable(&mut self, part: usize, text: &str) {
        let error = text.parse::<TokenStream>().err();
        let start = error.map(|error| error.span().start());
        let (line, column) = start.map_or((0, 0), |at| (at.line.saturating_sub(1), at.column));
        let guilty = text.split('\n').nth(line).unwrap_or_default();
        let guilty = guilty.chars().nth(column).unwrap_or(' ');
        let message = if "()[]{}".contains(guilty) {
            message::single_bracket(guilty)
        } else {
            message::unexpected_character(guilty)
        };
        let place = Place {
            line,
            column,
            width: 1,
        };
        self.push(Level::Error, part, &place, &message, Vec::new());
    }

    /// The name of a parameter or of a dashpot; only a parameter may be an array.
    fn name(&mut self, part: Part, text: &'s str) -> Option<Name> {
        let may_be_array = matches!(part, Part::Parameter(_));
        let group = self.part(part, text, text)?;
        let name = as_name(group.stream()).filter(|(_, array)| may_be_array || array.is_none());
        if name.is_none() {
            let index = self.parts.len() - 1;
            self.report_part(index, &message::not_a_name(&short(text)));
        }
        name
    }

    /// A unit, whose text need not be made of tokens: `°`. Its place is that of the whole text.
    fn unit(&mut self, part: Part, text: &'s str) -> Option<LitStr> {
        let group = self.part(part, text, "")?;
        Some(LitStr::new(text, group.span_open()))
    }

    /// Reports something at its tokens.
    pub(super) fn report(
        &mut self,
        level: Level,
        span: Span,
        message: &Message,
        calls: Vec<String>,
    ) {
        let part = self.files.get(&span.file()).copied().unwrap_or_default();
        let place = self.place(part, span);
        self.push(level, part, &place, message, calls);
    }

    /// Reports something about the whole of a part.
    fn report_part(&mut self, part: usize, message: &Message) {
        let place = self.whole(part);
        self.push(Level::Error, part, &place, message, Vec::new());
    }

    fn push(
        &mut self,
        level: Level,
        part: usize,
        at: &Place,
        message: &Message,
        calls: Vec<String>,
    ) {
        let line = self.parts[part].1.get(at.line).copied().unwrap_or_default();
        let fault = Fault {
            level,
            part: self.parts[part].0.clone(),
            line: at.line + 1,
            column: at.column + 1,
            width: at.width,
            text: message.text(self.dialect).to_owned(),
            help: message.help(self.dialect).to_owned(),
            calls,
            drawing: Drawing::new(line, at.column, at.width),
        };
        self.faults.push((part, fault));
    }

    fn whole(&self, part: usize) -> Place {
        let first = self.parts[part].1.first();
        Place {
            line: 0,
            column: 0,
            width: first.map_or(0, |line| line.chars().count()).max(1),
        }
    }

    /// The place of tokens. The parenthesis before a text stands for the whole of it, the one behind it for its end.
    fn place(&self, part: usize, span: Span) -> Place {
        let lines = &self.parts[part].1;
        let (start, end) = (span.start(), span.end());
        let Some(line) = start.line.checked_sub(2) else {
            return self.whole(part);
        };
        let Some(text) = lines.get(line) else {
            let written = |line: &&str| !line.trim_end().is_empty();
            let last = lines.iter().rposition(written).unwrap_or_default();
            let text = lines.get(last).map_or("", |line| line.trim_end());
            return Place {
                line: last,
                column: text.chars().count(),
                width: 1,
            };
        };
        let until = if end.line == start.line {
            end.column
        } else {
            text.trim_end().chars().count()
        };
        Place {
            line,
            column: start.column,
            width: until.saturating_sub(start.column).max(1),
        }
    }

    /// What has been reported, in the order of the source.
    pub(super) fn take_faults(&mut self) -> Faults {
        let mut faults = mem::take(&mut self.faults);
        // Stable: faults at one place stay in the order of the phases.
        faults.sort_by_key(|(part, fault)| (*part, fault.line, fault.column));
        Faults(faults.into_iter().map(|(_, fault)| fault).collect())
    }
}

/// `#[name(tokens)]`, at the place of a whole part.
fn attribute(name: &str, part: &Group, paren: Paren, tokens: TokenStream) -> Attribute {
    Attribute {
        pound_token: syn::token::Pound::default(),
        style: AttrStyle::Outer,
        bracket_token: syn::token::Bracket::default(),
        meta: Meta::List(MetaList {
            path: Ident::new(name, part.span_open()).into(),
            delimiter: MacroDelimiter::Paren(paren),
            tokens,
        }),
    }
}

/// `k` or `k[3]`
fn as_name(tokens: TokenStream) -> Option<Name> {
    let mut tokens = tokens.into_iter();
    let TokenTree::Ident(ident) = tokens.next()? else {
        return None;
    };
    // A keyword is an identifier of `proc-macro2`, too; `syn` refuses it.
    let ident = syn::parse2(TokenTree::from(ident).into()).ok()?;
    let length = match tokens.next() {
        None => None,
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Bracket => {
            let mut inside = group.stream().into_iter();
            let literal = inside.next().filter(|_| inside.next().is_none())?;
            let TokenTree::Literal(literal) = literal else {
                return None;
            };
            let length: LitInt = syn::parse2(TokenTree::from(literal).into()).ok()?;
            let plain = length.suffix().is_empty() && length.base10_parse::<usize>().is_ok();
            Some(length).filter(|_| plain).map(Some)?
        }
        Some(_) => return None,
    };
    tokens.next().is_none().then_some((ident, length))
}

/// Frees what `proc-macro2` keeps of every text for the life of a thread.
pub(crate) fn forget_places() {
    proc_macro2::extra::invalidate_current_thread_spans();
}

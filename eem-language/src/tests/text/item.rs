//! A struct with its attributes as a source of texts, with the places that the texts come from.

use std::ops::Range;

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::ToTokens as _;
use syn::spanned::Spanned as _;
use syn::{Data, DeriveInput, Field, Fields, Item, Meta, MetaList, Type};

use crate::text::{Part, Source};

/// An item of a file as texts.
pub(super) struct AsText {
    pub(super) source: Source,
    origins: Vec<Origin>,
}

/// Where the text of a part stands in the file, in bytes.
struct Origin {
    part: Part,
    range: Range<usize>,
}

/// What cannot be said in texts.
pub(super) type RustOnly = &'static str;

/// The items of a file that derive.
pub(super) fn items(text: &str) -> Vec<DeriveInput> {
    let file = syn::parse_file(text).expect("the file is Rust");
    let items = file.items.into_iter();
    let derives = |item: &DeriveInput| {
        let mut attributes = item.attrs.iter().filter(|a| a.path().is_ident("derive"));
        attributes.any(|a| a.to_token_stream().to_string().contains("FreeEnergy"))
    };
    let inputs = items.filter_map(|item| match item {
        Item::Struct(item) => Some(DeriveInput::from(item)),
        Item::Enum(item) => Some(item.into()),
        Item::Union(item) => Some(item.into()),
        _ => None,
    });
    inputs.filter(derives).collect()
}

impl AsText {
    /// What an item of this file says.
    pub(super) fn new(file: &str, item: &DeriveInput) -> Result<Self, RustOnly> {
        let mut energy = None;
        let (mut laws, mut parameters) = (Vec::new(), Vec::new());
        for attribute in &item.attrs {
            let path = attribute.path();
            if path.is_ident("free_energy") {
                let range = inside(&attribute.meta)?;
                let text = &file[range.clone()];
                if text.trim_start().starts_with("crate") || energy.is_some() {
                    return Err("the path of the crate, or a second attribute");
                }
                energy = Some(range);
            } else if path.is_ident("viscosity") {
                let end = inside(&attribute.meta)?.end;
                laws.extend(split(list(&attribute.meta)?.tokens.clone(), end)?);
            } else if path.is_ident("unit") {
                return Err("units of constants");
            }
        }
        let fields = match &item.data {
            Data::Struct(data) => match &data.fields {
                Fields::Unnamed(_) => return Err("a tuple struct"),
                fields => fields.iter(),
            },
            _ => return Err("no struct"),
        };
        for field in fields {
            parameters.extend(parameter(file, item, field)?);
        }
        let energy = energy.ok_or("no free energy")?;
        let mut this = Self {
            source: Source::new(&file[energy.clone()]),
            origins: vec![Origin {
                part: Part::FreeEnergy,
                range: energy,
            }],
        };
        for [name, law] in laws {
            let [dashpot, text] =
                [&name, &law].map(|range: &Range<usize>| file[range.clone()].to_owned());
            this.origin(Part::Dashpot(dashpot.clone()), name);
            this.origin(Part::Viscosity(dashpot.clone()), law);
            this.source = this.source.viscosity(dashpot, text);
        }
        for (name, declared, unit) in parameters {
            this.origin(Part::Parameter(declared.clone()), name);
            let text = unit
                .as_ref()
                .map(|unit| &file[unit.start + 1..unit.end - 1]);
            this.source = this.source.parameter(declared.clone(), text);
            if let Some(unit) = unit {
                this.origin(Part::Unit(declared), unit);
            }
        }
        Ok(this)
    }

    fn origin(&mut self, part: Part, range: Range<usize>) {
        self.origins.push(Origin { part, range });
    }

    /// The part, line and column of a byte of the file.
    pub(super) fn place(&self, file: &str, byte: usize) -> Option<(Part, usize, usize)> {
        let within = |origin: &&Origin| (origin.range.start..=origin.range.end).contains(&byte);
        let Origin { part, range } = self.origins.iter().find(within)?;
        if let Part::Unit(_) = part {
            return Some((part.clone(), 1, 1));
        }
        let before = &file[range.start..byte];
        // The end of a text is behind what is written.
        let before = if byte == range.end {
            before.trim_end()
        } else {
            before
        };
        let last = before.rsplit('\n').next().unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        Some((part.clone(), line, last.chars().count() + 1))
    }
}

fn list(meta: &Meta) -> Result<&MetaList, RustOnly> {
    match meta {
        Meta::List(list) if !list.tokens.is_empty() => Ok(list),
        _ => Err("an attribute without parentheses, or without anything in them"),
    }
}

/// What is between the parentheses of an attribute.
fn inside(meta: &Meta) -> Result<Range<usize>, RustOnly> {
    let span = list(meta)?.delimiter.span();
    Ok(span.open().byte_range().end..span.close().byte_range().start)
}

/// Names and laws in `a = …, b = …`, up to `end`.
fn split(tokens: TokenStream, end: usize) -> Result<Vec<[Range<usize>; 2]>, RustOnly> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let is = |index: usize, c: char| matches!(tokens.get(index), Some(TokenTree::Punct(p)) if p.as_char() == c);
    let is_name = |index: usize| matches!(tokens.get(index), Some(TokenTree::Ident(_)));
    let starts = |index: usize| is_name(index) && is(index + 1, '=') && !is(index + 2, '=');
    if !starts(0) {
        return Err("an attribute that is no list of laws");
    }
    let byte = |index: usize| tokens[index].span().byte_range();
    let first = (0..tokens.len()).filter(|&i| starts(i) && (i == 0 || is(i - 1, ',')));
    let first: Vec<usize> = first.collect();
    let ends = first.iter().skip(1).map(|&next| byte(next - 1).start);
    let ends = ends.chain([end]);
    let laws = first.iter().zip(ends);
    Ok(laws
        .map(|(&i, end)| [byte(i), byte(i + 1).end..end])
        .collect())
}

/// Where its name stands, its name with the length of an array, and where its unit stands.
type Declared = (Range<usize>, String, Option<Range<usize>>);

/// Nothing for a field that is no number or is marked.
fn parameter(file: &str, item: &DeriveInput, field: &Field) -> Result<Option<Declared>, RustOnly> {
    let mut unit = None;
    for attribute in &field.attrs {
        let path = attribute.path();
        if path.is_ident("unit") {
            let text = attribute.parse_args::<syn::LitStr>();
            let text = text.map_err(|_| "a unit that is no string")?;
            if unit.replace(text.span().byte_range()).is_some() {
                return Err("a second unit");
            }
        } else if path.is_ident("free_energy") {
            let mark = attribute.parse_args::<syn::Ident>();
            if mark.is_ok_and(|mark| mark == "unused") {
                return Ok(None);
            }
            return Err("an attribute of a field");
        } else if path.is_ident("viscosity") {
            return Err("an attribute of a field");
        }
    }
    let range = |span: Span| span.byte_range();
    let Some(ident) = &field.ident else {
        return Ok(None);
    };
    let name = file[range(ident.span())].to_owned();
    let declared = match &field.ty {
        ty if is_number(item, ty) => name,
        Type::Array(array) if is_number(item, &array.elem) => {
            let length = &file[range(array.len.span())];
            if !length.chars().all(|c| c.is_ascii_digit()) {
                return Err("an array whose length is a constant");
            }
            format!("{name}[{length}]")
        }
        _ => return Ok(None),
    };
    Ok(Some((range(ident.span()), declared, unit)))
}

fn is_number(item: &DeriveInput, ty: &Type) -> bool {
    let name = ty.to_token_stream().to_string();
    let mut scalars = item.generics.type_params().map(|p| p.ident.to_string());
    matches!(&*name, "f64" | "f32") || scalars.any(|scalar| scalar == name)
}

//! The units of constants: `#[unit(R = "J/(mol K)", crate::gas::KB = "J/K")]` on the struct.

use syn::parse::ParseStream;
use syn::punctuated::Punctuated;
use syn::{Attribute, Data, Lit, LitStr, Path, Token};

use super::declaration::{ATTRIBUTE, Declaration, unit_of};
use crate::ast;
use crate::check::constants::{bare, of_std, text};
use crate::checked::Checked;
use crate::ctxt::Ctxt;
use crate::message::unit as message;
use crate::nearest::nearest;

/// The unit of a constant.
#[derive(Debug)]
pub(super) struct Annotation {
    /// The index of the constant: see [`Origin::Constant`](crate::checked::Origin::Constant).
    pub(super) constant: usize,
    pub(super) declaration: Declaration,
}

/// The units that are given to constants of the formulas. Reports all others.
pub(super) fn read(cx: &Ctxt, checked: &Checked<'_>) -> Vec<Annotation> {
    let attributes = checked.original.attrs.iter();
    let mut annotations: Vec<Annotation> = Vec::new();
    for attribute in attributes.filter(|a| a.path().is_ident(ATTRIBUTE)) {
        for (path, unit) in entries(cx, attribute) {
            let declaration = unit_of(cx, &unit);
            let Some(constant) = constant(checked, &path) else {
                report(cx, checked, &path);
                continue;
            };
            if annotations.iter().any(|a| a.constant == constant) {
                cx.error(&path, &message::second_of_constant(&text(&path)));
                continue;
            }
            annotations.push(Annotation {
                constant,
                declaration,
            });
        }
    }
    annotations
}

/// The entries of one attribute; empty if it cannot be read.
fn entries(cx: &Ctxt, attribute: &Attribute) -> Vec<(Path, LitStr)> {
    if let Ok(Lit::Str(_)) = attribute.parse_args() {
        cx.error(attribute.path(), &message::not_on_a_field());
        return Vec::new();
    }
    let entry = |input: ParseStream<'_>| {
        let path = input.call(Path::parse_mod_style)?;
        input.parse::<Token![=]>()?;
        Ok((path, input.parse()?))
    };
    let parser = |input: ParseStream<'_>| Punctuated::parse_terminated_with(input, entry);
    let entries: syn::Result<Punctuated<_, Token![,]>> = attribute.parse_args_with(parser);
    match entries {
        Ok(entries) if !entries.is_empty() => entries.into_iter().collect(),
        _ => {
            cx.error(&attribute.meta, &message::unreadable_constants());
            Vec::new()
        }
    }
}

/// The constant of the formulas that a path means.
fn constant(checked: &Checked<'_>, path: &Path) -> Option<usize> {
    let wanted = text(path);
    checked
        .constants()
        .position(|tokens| text(tokens) == wanted)
}

/// Reports a name that is not a constant of the formulas. Unknown names are not reported if a formula has
/// an error: the constant may be in it.
fn report(cx: &Ctxt, checked: &Checked<'_>, path: &Path) {
    let name = text(path);
    if of_std(path).or(path.get_ident().and_then(bare)).is_some() {
        return cx.error(path, &message::of_pure_number(&name));
    }
    if is_field(checked, &name) {
        return cx.error(path, &message::of_field(&name));
    }
    if !checked.sound {
        return;
    }
    let constants: Vec<String> = checked.constants().map(text).collect();
    let names = || constants.iter().map(String::as_str);
    let message = message::of_no_constant(&name, nearest(&name, names()), names());
    cx.error(path, &message);
}

fn is_field(checked: &Checked<'_>, name: &str) -> bool {
    let Data::Struct(data) = &checked.original.data else {
        return false;
    };
    let mut idents = data.fields.iter().filter_map(|field| field.ident.as_ref());
    idents.any(|ident| ast::name(ident) == name)
}

//! The fields that are parameters, and the scalar type of the model, which follows from their types.
//!
//! A field is a number or an array of numbers, every entry of which is a parameter of its own.
//! Only fields that an expression mentions count: a struct may carry anything else. But a number
//! that no expression mentions is reported, unless it is marked as unused.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use syn::Type;

use super::constants::Constants;
use crate::ast::{self, Field, Input};
use crate::checked::{Origin, Parameter, ParameterKind, Scalar, Source};
use crate::ctxt::Ctxt;
use crate::message::field as message;

/// The fields and constants that expressions have mentioned so far.
#[derive(Debug)]
pub(super) struct Used {
    /// For every field, the entries that are mentioned; a number has the only entry 0.
    fields: Vec<BTreeSet<usize>>,
    pub(super) constants: Constants,
    /// Whether no error has been reported that may have hidden the use of a field.
    complete: bool,
}

impl Used {
    /// No field has been mentioned.
    pub(super) fn none(input: &Input<'_>) -> Self {
        Self {
            fields: vec![BTreeSet::new(); input.fields.iter().flatten().count()],
            constants: Constants::default(),
            complete: input.laws_complete,
        }
    }

    /// Whether no error has been reported that may have hidden the use of a field.
    pub(super) fn is_complete(&self) -> bool {
        self.complete
    }

    /// Records that an expression with an error might have mentioned any field.
    pub(super) fn give_up(&mut self) {
        self.complete = false;
    }

    /// Records that an expression mentions field `index`, which is not an array.
    pub(super) fn mark(&mut self, index: usize) {
        self.mark_entry(index, 0);
    }

    /// Records that an expression mentions an entry of field `index`.
    pub(super) fn mark_entry(&mut self, index: usize, entry: usize) {
        self.fields[index].insert(entry);
    }

    fn fields<'i, 'a>(
        &'i self,
        input: &'i Input<'a>,
    ) -> impl Iterator<Item = (usize, &'i Field<'a>)> {
        let fields = input.fields.iter().flatten().enumerate();
        fields.filter(|&(index, _)| !self.fields[index].is_empty())
    }
}

/// The kind of a field by its type.
enum Kind<'a> {
    Double,
    Single,
    TypeParameter(&'a Ident),
    Other,
}

/// The fields that are used, in order of declaration, and the constants; reports fields whose type cannot
/// be a parameter.
pub(super) fn parameters<'a>(cx: &Ctxt, input: &Input<'a>, used: &Used) -> Vec<Parameter<'a>> {
    let mut parameters = Vec::new();
    for (index, field) in used.fields(input) {
        let (ident, name) = (field.ident, ast::name(field.ident));
        let array = array(field.ty);
        let ty = array.map_or(field.ty, |(ty, _)| ty);
        let kind = match kind(input, ty) {
            Kind::Double => ParameterKind::Double,
            Kind::Single => ParameterKind::Single,
            Kind::TypeParameter(_) => ParameterKind::Scalar,
            Kind::Other => {
                cx.error(field.ty, &message::not_a_parameter(field.ident));
                continue;
            }
        };
        match array {
            None => parameters.push(Parameter {
                origin: Origin::Field(index),
                name,
                source: Source::Field(ident, kind),
            }),
            Some((_, None)) => cx.error(field.ty, &message::array_without_length(ident)),
            Some((_, Some(_))) => {
                let entries = used.fields[index].iter();
                parameters.extend(entries.map(|&entry| Parameter {
                    origin: Origin::Entry(index, entry),
                    name: format!("{name}[{entry}]"),
                    source: Source::Entry(ident, entry, kind),
                }));
            }
        }
    }
    parameters.extend(constants(input, used));
    parameters
}

/// The constants by the last names of their paths; by their paths if something else has that name.
fn constants<'a>(input: &Input<'a>, used: &Used) -> Vec<Parameter<'a>> {
    let last = |path: &str| path.rsplit("::").next().unwrap_or_default().to_owned();
    let paths = used.constants.paths();
    let fields = input.fields.iter().flatten().map(|field| field.ident);
    let arguments = input.arguments.iter().map(|argument| argument.ident);
    let taken: Vec<String> = fields.chain(arguments).map(ast::name).collect();
    let parameter = |(index, (path, tokens)): (usize, &(String, TokenStream))| {
        let short = last(path);
        let same = paths
            .iter()
            .filter(|(other, _)| last(other) == short)
            .count();
        let is_free = same == 1 && !taken.contains(&short);
        Parameter {
            origin: Origin::Constant(index),
            name: if is_free { short } else { path.clone() },
            source: Source::Constant(tokens.clone()),
        }
    };
    paths.iter().enumerate().map(parameter).collect()
}

/// The scalar of the model: the one type parameter among the types of its parameters, if any.
pub(super) fn scalar<'a>(cx: &Ctxt, input: &Input<'a>, used: &Used) -> Scalar<'a> {
    let mut scalar = Scalar::Any;
    for (_, field) in used.fields(input) {
        let ty = array(field.ty).map_or(field.ty, |(ty, _)| ty);
        let Kind::TypeParameter(parameter) = kind(input, ty) else {
            continue;
        };
        match scalar {
            Scalar::Parameter(first) if first != parameter => {
                cx.error(field.ty, &message::second_scalar(parameter, first));
            }
            _ => scalar = Scalar::Parameter(parameter),
        }
    }
    scalar
}

/// Reports a number that no expression mentions and that is not marked as unused. Of an array of numbers,
/// every entry has to be mentioned.
///
/// Fields of other types are not numbers; neither are those of a type parameter that is not the scalar.
pub(super) fn check_used(cx: &Ctxt, input: &Input<'_>, used: &Used, scalar: Scalar<'_>) {
    if !used.complete {
        return;
    }
    for (index, field) in input.fields.iter().flatten().enumerate() {
        let array = array(field.ty);
        let number = match kind(input, array.map_or(field.ty, |(ty, _)| ty)) {
            Kind::Double | Kind::Single => true,
            Kind::TypeParameter(parameter) => scalar == Scalar::Parameter(parameter),
            Kind::Other => false,
        };
        let marked = field.unused || field.wrong || ast::is_underscored(field.ident);
        if !number || marked || is_hidden(input, field) {
            continue;
        }
        let used = &used.fields[index];
        let name = ast::name(field.ident);
        let missing = match array {
            Some((_, Some(length))) if !used.is_empty() => {
                let unused = (0..length).find(|entry| !used.contains(entry));
                unused.map(|entry| format!("{name}[{entry}]"))
            }
            _ => used.is_empty().then_some(name),
        };
        if let Some(name) = missing {
            cx.error(field.ident, &message::unused(&name));
        }
    }
}

/// Whether an argument has the same name, which has been reported.
fn is_hidden(input: &Input<'_>, field: &Field<'_>) -> bool {
    let mut arguments = input.arguments.iter();
    arguments.any(|argument| ast::name(argument.ident) == ast::name(field.ident))
}

/// The type of the entries of an array and their number, if that is written out.
pub(super) fn array(ty: &Type) -> Option<(&Type, Option<usize>)> {
    match ty {
        Type::Group(group) => array(&group.elem),
        Type::Paren(paren) => array(&paren.elem),
        Type::Array(array) => {
            let length = match &array.len {
                syn::Expr::Lit(syn::ExprLit {
                    lit: syn::Lit::Int(length),
                    ..
                }) => length.base10_parse().ok(),
                _ => None,
            };
            Some((&array.elem, length))
        }
        _ => None,
    }
}

fn kind<'a>(input: &Input<'a>, ty: &Type) -> Kind<'a> {
    let path = match ty {
        Type::Group(group) => return kind(input, &group.elem),
        Type::Paren(paren) => return kind(input, &paren.elem),
        Type::Path(path) if path.qself.is_none() => &path.path,
        _ => return Kind::Other,
    };
    let Some(ident) = path.get_ident() else {
        // `core::primitive::f64` and `std::primitive::f64`, with or without a leading `::`.
        let segments: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        let segments: Vec<&str> = segments.iter().map(String::as_str).collect();
        return match segments[..] {
            ["core" | "std", "primitive", "f64"] => Kind::Double,
            ["core" | "std", "primitive", "f32"] => Kind::Single,
            _ => Kind::Other,
        };
    };
    let mut parameters = input.original.generics.type_params();
    match parameters.find(|parameter| parameter.ident == *ident) {
        Some(parameter) => Kind::TypeParameter(&parameter.ident),
        None if ident == "f64" => Kind::Double,
        None if ident == "f32" => Kind::Single,
        None => Kind::Other,
    }
}

//! Which fields are parameters, and what scalar they make the model work in.
//!
//! Only fields that an expression mentions count: a struct may carry anything else. But a number
//! that no expression mentions is a parameter without effect, unless the struct says so.

use proc_macro2::Ident;
use syn::Type;

use crate::ast::{self, Field, Input};
use crate::checked::{Parameter, ParameterKind, Scalar};
use crate::ctxt::Ctxt;
use crate::message::field as message;

/// The fields that expressions have mentioned so far.
#[derive(Debug)]
pub(super) struct Used {
    fields: Vec<bool>,
    /// Nothing has been reported that may have hidden the use of a field.
    complete: bool,
}

impl Used {
    /// No field has been mentioned.
    pub(super) fn none(input: &Input<'_>) -> Self {
        Self {
            fields: vec![false; input.fields.iter().flatten().count()],
            complete: input.laws_complete,
        }
    }

    /// Nothing has been reported that may have hidden the use of a field.
    pub(super) fn is_complete(&self) -> bool {
        self.complete
    }

    /// Some expression has been reported: it might have mentioned any field.
    pub(super) fn give_up(&mut self) {
        self.complete = false;
    }

    /// An expression mentions field `index`.
    pub(super) fn mark(&mut self, index: usize) {
        self.fields[index] = true;
    }

    fn fields<'i, 'a>(
        &'i self,
        input: &'i Input<'a>,
    ) -> impl Iterator<Item = (usize, &'i Field<'a>)> {
        let fields = input.fields.iter().flatten().enumerate();
        fields.filter(|&(index, _)| self.fields[index])
    }
}

/// What the type of a field makes of it.
enum Kind<'a> {
    Double,
    Single,
    TypeParameter(&'a Ident),
    Other,
}

/// The fields that are used, in order of declaration; reports those whose type cannot be one.
pub(super) fn parameters<'a>(cx: &Ctxt, input: &Input<'a>, used: &Used) -> Vec<Parameter<'a>> {
    let parameter = |(index, field): (usize, &Field<'a>)| {
        let kind = match kind(input, field.ty) {
            Kind::Double => ParameterKind::Double,
            Kind::Single => ParameterKind::Single,
            Kind::TypeParameter(_) => ParameterKind::Scalar,
            Kind::Other => {
                cx.error(field.ty, &message::not_a_parameter(field.ident));
                return None;
            }
        };
        Some(Parameter {
            field: index,
            ident: field.ident,
            kind,
        })
    };
    used.fields(input).filter_map(parameter).collect()
}

/// The scalar of the model: the one type parameter among the types of its parameters, if any.
pub(super) fn scalar<'a>(cx: &Ctxt, input: &Input<'a>, used: &Used) -> Scalar<'a> {
    let mut scalar = Scalar::Any;
    for (_, field) in used.fields(input) {
        let Kind::TypeParameter(parameter) = kind(input, field.ty) else {
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

/// Every number is a parameter that an expression mentions, or is marked as unused.
///
/// Fields of other types are no numbers, and so is a type parameter that is not the scalar.
pub(super) fn check_used(cx: &Ctxt, input: &Input<'_>, used: &Used, scalar: Scalar<'_>) {
    if !used.complete {
        return;
    }
    for (index, field) in input.fields.iter().flatten().enumerate() {
        let number = match kind(input, field.ty) {
            Kind::Double | Kind::Single => true,
            Kind::TypeParameter(parameter) => scalar == Scalar::Parameter(parameter),
            Kind::Other => false,
        };
        let marked = field.unused || field.wrong || ast::is_underscored(field.ident);
        if number && !marked && !used.fields[index] && !is_hidden(input, field) {
            cx.error(field.ident, &message::unused(field.ident));
        }
    }
}

/// An argument has the same name, which has been reported.
fn is_hidden(input: &Input<'_>, field: &Field<'_>) -> bool {
    let mut arguments = input.arguments.iter();
    arguments.any(|argument| ast::name(argument.ident) == ast::name(field.ident))
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

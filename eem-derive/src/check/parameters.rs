//! Which fields are parameters, and what scalar they make the model work in.
//!
//! Only fields that an expression mentions count: a struct may carry anything else.

use proc_macro2::Ident;
use syn::Type;

use crate::ast::{Field, Input};
use crate::checked::{Parameter, ParameterKind, Scalar};
use crate::ctxt::Ctxt;
use crate::message::field as message;

/// The fields that expressions have mentioned so far.
#[derive(Debug)]
pub(super) struct Used(Vec<bool>);

impl Used {
    /// No field has been mentioned.
    pub(super) fn none(fields: &[Field<'_>]) -> Self {
        Self(vec![false; fields.len()])
    }

    /// An expression mentions field `index`.
    pub(super) fn mark(&mut self, index: usize) {
        self.0[index] = true;
    }

    fn fields<'i, 'a>(
        &'i self,
        input: &'i Input<'a>,
    ) -> impl Iterator<Item = (usize, &'i Field<'a>)> {
        let fields = input.fields.iter().enumerate();
        fields.filter(|&(index, _)| self.0[index])
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

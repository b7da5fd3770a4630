//! Where the inputs of a program come from in the generated functions.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::ast::Role;
use crate::checked::{Checked, Parameter, ParameterKind, Source};

/// The parameters and the shape of the state of one model.
pub(super) struct Inputs {
    /// The scalar of the implementation.
    pub(super) scalar: TokenStream,
    /// Fields of `self`, converted to the scalar.
    pub(super) parameters: Vec<TokenStream>,
    /// Number of variables, N.
    pub(super) variables: usize,
    /// Number of dashpots, K.
    pub(super) dashpots: usize,
    /// Number of viscosities: of dashpots and of the viscous strain.
    pub(super) viscosities: usize,
    /// Number of measures with a viscosity.
    pub(super) drags: usize,
    /// Whether there is a temperature.
    pub(super) thermal: bool,
}

impl Inputs {
    /// The inputs of a model.
    pub(super) fn new(checked: &Checked<'_>, scalar: &TokenStream) -> Self {
        let of_role = |role| checked.variables.iter().filter(move |v| v.role == role);
        let parameters = checked.parameters.iter();
        Self {
            scalar: scalar.clone(),
            parameters: parameters.map(|p| parameter(p, scalar)).collect(),
            variables: checked.variables.len(),
            dashpots: of_role(Role::Viscous).count(),
            viscosities: checked.viscosities.len(),
            drags: usize::from(checked.drag.is_some()),
            thermal: of_role(Role::Temperature).count() == 1,
        }
    }

    /// Number of measures, M.
    pub(super) fn measures(&self) -> usize {
        self.variables - self.dashpots - usize::from(self.thermal)
    }

    /// Number of corner temperatures of the entropy form, 2(N − 1) if there is a temperature.
    pub(super) fn corners(&self) -> usize {
        if self.thermal {
            2 * (self.variables - 1)
        } else {
            0
        }
    }

    /// Number of algorithmic quantities: f* and g*, and with a temperature θ* and Δs.
    pub(super) fn responses(&self) -> usize {
        self.variables + usize::from(self.thermal)
    }

    /// Input `index` of a program at one state: parameters, x.
    pub(super) fn point(&self, index: usize) -> TokenStream {
        self.parameter_or(index, |index| element(&quote!(__x), index))
    }

    /// Input `index` of a program at one state as a function of the temperature: parameters, x without θ, θ.
    pub(super) fn at_temperature(&self, index: usize) -> TokenStream {
        let last = self.variables - 1;
        self.parameter_or(index, |index| {
            if index == last {
                quote!(__theta)
            } else {
                element(&quote!(__x), index)
            }
        })
    }

    /// Input `index` of viscosities or of their adjoint: parameters, θ if there is one, weights.
    pub(super) fn viscosity(&self, index: usize) -> TokenStream {
        let first = usize::from(self.thermal);
        self.parameter_or(index, |index| match index.checked_sub(first) {
            None => quote!(__theta),
            Some(weight) => element(&quote!(__weights), weight),
        })
    }

    /// Input `index` of an algorithmic form: parameters, x⁰, x¹, corner temperatures.
    pub(super) fn form(&self, index: usize) -> TokenStream {
        let variables = self.variables;
        self.parameter_or(index, |index| match index / variables {
            0 => element(&quote!(__x0), index),
            1 => element(&quote!(__x1), index - variables),
            _ => element(&quote!(__corners), index - 2 * variables),
        })
    }

    /// Input `index` of a program with these arrays, of the given lengths, as arguments: parameters, then their elements.
    pub(super) fn argument(&self, index: usize, arrays: &[(TokenStream, usize)]) -> TokenStream {
        self.parameter_or(index, |mut index| {
            for (array, count) in arrays {
                if index < *count {
                    return element(array, index);
                }
                index -= count;
            }
            unreachable!("a program has no other inputs")
        })
    }

    fn parameter_or(&self, index: usize, state: impl FnOnce(usize) -> TokenStream) -> TokenStream {
        match self.parameters.get(index) {
            Some(parameter) => parameter.clone(),
            None => state(index - self.parameters.len()),
        }
    }
}

fn parameter(parameter: &Parameter<'_>, scalar: &TokenStream) -> TokenStream {
    let (place, kind) = match &parameter.source {
        Source::Field(ident, kind) => (quote!(self.#ident), *kind),
        Source::Entry(ident, entry, kind) => {
            let entry = Literal::usize_unsuffixed(*entry);
            (quote!(self.#ident[#entry]), *kind)
        }
        // An `f64`, or a number that converts to it without loss.
        Source::Constant(path) => (path.clone(), ParameterKind::Single),
    };
    match kind {
        ParameterKind::Double => quote!(<#scalar as __eem::Scalar>::from_f64(#place)),
        ParameterKind::Single => {
            let double = quote!(__eem::core::convert::From::from(#place));
            quote!(<#scalar as __eem::Scalar>::from_f64(#double))
        }
        ParameterKind::Scalar => place,
    }
}

fn element(array: &TokenStream, index: usize) -> TokenStream {
    let index = Literal::usize_unsuffixed(index);
    quote!(#array[#index])
}

//! Expand phase: the programs of a model → one `impl FreeEnergy` and one `impl Describe`, with one
//! `impl StrainEnergy` for a solid, and one `impl JointEnergy` if it has a viscous strain.
//!
//! Only prints: an [`eem_symbolic::Program`] determines which values exist, and in which order and at
//! which stage they are computed.

pub(crate) mod constants;
pub(crate) mod description;
mod docs;
mod duplicate;
pub(crate) mod equation;
mod forms;
mod header;
mod inputs;
mod lines;
mod parameters;
mod points;
mod rates;
mod statements;
pub(crate) mod strains;
mod viscosities;

use eem_symbolic::{Model, ParameterPrograms, Programs};
use proc_macro2::TokenStream;
use quote::quote;
use syn::Path;

use crate::checked::Checked;
use crate::units::{Quantities, Units};
pub(crate) use header::Header;
use inputs::Inputs;

/// The implementations of the traits, with derivatives with respect to the parameters if their programs are given.
pub(crate) fn expand(
    checked: &Checked<'_>,
    model: &Model,
    programs: &Programs,
    derivatives: Option<&ParameterPrograms>,
    units: &Units,
) -> TokenStream {
    let header = Header::new(checked.original, checked.scalar);
    let inputs = Inputs::new(checked, &header.scalar);
    let constants = constants::constants(checked, programs, &inputs, units);
    let points = points::points(programs, &inputs);
    let forms = forms::forms(programs, &inputs);
    let parameters = derivatives.map(|programs| parameters::parameters(programs, &inputs));
    let quantities = Quantities::of(checked.per_volume());
    let equations = equation::equations(&checked.arguments(), quantities, &model.formulas());
    let formulas = docs::formulas(checked, &equations, units);
    let costs = description::costs(programs, derivatives);
    let description = description::description(checked, model, &costs, &equations, units);
    let duplicate = duplicate::duplicate(checked.original);
    let body = quote! { #constants #duplicate #points #forms #parameters };
    let implementation = header.implementation(&body);
    let strains = strains::strains(checked, programs, &inputs);
    let all = quote! { #formulas #implementation #strains #description };
    wrap(checked.krate, &all)
}

// Expands to: a scope of its own, in which `__eem` is the private module of the crate. Everything
// that generated code names starts there.
//
//     const _: () = {
//         use ::eem::__private as __eem;
//         impl __eem::FreeEnergy<f64> for Spring { … }
//         impl __eem::Describe for Spring { … }
//     };
pub(crate) fn wrap(krate: &Path, implementation: &TokenStream) -> TokenStream {
    quote! {
        // Numbers have all their digits, without separators.
        #[allow(clippy::unreadable_literal, clippy::excessive_precision)]
        // `PI` of a formula is a number like any other.
        #[allow(clippy::approx_constant)]
        // Values are named `__v0`, `__v1`, …
        #[allow(clippy::many_single_char_names, clippy::similar_names)]
        // A long formula makes a long function.
        #[allow(clippy::too_many_lines, clippy::cognitive_complexity, clippy::let_and_return)]
        // `__eem` may be a path through the crate that defines the struct.
        #[allow(unused_qualifications)]
        const _: () = {
            use #krate::__private as __eem;
            #implementation
        };
    }
}

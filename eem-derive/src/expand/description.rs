//! The description of the model: the implementation of `Describe`.

use eem_symbolic::{Formulas, Model, Program, Programs};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::docs;
use crate::ast::{self, Role};
use crate::checked::Checked;
use crate::units::{self, Units};

// Expands to:
//
//     impl Describe for Spring {
//         const DESCRIPTION: Description = Description { name: "Spring", … };
//     }
pub(super) fn description(
    checked: &Checked<'_>,
    model: &Model,
    programs: &Programs,
    equations: &[Equation],
    units: &Units,
) -> TokenStream {
    let name = ast::name(&checked.original.ident);
    let arguments = arguments(checked);
    let parameters = parameters(checked, units);
    let formulas = equations.iter().map(Equation::tokens);
    let differences = differences(checked, model);
    let differences = differences.iter().map(Equation::tokens);
    let costs = costs(programs);
    let body = quote! {
        const DESCRIPTION: __eem::Description = __eem::Description {
            name: #name,
            arguments: &[#(#arguments),*],
            parameters: &[#(#parameters),*],
            formulas: &[#(#formulas),*],
            divided_differences: &[#(#differences),*],
            costs: &[#(#costs),*],
        };
    };
    implementation(checked.original, &body)
}

/// The implementation of `Describe` with the given body.
pub(crate) fn implementation(input: &syn::DeriveInput, body: &TokenStream) -> TokenStream {
    let ident = &input.ident;
    let (impl_generics, ty_generics, where_clause) = input.generics.split_for_impl();
    quote! {
        #[automatically_derived]
        impl #impl_generics __eem::Describe for #ident #ty_generics #where_clause {
            #body
        }
    }
}

fn arguments(checked: &Checked<'_>) -> impl Iterator<Item = TokenStream> {
    checked.variables.iter().map(|variable| {
        let (name, role) = (ast::name(variable.ident), variable.role.name());
        let unit = units::of_role(variable.role).to_string();
        quote! { __eem::describe::Argument::new(#name, #role, #unit) }
    })
}

fn parameters(checked: &Checked<'_>, units: &Units) -> impl Iterator<Item = TokenStream> {
    checked.parameters.iter().map(|parameter| {
        let name = ast::name(parameter.ident);
        let unit = units.of_field(parameter.field);
        unit.map_or_else(
            || quote! { __eem::describe::Parameter::without_unit(#name) },
            |unit| quote! { __eem::describe::Parameter::new(#name, #unit) },
        )
    })
}

/// A formula, its left side and its unit.
pub(super) struct Equation {
    symbol: String,
    /// Both sides, broken into lines.
    pub(super) lines: Vec<String>,
    unit: String,
}

impl Equation {
    /// `meaning` follows the symbol: `s = −∂ψ/∂theta = …`.
    fn new(symbol: &str, meaning: &str, formula: &str, unit: &str) -> Self {
        Self {
            symbol: symbol.to_owned(),
            lines: docs::lines(&format!("{symbol}{meaning} = {formula}")),
            unit: unit.to_owned(),
        }
    }

    fn tokens(&self) -> TokenStream {
        let (symbol, unit) = (&self.symbol, &self.unit);
        let equation = self.lines.join("\n");
        quote! { __eem::describe::Formula::new(#symbol, #equation, #unit) }
    }
}

/// The formulas in the order in which a reader wants them.
pub(super) fn equations(checked: &Checked<'_>, formulas: &Formulas) -> Vec<Equation> {
    let names = |role| {
        let variables = checked.variables.iter().filter(move |v| v.role == role);
        variables.map(|v| ast::name(v.ident))
    };
    let theta = names(Role::Temperature).next().unwrap_or_default();
    let mut equations = vec![Equation::new("ψ", "", &formulas.free_energy, "J")];
    if let Some(entropy) = &formulas.entropy {
        let meaning = format!(" = −∂ψ/∂{theta}");
        equations.push(Equation::new("s", &meaning, entropy, "J/K"));
        let meaning = format!(" = ψ + {theta} s");
        let energy = &formulas.internal_energy;
        equations.push(Equation::new("e", &meaning, energy, "J"));
    }
    for (name, force) in names(Role::Stretch).zip(&formulas.forces) {
        let meaning = format!(" = ∂ψ/∂{name}");
        equations.push(Equation::new("f", &meaning, force, "N"));
    }
    let dashpots = formulas.dashpot_forces.len();
    for (k, (name, force)) in names(Role::Viscous)
        .zip(&formulas.dashpot_forces)
        .enumerate()
    {
        let meaning = format!(" = −∂ψ/∂{name}");
        equations.push(Equation::new(
            &subscript("g", k, dashpots),
            &meaning,
            force,
            "N",
        ));
    }
    if let Some(capacity) = &formulas.heat_capacity {
        let meaning = format!(" = {theta} ∂s/∂{theta}");
        equations.push(Equation::new("c", &meaning, capacity, "J/K"));
    }
    for (k, viscosity) in formulas.viscosities.iter().enumerate() {
        equations.push(Equation::new(
            &subscript("η", k, dashpots),
            "",
            viscosity,
            "N s/m",
        ));
    }
    equations
}

/// `symbol`, numbered from 1 if there are several.
fn subscript(symbol: &str, index: usize, count: usize) -> String {
    if count == 1 {
        symbol.to_owned()
    } else {
        format!("{symbol}_{}", index + 1)
    }
}

fn differences(checked: &Checked<'_>, model: &Model) -> Vec<Equation> {
    let formulas = model.difference_formulas();
    let equation = |formula: &eem_symbolic::DifferenceFormula| {
        let name = &formula.variable;
        let mut variables = checked.variables.iter();
        let thermal = variables.any(|v| v.role == Role::Temperature && ast::name(v.ident) == *name);
        let unit = match (formula.potential, thermal) {
            ("s", true) => "J/K^2",
            ("s", false) => "N/K",
            (_, true) => "J/K",
            (_, false) => "N",
        };
        let symbol = format!("{}[{name}]", formula.potential);
        let left = format!("{}[{name}⁰, {name}¹]", formula.potential);
        Equation {
            symbol,
            lines: docs::lines(&format!("{left} = {}", formula.formula)),
            unit: unit.to_owned(),
        }
    };
    formulas.iter().map(equation).collect()
}

fn costs(programs: &Programs) -> impl Iterator<Item = TokenStream> {
    let rows = [
        ("free_energy", Some(&programs.free_energy), false),
        ("energy_magnitude", Some(&programs.energy_magnitude), false),
        ("internal_energy", Some(&programs.internal_energy), false),
        ("gradient", Some(&programs.gradient), false),
        ("hessian", Some(&programs.hessian), false),
        ("caloric", programs.caloric.as_ref(), false),
        ("entropy_hessian", programs.entropy_hessian.as_ref(), false),
        ("viscosity", programs.viscosity.as_ref(), false),
        ("entropy_form", Some(&programs.entropy_form), true),
        ("temperature_form", programs.temperature_form.as_ref(), true),
    ];
    let rows = rows.into_iter();
    rows.filter_map(|(function, program, two_states)| Some(cost(function, program?, two_states)))
}

/// A function of one state computes everything in every call.
fn cost(function: &str, program: &Program, two_states: bool) -> TokenStream {
    let count = program.operation_count();
    let (old, new) = (count.old.total(), count.new.total());
    let (step, call) = if two_states {
        (old, new)
    } else {
        (0, old + new)
    };
    let [step, call] = [step, call].map(Literal::usize_unsuffixed);
    quote! { __eem::describe::Cost::new(#function, #step, #call) }
}

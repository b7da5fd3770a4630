//! The formulas of a model as equations with a unit.

use eem_symbolic::{DifferenceFormula, Formulas, Model};
use proc_macro2::TokenStream;
use quote::quote;

use super::lines::lines;
use crate::ast::{self, Role};
use crate::checked::Checked;
use crate::units::Quantities;

/// A formula, its left side and its unit.
pub(crate) struct Equation {
    pub(crate) symbol: String,
    /// Both sides, broken into lines.
    pub(crate) lines: Vec<String>,
    pub(crate) unit: String,
}

/// The arguments of a free energy in the order of the state, by name.
pub(crate) type Arguments = [(String, Role)];

impl Equation {
    /// `meaning` follows the symbol: `s = −∂ψ/∂theta = …`.
    fn new(symbol: &str, meaning: &str, formula: &str, unit: &str) -> Self {
        Self {
            symbol: symbol.to_owned(),
            lines: lines(&format!("{symbol}{meaning} = {formula}")),
            unit: unit.to_owned(),
        }
    }

    pub(super) fn tokens(&self) -> TokenStream {
        let (symbol, unit) = (&self.symbol, &self.unit);
        let equation = self.lines.join("\n");
        quote! { __eem::describe::Formula::new(#symbol, #equation, #unit) }
    }
}

/// All formulas of a model: potentials, forces, heat capacity, viscosities.
pub(crate) fn equations(
    arguments: &Arguments,
    units: &Quantities,
    formulas: &Formulas,
) -> Vec<Equation> {
    let names = |wanted: fn(Role) -> bool| {
        let wanted = arguments.iter().filter(move |(_, role)| wanted(*role));
        wanted.map(|(name, _)| name.as_str())
    };
    let theta = names(|role| role == Role::Temperature).next();
    let theta = theta.unwrap_or_default();
    let mut equations = vec![Equation::new("ψ", "", &formulas.free_energy, units.energy)];
    if let Some(entropy) = &formulas.entropy {
        let meaning = format!(" = −∂ψ/∂{theta}");
        equations.push(Equation::new("s", &meaning, entropy, units.entropy));
        let meaning = format!(" = ψ + {theta} s");
        let energy = &formulas.internal_energy;
        equations.push(Equation::new("e", &meaning, energy, units.energy));
    }
    let measures = formulas.forces.len();
    let forces = names(Role::is_measure).zip(&formulas.forces);
    for (a, (name, force)) in forces.enumerate() {
        let symbol = subscript("f", a, measures);
        let meaning = format!(" = ∂ψ/∂{name}");
        equations.push(Equation::new(&symbol, &meaning, force, units.force));
    }
    let dashpots = formulas.dashpot_forces.len();
    let forces = names(|role| role == Role::Viscous).zip(&formulas.dashpot_forces);
    for (k, (name, force)) in forces.enumerate() {
        let symbol = subscript("g", k, dashpots);
        let meaning = format!(" = −∂ψ/∂{name}");
        equations.push(Equation::new(&symbol, &meaning, force, units.force));
    }
    if let Some(capacity) = &formulas.heat_capacity {
        let meaning = format!(" = {theta} ∂s/∂{theta}");
        equations.push(Equation::new("c", &meaning, capacity, units.entropy));
    }
    for (k, viscosity) in formulas.viscosities.iter().enumerate() {
        equations.push(Equation::new(
            &subscript("η", k, formulas.viscosities.len()),
            "",
            viscosity,
            units.viscosity,
        ));
    }
    if let (Some(drag), Some(name)) = (&formulas.drag, names(Role::is_measure).next()) {
        let symbol = format!("η[{name}]");
        equations.push(Equation::new(&symbol, "", drag, units.viscosity));
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

/// The divided differences that discrete derivatives consist of.
pub(super) fn differences(checked: &Checked<'_>, model: &Model) -> Vec<Equation> {
    let formulas = model.difference_formulas();
    let units = Quantities::of(checked.per_volume());
    let equation = |formula: &DifferenceFormula| {
        let name = &formula.variable;
        let mut variables = checked.variables.iter();
        let thermal = variables.any(|v| v.role == Role::Temperature && ast::name(v.ident) == *name);
        let unit = match (formula.potential, thermal) {
            ("s", true) => units.entropy_per_kelvin,
            ("s", false) => units.force_per_kelvin,
            (_, true) => units.entropy,
            (_, false) => units.force,
        };
        let symbol = format!("{}[{name}]", formula.potential);
        let left = format!("{}[{name}⁰, {name}¹]", formula.potential);
        Equation {
            symbol,
            lines: lines(&format!("{left} = {}", formula.formula)),
            unit: unit.to_owned(),
        }
    };
    formulas.iter().map(equation).collect()
}

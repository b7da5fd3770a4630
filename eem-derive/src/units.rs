//! Units: [`checked`](crate::checked) → the units of its fields, every operation in order.
//!
//! A model in which no field that it uses has a unit is not looked at. Otherwise all of them need
//! one; λ and γ are in m, θ is in K, ψ has to come out in J and viscosities in N s/m. Numbers in a
//! formula have no unit, so that a factor of 1000 never stands for a prefix: the scale of a unit is
//! compared like its dimension, and a value in mm cannot be added to one in m.
//!
//! The rules are one function each in `rules`, which walk the expression as it was written. An
//! expression with an error has no unit, and nothing more is said about what contains it.

mod display;
mod excerpt;
mod fields;
pub(crate) mod grammar;
mod rules;
mod table;
pub(crate) mod unit;
mod unknowns;

use crate::ast::Role;
use crate::checked::Checked;
use crate::ctxt::Ctxt;
use crate::message::unit as message;
use fields::Declaration;
use rules::Rules;
pub(crate) use unit::Unit;

/// The units of the fields.
#[derive(Debug)]
pub(crate) struct Units {
    declarations: Vec<Declaration>,
}

impl Units {
    /// The unit of a field as it was written, by the index of the field in the struct.
    pub(crate) fn of_field(&self, index: usize) -> Option<&str> {
        match self.declarations.get(index)? {
            Declaration::Unit(_, text) => Some(text),
            Declaration::Missing | Declaration::Unreadable => None,
        }
    }

    /// Whether a field says anything about its unit.
    fn is_declared(&self, index: usize) -> bool {
        let declaration = self.declarations.get(index);
        declaration.is_some_and(|declaration| !matches!(declaration, Declaration::Missing))
    }
}

/// The unit of an argument of the free energy.
pub(crate) fn of_role(role: Role) -> Unit {
    match role {
        Role::Stretch | Role::Viscous => Unit::metre(),
        Role::Temperature => Unit::kelvin(),
    }
}

/// Reads the units of the fields and checks the formulas with them.
pub(crate) fn check(cx: &Ctxt, checked: &Checked<'_>) -> Units {
    let units = Units {
        declarations: fields::read(cx, checked.original),
    };
    let mut used = checked.parameters.iter();
    if !used.any(|parameter| units.is_declared(parameter.field)) {
        return units;
    }
    let mut rules = Rules::new(cx, checked, &units);
    rules.body("the free energy", "J", &Unit::joule(), &checked.energy);
    for viscosity in checked.viscosities.iter().flatten() {
        rules.body("a viscosity", "N s/m", &Unit::viscosity(), viscosity);
    }
    let unknowns = rules.unknowns;
    for parameter in &checked.parameters {
        if !units.is_declared(parameter.field) {
            let unit = unknowns.unit(parameter.field);
            cx.error(
                parameter.ident,
                &message::missing(parameter.ident, unit.as_ref()),
            );
        }
    }
    units
}

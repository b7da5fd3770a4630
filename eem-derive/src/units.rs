//! Units: [`checked`](crate::checked) → the units of its fields, every operation in order.
//!
//! A model is checked if one of the fields in its formulas has a unit. Then all of them
//! need one; θ is in K. In a spring λ and γ are in m, ψ has to come out in J and viscosities in N s/m; in
//! a solid strains and γ are pure numbers, ψ is in J/m³ and viscosities are in Pa s. Numbers in a formula have no unit, so that a factor of 1000 never stands for a prefix: the scale of a unit is
//! compared like its dimension, and a value in mm cannot be added to one in m.
//!
//! The rules are one function each in `rules`, which walk the expression as it was written. An
//! expression with an error has no unit, and nothing more is said about what contains it.

mod declared;
mod excerpt;
pub(crate) mod grammar;
mod quantities;
mod rules;
mod unknowns;

use crate::ast::Role;
use crate::checked::Checked;
use crate::ctxt::Ctxt;
use crate::message::unit as message;
pub(crate) use declared::Units;
pub(crate) use quantities::Quantities;
use quantities::unit;
use rules::Rules;

/// Reads the units of the fields and checks the formulas with them.
pub(crate) fn check(cx: &Ctxt, checked: &Checked<'_>) -> Units {
    let units = Units::read(cx, checked.original);
    let mut used = checked.parameters.iter();
    // What is a spring and a solid has been reported.
    let both = checked.per_volume() && checked.variables.iter().any(|v| v.role == Role::Stretch);
    if both || !used.any(|parameter| units.is_declared(parameter.field)) {
        return units;
    }
    let mut rules = Rules::new(cx, checked, &units);
    let &Quantities {
        what,
        energy,
        viscosity,
        ..
    } = rules.quantities;
    rules.body(what, energy, &unit(energy), &checked.energy);
    for law in checked.viscosities.iter().flatten() {
        rules.body("a viscosity", viscosity, &unit(viscosity), law);
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

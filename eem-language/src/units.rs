//! Units: [`checked`](crate::checked) → the units of its fields, every operation in order.
//!
//! A model is checked if one of the fields or constants in its formulas has a unit. Then all fields
//! need one, a constant without one is dimensionless; θ is in K. In a spring λ and γ are in m, ψ has to
//! come out in J and viscosities in N s/m; in a solid strains and γ are dimensionless, ψ is in J/m³ and
//! viscosities are in Pa s. Numbers in a formula have no unit, so that a factor of 1000 never stands for
//! a prefix: the scale of a unit is compared like its dimension, and a value in mm cannot be added to
//! one in m.
//!
//! The rules are one function each in `rules`, which walk the expression as it was written. An
//! expression with an error has no unit, and expressions that contain it are not reported again.

mod constants;
mod declaration;
mod declared;
mod excerpt;
pub(crate) mod grammar;
mod quantities;
mod rules;
mod unknowns;

use crate::ast::Role;
use crate::checked::{Checked, Source};
use crate::ctxt::Ctxt;
use crate::message::unit as message;
pub(crate) use declared::Units;
pub(crate) use excerpt::excerpt;
pub(crate) use quantities::Quantities;
use quantities::unit;
use rules::Rules;
use unknowns::Unknowns;

/// Reads the units of the fields and checks the formulas with them.
pub(crate) fn check(cx: &Ctxt, checked: &Checked<'_>) -> Units {
    let units = Units::read(cx, checked);
    // A model of both a spring and a solid has been reported.
    let both = checked.per_volume() && checked.variables.iter().any(|v| v.role == Role::Stretch);
    if both || !units.are_checked() {
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
    for law in checked.viscosities.iter().flatten().chain(&checked.drag) {
        rules.body("a viscosity", viscosity, &unit(viscosity), law);
    }
    report_missing(cx, checked, &units, &rules.unknowns);
    units
}

/// Reports every field without a unit, with the one that the formulas need.
fn report_missing(cx: &Ctxt, checked: &Checked<'_>, units: &Units, unknowns: &Unknowns) {
    let mut before = None;
    for parameter in &checked.parameters {
        let (Some(field), Source::Field(ident, _) | Source::Entry(ident, ..)) =
            (parameter.origin.field(), &parameter.source)
        else {
            continue;
        };
        // Entries of an array follow each other and have one unit.
        if units.is_missing(parameter.origin) && before != Some(field) {
            let unit = unknowns.unit(field);
            cx.error(ident, &message::missing(ident, unit.as_ref()));
        }
        before = Some(field);
    }
}

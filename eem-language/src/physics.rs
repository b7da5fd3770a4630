//! Physics phase: reports complete models that describe no possible material.
//!
//! [`eem_symbolic::Flaw`] says what is wrong; this phase adds the place and the message.

use eem_symbolic::{Flaw, Model, ParameterPrograms, Programs};

use crate::ast::{self, Joint, Role};
use crate::checked::{Checked, Variable};
use crate::ctxt::Ctxt;
use crate::message::{Message, attribute::physics as message};

/// Reports every flaw of a sound model: at the argument of the free energy that it is about, or at the
/// viscosity law.
pub(crate) fn check(cx: &Ctxt, checked: &Checked<'_>, model: &Model) {
    for flaw in model.flaws() {
        match flaw {
            Flaw::Independent(symbol) => {
                report_independent(cx, checked, model.graph.name(symbol));
            }
            Flaw::NoHeatCapacity => report_thermal(cx, checked, message::no_heat_capacity),
            Flaw::NegativeHeatCapacity => {
                report_thermal(cx, checked, message::negative_heat_capacity);
            }
            Flaw::NoViscosity(dashpot) => {
                if let Some(Some(law)) = checked.viscosities.get(dashpot) {
                    let argument = dashpot_argument(checked, dashpot);
                    cx.error(
                        law.value.original,
                        &message::no_viscosity(argument.as_deref()),
                    );
                }
            }
            Flaw::NoDrag => {
                if let Some(law) = &checked.drag {
                    cx.error(law.value.original, &message::no_viscosity(None));
                }
            }
        }
    }
}

/// The argument that a law is for, in the order of [`Checked::viscosities`].
fn dashpot_argument(checked: &Checked<'_>, dashpot: usize) -> Option<String> {
    let flows = [
        Role::Viscous,
        Role::Joint(Joint::Strain),
        Role::Joint(Joint::Trace),
    ];
    let variables = checked.variables.iter();
    let of_role = |role| variables.clone().filter(move |v| v.role == role);
    let variable = flows.into_iter().flat_map(of_role).nth(dashpot)?;
    Some(ast::name(variable.ident))
}

/// Reports factors of ψ, or of a derivative, that are too large only as a product; single constants have
/// been checked before.
pub(crate) fn check_programs(
    cx: &Ctxt,
    checked: &Checked<'_>,
    programs: &Programs,
    derivatives: Option<&ParameterPrograms>,
) {
    let derivatives = derivatives.map_or(Ok(()), ParameterPrograms::verify);
    if programs.verify().and(derivatives).is_err() {
        cx.error(checked.energy.value.original, &message::factor_too_large());
    }
}

fn report_independent(cx: &Ctxt, checked: &Checked<'_>, name: &str) {
    let mut variables = checked.variables.iter();
    if let Some(variable) = variables.find(|variable| ast::name(variable.ident) == name) {
        // E:Γ and Γ:Γ contain the trace, too; with its viscosity it flows.
        if variable.role == Role::Joint(Joint::Trace) {
            return;
        }
        let measure = checked
            .variables
            .first()
            .map(|first| ast::name(first.ident));
        let message = message::independent(variable, &measure.unwrap_or_default());
        cx.error(variable.ident, &message);
    }
}

fn report_thermal(cx: &Ctxt, checked: &Checked<'_>, message: fn(&Variable<'_>) -> Message) {
    let mut variables = checked.variables.iter();
    if let Some(theta) = variables.find(|variable| variable.role == Role::Temperature) {
        cx.error(theta.ident, &message(theta));
    }
}

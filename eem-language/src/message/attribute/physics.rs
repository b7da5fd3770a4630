//! Messages about free energies and viscosities that no material can have.

use super::Message;
use crate::ast::{self, Joint, Role, Strain};
use crate::checked::Variable;

/// `measure` is the name of a measure of the model.
pub(crate) fn independent(variable: &Variable<'_>, measure: &str) -> Message {
    let name = ast::name(variable.ident);
    let help = match variable.role {
        Role::Strain(strain) => {
            let term = match strain {
                Strain::Trace => format!("0.5 * la * {name}.powi(2)"),
                Strain::Square => format!("mu * {name}"),
                Strain::Dilatation => format!("0.5 * bulk * {name}.powi(2)"),
                Strain::Fibre => format!("0.5 * stiffness * {name}.powi(2)"),
            };
            format!(
                "there is no stress; add its term, for example `{term}`, or remove the argument"
            )
        }
        Role::Joint(joint) => {
            let term = match joint {
                Joint::Trace => format!("0.5 * bulk * {name}.powi(2)"),
                Joint::Square => format!("branch * {name}"),
                Joint::Strain => format!("- 2 * branch * {name}"),
            };
            format!(
                "`{name}` has no effect on the viscous strain; add its term, for example `{term}`, or remove the argument"
            )
        }
        Role::Stretch => format!(
            "there is no force; add its term, for example `0.5 * stiffness * ({name} - length).powi(2)`"
        ),
        Role::Viscous => format!(
            "nothing drives the dashpot; add its term, for example `0.5 * branch * ({measure} - {name}).powi(2)`, or remove the argument and its viscosity"
        ),
        Role::Temperature => format!(
            "there is no entropy; add a heat capacity, for example `capacity * ({name} - {name} * ln({name} / theta_ref))`, or remove the argument"
        ),
    };
    Message::new(format!("the free energy does not depend on `{name}`"), help)
}

pub(crate) fn no_heat_capacity(theta: &Variable<'_>) -> Message {
    let name = ast::name(theta.ident);
    Message::new(
        format!(
            "the free energy is linear in `{name}`: the heat capacity is zero, so that the temperature cannot be found from the entropy"
        ),
        format!(
            "add a heat capacity, for example `capacity * ({name} - {name} * ln({name} / theta_ref))`"
        ),
    )
}

pub(crate) fn negative_heat_capacity(theta: &Variable<'_>) -> Message {
    let name = ast::name(theta.ident);
    Message::new(
        "the heat capacity is never positive",
        format!(
            "it is `-{name}` times the second derivative with respect to `{name}`: check the signs; it usually comes from a term `-capacity * {name} * ln({name})`"
        ),
    )
}

/// `argument` is that of the dashpot; the dashpot of a `Stretch` has none of its own.
pub(crate) fn no_viscosity(argument: Option<&str>) -> Message {
    let and_argument =
        argument.map_or_else(String::new, |name| format!(" and the argument `{name}`"));
    Message::new(
        "a viscosity must be positive",
        format!("check the signs; to remove the dashpot, delete this law{and_argument}"),
    )
}

pub(crate) fn factor_too_large() -> Message {
    Message::new(
        "the free energy, or a derivative of it, has a factor that does not fit an `f64`",
        "an `f64` reaches to about `1.8e308`; choose other units",
    )
}

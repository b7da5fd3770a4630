//! The units of the quantities that a model computes.

use super::grammar;
use crate::ast::Role;
use crate::unit::Unit;

/// The units of a spring or of a solid, as messages and descriptions write them.
#[derive(Debug)]
pub(crate) struct Quantities {
    /// What messages call ψ.
    pub(crate) what: &'static str,
    /// ψ and e.
    pub(crate) energy: &'static str,
    /// Derivatives of ψ and e with respect to measures and viscous variables.
    pub(crate) force: &'static str,
    /// s, c and derivatives of e with respect to θ.
    pub(crate) entropy: &'static str,
    /// Derivatives of s with respect to measures and viscous variables.
    pub(crate) force_per_kelvin: &'static str,
    /// Derivatives of s with respect to θ.
    pub(crate) entropy_per_kelvin: &'static str,
    /// η.
    pub(crate) viscosity: &'static str,
    /// Whether viscous variables are lengths.
    lengths: bool,
}

/// A free energy of lengths.
const SPRING: Quantities = Quantities {
    what: "the free energy",
    energy: "J",
    force: "N",
    entropy: "J/K",
    force_per_kelvin: "N/K",
    entropy_per_kelvin: "J/K^2",
    viscosity: "N s/m",
    lengths: true,
};

/// A free energy of strains, per volume.
const SOLID: Quantities = Quantities {
    what: "the free energy per volume",
    energy: "J/m^3",
    force: "Pa",
    entropy: "J/(K m^3)",
    force_per_kelvin: "Pa/K",
    entropy_per_kelvin: "J/(K^2 m^3)",
    viscosity: "Pa s",
    lengths: false,
};

impl Quantities {
    /// The units of a spring, or of a solid.
    pub(crate) fn of(per_volume: bool) -> &'static Self {
        if per_volume { &SOLID } else { &SPRING }
    }

    /// The unit of an argument of the free energy.
    pub(crate) fn of_role(&self, role: Role) -> Unit {
        match role {
            Role::Viscous if !self.lengths => Unit::one(),
            Role::Stretch | Role::Viscous => Unit::metre(),
            Role::Strain(_) | Role::Joint(_) => Unit::one(),
            Role::Temperature => Unit::kelvin(),
        }
    }
}

/// The unit that a text of [`Quantities`] stands for.
pub(super) fn unit(text: &str) -> Unit {
    grammar::parse(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{Quantities, SOLID, SPRING, unit};
    use crate::ast::Role;
    use crate::unit::Unit;

    #[test]
    fn units_of_quantities_fit_each_other() {
        for quantities in [SPRING, SOLID] {
            let Quantities {
                energy,
                force,
                entropy,
                force_per_kelvin,
                entropy_per_kelvin,
                viscosity,
                ..
            } = quantities;
            let [energy, force, entropy] = [energy, force, entropy].map(unit);
            let [force_per_kelvin, entropy_per_kelvin, viscosity] =
                [force_per_kelvin, entropy_per_kelvin, viscosity].map(unit);
            let length = quantities.of_role(Role::Viscous);
            let kelvin = Unit::kelvin();
            assert_eq!(energy.over(&length), Some(force.clone()));
            assert_eq!(energy.over(&kelvin), Some(entropy.clone()));
            assert_eq!(entropy.over(&length), Some(force_per_kelvin));
            assert_eq!(entropy.over(&kelvin), Some(entropy_per_kelvin));
            let rate = length.over(&unit("s"));
            assert_eq!(rate.and_then(|rate| force.over(&rate)), Some(viscosity));
        }
    }
}

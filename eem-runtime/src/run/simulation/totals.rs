//! Whether the sums over a whole scene can be represented.

use crate::run::ledger::Ledger;
use crate::scene::error::SceneError;
use eem_material::number::scalar::Real;

/// An entry of the ledger that is not finite.
#[derive(Clone, Copy, Debug)]
pub(super) struct Overflow {
    pub(super) quantity: &'static str,
    pub(super) value: f64,
    pub(super) unit: &'static str,
}

/// The first sum that is not finite. The laws could not be checked with it.
pub(super) fn overflow<S: Real, const D: usize>(ledger: &Ledger<D, S>) -> Option<Overflow> {
    let sums = [
        ("kinetic energy", ledger.kinetic_energy, "J"),
        ("potential energy", ledger.potential_energy, "J"),
        ("internal energy", ledger.internal_energy, "J"),
        ("energy", ledger.energy, "J"),
        ("entropy", ledger.entropy, "J/K"),
    ];
    let momenta = ledger.linear_momentum.iter();
    let momenta = momenta.map(|&component| ("linear momentum", component, "kg m/s"));
    let angular = ledger.angular_momentum.iter();
    let angular = angular.map(|&component| ("angular momentum", component, "kg m²/s"));
    let mut all = sums.into_iter().chain(momenta).chain(angular);
    let (quantity, value, unit) = all.find(|(_, value, _)| !value.is_finite())?;
    Some(Overflow {
        quantity,
        value: value.to_f64(),
        unit,
    })
}

/// An error unless all sums of the initial state are finite.
pub(super) fn check_totals<S: Real, const D: usize>(
    ledger: &Ledger<D, S>,
) -> Result<(), SceneError> {
    match overflow(ledger) {
        None => Ok(()),
        Some(Overflow {
            quantity,
            value,
            unit,
        }) => Err(SceneError::Total {
            quantity,
            value,
            unit,
        }),
    }
}

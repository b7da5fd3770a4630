//! The energy–entropy–momentum scheme in entropy form.
//!
//! ```text
//! f* = D_λ e,  g* = −D_γ e,  θ* = D_s e      of e(λ, γ, s) = ψ + θ̂ s,  θ̂(λ, γ, s): S(λ, γ, θ̂) = s
//! ```
//!
//! with the symmetrised partitioned discrete derivatives of García Orden & Romero (2012), eq. (28).
//! The sum `f*Δλ − g*Δγ + θ*Δs` is `Δe` exactly, hence the first law; `θ*` is a mean
//! temperature, hence positive, hence the second.
//!
//! The local unknown is the new temperature. The temperatures of the mixed states on the way from
//! old to new come from the Legendre inversion θ̂, by Newton's method, for any free energy.

use crate::element::conjugates::element::{ElementScheme, Form, Infeasible, Placement, Start};
use crate::element::conjugates::temperature::temperature_of;
use eem_material::free_energy::{Array, Entry, FreeEnergy, Material};
use eem_material::number::scalar::Real;

/// See the module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EemEntropy;

impl<S: Real, M: Material<S>> ElementScheme<S, M> for EemEntropy {
    const EXACT: bool = true;

    /// What the form keeps, and s⁰, J/K.
    type Old = (M::EntropyFormOld, S);
    /// Corner temperatures.
    type Memory = M::Corners;
    type AtPoint<T: Entry> = [T; 0];

    #[inline]
    fn placement(self) -> Placement {
        Placement::Ends
    }

    #[inline]
    fn old(model: &M, x0: &M::Variables, entropy: S) -> Self::Old {
        (model.entropy_form_old(x0), entropy)
    }

    fn memory(theta0: S) -> Self::Memory {
        M::Corners::filled(theta0)
    }

    #[inline]
    fn prepare(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        corners: &mut Self::Memory,
    ) -> Result<(), Infeasible> {
        if M::THERMAL {
            find_corners(model, start, x, corners)?;
        }
        Ok(())
    }

    #[inline]
    fn form(
        self,
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
    ) -> Form<S, M> {
        model.entropy_form(&start.old.0, x, corners)
    }

    /// The temperature form, which has no mixed states: with a small heat capacity their temperatures
    /// overflow away from the solution.
    #[cold]
    #[inline(never)]
    fn starting_form(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
    ) -> Option<Form<S, M>> {
        let old = model.temperature_form_old(&start.x0);
        Some(model.temperature_form(&old, x))
    }

    #[inline]
    fn response(
        self,
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        corners: &Self::Memory,
    ) -> M::Response {
        model.entropy_form_response(&start.old.0, x, corners)
    }
}

/// The temperatures of the mixed states: first the ascending chain, where the first k variables
/// are new and the entropy is old, then the descending one, the other way round.
///
/// A trial beyond a spinodal is refused, so that all corners lie on the stable branch.
fn find_corners<S: Real, M: FreeEnergy<S>>(
    model: &M,
    start: &Start<S, M, (M::EntropyFormOld, S)>,
    x1: &M::Variables,
    corners: &mut M::Corners,
) -> Result<(), Infeasible> {
    let steps = M::Corners::LEN / 2;
    let (ascending, descending) = corners.as_mut().split_at_mut(steps);
    let caloric1 = model.caloric(x1);
    Infeasible::unless_stable(caloric1.heat_capacity, x1[M::Variables::LEN - 1])?;
    for k in 1..=steps {
        let mixed = model.caloric_between(&start.x0, x1, k);
        ascending[k - 1] = temperature_of(&mixed, start.old.1, ascending[k - 1])?;
        let mixed = model.caloric_between(x1, &start.x0, k);
        descending[k - 1] = temperature_of(&mixed, caloric1.entropy, descending[k - 1])?;
    }
    Ok(())
}

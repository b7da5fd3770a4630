//! The [damping](super::damping) of a point: found when a step begins, and what it changes.

use super::damping::Damping;
use super::point::{Point, temperature_in};
use crate::element::conduction::Partner;
use crate::element::conjugates::{ElementScheme, Form, Placement, end_weight};
use crate::element::error::StateError;
use crate::element::group::respond::check_temperature;
use crate::element::group::view::StepView;
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::{Array, FreeEnergy};
use eem_material::number::scalar::Real;

impl<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    Point<S, M, K, C, D>
{
    /// Finds the damping of a step from its old state.
    #[inline]
    pub(super) fn begin_damping(&mut self, view: &StepView<'_, S>) {
        if C::Damping::<()>::LEN == 0 {
            return;
        }
        let mut damping = Damping::<S, M::Viscosities>::none();
        let x0 = self.start.x0;
        if let Some(slot) = self.conducting_slot(view) {
            let theta = x0[Self::TEMPERATURE];
            let x = view.step * relaxation_rate(view, slot);
            damping.weight = S::from_f64(2.0) * end_weight(x) * theta;
            damping.per_capacity = per_capacity(view, slot);
        }
        if M::DASHPOTS > 0 {
            let theta = x0[Self::VARIABLES - 1];
            let (viscosities, _) = self.model.viscosity(theta);
            let (_, hessian) = self.model.hessian(&x0);
            for k in 0..M::DASHPOTS {
                let stiff = view.step * stiffness_of::<S, M>(k, &hessian);
                let weight = end_weight((stiff / viscosities[k]).maximum(S::zero()));
                damping.viscosities[k] = weight * stiff;
            }
        }
        for own in self.damping.as_mut() {
            *own = damping;
        }
    }

    /// Its thermal slot, if it conducts heat at a free temperature.
    fn conducting_slot(&self, view: &StepView<'_, S>) -> Option<usize> {
        let conducts = |slot: &usize| !view.conduction.links(*slot).is_empty();
        let slot = self.slots().thermal.filter(conducts);
        slot.filter(|_| !self.is_prescribed)
    }

    /// Adds the damping to the viscosities.
    #[inline]
    pub(super) fn thicken(&mut self) {
        for damping in self.damping.as_ref() {
            for k in 0..M::DASHPOTS {
                self.viscosities.0[k] += damping.viscosities[k];
            }
        }
    }

    /// The viscosity of a dashpot without the damping, N s/m.
    #[inline]
    pub(super) fn own_viscosity(&self, k: usize) -> S {
        let damping = self.damping.as_ref().iter();
        damping.fold(self.viscosities.0[k], |eta, damping| {
            eta - damping.viscosities[k]
        })
    }

    /// Θ at a response, K; zero without temperature.
    #[inline]
    pub(super) fn conducting_temperature(&self, response: &M::Response) -> S {
        let theta = temperature_in::<S, M>(response);
        if !M::THERMAL {
            return theta;
        }
        let change = response[Self::ENTROPY];
        let damping = self.damping.as_ref().iter();
        damping.fold(theta, |theta, damping| {
            theta + damping.shift(change)[0] * change
        })
    }

    /// `∂(Θ − θ*)/∂Δs`, K²/J.
    #[inline]
    pub(super) fn shift_by_entropy(&self, response: &M::Response) -> S {
        let damping = self.damping.as_ref().iter();
        damping.fold(S::zero(), |sum, damping| {
            sum + damping.shift(response[Self::ENTROPY])[1]
        })
    }

    /// A form with Θ instead of θ*.
    #[inline]
    pub(super) fn conducting(&self, (response, tangent): &Form<S, M>) -> Form<S, M> {
        let (mut response, mut tangent) = (*response, *tangent);
        let by_entropy = self.shift_by_entropy(&response);
        response[Self::TEMPERATURE] = self.conducting_temperature(&response);
        let entropy_by = tangent[Self::ENTROPY];
        for column in 0..Self::VARIABLES {
            tangent[Self::TEMPERATURE][column] += by_entropy * entropy_by[column];
        }
        (response, tangent)
    }

    /// An error unless Θ is positive.
    #[inline]
    pub(super) fn check_conducting(&self, response: &M::Response) -> Result<(), StateError> {
        if !M::THERMAL || C::Damping::<()>::LEN == 0 {
            return Ok(());
        }
        check_temperature(self.element, self.conducting_temperature(response))
    }

    /// The entropy that the damping of heat produces in the step, `(Θ − θ*) Δs/Θ`, J/K; `None` without such damping.
    #[inline]
    pub(super) fn damping_production(&self, view: &StepView<'_, S>, per_theta: S) -> Option<S> {
        let damping = self.damping.as_ref().first()?;
        self.conducting_slot(view)?;
        let change = self.response[Self::ENTROPY];
        Some(damping.shift(change)[0] * (change * change) * per_theta)
    }
}

/// A stiffness of a dashpot with which no relaxation of the element alternates, N/m, given the second derivatives of ψ:
///
/// ```text
/// k = max(0, κ + Σ ‖∂²ψ/∂γ∂γ′‖),   κ = m + s √(n − 1),   m = tr H/n,   n s² = ‖H − m I‖²,   H = ∂²ψ/∂γ∂γ
/// ```
///
/// with Frobenius norms, and the sum over the other dashpots. A dashpot has n = 1 and κ = ∂²ψ/∂γ². The n components of a viscous
/// strain tensor count as one, so that k depends on no axes; κ is their stiffness if that is the same for all, and never below
/// the largest eigenvalue of H (Wolkowicz & Styan 1980). The sum is that of Gershgorin's bound.
fn stiffness_of<S: Real, M: FreeEnergy<S>>(dashpot: usize, hessian: &M::Hessian) -> S {
    let scalars = M::DASHPOTS - M::VISCOUS_STRAIN;
    let block = |dashpot: usize| {
        if dashpot < scalars {
            dashpot..dashpot + 1
        } else {
            scalars..M::DASHPOTS
        }
    };
    let own = block(dashpot);
    let at = |row: usize, column: usize| hessian[M::MEASURES + row][M::MEASURES + column];
    #[expect(clippy::cast_precision_loss, reason = "at most five")]
    let n = S::from_f64(own.len() as f64);
    let mean = own.clone().fold(S::zero(), |sum, k| sum + at(k, k)) / n;
    let square = |other: core::ops::Range<usize>, mean: S| {
        let mut sum = S::zero();
        for row in own.clone() {
            for column in other.clone() {
                let entry = at(row, column) - if row == column { mean } else { S::zero() };
                sum += entry * entry;
            }
        }
        sum
    };
    let mut stiffness = mean;
    if own.len() > 1 {
        stiffness += (square(own.clone(), mean) * (n - S::one()) / n).sqrt();
    }
    let mut other = 0;
    while other < M::DASHPOTS {
        let others = block(other);
        other = others.end;
        if others != own {
            stiffness += square(others, S::zero()).sqrt();
        }
    }
    stiffness.maximum(S::zero())
}

/// The rate at which conduction equalizes the temperature of a slot with paths at most, `Σ κ (1/c + 1/c_partner)`, 1/s.
pub(super) fn relaxation_rate<S: Real>(view: &StepView<'_, S>, slot: usize) -> S {
    let own = per_capacity(view, slot);
    let links = view.conduction.links(slot).iter();
    links.fold(S::zero(), |sum, link| {
        let partner = match link.partner {
            Partner::Slot(partner) => per_capacity(view, partner),
            Partner::Reservoir(_) => S::zero(),
        };
        sum + link.conductance * (own + partner)
    })
}

/// `1/c⁰` of a slot with paths, K/J; zero where a thermostat prescribes its temperature.
fn per_capacity<S: Real>(view: &StepView<'_, S>, slot: usize) -> S {
    if view.prescribed(slot, Placement::End).is_some() {
        return S::zero();
    }
    let element = view.conduction.owner(slot);
    view.state.energies[element].heat_capacity.recip()
}

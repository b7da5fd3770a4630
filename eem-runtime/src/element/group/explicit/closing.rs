//! Elements in the state that closes a step: temperatures from entropies, energies, and the rates with
//! which the next step begins.

use crate::element::conjugates::{Infeasible, Variational};
use crate::element::error::StateError;
use crate::element::group::arms::add_scaled;
use crate::element::group::explicit::closed::Closed;
use crate::element::group::explicit::group::FreeGroup;
use crate::element::group::explicit::rates::{Found, arms_of, pull_nodes};
use crate::element::group::explicit::view::{ClosingView, StageRates, StageView};
use crate::element::group::point::Point;
use crate::element::kinematics::{Arms, Kinematics};
use crate::material::free_energy::{Array, FreeEnergy, Rates};
use crate::material::inversion::temperature_near;
use crate::number::scalar::{Mask, Real, unless};

/// Evaluations of a temperature after which the safeguarded search takes over. Newton's method from the
/// temperature of the stages needs one or two.
const MOST_EVALUATIONS: usize = 6;

/// A correction of ln θ for which the guess is not nearly right.
const LARGEST_CORRECTION: f64 = 0.25;

/// The temperature at which a model was evaluated last, the corrected one, and what was evaluated.
type Settled<S, M, T> = (S, S, (Rates<<M as FreeEnergy<S>>::Variables>, T));

impl<S, M, K, const D: usize> FreeGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// See [`ExplicitGroup::close`](super::ExplicitGroup::close).
    pub(super) fn close_all(&mut self, view: &mut ClosingView<'_, S>) -> Result<(), StateError> {
        let mut closed = self.closed.iter_mut();
        let placed = self.components.iter().zip(&self.places);
        for (member, (&component, nodes)) in self.elements.members.iter().zip(placed) {
            if !view.open[component as usize] {
                closed.by_ref().take(member.points.as_ref().len()).count();
                continue;
            }
            let r = arms_of::<K, S, D>(nodes, view.positions);
            for (point, closed) in member.points.as_ref().iter().zip(&mut closed) {
                point.close_at(&r, component, view, closed)?;
            }
        }
        Ok(())
    }

    /// See [`ExplicitGroup::pull`](super::ExplicitGroup::pull).
    pub(super) fn pull_all(
        &self,
        asked: &[bool],
        forces: &mut [S],
        [creep, powers]: [&mut [S]; 2],
    ) {
        let mut closed = self.closed.iter();
        let placed = self.components.iter().zip(&self.places);
        for (member, (&component, nodes)) in self.elements.members.iter().zip(placed) {
            let mut pull = Arms::<K, S, D>::filled([S::zero(); D]);
            for (point, closed) in member.points.as_ref().iter().zip(&mut closed) {
                if asked[component as usize] {
                    for a in 0..M::MEASURES {
                        let force = closed.rates.forces[a];
                        add_scaled::<K, S, D>(&mut pull, force, &closed.gradient[a]);
                    }
                    for k in 0..M::DASHPOTS {
                        let g = closed.rates.forces[M::MEASURES + k];
                        let at = point.slots().viscous + k;
                        creep[at] = g / closed.viscosities.0[k];
                        powers[at] = g * creep[at];
                    }
                }
            }
            if asked[component as usize] {
                pull_nodes::<K, S, D>(nodes, &pull, forces);
            }
        }
    }

    /// See [`ExplicitGroup::finish`](super::ExplicitGroup::finish).
    pub(super) fn finish_all(
        &self,
        view: &StageView<'_, S>,
        rates: &mut StageRates<'_, S>,
    ) -> Result<(), StateError> {
        let mut closed = self.closed.iter();
        for (member, nodes) in self.elements.members.iter().zip(&self.places) {
            let motion = arms_of::<K, S, D>(nodes, rates.row);
            let mut pull = Arms::<K, S, D>::filled([S::zero(); D]);
            for (point, closed) in member.points.as_ref().iter().zip(&mut closed) {
                let theta = point.temperature_in(&view.y[view.offsets.temperatures..]);
                let (of_point, viscosities) = closed.at(theta);
                let found = Found {
                    theta,
                    rates: &of_point,
                    viscosities: &viscosities,
                    gradient: &closed.gradient,
                };
                if !point.write_rates(view, &motion, &found, rates, &mut pull) {
                    let r = arms_of::<K, S, D>(nodes, view.y);
                    let measures = point.kinematics.measure(&r);
                    return Err(point.refuse(&found, &r, &measures));
                }
            }
            pull_nodes::<K, S, D>(nodes, &pull, &mut rates.row[view.offsets.momenta..]);
        }
        Ok(())
    }
}

impl<S, M, K, const D: usize> Point<S, M, K, Variational, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Finds temperature and energy with these arms.
    #[inline]
    fn close_at(
        &self,
        r: &Arms<K, S, D>,
        component: u32,
        view: &mut ClosingView<'_, S>,
        closed: &mut Closed<S, M, K, D>,
    ) -> Result<(), StateError> {
        let measures = self.kinematics.measure(r);
        if !self.kinematics.is_admissible(r, &measures) {
            return Err(self.kinematics.refusal(self.element, r));
        }
        let theta = self.temperature_in(view.temperatures);
        let x = self.variables_at(&measures, view.viscous, theta);
        let at = self.model.rates_at(x);
        let thermal = self.slots().thermal;
        let is_held = thermal.is_some_and(|slot| view.held.get(slot).copied().unwrap_or(false));
        let (theta, settled, (rates, [entropy, psi])) = match thermal {
            Some(slot) if !is_held => {
                let entropy = view.next.entropies.values()[slot];
                self.temperature_of(&x, &at, [entropy, theta])?
            }
            _ => (theta, theta, at(theta)),
        };
        let waits = view.waits[component as usize];
        let found = Closed {
            theta,
            rates,
            viscosities: match M::DASHPOTS {
                0 => closed.viscosities,
                _ => self.model.viscosity(theta),
            },
            gradient: self.kinematics.gradient(r, &measures),
        };
        closed.replace(waits, found);
        self.unless_infinite(psi)?;
        let (mut energy, mut magnitude) = (psi, psi.abs());
        let keep = |old: S, new: S| unless(waits, old, new);
        if let Some(slot) = thermal {
            let kept = view.next.entropies.values()[slot];
            if is_held {
                view.next.entropies.set(slot, keep(kept, entropy));
            }
            let kept = view.next.entropies.values()[slot];
            let capacity = rates.forces[Self::TEMPERATURE];
            Infeasible::unless_stable(capacity, theta)
                .map_err(|infeasible| infeasible.of(self.element))?;
            // Stationary in θ at the kept entropy: the last correction of θ does not change it.
            energy = psi + theta * kept;
            magnitude = energy.abs() + theta * (kept.abs() + capacity);
            view.temperatures[slot] = keep(view.temperatures[slot], settled);
            view.capacities[slot] = keep(view.capacities[slot], capacity);
        }
        let sum = &mut view.energies[component as usize];
        sum.add(waits, [energy, magnitude]);
        let stored = &mut view.next.energies[self.element.index()];
        stored.value = keep(stored.value, energy);
        stored.magnitude = keep(stored.magnitude, magnitude);
        Ok(())
    }

    /// The temperature of an entropy near a guess by Newton's method in ln θ: the one at which the model
    /// was last evaluated, the corrected one, and what was evaluated.
    ///
    /// Of several numbers each stops where it would alone, and waits for the others.
    #[inline]
    fn temperature_of<T>(
        &self,
        x: &M::Variables,
        at: &impl Fn(S) -> (Rates<M::Variables>, T),
        [entropy, guess]: [S; 2],
    ) -> Result<Settled<S, M, T>, StateError>
    where
        T: Copy + AsRef<[S]>,
    {
        // √u, whose square is a rounding.
        let enough = (S::from_f64(0.5) * S::EPSILON).sqrt();
        let mut theta = guess;
        let (mut is_settled, mut is_lost) = (S::Mask::none(), S::Mask::none());
        for _ in 0..MOST_EVALUATIONS {
            let (rates, values) = at(theta);
            let capacity = rates.forces[Self::TEMPERATURE];
            let correction = (entropy - values.as_ref()[0]) / capacity;
            let size = correction.abs();
            let is_near = S::zero().less(capacity) & size.at_most(S::from_f64(LARGEST_CORRECTION));
            is_lost = is_lost | !is_near;
            is_settled = (is_settled | size.at_most(enough)) & !is_lost;
            if is_settled.all() {
                return Ok((theta, theta + theta * correction, (rates, values)));
            }
            if (is_settled | is_lost).all() {
                break;
            }
            let next = theta * correction.exp();
            theta = unless(is_settled | is_lost, theta, next);
        }
        self.search(x, at, [entropy, guess], (is_settled, theta))
    }

    /// The same from a guess that is not nearly right; for several numbers only where Newton's method has not
    /// settled on a temperature.
    #[cold]
    fn search<T: Copy + AsRef<[S]>>(
        &self,
        x: &M::Variables,
        at: &impl Fn(S) -> (Rates<M::Variables>, T),
        [entropy, guess]: [S; 2],
        (is_settled, settled): (S::Mask, S),
    ) -> Result<Settled<S, M, T>, StateError> {
        let caloric_at = self.model.caloric_at(*x);
        let enough = S::from_f64(0.5) * S::EPSILON.sqrt();
        let found = temperature_near(|theta| (caloric_at(theta).0, []), entropy, guess, enough);
        let (found, []) = found.map_err(|source| {
            let entropy = entropy.to_f64();
            Infeasible::Entropy { entropy, source }.of(self.element)
        })?;
        let theta = S::select(is_settled, settled, found);
        let (rates, values) = at(theta);
        let correction = (entropy - values.as_ref()[0]) / rates.forces[Self::TEMPERATURE];
        let corrected = S::select(is_settled, theta + theta * correction, theta);
        Ok((theta, corrected, (rates, values)))
    }
}

//! Elements in the state that closes a step: temperatures from entropies, energies, and the rates with
//! which the next step begins.

use crate::element::conjugates::{Infeasible, PointRule};
use crate::element::error::StateError;
use crate::element::group::arms::add_scaled;
use crate::element::group::explicit::closed::Closed;
use crate::element::group::explicit::group::FreeGroup;
use crate::element::group::explicit::rates::{Found, arms_of, pull_nodes};
use crate::element::group::explicit::temperature::Settled;
use crate::element::group::explicit::view::{ClosingView, StageRates, StageView};
use crate::element::group::point::Point;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::state::Energy;
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::{Real, unless};

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> FreeGroup<S, M, K, D> {
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

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> Point<S, M, K, PointRule, D> {
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
        let waits = view.waits[component as usize];
        let theta = self.temperature_in(view.temperatures);
        let x = self.variables_at(&measures, view.viscous, theta);
        let at = self.model.rates_at(x);
        let thermal = self.slots().thermal;
        let free = thermal.filter(|&slot| !view.held.get(slot).copied().unwrap_or(false));
        let settled = match free.map(|slot| view.next.entropies.values()[slot]) {
            Some(entropy) => self.temperature_of(&x, &at, [entropy, theta], view.unkept)?,
            None => Settled::given(theta, at(theta)),
        };
        let theta = settled.theta;
        let (rates, [entropy, psi]) = settled.evaluated;
        let mut found = Closed {
            theta,
            rates,
            viscosities: match M::DASHPOTS {
                0 => closed.viscosities,
                _ => self.model.viscosity(theta),
            },
            gradient: self.kinematics.gradient(r, &measures),
            values: closed.values,
        };
        self.unless_infinite(psi)?;
        let mut energy = Energy::without_temperature(psi);
        if let Some(slot) = thermal {
            let mut kept = view.next.entropies.values()[slot];
            if free.is_none() {
                kept = unless(waits, kept, entropy);
                view.next.entropies.set(slot, kept);
            }
            let capacity = rates.forces[Self::TEMPERATURE];
            Infeasible::unless_stable(capacity, theta)
                .map_err(|infeasible| infeasible.of(self.element))?;
            // Stationary in θ at the kept entropy: the last correction of θ does not change it.
            energy.value = psi + theta * kept;
            let heat = theta * (kept.abs() + capacity);
            energy.magnitude = energy.value.abs() + heat;
            energy.terms += heat;
            view.keep_heat(slot, waits, [settled.corrected, capacity, settled.bend]);
        }
        self.add_bounds_of(r, x, &mut found, &mut energy);
        closed.replace(waits, found);
        self.write_energy(component, &energy, view);
        Ok(())
    }

    /// Adds what the bounds ask of a state with these arms, whose temperature and forces have been found.
    #[inline]
    fn add_bounds_of(
        &self,
        r: &Arms<K, S, D>,
        mut x: M::Variables,
        found: &mut Closed<S, M, K, D>,
        energy: &mut Energy<S>,
    ) {
        energy.add_forces(self.work_of(&found.rates.forces, r, &x));
        let theta = found.theta;
        energy.add_values(found.values.update(energy.terms, || {
            if M::THERMAL {
                x[Self::TEMPERATURE] = theta;
            }
            self.model.energy_magnitude(&x)
        }));
    }

    /// Writes the energy in a new state and adds it to that of the component, except for numbers that wait.
    #[inline]
    fn write_energy(&self, component: u32, energy: &Energy<S>, view: &mut ClosingView<'_, S>) {
        let waits = view.waits[component as usize];
        view.energies[component as usize].add(waits, energy);
        let stored = &mut view.next.energies[self.element.index()];
        stored.value = unless(waits, stored.value, energy.value);
        stored.magnitude = unless(waits, stored.magnitude, energy.magnitude);
        stored.terms = unless(waits, stored.terms, energy.terms);
        stored.excess = unless(waits, stored.excess, energy.excess);
    }
}

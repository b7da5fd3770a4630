//! Rates and targets of a state from which nothing is known yet: the first, or one that was changed.

use super::components::Component;
use super::components::Support;
use super::memory::Target;
use super::memory::{END, START};
use super::stages::From;
use super::vector::{Origin, add};
use super::{Explicit, ExplicitView};
use crate::algebra::bivector::Bivector;
use crate::element::group::{ComponentEnergy, points};
use crate::element::state::State;
use crate::step::error::StepFailure;
use eem_material::number::compensated::Sum;
use eem_material::number::scalar::Real;

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Takes the start of a step from a state.
    pub(super) fn load(&mut self, view: &ExplicitView<'_, S, D>) {
        let (state, offsets) = (view.state, self.offsets);
        let nodes = &self.components.nodes;
        let y0 = &mut self.y0;
        let (moving, internal) = y0.split_at_mut(offsets.viscous);
        let (positions, momenta) = moving.split_at_mut(offsets.momenta);
        let placed = positions.as_chunks_mut::<D>().0.iter_mut();
        let placed = placed.zip(momenta.as_chunks_mut::<D>().0);
        let old = points::<S, D>(state.positions.values());
        let old_momenta = points::<S, D>(state.momenta.values());
        for ((position, momentum), &node) in placed.zip(nodes) {
            *position = old[node as usize];
            *momentum = old_momenta[node as usize];
        }
        let (viscous, temperatures) = internal.split_at_mut(offsets.temperatures - offsets.viscous);
        let (temperatures, reservoirs) =
            temperatures.split_at_mut(offsets.reservoirs - offsets.temperatures);
        viscous.copy_from_slice(state.viscous.values());
        temperatures.copy_from_slice(&state.temperatures);
        let (reservoirs, _) = reservoirs.split_at_mut(offsets.size - offsets.reservoirs);
        reservoirs.copy_from_slice(&view.conduction.reservoirs);
    }

    /// Finds rates and targets of a state that is loaded.
    pub(super) fn prepare(&mut self, view: &ExplicitView<'_, S, D>) -> Result<(), StepFailure> {
        self.y.copy_from_slice(&self.y0);
        self.evaluate_loads(view, view.state.time.value)?;
        self.find_rates(0, From::Model, END)?;
        core::mem::swap(&mut self.start, &mut self.end);
        self.rows.swap(START, END);
        self.set_targets(view.state);
        self.is_ready = true;
        Ok(())
    }

    /// Sums the energies of the elements of a state.
    fn sum_energies(&mut self, state: &State<S>) {
        self.scratch.energies.fill(ComponentEnergy::none());
        let elements = self.components.of_element.iter().zip(&state.energies);
        for (&component, energy) in elements {
            let sum = &mut self.scratch.energies[component as usize];
            sum.value.add(energy.value);
            sum.magnitude += energy.magnitude;
        }
    }

    /// Energy and momenta of the state are what they have to be from now on.
    fn set_targets(&mut self, state: &State<S>) {
        self.books.shares.write(|shares| shares.fill(S::zero()));
        (self.books.largest_momentum, self.books.residue) = (S::zero(), S::zero());
        self.books.terms = None;
        self.new_books.copy_from(&self.books);
        self.sum_energies(state);
        for slot in 0..self.held.len() {
            let element = self.components.elements[slot] as usize;
            self.books.held_energies[slot] = state.energies[element].value;
        }
        for index in 0..self.components.all.len() {
            self.books.targets[index] = Target::none();
            self.new_books.targets[index] = Target::none();
            let [energy, ..] = self.energy_of(index);
            let component = &self.components.all[index];
            let momenta = self.origin(component);
            let momenta = momenta.map(|origin| self.momenta_about(component, &origin));
            let (linear, angular) = momenta.unwrap_or(([S::zero(); D], Bivector::zero()));
            let mut target = Target::none();
            target.energy = Sum::new(energy);
            for (sum, value) in target.linear.iter_mut().zip(linear) {
                *sum = Sum::new(value);
            }
            target.angular = angular.map(Sum::new(S::zero()), Sum::new);
            self.books.targets[index] = target;
        }
    }

    /// The point about which a component keeps its angular momentum: its anchor or its centre of mass; none with
    /// several anchors.
    pub(super) fn origin(&self, component: &Component<S>) -> Option<Origin<S, D>> {
        self.origin_in(component, points::<S, D>(&self.y[..self.offsets.momenta]))
    }

    /// The same for other positions than those of the present stage vector.
    pub(super) fn origin_in(
        &self,
        component: &Component<S>,
        positions: &[[S; D]],
    ) -> Option<Origin<S, D>> {
        match component.support {
            Support::Free => {
                let masses = component.masses.clone();
                let masses = masses.map(|place| (self.masses[place], &positions[place]));
                Some(Origin::center(masses, component.mass))
            }
            Support::Anchor(place) => Some(Origin::at(&positions[place])),
            Support::Several => None,
        }
    }

    /// Linear momentum, and angular momentum about the anchor, or about the centre of mass.
    pub(super) fn momenta_about(
        &self,
        component: &Component<S>,
        origin: &Origin<S, D>,
    ) -> ([S; D], Bivector<S, D>) {
        let positions = points::<S, D>(&self.y[..self.offsets.momenta]);
        let momenta = points::<S, D>(&self.y[self.offsets.momenta..self.offsets.viscous]);
        let (mut linear, mut angular) = ([S::zero(); D], Bivector::zero());
        for place in component.masses.clone() {
            let arm = origin.arm(&positions[place]);
            add(&mut linear, S::one(), &momenta[place]);
            angular.add(S::one(), &Bivector::wedge(&arm, &momenta[place]));
        }
        (linear, angular)
    }
}

//! The adjoint of a step at its points: the transposed local equations and their elimination.
//!
//! With the weights w of the equations of a step (see `step/adjoint.rs`), the local unknowns are the weights of `R_γ` and `R_s`,
//!
//! ```text
//! Aᵀ w_u = λ_u − Bᵀ (h D*π·w_v) + (∂θ*/∂u) (w_Θ + s)      A = ∂r_u/∂u,  B = ∂f*/∂u,  s = Σ λ_σ h κ_r/θ_r
//! ```
//!
//! for u = (γ, θ). They have the form of the local equations of a step with numbers per measure, `h D*π·w_v`, and per
//! interface temperature, `w_Θ`, and are eliminated like them. The rest of `wᵀ ∂R/∂x¹` is added, transposed, at the matrix
//! indices of a step.

mod condensed;
mod weights;

use super::arms::{scale, spread};
use super::element_group::ElementGroup;
use super::evaluate::in_rounds;
use super::member::Member;
use super::point::temperature_in;
use super::point_step::{PastStep, PerVariable, SeeParameters, StepBack, StepWeights};
use super::pose::Pose;
use super::share::{Heat, Momentum, Share};
use super::site::{Contact, Site, paths_of};
use crate::algebra::system::LinearSystem;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Exact, Family};
use crate::element::error::StateError;
use crate::element::kinematics::{Arms, Kinematics, Points};
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use weights::Surroundings;

impl<A: Arrays, K: Kinematics<D>, const D: usize> ElementGroup<A, K, D> {
    /// Finds the interface temperatures θ* of a step. Points that have one return to the states of the step.
    pub(super) fn find_interfaces(
        &mut self,
        step: &PastStep<'_>,
        interface: &mut InterfaceTemperatures,
    ) -> Result<(), StateError> {
        for member in &mut self.members {
            let arms = member.past_arms(step);
            for point in member.points.as_mut() {
                if let Some(slot) = point.slots().thermal
                    && point.contact_in(&self.contacts).is_some()
                {
                    point.return_to(step, &arms)?;
                    let (model, corners) = (&point.model, &point.corners);
                    let response =
                        point
                            .start
                            .response::<Exact>(point.scheme, model, &point.x, corners);
                    interface.set(slot, temperature_in::<A>(&response));
                }
            }
        }
        Ok(())
    }

    /// Adds `(∂R/∂x¹)ᵀ` of a step and the right-hand side, local weights eliminated, to a system.
    pub(super) fn pull_back(
        &mut self,
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let (values, right) = system.parts();
        let contacts = &self.contacts;
        let of_one = |member: &mut Member<A, K, D>, share: &mut Share<K, D>| {
            member.pull_back(contacts, step, interface, share)
        };
        let mut add = |member: &Member<A, K, D>, share: &Share<K, D>| {
            member.add_transposed(share, contacts, (&mut *values, &mut *right));
        };
        if const { K::PerPoint::<()>::LEN > 1 } {
            return in_rounds(&mut self.members, &mut self.shares, &of_one, &mut add);
        }
        for member in &mut self.members {
            let mut share = Share::none();
            of_one(member, &mut share)?;
            add(member, &share);
        }
        Ok(())
    }

    /// Finds the derivatives with respect to the old state and to the parameters, given the solution of that system.
    pub(super) fn recover(
        &mut self,
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        solution: &[[f64; 1]],
        (by_old, weights): (&mut PerVariable, &mut StepWeights),
        see: &mut SeeParameters<'_>,
    ) {
        let h = step.past.view.step;
        let mut workspaces = [const { Vec::new() }; 2];
        for member in &mut self.members {
            let w = member.site.motion_in(solution);
            let arms = member.past_arms(&step.past);
            let is_held = member.site.is_mass.as_ref().contains(&false);
            let mut by_arms = [Arms::<K, D>::filled([0.0; D]); 2];
            for point in member.points.as_mut() {
                let contact = point.contact_in(&self.contacts);
                let around = Surroundings {
                    step,
                    interface,
                    paths: paths_of(contact),
                    theta: contact.map_or(0.0, |own| solution[own.unknown as usize][0]),
                };
                let [by_end, by_start] = &mut by_arms;
                let ends = point.ends(arms);
                let along = point.kinematics.discrete_rates(&ends, &w);
                let of_point = point.weigh(&around, &along);
                let by = point.by_old(&of_point.rho, &of_point.increments);
                let back = point.ends_back(arms);
                point.add_by_arms(&back, &by, &w, h, by_start);
                if is_held {
                    let by = point.by_new(&of_point.rho, &of_point.increments);
                    point.add_by_arms(&ends, &by, &w, h, by_end);
                }
                point.write(&by, &of_point, by_old, weights);
                weights.by_size.add_all(&of_point.by_size);
                see(
                    point.element,
                    point.by_parameters(&of_point, &mut workspaces),
                );
            }
            let [by_end, by_start] = by_arms;
            member
                .site
                .subtract(&by_start, false, &mut by_old.positions);
            if is_held {
                member.site.subtract(&by_end, true, &mut by_old.positions);
                let [old, new] = &mut weights.anchors;
                member.site.subtract(&by_start, true, old);
                member.site.subtract(&by_end, true, new);
            }
        }
    }

    /// Passes the derivatives of the internal energies with respect to the parameters in a state to `see`.
    pub(super) fn energy_by_parameters(&self, state: &State, see: &mut SeeParameters<'_>) {
        let mut found = Vec::new();
        for member in &self.members {
            for point in member.points.as_ref() {
                let x = point.variables_in(&member.arms_in(state), state);
                found.resize(point.model.facts().derivatives, 0.0);
                point.model.energy_by_parameters(&x, &mut found);
                see(point.element, &found);
            }
        }
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// The contribution of its points to the transposed system.
    #[inline]
    fn pull_back(
        &mut self,
        contacts: &[Contact<K, D>],
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        share: &mut Share<K, D>,
    ) -> Result<(), StateError> {
        let (past, arms) = (&step.past, self.past_arms(&step.past));
        share.momentum = None;
        for (point, heat) in self.points.as_mut().iter_mut().zip(share.heat.as_mut()) {
            let contact = point.contact_in(contacts);
            if contact.is_none() {
                point.return_to(past, &arms)?;
            }
            let form = point.tangent_in(past.view.per_step)?;
            let reduced = point.condense_transposed(step, interface, &form, paths_of(contact))?;
            let pose = Pose::new(
                &point.kinematics,
                Exact::placement(point.scheme),
                point.ends(arms),
            );
            *heat = contact.map(|_| point.heat_transposed(past.view.step, &pose, &reduced));
            point.add_transposed(
                past.view.step,
                &pose,
                (&form, &reduced),
                &mut share.momentum,
            );
        }
        Ok(())
    }

    /// Adds the contribution to the entries of Aᵀ and the rows of B.
    #[inline]
    fn add_transposed(
        &self,
        share: &Share<K, D>,
        contacts: &[Contact<K, D>],
        (values, right): (&mut [f64], &mut [[f64; 1]]),
    ) {
        let heats = share.heat.as_ref().iter().zip(self.points.as_ref());
        for (heat, point) in heats {
            if let (Some(heat), Some(contact)) = (heat, point.contact_in(contacts)) {
                contact.add_transposed(&self.site, heat, (&mut *values, &mut *right));
            }
        }
        if let Some(momentum) = &share.momentum {
            self.site
                .add_transposed(momentum, right.as_flattened_mut(), values);
        }
    }
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// Adds transposed blocks.
    #[inline]
    fn add_transposed(&self, momentum: &Momentum<K, D>, right: &mut [f64], values: &mut [f64]) {
        self.subtract_arms(&momentum.pull, &self.rows, right);
        for (j, row) in momentum.blocks.as_ref().iter().enumerate() {
            for (i, block) in row.as_ref().iter().enumerate() {
                let mut transposed = *block;
                for (row, entries) in transposed.iter_mut().enumerate() {
                    for (entry, of) in entries.iter_mut().zip(block) {
                        *entry = of[row];
                    }
                }
                self.add_block([i + 1, j + 1], &transposed, values);
            }
        }
    }

    /// Subtracts derivatives with respect to the arms from those to the positions of all nodes, or of anchors only.
    #[inline]
    fn subtract(&self, by_arm: &Arms<K, D>, only_anchors: bool, target: &mut [f64]) {
        let target = target.as_chunks_mut::<D>().0;
        let by_node = spread::<K, D>(by_arm);
        let nodes = self.nodes.as_ref().iter().zip(self.is_mass.as_ref());
        for ((&node, &is_mass), by) in nodes.zip(by_node.as_ref()) {
            if is_mass && only_anchors {
                continue;
            }
            for (sum, &by) in target[node as usize].iter_mut().zip(by) {
                *sum -= by;
            }
        }
    }
}

impl<K: Kinematics<D>, const D: usize> Contact<K, D> {
    /// Adds the transposed equations of interface temperatures, see [`Point::heat_transposed`].
    fn add_transposed(
        &self,
        site: &Site<K, D>,
        heat: &Heat<K, D>,
        (values, right): (&mut [f64], &mut [[f64; 1]]),
    ) {
        site.add_column(&self.column, &heat.by_arm, values);
        let mut sum = 0.0;
        for (path, partner) in self.paths.iter().zip(&self.partners) {
            let conductance = path.conductance;
            sum += conductance;
            let mut pull = heat.pull;
            scale::<K, D>(&mut pull, conductance);
            site.subtract_arms(&pull, &partner.row, values);
            values[path.entry_back as usize] -= conductance * heat.slope;
            right[path.unknown as usize][0] += conductance * heat.residual;
        }
        let mut pull = heat.pull;
        scale::<K, D>(&mut pull, -sum);
        site.subtract_arms(&pull, &self.row, values);
        values[self.diagonal as usize] += 1.0 + sum * heat.slope;
        right[self.unknown as usize][0] -= sum * heat.residual;
    }
}

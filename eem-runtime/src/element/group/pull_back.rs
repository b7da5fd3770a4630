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

use super::arms::{add_scaled, scale, spread};
use super::element_group::ElementGroup;
use super::evaluate::in_rounds;
use super::member::{Block, Member};
use super::placed::PlacedPoint;
use super::point_step::{
    PastStep, PerVariable, Reduced, SeeParameters, StepBack, StepWeights, Surroundings,
};
use super::points::PointSet;
use super::pose::Pose;
use super::share::{Contacts, Heat, Momentum, Share};
use super::site::{ContactSite, HeatContact, Site, paths_of};
use crate::algebra::system::LinearSystem;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Family, Placement};
use crate::element::error::StateError;
use crate::element::kinematics::{Arms, Ends, Gradient, Kinematics, Measures, QuadraticStrain};
use eem_material::free_energy::Array;
use eem_material::number::compact::compact;

impl<K, P, C, const D: usize> ElementGroup<K, P, C, D>
where
    K: QuadraticStrain<D>,
    P: ?Sized + PointSet<K::Measures>,
    C: Family,
{
    /// Finds the interface temperatures θ* of a step. Points that have one return to the states of the step.
    pub(super) fn find_interfaces(
        &mut self,
        step: &PastStep<'_>,
        interface: &mut InterfaceTemperatures,
    ) -> Result<(), StateError> {
        for Block { members, points } in &mut self.elements.blocks {
            let mut index = 0;
            for member in members {
                let arms = member.past_arms(step);
                for point in member.points.as_ref() {
                    let (_, slots) = points.place(index);
                    if let Some(slot) = slots.thermal
                        && self.contacts.heat.get(points.contact(index)).is_some()
                    {
                        let ends = point.past_ends(arms);
                        let theta = points.find_interface(index, step, ends.measures.each_ref())?;
                        interface.set(slot, theta);
                    }
                    index += 1;
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
        if const { Member::<K, D>::POINTS == 1 } {
            for Block { members, points } in &mut self.elements.blocks {
                for (index, member) in members.iter_mut().enumerate() {
                    let mut share = Share::none();
                    member.pull_back(
                        (index, &mut **points),
                        contacts,
                        (step, interface),
                        &mut share,
                    )?;
                    member.add_transposed(&share, contacts, (&mut *values, &mut *right));
                }
            }
            return Ok(());
        }
        let of_one = |block: &mut Block<K, P, D>, share: &mut Share<K, D>| {
            let (points, at) = (&mut *block.points, (step, interface));
            let mut members = block.members.iter_mut().enumerate();
            members.try_for_each(|(index, member)| {
                member.pull_back((index, points), contacts, at, share)
            })
        };
        let mut add = |block: &Block<K, P, D>, share: &Share<K, D>| {
            for member in &block.members {
                member.add_transposed(share, contacts, (&mut *values, &mut *right));
            }
        };
        in_rounds(
            &mut self.elements.blocks,
            &mut self.shares,
            &of_one,
            &mut add,
        )
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
        for Block { members, points } in &mut self.elements.blocks {
            let mut index = 0;
            for member in members {
                let w = member.site.motion_in(solution);
                let arms = member.past_arms(&step.past);
                let is_held = member.site.is_mass.as_ref().contains(&false);
                let mut by_arms = [Arms::<K, D>::filled([0.0; D]); 2];
                for point in member.points.as_ref() {
                    let contact = self.contacts.heat.get(points.contact(index));
                    let around = Surroundings {
                        step,
                        interface,
                        paths: paths_of(contact),
                        theta: contact.map_or(0.0, |own| solution[own.unknown as usize][0]),
                    };
                    let [by_end, by_start] = &mut by_arms;
                    let kinematics = &point.kinematics;
                    let past = point.past_ends(arms);
                    let ends = past.forward(kinematics);
                    let along = kinematics.discrete_rates(&ends, &w);
                    let found = (&mut *by_old, &mut *weights);
                    let of_point = points.weigh(index, &around, (&along, is_held), found, see);
                    let mut forces = of_point.forces;
                    for force in forces.as_mut() {
                        *force *= h;
                    }
                    let add = |ends: &Ends<K, D>, by: &Measures<K, D>, sum: &mut Arms<K, D>| {
                        let pulled = kinematics.pull_back(ends, by, (&forces, &w));
                        add_scaled::<K, D>(sum, 1.0, &pulled);
                    };
                    add(&past.back(kinematics), &of_point.by_old, by_start);
                    if is_held {
                        add(&ends, &of_point.by_new, by_end);
                    }
                    index += 1;
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
    }
}

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// Finds the contribution of the element to the transposed system.
    #[inline]
    fn pull_back<P: ?Sized + PointSet<K::Measures>>(
        &mut self,
        (index, points): (usize, &mut P),
        contacts: &Contacts<K, D>,
        (step, interface): (&StepBack<'_>, &InterfaceTemperatures),
        share: &mut Share<K, D>,
    ) -> Result<(), StateError> {
        let arms = self.past_arms(&step.past);
        let first = index * Self::POINTS;
        share.momentum = None;
        let own = self.points.as_ref().iter().zip(share.heat.as_mut());
        for (index, (point, heat)) in (first..).zip(own) {
            let contact = contacts.heat.get(points.contact(index));
            let past = point.past_ends(arms);
            let around = (interface, contact);
            let measures = past.measures.each_ref();
            let reduced = points.condense_transposed(index, step, around, measures)?;
            let ends = past.forward(&point.kinematics);
            let pose = Pose::new(&point.kinematics, Placement::Ends, ends);
            let h = step.past.view.step;
            let own = compact(points.contact(index));
            *heat = contact.map(|_| heat_transposed((own, h), &pose, &reduced));
            point.add_transposed(h, &pose, &reduced, &mut share.momentum);
        }
        Ok(())
    }

    /// Adds the contribution to the entries of Aᵀ and the rows of B.
    #[inline]
    fn add_transposed(
        &self,
        share: &Share<K, D>,
        contacts: &Contacts<K, D>,
        (values, right): (&mut [f64], &mut [[f64; 1]]),
    ) {
        for heat in share.heat.as_ref().iter().flatten() {
            let (contact, own) = contacts.at(heat.contact);
            own.add_transposed(contact, &self.site, heat, (&mut *values, &mut *right));
        }
        if let Some(momentum) = &share.momentum {
            self.site
                .add_transposed(momentum, right.as_flattened_mut(), values);
        }
    }
}

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    /// Adds the derivatives of `wᵀR` with respect to the arms: the constant part, and that linear in `w_v`, its rows.
    #[inline]
    fn add_transposed(
        &self,
        step: f64,
        pose: &Pose<K, D>,
        reduced: &Reduced<K::Measures>,
        sum: &mut Option<Momentum<K, D>>,
    ) {
        let (kinematics, at) = (&self.kinematics, Placement::Ends);
        let mut forces = Measures::<K, D>::filled(0.0);
        let mut by_arm = pose.sensitivity;
        for a in 0..Measures::<K, D>::LEN {
            forces[a] = step * reduced.forces[a];
            by_arm[a] = combined::<K, D>(&pose.sensitivity, &reduced.moduli[a], step);
        }
        let pull = combined::<K, D>(&pose.sensitivity, &reduced.constant, 1.0);
        match sum {
            None => {
                *sum = Some(Momentum {
                    pull,
                    blocks: pose.tangent(kinematics, at, &forces, &by_arm),
                });
            }
            Some(sum) => {
                add_scaled::<K, D>(&mut sum.pull, 1.0, &pull);
                pose.add_tangent(kinematics, at, (&forces, &by_arm), &mut sum.blocks);
            }
        }
    }
}

/// The terms of the interface temperatures of a point, its own and its partners': `by_arm` is the derivative of `wᵀR` with respect
/// to `w_Θ` and the arms. `−(∂R_s/∂Q) w_s` is `pull` times `w_v` plus `slope` times `w_Θ` plus `residual`.
fn heat_transposed<K: Kinematics<D>, const D: usize>(
    (contact, step): (u32, f64),
    pose: &Pose<K, D>,
    reduced: &Reduced<K::Measures>,
) -> Heat<K, D> {
    let (own, factor) = (&reduced.own_weight, reduced.heat_factor);
    Heat {
        contact,
        residual: factor * own.value,
        by_arm: combined::<K, D>(&pose.sensitivity, &reduced.by_heat, 1.0),
        slope: factor * own.by_heat,
        pull: combined::<K, D>(&pose.direction, &own.by_measure, step * factor),
    }
}

/// `factor Σ_b slopes_b rows_b`.
#[inline]
fn combined<K: Kinematics<D>, const D: usize>(
    rows: &Gradient<K, D>,
    slopes: &Measures<K, D>,
    factor: f64,
) -> Arms<K, D> {
    let mut sum = Arms::<K, D>::filled([0.0; D]);
    for (row, &slope) in rows.as_ref().iter().zip(slopes.as_ref()) {
        add_scaled::<K, D>(&mut sum, factor * slope, row);
    }
    sum
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

impl<K: Kinematics<D>, const D: usize> ContactSite<K, D> {
    /// Adds the transposed equations of interface temperatures, see [`heat_transposed`].
    fn add_transposed(
        &self,
        contact: &HeatContact,
        site: &Site<K, D>,
        heat: &Heat<K, D>,
        (values, right): (&mut [f64], &mut [[f64; 1]]),
    ) {
        site.add_column(&self.column, &heat.by_arm, values);
        let mut sum = 0.0;
        for (path, partner) in contact.paths.iter().zip(&self.partners) {
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
        values[contact.diagonal as usize] += 1.0 + sum * heat.slope;
        right[contact.unknown as usize][0] -= sum * heat.residual;
    }
}

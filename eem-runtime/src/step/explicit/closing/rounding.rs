//! What rounding explains of the energy that a component lacks.
//!
//! The energy is closed to some roundings of its terms at the end of the step. Where no correction is possible, a defect is
//! accepted up to `8 ε` of
//!
//! ```text
//! Σ |terms of E¹| + Σ |F||q|
//! ```
//!
//! as the positions q are rounded to ε of their coordinates. Near rest the forces F, the momenta and with them these terms
//! vanish, but not the rounding of q and of viscous stretches γ: it is then `k ε |q|` of a force, with the energy
//! `k (ε |q|)²`, however small all energies are. Nor do the momenta at the start of a step and the work in it vanish where a body is
//! brought to rest. Counted are, then, the terms A* of the [certificate](crate::step::certificate), too:
//!
//! ```text
//! T⁰ + |work| + Σ |g||γ| + ε Σ k |q|²
//! ```
//!
//! with the stiffness k of each element and the coordinates of its masses. They are found only where the others are not
//! enough. What is accepted for them is no debt of later steps, of which it is not the rounding.

use super::super::vector::dot;
use super::super::{Explicit, ExplicitView};
use super::{FROZEN, Status};

impl<const D: usize> Explicit<D> {
    /// Closed if the remaining defect is rounding, failed otherwise.
    pub(super) fn unless_rounding(&mut self, index: usize, view: &ExplicitView<'_, D>) -> Status {
        let progress = &self.scratch.progress[index];
        let (defect, scale) = (progress.defect, progress.scale);
        let mut granularity = self.granularity(index);
        let is_rounding = |terms: f64| defect.abs() <= FROZEN * f64::EPSILON * (scale + terms);
        let mut is_closed = is_rounding(granularity);
        let mut is_forgiven = false;
        if !is_closed {
            granularity += self.terms_at_rest(index, view);
            is_forgiven = is_rounding(granularity);
            is_closed = is_forgiven;
        }
        let progress = &mut self.scratch.progress[index];
        progress.granularity = granularity;
        progress.is_forgiven = is_forgiven;
        progress.is_closed = is_closed;
        if is_closed {
            Status::Closed
        } else {
            Status::Failed
        }
    }

    /// What rounding explains of the energy of a component of this magnitude, J.
    #[cold]
    pub(in super::super) fn explained(
        &mut self,
        index: usize,
        magnitude: f64,
        view: &ExplicitView<'_, D>,
    ) -> f64 {
        self.scratch.needs_forces.fill(false);
        self.scratch.needs_forces[index] = true;
        self.find_forces(view);
        let terms = self.granularity(index) + self.terms_at_rest(index, view);
        FROZEN * f64::EPSILON * (magnitude + terms)
    }

    /// `Σ |F||q|`: times ε, the error of the energy by rounding of positions, J.
    fn granularity(&self, index: usize) -> f64 {
        let masses = self.components.all[index].masses.clone();
        masses.fold(0.0, |sum, at| {
            let terms = self.scratch.forces[at]
                .iter()
                .zip(self.stage.places[at].q());
            terms.fold(sum, |sum, (&force, &q)| sum + (force * q).abs())
        })
    }

    /// `T⁰ + |work| + Σ |g||γ| + ε Σ k |q|²`: terms that do not vanish with the energy, J.
    #[cold]
    fn terms_at_rest(&mut self, index: usize, view: &ExplicitView<'_, D>) -> f64 {
        self.find_stiffnesses(view);
        let loads = self.load_sums.get(index);
        let mut sum = loads.map_or(0.0, |sums| (view.step * sums.work).abs());
        for at in self.components.all[index].masses.clone() {
            let place = &self.stage.places[at];
            let start = &place.past.start[1];
            let stiffness = self.scratch.stiffnesses[self.components.nodes[at] as usize];
            sum += 0.5 * dot(start, start) * place.per_mass;
            sum += f64::EPSILON * stiffness * dot(place.q(), place.q());
        }
        for (dashpot, own) in self.components.dashpots.iter().enumerate() {
            let [rate, power] = self.scratch.creep[dashpot];
            if own.component as usize == index && rate != 0.0 {
                let stretch = self.stage.inner[dashpot].now;
                sum += (power / rate * stretch).abs();
            }
        }
        sum
    }

    /// Sums the stiffnesses of the elements at each node, once in a step.
    fn find_stiffnesses(&mut self, view: &ExplicitView<'_, D>) {
        if self.scratch.has_stiffnesses {
            return;
        }
        self.scratch.has_stiffnesses = true;
        let sums = &mut self.scratch.stiffnesses;
        sums.fill(0.0);
        for group in &self.groups {
            group.elements().stiffness(view.state, &mut |point| {
                for &node in point.nodes {
                    sums[node as usize] += point.elastic;
                }
            });
        }
    }
}

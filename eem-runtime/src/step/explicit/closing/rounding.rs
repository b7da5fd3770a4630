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
//! brought to rest. Counted are, then, the terms A* and A⁺ of the [certificate](crate::step::certificate), too, with both ends:
//!
//! ```text
//! T⁰ + |work| + Σ (|f⁰|λ⁰ + |f¹|λ¹ + |g⁰||γ⁰| + |g¹||γ¹|) + Σ k |q| (|Δq| + ε |q|) + Σ g̃ (|Δγ| + ε |γ|)
//! ```
//!
//! with the stiffness k of each element, the coordinates of its nodes, masses and anchors, and the terms `g̃ = Σ |∂g/∂q||q| + |∂g/∂γ||γ|` of
//! the force of a dashpot. The velocity of a moved anchor is the
//! slope of a polynomial through its positions x, of which each is rounded: `½ε Σ_m |ℓ'_m||x|/h`, with up to 200 as the sum. Its work
//! in a step has the rounding
//!
//! ```text
//! ½ε Σ_j |b_j| Σ_m |ℓ'_m(c_j)| |f_j − f⁰||x|
//! ```
//!
//! Where loads are functions of time, the work that the rounding of time explains counts, too. All are found only where the others are not
//! enough. What is accepted for them is no debt of later steps, of which it is not the rounding.
//!
//! Nor is a debt the fault of the step that finds no motion left to pay it: after a bump, when all has come to rest but the last bits. Where
//! loads or dashpots change the energy, a component is closed, then, if what this step adds to the debt is the rounding of these terms, and
//! the debt is forgiven.
//!
//! Motion beside a large energy, a small vibration beside a prestress, is not told by that energy. There a defect is not corrected, though it
//! could be, up to `8 ε` of
//!
//! ```text
//! A¹ = Σ |terms of E¹| + Σ (|f¹|λ¹ + |g¹||γ¹|)
//! ```
//!
//! if step control would feel the correction and no anchor is moved. It stays a debt, so that the energy does not drift: what is more than
//! rounding is corrected. The work of moved anchors changes the prestress, which a debt would outlive.

use super::super::accounts::Accounts;
use super::super::bodies::Bodies;
use super::super::memory::Motion;
use super::{FROZEN, Status};
use crate::algebra::{dot, size};
use crate::element::group::ComponentEnergy;
use eem_material::number::scalar::Scalar;

impl Accounts {
    /// Closes a component whose defect is the rounding of its energies; returns whether it is.
    pub(super) fn leave_rounding(&mut self, index: usize) -> bool {
        let (inner, progress) = (
            &self.scratch.energies[index],
            &mut self.scratch.progress[index],
        );
        let forces = Scalar::maximum(inner.terms - inner.magnitude, 0.0);
        let terms = progress.scale + forces;
        let is_closed = progress.defect.abs() <= FROZEN * f64::EPSILON * terms;
        if is_closed {
            progress.values = forces;
            progress.is_closed = true;
        }
        is_closed
    }

    /// Closed if the remaining defect, or what this step adds to it, is rounding, failed otherwise.
    pub(super) fn unless_rounding(&mut self, bodies: &dyn Bodies, index: usize) -> Status {
        let mut progress = self.scratch.progress[index];
        let (defect, scale) = (progress.defect, progress.scale);
        let is_rounding =
            |defect: f64, terms: f64| defect.abs() <= FROZEN * f64::EPSILON * (scale + terms);
        progress.granularity = self.granularity(bodies, index);
        progress.is_closed = is_rounding(defect, progress.granularity);
        if !progress.is_closed {
            progress.granularity += self.terms_at_rest(bodies, index);
            progress.is_forgiven = is_rounding(defect, progress.granularity);
            if !progress.is_forgiven && self.is_driven {
                progress.debt = self.debt(bodies, index);
                progress.is_forgiven = is_rounding(defect - progress.debt, progress.granularity);
            }
            progress.is_closed = progress.is_forgiven;
        }
        self.scratch.progress[index] = progress;
        if progress.is_closed {
            Status::Closed
        } else {
            Status::Failed
        }
    }

    /// The defect of the energy of a component at the start of the step, J.
    #[cold]
    fn debt(&mut self, bodies: &dyn Bodies, index: usize) -> f64 {
        let (motion, energy) = (self.motions[index], self.scratch.energies[index]);
        let (mut of_masses, mut inner) = (Motion::default(), ComponentEnergy::default());
        for at in self.components.all[index].masses.clone() {
            let place = bodies.at(at);
            of_masses.add_energy(place.start, place.force, place.per_mass);
        }
        for energy in self.components.energies_in(bodies.view().state, index) {
            inner.add(energy);
        }
        (self.motions[index], self.scratch.energies[index]) = (of_masses, inner);
        self.swap_books();
        let [debt, _] = self.defect_of(index);
        self.swap_books();
        (self.motions[index], self.scratch.energies[index]) = (motion, energy);
        debt
    }

    /// What rounding explains of the energy of a component of this magnitude, J.
    #[cold]
    pub(in super::super) fn explained(
        &mut self,
        bodies: &dyn Bodies,
        index: usize,
        magnitude: f64,
    ) -> f64 {
        self.scratch.needs_forces.fill(false);
        self.scratch.needs_forces[index] = true;
        self.find_forces(bodies);
        let terms = self.granularity(bodies, index) + self.terms_at_rest(bodies, index);
        FROZEN * f64::EPSILON * (magnitude + terms)
    }

    /// Finds the constant forces and those of elements in the components that need them: the negative gradient of the energy.
    pub(super) fn find_forces(&mut self, bodies: &dyn Bodies) {
        let scratch = &mut self.scratch;
        bodies.find_forces(
            &scratch.needs_forces,
            &mut scratch.forces,
            &mut scratch.creep,
        );
    }

    /// The force on a place that was found, N.
    fn force(&self, place: usize) -> &[f64] {
        &self.scratch.forces[place * self.dimension..][..self.dimension]
    }

    /// `Σ |F||q|`: times ε, the error of the energy by rounding of positions, J.
    fn granularity(&self, bodies: &dyn Bodies, index: usize) -> f64 {
        let mut sum = 0.0;
        for at in self.components.all[index].masses.clone() {
            for (force, q) in self.force(at).iter().zip(bodies.at(at).q) {
                sum += (force * q).abs();
            }
        }
        sum
    }

    /// The terms that do not vanish with the energy, J.
    #[cold]
    fn terms_at_rest(&mut self, bodies: &dyn Bodies, index: usize) -> f64 {
        let view = bodies.view();
        self.find_stiffnesses(bodies);
        let mut sum = self.scratch.energies[index].excess;
        if let Some(loads) = self.load_sums.get(index) {
            sum += (view.step * loads.work).abs() + 0.5 / FROZEN * loads.noise;
        }
        for energy in self.components.energies_in(view.state, index) {
            sum += energy.excess;
        }
        for (at, &node) in self.components.nodes.iter().enumerate() {
            if self.components.of_place[at] != index {
                continue;
            }
            let place = bodies.at(at);
            let old = &view.state.positions.values()[node * self.dimension..];
            let mut way = 0.0;
            for (q, old) in place.q.iter().zip(old) {
                way += (q - old).abs();
            }
            let position = size(place.q);
            let stiffness = self.scratch.stiffnesses[node];
            sum += stiffness * position * (way + f64::EPSILON * position);
            if place.mass > 0.0 {
                let start = place.start[1];
                sum += 0.5 * dot(start, start) * place.per_mass;
            }
        }
        for dashpot in self.components.dashpots_of(index) {
            let now = self.stage.inner[dashpot];
            let way = (now - self.stage.inner_start(dashpot)).abs();
            sum += self.scratch.pulls[dashpot] * (way + f64::EPSILON * now.abs());
        }
        sum + self.rounding_of_work(bodies, index) / (FROZEN * f64::EPSILON)
    }

    /// The work that the rounding of loads explains, J: of the impulses on masses and of the positions of moved anchors.
    fn rounding_of_work(&mut self, bodies: &dyn Bodies, index: usize) -> f64 {
        self.find_rounding(bodies);
        if self.rounding.is_none() {
            return 0.0;
        }
        let length = |vector: &[f64]| dot(vector, vector).sqrt();
        let mut sum = 0.0;
        for at in self.components.all[index].masses.clone() {
            let (place, rounding) = (bodies.at(at), self.rounding.at(self.components.nodes[at]));
            let impulse = rounding.impulse;
            let momenta = length(place.start[1]) + length(place.p) + impulse;
            sum += impulse * momenta * place.per_mass;
            // The force of the springs is that on the mass less the constant one.
            let force = length(self.force(at)) + length(place.force);
            sum += force * rounding.pull;
        }
        sum
    }

    /// Finds the stiffnesses of the elements at each node, and the terms of the force of each dashpot, once in a step.
    fn find_stiffnesses(&mut self, bodies: &dyn Bodies) {
        if self.scratch.has_stiffnesses {
            return;
        }
        self.scratch.has_stiffnesses = true;
        let (sums, pulls) = (&mut self.scratch.stiffnesses, &mut self.scratch.pulls);
        sums.fill(0.0);
        let (positions, d) = (bodies.view().state.positions.values(), self.dimension);
        bodies.see_stiffnesses(&mut |point| {
            let mut coordinates = 0.0;
            for &node in point.nodes {
                let node = node as usize;
                sums[node] += point.elastic;
                coordinates += size(&positions[node * d..][..d]);
            }
            let [by_nodes, own] = point.pull;
            pulls[point.dashpots].fill(by_nodes * coordinates + own);
        });
    }
}

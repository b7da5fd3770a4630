//! From the elements to the global system, and back.

use super::{ElementGroup, StepView, Trial};
use crate::conduction::Partner;
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::ElementScheme;
use crate::system::LinearSystem;

impl<S, M, K, C> ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    /// The factor by which heat from other elements enters the entropy balance of element `i`:
    /// `∂r_s/∂Q = −h w/θ*`; zero without temperature.
    fn heat_factor(&self, view: &StepView<'_, S>, i: usize) -> S {
        if !M::THERMAL {
            return S::zero();
        }
        -view.thermal_step() * S::from_f64(C::IMPLICIT) / self.members[i].temperature()
    }

    /// A row of the tangent with the internal variables eliminated: response `row` of element `i`
    /// as `constant + Σ_a by_measure(a) δπ_a + by_heat δr_s`, relative to its present value.
    fn condensed_row(&self, i: usize, row: usize) -> CondensedRow<M::Variables, S> {
        let member = &self.members[i];
        let tangent = &member.tangent.as_ref()[row].as_ref();
        let (by_measure, by_unknown) = tangent.split_at(M::MEASURES);
        let dot = |vector: &M::Variables| {
            let pairs = by_unknown.iter().zip(vector.as_ref());
            pairs.fold(S::zero(), |sum, (&a, &b)| sum + a * b)
        };
        let mut entries = M::Variables::filled(S::zero());
        for (a, &entry) in by_measure.iter().enumerate() {
            let eliminated = dot(&member.condensed.by_measure.as_ref()[a]);
            entries.as_mut()[a] = entry - eliminated;
        }
        CondensedRow {
            constant: -dot(&member.condensed.constant),
            by_measure: entries,
            by_heat: -dot(&member.condensed.by_heat),
        }
    }

    /// See [`Group::assemble`](super::Group::assemble).
    pub(super) fn assemble_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        system: &mut LinearSystem<S>,
    ) {
        for i in 0..self.members.len() {
            if view.phase.moves() {
                self.assemble_momentum(view, trial, i, system);
            }
            let slot = self.members[i].slots.thermal;
            if let Some(unknown) = slot.and_then(|slot| view.layout.coupled[slot]) {
                self.assemble_temperature(view, trial, i, unknown, system);
            }
        }
    }

    /// The impulse `h w Gᵀ f*` on the nodes and its derivatives.
    fn assemble_momentum(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        i: usize,
        system: &mut LinearSystem<S>,
    ) {
        let impulse = view.step * S::from_f64(C::IMPLICIT);
        let width = self.geometry.width();
        let old = view.state.positions.values();
        self.geometry.gather(i, C::PLACEMENT, old, &trial.positions);
        let response = self.members[i].response;
        let forces = &response.as_ref()[..M::MEASURES];
        self.geometry
            .curve(self.kinematics, i, C::PLACEMENT, forces);
        for (a, &force) in forces.iter().enumerate() {
            let row = self.condensed_row(i, a);
            let direction = &self.geometry.direction(i)[a * width..(a + 1) * width];
            let stiffness = self.stiffness_row(i, &row);
            for (p, at) in self.unknowns(view, i).enumerate() {
                let Some(at) = at else { continue };
                let along = impulse * direction[p];
                system.add_right(at, -along * (force + row.constant));
                for (q, to) in self.unknowns(view, i).enumerate() {
                    if let Some(to) = to {
                        system.add(at, to, along * stiffness(q));
                    }
                }
                let heat = along * row.by_heat * self.heat_factor(view, i);
                self.add_partners(view, i, at, heat, system);
            }
        }
        for (p, at) in self.unknowns(view, i).enumerate() {
            let Some(at) = at else { continue };
            for (q, to) in self.unknowns(view, i).enumerate() {
                if let Some(to) = to {
                    system.add(at, to, impulse * self.geometry.matrix[p * width + q]);
                }
            }
        }
    }

    /// The equation `Θ − θ* = 0` of an element whose temperature neighbours see.
    fn assemble_temperature(
        &self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        i: usize,
        unknown: usize,
        system: &mut LinearSystem<S>,
    ) {
        let member = &self.members[i];
        let row = self.condensed_row(i, M::MEASURES + M::DASHPOTS);
        let seen = member
            .slots
            .thermal
            .map_or(S::zero(), |slot| trial.seen_temperatures[slot]);
        system.add(unknown, unknown, S::one());
        system.add_right(unknown, member.temperature() + row.constant - seen);
        let sensitivity = self.stiffness_row(i, &row);
        for (q, to) in self.unknowns(view, i).enumerate() {
            if let Some(to) = to {
                system.add(unknown, to, -sensitivity(q));
            }
        }
        let heat = -row.by_heat * self.heat_factor(view, i);
        self.add_partners(view, i, unknown, heat, system);
    }

    /// The derivative of a condensed response by coordinate `q` of element `i`.
    fn stiffness_row<'a>(
        &'a self,
        i: usize,
        row: &'a CondensedRow<M::Variables, S>,
    ) -> impl Fn(usize) -> S + 'a {
        let width = self.geometry.width();
        let sensitivity = self.geometry.sensitivity(i);
        let increments = self.geometry.increment_sensitivity(i);
        let by_increment = &self.members[i].by_increment;
        move |q| {
            let mut sum = S::zero();
            for (b, &entry) in row.by_measure.as_ref()[..M::MEASURES].iter().enumerate() {
                sum += entry * sensitivity[b * width + q];
                if C::IN_TEMPERATURE {
                    let entry = row.by_heat * by_increment.as_ref()[b];
                    sum += entry * increments[b * width + q];
                }
            }
            sum
        }
    }

    /// Adds the derivatives of `factor Σ κ (Θ_partner − Θ)` of element `i`.
    fn add_partners(
        &self,
        view: &StepView<'_, S>,
        i: usize,
        row: usize,
        factor: S,
        system: &mut LinearSystem<S>,
    ) {
        let Some(slot) = self.members[i].slots.thermal else {
            return;
        };
        for link in view.conduction.links(slot) {
            if let Partner::Slot(partner) = link.partner {
                let entry = factor * link.conductance;
                for (slot, entry) in [(partner, entry), (slot, -entry)] {
                    if let Some(column) = view.layout.coupled[slot] {
                        system.add(row, column, entry);
                    }
                }
            }
        }
    }

    /// The unknown of each coordinate of element `i`; `None` at anchors.
    pub(super) fn unknowns(
        &self,
        view: &StepView<'_, S>,
        i: usize,
    ) -> impl Iterator<Item = Option<usize>> {
        let dimension = self.geometry.dimension();
        let nodes = self.geometry.nodes_of(i).iter();
        nodes.flat_map(move |&node| {
            let first = view.layout.nodes[node];
            (0..dimension).map(move |axis| first.map(|first| first + axis))
        })
    }

    /// See [`Group::correct`](super::Group::correct).
    pub(super) fn correct_all(&mut self, view: &StepView<'_, S>, solution: &[S]) -> S {
        let mut largest = S::zero();
        for i in 0..self.members.len() {
            let correction = self.correction(view, i, solution);
            let length = self.geometry.old_measures[self.geometry.measures_range(i).start];
            let member = &mut self.members[i];
            member.previous = member.x;
            member.correction = correction;
            if M::THERMAL {
                member.previous_entropy_change = member.response.as_ref()[M::Variables::LEN];
                let row = member.tangent.as_ref()[M::Variables::LEN].as_ref().iter();
                let terms = row
                    .zip(correction.as_ref())
                    .map(|(&entry, &change)| entry * change);
                member.entropy_correction = terms.fold(S::zero(), |sum, term| sum + term);
            }
            for index in M::MEASURES..M::Variables::LEN {
                let scale = if M::THERMAL && index == M::Variables::LEN - 1 {
                    member.x.as_ref()[index]
                } else {
                    length
                };
                largest = largest.maximum((correction.as_ref()[index] / scale).abs());
            }
        }
        largest
    }

    /// The change of the measures, and `δu = −(constant + Σ_a by_measure_a δπ_a + by_heat δr_s)`.
    fn correction(&self, view: &StepView<'_, S>, i: usize, solution: &[S]) -> M::Variables {
        let member = &self.members[i];
        let condensed = &member.condensed;
        let width = self.geometry.width();
        let mut heat = S::zero();
        if let Some(slot) = member.slots.thermal {
            for link in view.conduction.links(slot) {
                if let Partner::Slot(partner) = link.partner {
                    let change = |slot: usize| {
                        view.layout.coupled[slot].map_or(S::zero(), |at| solution[at])
                    };
                    heat += link.conductance * (change(partner) - change(slot));
                }
            }
            heat *= self.heat_factor(view, i);
        }
        if C::IN_TEMPERATURE {
            let rows = self.geometry.increment_sensitivity(i).chunks_exact(width);
            for (row, &slope) in rows.zip(member.by_increment.as_ref()) {
                for (&entry, at) in row.iter().zip(self.unknowns(view, i)) {
                    heat += slope * entry * at.map_or(S::zero(), |at| solution[at]);
                }
            }
        }
        let unknowns = M::MEASURES..M::Variables::LEN;
        let mut correction = M::Variables::filled(S::zero());
        for (u, at) in unknowns.clone().enumerate() {
            let constant = condensed.constant.as_ref()[u] + condensed.by_heat.as_ref()[u] * heat;
            correction.as_mut()[at] = -constant;
        }
        for a in 0..M::MEASURES {
            let sensitivity = &self.geometry.sensitivity(i)[a * width..(a + 1) * width];
            let mut change = S::zero();
            for (&entry, at) in sensitivity.iter().zip(self.unknowns(view, i)) {
                change += entry * at.map_or(S::zero(), |at| solution[at]);
            }
            correction.as_mut()[a] = change;
            let by_measure = &condensed.by_measure.as_ref()[a];
            for (u, at) in unknowns.clone().enumerate() {
                correction.as_mut()[at] -= by_measure.as_ref()[u] * change;
            }
        }
        correction
    }
}

/// See [`ElementGroup::condensed_row`].
struct CondensedRow<V, S> {
    constant: S,
    by_measure: V,
    by_heat: S,
}

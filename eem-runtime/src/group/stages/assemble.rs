//! From the stages of the elements to the global system, and back.

use super::{END, MIDDLE, StageTrial, StageView, ThreeStageGroup};
use crate::conduction::Partner;
use crate::free_energy::{Array, FreeEnergy};
use crate::group::geometry::Geometry;
use crate::kinematics::Kinematics;
use crate::layout::Layout;
use crate::scalar::Real;
use crate::scheme::{Placement, variational_4};
use crate::system::LinearSystem;

impl<S, M, K> ThreeStageGroup<S, M, K>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
{
    /// See [`StageGroup::assemble`](super::StageGroup::assemble).
    pub(super) fn assemble_all(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
        system: &mut LinearSystem<S>,
    ) {
        for i in 0..self.members.len() {
            self.assemble_forces(view, i, 0, system);
            self.assemble_forces(view, i, MIDDLE, system);
            self.assemble_turn(view, trial, i, system);
            let Some(slot) = self.elements.members[i].slots.thermal else {
                continue;
            };
            if let Some(unknown) = view.layout.coupled[slot] {
                for (stage, row) in [(0, unknown), (END, view.layout.unknowns + unknown)] {
                    let seen = trial.seen_temperatures[stage][slot];
                    self.assemble_temperature(view, i, stage, (row, seen), system);
                }
            }
        }
    }

    /// The impulses of the forces `f_i ∂π/∂q_i` of a stage and their derivatives, with the direction
    /// held.
    fn assemble_forces(
        &mut self,
        view: &StageView<'_, S>,
        i: usize,
        stage: usize,
        system: &mut LinearSystem<S>,
    ) {
        let width = self.geometry[stage].width();
        for a in 0..M::MEASURES {
            let point = &self.members[i].points[stage];
            let (force, by) = (point.gradient.as_ref()[a], point.hessian.as_ref()[a]);
            self.local.eliminate(&self.members[i], stage, &by);
            let value = force + self.local.row[0];
            for (half, weights) in variational_4::MIDDLE_AND_END.iter().enumerate() {
                let impulse = view.step * S::from_f64(weights[stage]);
                let geometry = &self.geometry[stage];
                for (p, at) in unknowns_of(view.layout, geometry, i).enumerate() {
                    let Some(at) = at else { continue };
                    let row = half * view.layout.unknowns + at;
                    let along = impulse * geometry.direction(i)[a * width + p];
                    system.add_right(row, -along * value);
                    self.add_row(view, i, (row, along), system);
                }
            }
        }
    }

    /// What the forces of the middle do when their directions turn.
    fn assemble_turn(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
        i: usize,
        system: &mut LinearSystem<S>,
    ) {
        let (kinematics, positions) = (self.elements.kinematics, &trial.positions[MIDDLE]);
        let forces = self.members[i].points[MIDDLE].gradient;
        let forces = &forces.as_ref()[..M::MEASURES];
        let geometry = &mut self.geometry[MIDDLE];
        geometry.gather(i, Placement::End, positions, positions);
        geometry.curve(kinematics, i, Placement::End, forces);
        let width = geometry.width();
        for (half, weights) in variational_4::MIDDLE_AND_END.iter().enumerate() {
            let impulse = view.step * S::from_f64(weights[MIDDLE]);
            for (p, at) in unknowns_of(view.layout, geometry, i).enumerate() {
                let Some(at) = at else { continue };
                let row = half * view.layout.unknowns + at;
                for (q, to) in unknowns_of(view.layout, geometry, i).enumerate() {
                    if let Some(to) = to {
                        system.add(row, to, impulse * geometry.matrix[p * width + q]);
                    }
                }
            }
        }
    }

    /// The equation `Θ_i − θ_i = 0` of an element whose temperature neighbours see.
    fn assemble_temperature(
        &mut self,
        view: &StageView<'_, S>,
        i: usize,
        stage: usize,
        (row, seen): (usize, S),
        system: &mut LinearSystem<S>,
    ) {
        let mut by = M::Variables::filled(S::zero());
        by.as_mut()[M::Variables::LEN - 1] = S::one();
        self.local.eliminate(&self.members[i], stage, &by);
        let theta = self.members[i].temperature(stage) + self.local.row[0];
        system.add(row, row, S::one());
        system.add_right(row, theta - seen);
        self.add_row(view, i, (row, -S::one()), system);
    }

    /// Adds the derivatives of `factor` times the quantity that has been eliminated last.
    fn add_row(
        &self,
        view: &StageView<'_, S>,
        i: usize,
        (row, factor): (usize, S),
        system: &mut LinearSystem<S>,
    ) {
        let by = &self.local.row[1..];
        let unknowns = view.layout.unknowns;
        for (half, geometry) in self.geometry[MIDDLE..].iter().enumerate() {
            let width = geometry.width();
            for (sensitivity, &entry) in geometry
                .sensitivity(i)
                .chunks_exact(width)
                .zip(&by[half * M::MEASURES..])
            {
                let entry = factor * entry;
                for (&slope, to) in sensitivity
                    .iter()
                    .zip(unknowns_of(view.layout, geometry, i))
                {
                    if let Some(to) = to {
                        system.add(row, half * unknowns + to, entry * slope);
                    }
                }
            }
        }
        let Some(slot) = self.elements.members[i].slots.thermal else {
            return;
        };
        // Q_0 depends on Θ_0 of both ends of a path, Q_m on their Θ_m.
        let [start, middle] = [0, 1].map(|heat| factor * by[2 * M::MEASURES + heat]);
        for link in view.conduction.links(slot) {
            let Partner::Slot(partner) = link.partner else {
                continue;
            };
            for (slot, conductance) in [(partner, link.conductance), (slot, -link.conductance)] {
                if let Some(to) = view.layout.coupled[slot] {
                    let half = mean_share(view, slot) * middle;
                    system.add(row, to, conductance * (start + half));
                    system.add(row, unknowns + to, conductance * half);
                }
            }
        }
    }

    /// See [`StageGroup::correct`](super::StageGroup::correct).
    pub(super) fn correct_all(&mut self, view: &StageView<'_, S>, solution: &[S]) -> S {
        let mut largest = S::zero();
        for i in 0..self.members.len() {
            self.change_inputs(view, i, solution);
            let measures = &self.elements.geometry;
            let length = measures.old_measures[measures.measures_range(i).start];
            let stages = &mut self.members[i];
            stages.hold();
            let unknowns = stages.solved.len() / (1 + self.local.inputs.len());
            for u in 0..unknowns {
                let mut change = -stages.solved[u];
                for (j, &input) in self.local.inputs.iter().enumerate() {
                    change -= stages.solved[(1 + j) * unknowns + u] * input;
                }
                let (stage, index, scale) = if u < 2 * M::DASHPOTS {
                    let stage = MIDDLE + u / M::DASHPOTS;
                    (stage, M::MEASURES + u % M::DASHPOTS, length)
                } else {
                    let stage = if u == 2 * M::DASHPOTS { 0 } else { END };
                    (stage, M::Variables::LEN - 1, stages.temperature(stage))
                };
                stages.correction[stage].as_mut()[index] = change;
                largest = largest.maximum((change / scale).abs());
            }
        }
        largest
    }

    /// The changes of the inputs of element `i` that go with the global ones.
    fn change_inputs(&mut self, view: &StageView<'_, S>, i: usize, solution: &[S]) {
        let unknowns = view.layout.unknowns;
        let (measures, heat) = self.local.inputs.split_at_mut(2 * M::MEASURES);
        for (half, geometry) in self.geometry[MIDDLE..].iter().enumerate() {
            let solution = &solution[half * unknowns..];
            let rows = geometry.sensitivity(i).chunks_exact(geometry.width());
            for (row, input) in rows.zip(&mut measures[half * M::MEASURES..]) {
                let pairs = row.iter().zip(unknowns_of(view.layout, geometry, i));
                *input = pairs.fold(S::zero(), |sum, (&slope, at)| {
                    sum + slope * at.map_or(S::zero(), |at| solution[at])
                });
            }
        }
        let (Some(slot), [start, middle]) = (self.elements.members[i].slots.thermal, heat) else {
            return;
        };
        let change = |slot: usize| {
            let of = |half: usize| {
                let at = view.layout.coupled[slot];
                at.map_or(S::zero(), |at| solution[half * unknowns + at])
            };
            [of(0), mean_share(view, slot) * (of(0) + of(1))]
        };
        (*start, *middle) = (S::zero(), S::zero());
        for link in view.conduction.links(slot) {
            if let Partner::Slot(partner) = link.partner {
                let (far, near) = (change(partner), change(slot));
                *start += link.conductance * (far[0] - near[0]);
                *middle += link.conductance * (far[1] - near[1]);
            }
        }
    }
}

/// The share of `Θ_0` and of `Θ_1` in `Θ_m`, which a thermostat gives directly.
fn mean_share<S: Real>(view: &StageView<'_, S>, slot: usize) -> S {
    match view.prescribed(slot) {
        None => S::from_f64(0.5),
        Some(_) => S::zero(),
    }
}

/// The unknown of each coordinate of element `i`, in one half of the unknowns; `None` at anchors.
fn unknowns_of<'a, S: Real>(
    layout: &'a Layout,
    geometry: &'a Geometry<S>,
    i: usize,
) -> impl Iterator<Item = Option<usize>> + 'a {
    let dimension = geometry.dimension();
    geometry.nodes_of(i).iter().flat_map(move |&node| {
        let first = layout.nodes[node];
        (0..dimension).map(move |axis| first.map(|first| first + axis))
    })
}

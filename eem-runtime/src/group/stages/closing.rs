//! The end of a step: forces and increments of the internal variables from the found stages.
//!
//! Newton's method leaves an error in the trial stages. Taking `f`, `g`, `θ` of the stages as given
//! and evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is.

use super::point::Point;
use super::{END, MIDDLE, StageTrial, StageView, ThreeStageGroup};
use crate::conduction::Partner;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::group::StepView;
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::{Placement, variational_4};
use crate::state::State;
use crate::system::LinearSystem;

impl<S, M, K> ThreeStageGroup<S, M, K>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
{
    /// A of the nodal force `A q_m` of element `i` in the middle, into the matrix of its geometry.
    fn secant(&mut self, i: usize) {
        let forces = self.members[i].points[MIDDLE].gradient;
        let (kinematics, forces) = (self.elements.kinematics, &forces.as_ref()[..M::MEASURES]);
        self.geometry[MIDDLE].secant(kinematics, i, Placement::Middle, forces);
    }

    /// See [`StageGroup::add_secant`](super::StageGroup::add_secant).
    pub(super) fn add_secant_all(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
        system: &mut LinearSystem<S>,
    ) {
        let impulse = view.step * S::from_f64(variational_4::MIDDLE_AND_END[0][MIDDLE]);
        let old = view.state.positions.values();
        for i in 0..self.members.len() {
            self.secant(i);
            let (geometry, width) = (&self.geometry[MIDDLE], self.geometry[MIDDLE].width());
            let unknown = |coordinate: usize| {
                let first = view.layout.nodes[coordinate / geometry.dimension()];
                first.map(|first| first + coordinate % geometry.dimension())
            };
            for (p, coordinate) in geometry.coordinates_of(i).enumerate() {
                let Some(at) = unknown(coordinate) else {
                    continue;
                };
                let row = &geometry.matrix[p * width..(p + 1) * width];
                for (&entry, coordinate) in row.iter().zip(geometry.coordinates_of(i)) {
                    let entry = impulse * entry;
                    system.add_right(at, -entry * old[coordinate]);
                    match unknown(coordinate) {
                        Some(to) => system.add(at, to, entry),
                        None => system.add_right(at, -entry * trial.displacements[0][coordinate]),
                    }
                }
            }
        }
    }

    /// See [`StageGroup::subtract_forces`](super::StageGroup::subtract_forces).
    pub(super) fn subtract_all_forces(
        &mut self,
        stage: usize,
        trial: &StageTrial<S>,
        forces: &mut [S],
    ) {
        let positions = &trial.positions[stage];
        for i in 0..self.members.len() {
            let width = self.geometry[stage].width();
            if stage == MIDDLE {
                self.secant(i);
                let geometry = &self.geometry[stage];
                let rows = geometry.matrix.chunks_exact(width);
                for (row, at) in rows.zip(geometry.coordinates_of(i)) {
                    let pairs = row.iter().zip(geometry.coordinates_of(i));
                    forces[at] -= pairs.fold(S::zero(), |sum, (&entry, coordinate)| {
                        sum + entry * positions[coordinate]
                    });
                }
                continue;
            }
            let geometry = &mut self.geometry[stage];
            geometry.aim(self.elements.kinematics, i, positions);
            let rows = geometry.direction(i).chunks_exact(width);
            let values = self.members[i].points[stage].gradient;
            for (row, &force) in rows.zip(values.as_ref()) {
                for (&entry, at) in row.iter().zip(geometry.coordinates_of(i)) {
                    forces[at] -= force * entry;
                }
            }
        }
    }

    /// See [`StageGroup::close`](super::StageGroup::close).
    pub(super) fn close_all(&mut self, view: &StageView<'_, S>, next: &mut State<S>) {
        let weights = variational_4::STEP.map(|weight| view.step * S::from_f64(weight));
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            let points = &stages.points;
            let step = |of: &dyn Fn(usize) -> S| {
                let terms = weights.iter().enumerate();
                terms.fold(S::zero(), |sum, (stage, &weight)| sum + weight * of(stage))
            };
            for k in 0..M::DASHPOTS {
                let creep = step(&|stage| points[stage].rates.as_ref()[M::MEASURES + k]);
                next.viscous.add(member.slots.viscous + k, creep);
            }
            let Some(slot) = member.slots.thermal else {
                next.dissipated
                    .add(0, step(&|stage| points[stage].dissipation));
                continue;
            };
            let last = M::Variables::LEN - 1;
            let received = step(&|stage| points[stage].rates.as_ref()[last]);
            next.entropies.add(slot, received);
            for link in view.conduction.links(slot) {
                if let Partner::Reservoir(index) = link.partner {
                    let theta = view.conduction.reservoirs[index];
                    let flow = |stage: usize| {
                        link.conductance * (stages.x[stage].as_ref()[last] - theta) / theta
                    };
                    next.reservoir_entropies.add(index, step(&flow));
                }
            }
            stages.entropy_received = received;
        }
    }

    /// See [`Elements::settle`](crate::group::Elements::settle).
    pub(super) fn settle_all(
        &mut self,
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StateError> {
        for i in 0..self.members.len() {
            let guess = self.members[i].x[END].as_ref()[M::Variables::LEN - 1];
            let caloric = self.elements.settle_one(i, view, next, guess)?;
            let slot = self.elements.members[i].slots.thermal;
            let stages = &self.members[i];
            let (Some(caloric), Some(slot), Some(_)) = (caloric, slot, stages.prescribed) else {
                continue;
            };
            next.entropies.set(slot, caloric.entropy);
            self.book_thermostat(view.step, i, caloric.entropy, next);
        }
        Ok(())
    }

    /// The heat of the thermostat of element `i`, whose new entropy is given.
    ///
    /// The entropies `(h/6)R_0`, `(2h/3)R_m`, `(h/6)R_1` that it gives at the stages are what the equations of the
    /// scheme lack with the prescribed temperatures, and its heat is `Σ θ_i` times them.
    fn book_thermostat(&self, h: S, i: usize, new_entropy: S, next: &mut State<S>) {
        let stages = &self.members[i];
        let last = M::Variables::LEN - 1;
        let [start, middle, end] = stages.points.each_ref().map(Point::entropy);
        let received = |stage: usize| {
            let rate = stages.points[stage].rates.as_ref()[last];
            h * S::from_f64(variational_4::STEP[stage]) * rate
        };
        let [w0, wm, w1] = variational_4::START.map(S::from_f64);
        let at_start = w0 * start + wm * middle + w1 * end - stages.entropy - received(0);
        let share = S::from_f64(variational_4::STEP[MIDDLE]);
        let in_middle = share * (end - start) - received(MIDDLE);
        let total = new_entropy - stages.entropy - stages.entropy_received;
        let at_end = total - at_start - in_middle;
        let given = [at_start, in_middle, at_end];
        for (stage, given) in given.into_iter().enumerate() {
            next.heat.add(0, stages.temperature(stage) * given);
        }
        next.thermostat_entropy.add(0, -total);
    }
}

//! The stages of a step: stage vectors and their rates.

use super::tableau::{
    ROW_1, ROW_2, ROW_3, ROW_4, ROW_5, ROW_6, ROW_7, ROW_8, ROW_9, ROW_10, ROW_11, STAGES, TIMES,
    WEIGHTED, WEIGHTS,
};
use super::{Explicit, ExplicitView};
use crate::element::error::StateError;
use crate::element::group::{StageRates, StageView};
use crate::number::scalar::Real;
use crate::step::error::StepFailure;
use crate::step::scheme::Scheme;

/// The buffer of the rates of each stage but the first: those of stages 1 and 2 are needed by the next two
/// stages only.
const BUFFER: [usize; STAGES] = [0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 1, 0];

/// Whether rates are found anew or as the elements were closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum From {
    Model,
    Closing,
}

impl<S: Real, const D: usize> Explicit<S, D> {
    /// The rates of a stage.
    #[inline]
    pub(super) fn rates(&self, stage: usize) -> &[S] {
        if stage == 0 {
            &self.start.rates
        } else {
            &self.k[BUFFER[stage]]
        }
    }

    /// The rates of the stages that have weights.
    #[inline]
    pub(super) fn weighted_rates(&self) -> [&[S]; 8] {
        WEIGHTED.map(|stage| self.rates(stage))
    }

    /// Goes to a stage, or to the end of the step where there are no more stages.
    pub(super) fn go_to(&mut self, stage: usize, h: S) {
        let mut y = core::mem::take(&mut self.y);
        let (y0, k) = (&self.y0, |stage: usize| self.rates(stage));
        match stage {
            1 => combine(&mut y, y0, [k(0)], h, &ROW_1),
            2 => combine(&mut y, y0, [0, 1].map(k), h, &ROW_2),
            3 => combine(&mut y, y0, [0, 2].map(k), h, &ROW_3),
            4 => combine(&mut y, y0, [0, 2, 3].map(k), h, &ROW_4),
            5 => combine(&mut y, y0, [0, 3, 4].map(k), h, &ROW_5),
            6 => combine(&mut y, y0, [0, 3, 4, 5].map(k), h, &ROW_6),
            7 => combine(&mut y, y0, [0, 3, 4, 5, 6].map(k), h, &ROW_7),
            8 => combine(&mut y, y0, [0, 3, 4, 5, 6, 7].map(k), h, &ROW_8),
            9 => combine(&mut y, y0, [0, 3, 4, 5, 6, 7, 8].map(k), h, &ROW_9),
            10 => combine(&mut y, y0, [0, 3, 4, 5, 6, 7, 8, 9].map(k), h, &ROW_10),
            11 => combine(&mut y, y0, [0, 3, 4, 5, 6, 7, 8, 9, 10].map(k), h, &ROW_11),
            _ => combine(&mut y, y0, self.weighted_rates(), h, &WEIGHTS),
        }
        self.y = y;
        self.prescribe(stage.min(STAGES - 1));
    }

    /// Puts moved anchors and thermostats where they are at a stage.
    fn prescribe(&mut self, stage: usize) {
        for (slot, theta) in self.prescribed.temperatures(stage) {
            self.y[self.offsets.temperatures + slot] = theta;
        }
        let positions = self.y[..self.offsets.momenta].as_chunks_mut::<D>().0;
        let anchors = self.components.anchors();
        for (place, node) in anchors {
            for (moved, position, _) in self.prescribed.motions(stage) {
                if moved == node {
                    positions[place] = *position;
                }
            }
        }
    }

    /// Evaluates the rates of the stage that has been gone to.
    pub(super) fn evaluate(
        &mut self,
        stage: usize,
        view: &ExplicitView<'_, S, D>,
    ) -> Result<(), StepFailure> {
        let share = S::from_f64(TIMES[stage]);
        let time = view.state.time.value + share * view.step;
        self.evaluate_loads(view, time)?;
        let mut rates = core::mem::take(&mut self.k[BUFFER[stage]]);
        let found = self.find_rates(stage, From::Model, &mut rates);
        self.k[BUFFER[stage]] = rates;
        Ok(found?)
    }

    /// Loads and weights at a time.
    pub(super) fn evaluate_loads(
        &mut self,
        view: &ExplicitView<'_, S, D>,
        time: S,
    ) -> Result<(), StepFailure> {
        if !self.loads.has_total_force() {
            return Ok(());
        }
        let scheme = Scheme::EemExplicit;
        self.loads
            .evaluate_forces_at(view.loads, view.masses, scheme, time)?;
        self.end.loads.copy_from_slice(&self.loads.total_force);
        if self.loads.has_force() {
            self.end.forces.copy_from_slice(&self.loads.force);
        }
        Ok(())
    }

    /// The rates of the present stage vector, and the powers that belong to them.
    pub(super) fn find_rates(
        &mut self,
        stage: usize,
        from: From,
        rates: &mut [S],
    ) -> Result<(), StateError> {
        let offsets = self.offsets;
        let (nodes, internal) = rates.split_at_mut(offsets.viscous);
        let (velocities, forces) = nodes.split_at_mut(offsets.momenta);
        let (creep, heating) = internal.split_at_mut(offsets.temperatures - offsets.viscous);
        self.begin_rates(stage, velocities, forces);
        let temperatures = &self.y[offsets.temperatures..];
        heating.fill(S::zero());
        for path in &self.components.paths {
            let [a, b] = path.ends.map(|end| end as usize);
            let flow = path.conductance * (temperatures[b] - temperatures[a]);
            heating[a] += flow;
            heating[b] -= flow;
        }
        let view = StageView {
            positions: &self.y[..offsets.momenta],
            velocities,
            viscous: &self.y[offsets.viscous..offsets.temperatures],
            temperatures,
            held: &self.held,
        };
        let mut rates = StageRates {
            forces: &mut *forces,
            creep,
            heating: &mut *heating,
            powers: &mut self.end.powers,
            supply: &mut self.end.supply,
        };
        self.evaluations += u64::from(from == From::Model);
        for group in &self.groups {
            match from {
                From::Model => group.rates(&view, &mut rates)?,
                From::Closing => group.finish(&view, &mut rates)?,
            }
        }
        let anchors = &mut forces.as_chunks_mut::<D>().0[self.components.masses..];
        for (reaction, force) in self.end.reactions.iter_mut().zip(anchors) {
            *reaction = core::mem::replace(force, [S::zero(); D]);
        }
        heating[offsets.reservoirs - offsets.temperatures..].fill(S::zero());
        Ok(())
    }

    /// Velocities, and the loads on all places.
    fn begin_rates(&self, stage: usize, velocities: &mut [S], forces: &mut [S]) {
        let velocities = velocities.as_chunks_mut::<D>().0;
        let momenta = self.y[self.offsets.momenta..self.offsets.viscous]
            .as_chunks::<D>()
            .0;
        let places = velocities.iter_mut().zip(momenta).zip(&self.per_mass);
        for ((velocity, momentum), &per_mass) in places {
            *velocity = momentum.map(|p| p * per_mass);
        }
        if self.prescribed.moves() {
            for (place, node) in self.components.anchors() {
                for (moved, _, velocity) in self.prescribed.motions(stage) {
                    if moved == node {
                        velocities[place] = *velocity;
                    }
                }
            }
        }
        if !self.loads.has_total_force() {
            forces.fill(S::zero());
            return;
        }
        let loads = self.end.loads.as_chunks::<D>().0;
        let forces = forces.as_chunks_mut::<D>().0;
        for (force, &node) in forces.iter_mut().zip(&self.components.nodes) {
            *force = loads[node as usize];
        }
        forces[self.components.masses..].fill([S::zero(); D]);
    }
}

/// `y = y⁰ + h Σ a k`.
#[inline]
fn combine<S: Real, const T: usize>(y: &mut [S], y0: &[S], k: [&[S]; T], h: S, a: &[f64; T]) {
    let size = y.len();
    let (y0, k) = (&y0[..size], k.map(|k| &k[..size]));
    let a = a.map(|a| h * S::from_f64(a));
    for index in 0..size {
        let mut sum = a[0] * k[0][index];
        for term in 1..T {
            sum += a[term] * k[term][index];
        }
        y[index] = y0[index] + sum;
    }
}

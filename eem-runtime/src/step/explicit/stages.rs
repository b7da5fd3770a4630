//! The stages of a step: stage vectors and their rates.

use super::memory::START;
use super::tableau::{
    ERROR_3, ERROR_5, ROW_1, ROW_2, ROW_3, ROW_4, ROW_5, ROW_6, ROW_7, ROW_8, ROW_9, ROW_10,
    ROW_11, STAGES, TIMES, WEIGHTED, WEIGHTS,
};
use super::{Explicit, ExplicitView};
use crate::element::error::StateError;
use crate::element::group::{Offsets, StageRates, StageView, points};
use crate::step::error::StepFailure;
use eem_material::number::scalar::Real;

/// The row of the rates of each stage: those of stages 1 and 2 are needed by the next two stages only, and
/// leave their rows to the last ones.
const ROWS: [usize; STAGES] = [START, 1, 2, 3, 4, 5, 6, 7, 8, 9, 2, 1];

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
        &self.rows[ROWS[stage]]
    }

    /// Goes to a stage, or to the end of the step where there are no more stages.
    pub(super) fn go_to(&mut self, stage: usize, h: S) {
        match stage {
            1 => self.combine([0], h, &ROW_1),
            2 => self.combine([0, 1], h, &ROW_2),
            3 => self.combine([0, 2], h, &ROW_3),
            4 => self.combine([0, 2, 3], h, &ROW_4),
            5 => self.combine([0, 3, 4], h, &ROW_5),
            6 => self.combine([0, 3, 4, 5], h, &ROW_6),
            7 => self.combine([0, 3, 4, 5, 6], h, &ROW_7),
            8 => self.combine([0, 3, 4, 5, 6, 7], h, &ROW_8),
            9 => self.combine([0, 3, 4, 5, 6, 7, 8], h, &ROW_9),
            10 => self.combine([0, 3, 4, 5, 6, 7, 8, 9], h, &ROW_10),
            11 => self.combine([0, 3, 4, 5, 6, 7, 8, 9, 10], h, &ROW_11),
            _ => self.combine(WEIGHTED, h, &WEIGHTS),
        }
        if !self.prescribed.is_none() {
            self.prescribe(stage.min(STAGES - 1));
        }
    }

    /// `y = y⁰ + h Σ a k` with the rates of some stages.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "stages are constants, whose rows are found without a look at bounds"
    )]
    fn combine<const T: usize>(&mut self, stages: [usize; T], h: S, a: &[f64; T]) {
        let mut k: [&[S]; T] = [&[]; T];
        for term in 0..T {
            k[term] = &self.rows[ROWS[stages[term]]];
        }
        add_rows(&mut self.y, &self.y0, k, h, a);
    }

    /// `h Σ E k` of both estimates, in the rows of two stages that have no weights.
    pub(super) fn find_errors(&mut self, h: S) {
        for (row, weights) in [(ROWS[3], &ERROR_5), (ROWS[4], &ERROR_3)] {
            let mut errors = core::mem::take(&mut self.rows[row]);
            let rates = WEIGHTED.map(|stage| self.rates(stage));
            sum_rows(&mut errors, rates, h, weights);
            self.rows[row] = errors;
        }
    }

    /// Where [`find_errors`](Self::find_errors) has left them.
    pub(super) fn errors(&self) -> [&[S]; 2] {
        [&self.rows[ROWS[3]], &self.rows[ROWS[4]]]
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
        Ok(self.find_rates(stage, From::Model, ROWS[stage])?)
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
        self.loads
            .evaluate_forces_at(view.loads, view.masses, time)?;
        self.end.loads.copy_from_slice(&self.loads.total_force);
        if self.loads.has_force() {
            self.end.forces.copy_from_slice(&self.loads.force);
        }
        Ok(())
    }

    /// The rates of the present stage vector, and the powers that belong to them; velocities and forces go to
    /// a row.
    pub(super) fn find_rates(
        &mut self,
        stage: usize,
        from: From,
        row: usize,
    ) -> Result<(), StateError> {
        self.begin_rates(stage, row);
        let offsets = &self.offsets;
        let row = &mut self.rows[row][..];
        for path in &self.components.paths {
            let [a, b] = path.ends.map(|end| offsets.temperatures + end as usize);
            let flow = path.conductance * (self.y[b] - self.y[a]);
            row[a] += flow;
            // A reservoir keeps its temperature.
            if path.share.is_none() {
                row[b] -= flow;
            }
        }
        let view = StageView {
            offsets,
            y: &self.y,
            held: &self.held,
        };
        let mut rates = StageRates {
            row,
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
        let forces = &mut rates.row[offsets.momenta..].as_chunks_mut::<D>().0;
        let anchored = forces[self.components.masses..].iter_mut();
        for (reaction, force) in self.end.reactions.iter_mut().zip(anchored) {
            *reaction = core::mem::replace(force, [S::zero(); D]);
        }
        Ok(())
    }

    /// Velocities, and the loads on all places.
    fn begin_rates(&mut self, stage: usize, row: usize) {
        let offsets = self.offsets;
        let (velocities, others) = self.rows[row].split_at_mut(offsets.momenta);
        others.fill(S::zero());
        let velocities = velocities.as_chunks_mut::<D>().0;
        let momenta = points::<S, D>(&self.y[offsets.momenta..offsets.viscous]);
        // Those of anchors stay zero, unless they are moved.
        let masses = &self.per_mass[..self.components.masses];
        let moving = velocities.iter_mut().zip(momenta).zip(masses);
        for ((velocity, momentum), &per_mass) in moving {
            for axis in 0..D {
                velocity[axis] = momentum[axis] * per_mass;
            }
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
        if self.loads.has_total_force() {
            let loads = points::<S, D>(&self.end.loads);
            let forces = others.as_chunks_mut::<D>().0.iter_mut();
            let masses = &self.components.nodes[..self.components.masses];
            for (force, &node) in forces.zip(masses) {
                *force = loads[node as usize];
            }
        }
    }
}

/// `y = y⁰ + h Σ a k`.
#[inline(never)]
fn add_rows<S: Real, const T: usize>(y: &mut [S], y0: &[S], k: [&[S]; T], h: S, a: &[f64; T]) {
    let (size, k, factors) = aligned(y, k, h, a);
    let (y, y0) = (&mut y[..size], &y0[..size]);
    for index in 0..size {
        let mut sum = factors[0] * k[0][index];
        for term in 1..T {
            sum += factors[term] * k[term][index];
        }
        y[index] = y0[index] + sum;
    }
}

/// `y = h Σ a k`.
#[inline(never)]
fn sum_rows<S: Real, const T: usize>(y: &mut [S], k: [&[S]; T], h: S, a: &[f64; T]) {
    let (size, k, factors) = aligned(y, k, h, a);
    let y = &mut y[..size];
    for index in 0..size {
        let mut sum = factors[0] * k[0][index];
        for term in 1..T {
            sum += factors[term] * k[term][index];
        }
        y[index] = sum;
    }
}

/// The size of a vector, of which the compiler sees that it is a multiple; rows of it, and their factors `h a`.
#[inline]
fn aligned<'a, S: Real, const T: usize>(
    y: &[S],
    mut k: [&'a [S]; T],
    h: S,
    a: &[f64; T],
) -> (usize, [&'a [S]; T], [S; T]) {
    let size = y.len() / Offsets::WIDTH * Offsets::WIDTH;
    for row in &mut k {
        *row = &row[..size];
    }
    let mut factors = [h; T];
    for (factor, &a) in factors.iter_mut().zip(a) {
        *factor = h * S::from_f64(a);
    }
    (size, k, factors)
}

//! One attempt at a step, which changes nothing until it is accepted.

use super::demand::Demand;
use super::tableau::STAGES;
use super::{Explicit, ExplicitView};
use crate::element::state::State;
use crate::step::error::StepFailure;
use crate::step::outcome::{Attempt, Outcome};
use eem_material::number::scalar::{Mask, Real};

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Writes the state after a step to `next`, from the state of the last accepted step or, after
    /// [`forget`](Self::forget), from any state. The outcome is `None` if the error exceeds the demand.
    pub(crate) fn step(
        &mut self,
        view: &ExplicitView<'_, S, D>,
        demand: Demand<S>,
        next: &mut State<S>,
    ) -> Result<Attempt<S>, StepFailure> {
        self.was_ready = self.is_ready;
        let attempt = self.attempt(view, demand, next);
        let is_made = matches!(&attempt, Ok(attempt) if attempt.outcome.is_some());
        if is_made {
            self.has_left = false;
        } else {
            // As before the attempt.
            self.is_ready = self.was_ready;
        }
        attempt.map_err(|failure| self.explain(failure, view))
    }

    fn attempt(
        &mut self,
        view: &ExplicitView<'_, S, D>,
        demand: Demand<S>,
        next: &mut State<S>,
    ) -> Result<Attempt<S>, StepFailure> {
        let [start, h] = [view.state.time.value, view.step];
        let time = start + h;
        if self.is_driven {
            self.prescribed
                .evaluate(view.loads, [start, h], view.state)?;
        }
        self.begin(view, next)?;
        self.go_through_stages(view)?;
        let scales = self.scales(time)?;
        let error = match demand {
            Demand::None => S::zero(),
            Demand::Within(tolerance) => self.estimate(view, &tolerance, scales),
        };
        if !error.at_most(S::one()).all() {
            let outcome = None;
            return Ok(Attempt { error, outcome });
        }
        self.book(view, next);
        self.close(view, (demand, scales), next)?;
        if next.meters.are_on {
            self.meter(h, next);
        }
        let correction = self.correction(view, demand, time)?;
        self.finish()?;
        self.store(next);
        self.books.largest_momentum = scales.momentum;
        let outcome: Outcome<S> = self.prove(correction, (view.state, time))?;
        let outcome = Some(outcome);
        Ok(Attempt { error, outcome })
    }

    /// Undoes the accepted step.
    pub(crate) fn undo(&mut self) {
        self.has_left = true;
        self.is_ready = self.was_ready;
    }

    /// Makes the next step start from another state, for which rates and targets are evaluated again.
    pub(crate) fn forget(&mut self) {
        self.is_ready = false;
    }

    /// The largest defect of all components before closing; an error unless it is small, or rounding.
    fn correction(
        &mut self,
        view: &ExplicitView<'_, S, D>,
        demand: Demand<S>,
        time: S,
    ) -> Result<S, StepFailure> {
        let mut largest = S::zero();
        let limit = demand.largest_correction();
        for index in 0..self.scratch.progress.len() {
            let progress = &self.scratch.progress[index];
            let (mut own, scale) = (progress.correction, progress.scale);
            if !own.abs().at_most(limit).all() {
                let explained = self.explained(index, scale, view);
                let is_rounding = (own * scale).abs().at_most(explained);
                own = S::select(is_rounding, S::zero(), own);
            }
            let is_larger = largest.abs().less(own.abs());
            largest = S::select(is_larger, own, largest);
        }
        if largest.abs().at_most(limit).all() {
            return Ok(largest);
        }
        Err(StepFailure::Correction {
            correction: largest.abs().to_f64(),
            limit: limit.to_f64(),
            time: time.to_f64(),
        })
    }

    /// Writes the closed state.
    fn store(&mut self, next: &mut State<S>) {
        let masses = &self.stage.places[..self.components.masses];
        for (place, &node) in masses.iter().zip(&self.components.nodes) {
            next.positions.set_point(node as usize, place.q());
            next.momenta.set_point(node as usize, place.p());
        }
        for moved in &self.prescribed.moved {
            let end = &moved.positions[STAGES - 1];
            next.positions.set_point(moved.node.index, end);
        }
        for dashpot in 0..self.stage.temperatures {
            next.viscous.set(dashpot, self.stage.inner[dashpot]);
        }
        for (slot, theta) in next.temperatures.iter_mut().enumerate() {
            *theta = self.stage.theta(slot);
        }
        if self.stage.has_thermostats {
            self.conclude_thermostats(next);
        }
    }
}

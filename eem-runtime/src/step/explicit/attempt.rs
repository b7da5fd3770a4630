//! One attempt at a step, which changes nothing until it is accepted.

use super::accounts::Accounts;
use super::demand::Demand;
use super::error::Measure;
use super::tableau::STAGES;
use super::{Explicit, View};
use crate::element::group::points;
use crate::element::state::State;
use crate::step::error::StepFailure;
use crate::step::outcome::Attempt;

impl Accounts {
    /// Writes the closed internal variables.
    #[inline]
    fn store(&self, next: &mut State) {
        for dashpot in 0..self.stage.temperatures {
            next.viscous.set(dashpot, self.stage.inner[dashpot]);
        }
        for (slot, theta) in next.temperatures.iter_mut().enumerate() {
            *theta = self.stage.theta(slot);
        }
        for held in &self.prescribed.held {
            let balance = &self.scratch.held[held.slot];
            next.book_thermostat(balance.heat, balance.given);
        }
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
}

impl<const D: usize> Explicit<D> {
    /// Writes the state after a step to `next`, from the state of the last accepted step or, after
    /// [`forget`](Accounts::forget), from any state. The outcome is `None` if the error exceeds the demand.
    pub(crate) fn step(
        &mut self,
        view: &View<'_>,
        demand: Demand,
        next: &mut State,
    ) -> Result<Attempt, StepFailure> {
        self.was_ready = self.is_ready;
        let attempt = self.attempt(view, demand, next);
        let is_made = matches!(&attempt, Ok(attempt) if attempt.outcome.is_some());
        if is_made {
            self.has_left = false;
        } else {
            // As before the attempt.
            self.is_ready = self.was_ready;
        }
        attempt.map_err(|failure| {
            let (accounts, bodies) = self.parts(view);
            accounts.explain(&bodies, failure)
        })
    }

    #[inline]
    fn attempt(
        &mut self,
        view: &View<'_>,
        demand: Demand,
        next: &mut State,
    ) -> Result<Attempt, StepFailure> {
        if self.is_driven {
            let (accounts, bodies) = self.parts(view);
            accounts.prescribed.evaluate(&bodies)?;
        }
        let scales = self.approach(view, next)?;
        let measure = match &demand {
            Demand::None => None,
            Demand::Within(tolerance) => Some(Measure {
                view,
                tolerance,
                scales,
                dimension: D,
            }),
        };
        let mut error = 0.0;
        if let Some(by) = &measure {
            error = self.estimate(by, view);
            if !(error <= 1.0) {
                return Ok(Attempt::rejected(error));
            }
        }
        self.book(view, next);
        self.close(view, (demand, scales), next)?;
        if let Some(by) = &measure {
            let (accounts, bodies) = self.parts(view);
            let moved = accounts.moved(&bodies, by);
            if !(moved <= 1.0) {
                return Ok(Attempt::rejected(moved));
            }
        }
        if next.meters.are_on {
            self.accounts.meter(view.step, next);
        }
        let correction = self.correction(view, demand.largest_correction())?;
        if self.loads.has_force() {
            let (accounts, bodies) = self.parts(view);
            accounts.book_constant_loads(&bodies, next);
        }
        self.finish()?;
        self.store(next);
        self.books.largest_momentum = scales.momentum;
        let outcome = Some(self.prove(correction, view)?);
        Ok(Attempt { error, outcome })
    }

    /// The largest defect of all components before closing; an error unless it is small, or rounding.
    #[inline]
    fn correction(&mut self, view: &View<'_>, limit: f64) -> Result<f64, StepFailure> {
        let mut largest = 0.0_f64;
        for index in 0..self.scratch.progress.len() {
            let progress = &self.scratch.progress[index];
            let (own, scale) = (progress.correction, progress.scale);
            let is_rounding = !(own.abs() <= limit) && {
                let (accounts, bodies) = self.parts(view);
                (own * scale).abs() <= accounts.explained(&bodies, index, scale)
            };
            if !is_rounding && largest.abs() < own.abs() {
                largest = own;
            }
        }
        if largest.abs() <= limit {
            return Ok(largest);
        }
        Err(StepFailure::Correction {
            correction: largest.abs(),
            limit,
            time: view.end(),
        })
    }

    /// Writes the closed state.
    #[inline]
    fn store(&mut self, next: &mut State) {
        let masses = &self.places[..self.components.masses];
        for (place, &node) in masses.iter().zip(&self.components.nodes) {
            next.positions.set_point(node, place.q());
            next.momenta.set_point(node, place.p());
        }
        for moved in &self.prescribed.moved {
            let end = &points::<D>(&moved.positions)[STAGES - 1];
            next.positions.set_point(moved.node, end);
        }
        self.accounts.store(next);
    }
}

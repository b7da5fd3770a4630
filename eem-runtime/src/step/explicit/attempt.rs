//! One attempt at a step, which changes nothing until it is accepted.

use super::closing::FROZEN;
use super::components::Support;
use super::demand::{Demand, Scales};
use super::memory::{END, START};
use super::stages::From;
use super::tableau::STAGES;
use super::{Explicit, ExplicitView};
use crate::element::group::UnkeptEntropy;
use crate::element::state::State;
use crate::step::certificate::is_wide;
use crate::step::error::StepFailure;
use crate::step::law::Law;
use crate::step::outcome::{Attempt, Outcome};
use eem_material::number::compensated::Total;
use eem_material::number::scalar::{Mask, Real};

/// Roundings of the magnitude of the energy that a step may be off by, as in the certificate.
const ROUNDINGS: f64 = 64.0;

impl<S: Real, const D: usize> Explicit<S, D> {
    /// One step: an attempt that is accepted unless its error exceeds what is demanded, or the reason why there
    /// is none.
    pub(crate) fn step(
        &mut self,
        view: &ExplicitView<'_, S, D>,
        demand: Demand<S>,
        next: &mut State<S>,
    ) -> Result<Attempt<S>, StepFailure> {
        let attempt = self.attempt(view, demand, next);
        let attempt = attempt.map_err(|failure| self.explain(failure, view))?;
        if attempt.outcome.is_some() {
            self.accept();
        }
        Ok(attempt)
    }

    /// Writes the state after a step to `next`, from a state that is that of the last accepted step, or after
    /// [`forget`](Self::forget) any. It counts once it is [accepted](Self::accept).
    fn attempt(
        &mut self,
        view: &ExplicitView<'_, S, D>,
        demand: Demand<S>,
        next: &mut State<S>,
    ) -> Result<Attempt<S>, StepFailure> {
        self.was_ready = self.is_ready;
        let attempt = self.attempt_ready(view, demand, next);
        let is_made = attempt
            .as_ref()
            .is_ok_and(|attempt| attempt.outcome.is_some());
        if !is_made {
            // As it was before, also if nothing was known of the state.
            self.is_ready = self.was_ready;
        }
        attempt
    }

    fn attempt_ready(
        &mut self,
        view: &ExplicitView<'_, S, D>,
        demand: Demand<S>,
        next: &mut State<S>,
    ) -> Result<Attempt<S>, StepFailure> {
        let h = view.step;
        let time = view.state.time.value;
        self.prescribed.evaluate(view.loads, [time, h])?;
        self.load(view);
        if !self.is_ready {
            self.prepare(view)?;
        }
        self.go_through_stages(view)?;
        self.expect_finite(time + h)?;
        let scales = self.scales();
        let error = match demand {
            Demand::None => S::zero(),
            Demand::Within(tolerance) => self.estimate(h, &tolerance, scales),
        };
        if !error.at_most(S::one()).all() {
            let outcome = None;
            return Ok(Attempt { error, outcome });
        }
        self.book(view, next);
        self.close(view, (demand, scales), next)?;
        let correction = self.correction(demand, time + h)?;
        self.finish()?;
        self.conclude_thermostats(view.state, next);
        self.store(view.state, next);
        let outcome = self.prove(scales, correction, (view.state, time + h))?;
        Ok(Attempt {
            error,
            outcome: Some(outcome),
        })
    }

    /// The step that was attempted last is made: the next one starts from its state.
    fn accept(&mut self) {
        core::mem::swap(&mut self.start, &mut self.end);
        self.rows.swap(START, END);
        core::mem::swap(&mut self.books, &mut self.new_books);
    }

    /// Takes back what has just been accepted.
    pub(crate) fn undo(&mut self) {
        self.accept();
        self.is_ready = self.was_ready;
    }

    /// The next step starts from another state: rates and targets are found anew.
    pub(crate) fn forget(&mut self) {
        self.is_ready = false;
    }

    /// All stages, and the end of the step before it is closed.
    fn go_through_stages(&mut self, view: &ExplicitView<'_, S, D>) -> Result<(), StepFailure> {
        for stage in 0..STAGES {
            if stage > 0 {
                self.go_to(stage, view.step);
                self.evaluate(stage, view)?;
            }
            self.gather(stage, view.step);
        }
        self.go_to(STAGES, view.step);
        Ok(())
    }

    fn expect_finite(&self, time: S) -> Result<(), StepFailure> {
        if !time.is_finite() {
            let value = time.to_f64();
            return Err(StepFailure::Time { value });
        }
        let moving = &self.y[..self.offsets.viscous];
        // Zero, unless some number is infinite or none.
        let rest = moving
            .iter()
            .fold(S::zero(), |rest, &x| rest + S::zero() * x);
        if rest.equal(S::zero()).all() {
            return Ok(());
        }
        Err(self.unbounded())
    }

    /// Which number of the state before closing is infinite or none.
    #[cold]
    fn unbounded(&self) -> StepFailure {
        let moving = &self.y[..self.offsets.viscous];
        let at = moving.iter().position(|value| !value.is_finite());
        let at = at.unwrap_or(0);
        let is_position = at < self.offsets.momenta;
        let place = at % self.offsets.momenta / D;
        StepFailure::Unbounded {
            node: self.components.nodes[place] as usize,
            axis: at % D,
            quantity: if is_position { "position" } else { "momentum" },
            value: moving[at].to_f64(),
        }
    }

    /// The largest first defect of all components, which has to be small.
    fn correction(&self, demand: Demand<S>, time: S) -> Result<S, StepFailure> {
        let all = self
            .scratch
            .progress
            .iter()
            .map(|progress| progress.correction);
        let largest = all.fold(S::zero(), |largest, correction| {
            let is_larger = largest.abs().less(correction.abs());
            S::select(is_larger, correction, largest)
        });
        let limit = demand.largest_correction();
        if largest.abs().at_most(limit).all() {
            return Ok(largest);
        }
        Err(StepFailure::Correction {
            correction: largest.abs().to_f64(),
            limit: limit.to_f64(),
            time: time.to_f64(),
        })
    }

    /// The rates of the closed state.
    fn finish(&mut self) -> Result<(), StepFailure> {
        Ok(self.find_rates(STAGES - 1, From::Closing, END)?)
    }

    /// Writes the closed state.
    fn store(&self, old: &State<S>, next: &mut State<S>) {
        let offsets = self.offsets;
        next.positions.copy_from(&old.positions);
        next.momenta.copy_from(&old.momenta);
        let placed = self.components.nodes.iter().enumerate();
        let part = |from: usize, place: usize| &self.y[from + place * D..from + (place + 1) * D];
        next.positions.write(|values| {
            for (place, &node) in placed.clone() {
                let node = node as usize * D;
                values[node..node + D].copy_from_slice(part(0, place));
            }
            for (node, position, _) in self.prescribed.motions(STAGES - 1) {
                values[node * D..(node + 1) * D].copy_from_slice(position);
            }
        });
        next.momenta.write(|values| {
            for (place, &node) in placed.take(self.components.masses) {
                let node = node as usize * D;
                values[node..node + D].copy_from_slice(part(offsets.momenta, place));
            }
        });
        let viscous = &self.y[offsets.viscous..offsets.temperatures];
        next.viscous.write(|values| values.copy_from_slice(viscous));
        let temperatures = &self.y[offsets.temperatures..offsets.reservoirs];
        next.temperatures.copy_from_slice(temperatures);
    }

    /// What is left of all defects, formed with energies of the state, has to be rounding.
    fn prove(
        &mut self,
        scales: Scales<S>,
        correction: S,
        (start, time): (&State<S>, S),
    ) -> Result<Outcome<S>, StepFailure> {
        if let Some(UnkeptEntropy { element, sizes }) = self.scratch.unkept {
            let sizes = sizes.map(S::from_f64);
            return Err(Law::KeptEntropy.not_kept(sizes, Some(element), time));
        }
        let rounding = S::from_f64(ROUNDINGS) * S::EPSILON;
        let [old, mut terms] = self
            .books
            .terms
            .unwrap_or_else(|| self.terms_at_start(start));
        let (mut residue, mut counted, mut own) = (S::zero(), S::zero(), S::zero());
        for index in 0..self.components.all.len() {
            let seen = self.scratch.progress[index].seen;
            let [defect, magnitude, motion] = seen.unwrap_or_else(|| self.defect_of(index));
            let granularity = self.scratch.progress[index].granularity;
            let magnitude = magnitude + S::from_f64(FROZEN / ROUNDINGS) * granularity;
            expect(Law::Energy, [-defect, rounding * magnitude], time)?;
            self.prove_momenta(index, time)?;
            residue -= defect;
            let energy = &self.scratch.energies[index];
            counted += magnitude + energy.excess;
            own += motion + energy.terms;
        }
        terms += own;
        let mut bound = rounding * (old + counted);
        if self.books.terms.is_none() {
            // After a restart the terms are not those of the step that left the old residue.
            bound += self.books.residue.abs();
        }
        self.new_books.terms = Some([counted, own]);
        self.new_books.largest_momentum = scales.momentum;
        self.new_books.residue = residue;
        let (mut production, mut least) = (Total::default(), self.scratch.least);
        for progress in &self.scratch.progress {
            production.add_total(progress.production);
            let has_produced = progress.least.less(S::MAX);
            // The factor is rounded to ε of what was produced before the closing.
            let closed = (progress.least * progress.factor).minimum(progress.production.value());
            least = least.minimum(S::select(has_produced, closed, S::MAX));
        }
        let has_produced = least.less(S::MAX);
        let least_production = S::select(has_produced, least, S::zero());
        expect(
            Law::Production,
            [least_production.minimum(S::zero()), S::zero()],
            time,
        )?;
        Ok(Outcome {
            defect: residue - self.books.residue,
            bound,
            is_bound_wide: is_wide(bound, terms),
            production: production.value(),
            least_production,
            correction,
        })
    }

    /// The momenta of the state that a component keeps have to be their targets, in all planes.
    fn prove_momenta(&self, index: usize, time: S) -> Result<(), StepFailure> {
        let component = &self.components.all[index];
        let Some(origin) = self.origin(component) else {
            return Ok(());
        };
        let rounding = S::from_f64(ROUNDINGS) * S::EPSILON;
        let (linear, angular) = self.missing_momenta(index, &origin);
        // Sums of magnitudes are at most √D times a length.
        let [momenta, moments] = self.momentum_terms(index, &origin);
        let dimension = (0..D).fold(S::zero(), |sum, _| sum + S::one());
        let (momenta, moments) = (momenta / dimension.sqrt(), moments / dimension);
        if component.support == Support::Free {
            let largest = linear
                .iter()
                .fold(S::zero(), |most, x| most.maximum(x.abs()));
            expect(Law::LinearMomentum, [largest, rounding * momenta], time)?;
        }
        expect(
            Law::AngularMomentum,
            [angular.largest(), rounding * moments],
            time,
        )
    }
}

/// An error where a law is off by more than its bound, or by what is no number.
fn expect<S: Real>(law: Law, [defect, bound]: [S; 2], time: S) -> Result<(), StepFailure> {
    if defect.abs().at_most(bound).all() {
        return Ok(());
    }
    Err(law.not_kept([defect, bound], None, time))
}

//! A run whose scheme follows from what the motion takes.

use super::attempt::explicit_view;
use super::control_memory::Control;
use super::groups::Groups;
use super::stepper::{Parts, Stepper};
use super::{Simulation, Tried};
use crate::algebra::memory::TooLarge;
use crate::element::group::Placed;
use crate::run::checkpoint::{Checkpoint, RestoreError, SavedChoice};
use crate::step::automatic::{CANDIDATES, Verdict, implicit};
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::SavedExplicit;
use crate::step::newton::StepReport;
use crate::step::scheme::{Closing, Scheme};
use crate::step::solver::SavedPast;
use crate::step::systems::Systems;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// An accurate step of a scheme that is likely to take least; the state is what it was if there is none.
    pub(super) fn step_of_choice(
        &mut self,
        control: &mut Control<S>,
        end: S,
    ) -> Result<StepReport<S>, StepError> {
        self.judge_trial(control);
        let is_explicit = self.in_use.closing() == Closing::Explicit;
        if is_explicit {
            self.look(control);
            if let Some(report) = self.try_implicit(control, end)? {
                return Ok(report);
            }
        } else {
            self.try_explicit(control);
        }
        self.step_of_some_scheme(control, end)
    }

    /// A step of the present scheme, or of another one if it finds none.
    fn step_of_some_scheme(
        &mut self,
        control: &mut Control<S>,
        end: S,
    ) -> Result<StepReport<S>, StepError> {
        let (own, usual) = (self.in_use, self.step);
        let mut failed = match self.counted_step(control, end) {
            Ok(report) => return Ok(report),
            Err(error) => error,
        };
        let StepFailure::TooSmall { too_large, .. } = &mut failed.failure else {
            return Err(failed);
        };
        let past = self.stepper.past(&self.state);
        for scheme in CANDIDATES {
            if scheme == own
                || !self.is_candidate(scheme, control)
                || !self.goes_over_to(scheme, control)
            {
                continue;
            }
            self.step = usual;
            if let Ok(report) = self.counted_step(control, end) {
                self.gone_on(control, usual);
                return Ok(report);
            }
        }
        self.return_to_scheme(own, &past, control);
        *too_large = control.memory.statistics.too_large;
        Err(failed)
    }

    /// Whether a scheme can be asked for steps of this tolerance.
    fn is_candidate(&self, scheme: Scheme, control: &Control<S>) -> bool {
        let is_second = (self.automatic.as_ref()).is_some_and(|automatic| automatic.is_second);
        let suits = !is_second || scheme.closing() == Closing::Increments;
        suits && control.memory.tolerance.check(scheme.accuracy()).is_ok()
    }

    /// A step of the present scheme, and what it took.
    fn counted_step(
        &mut self,
        control: &mut Control<S>,
        end: S,
    ) -> Result<StepReport<S>, StepError> {
        let before = self.stepper.evaluations();
        let found = self.find_accurate_step(control, end);
        let time = found.as_ref().map_or(0.0, |report| report.step.to_f64());
        self.count(before, time);
        found
    }

    /// Counts what was evaluated since there were so many evaluations, for a step of this time, s.
    fn count(&mut self, before: u64, time: f64) {
        let evaluations = self.stepper.evaluations() - before;
        let scheme = (self.in_use, self.layout.unknowns);
        if let Some(automatic) = &mut self.automatic {
            automatic.choice.note(scheme, evaluations, time);
        }
    }

    /// Looks how close explicit steps are to what is stable.
    fn look(&mut self, control: &Control<S>) {
        let Some(automatic) = &mut self.automatic else {
            return;
        };
        if !automatic.choice.looks() {
            return;
        }
        if let Stepper::Explicit(explicit) = &mut self.stepper {
            let view = explicit_view!(self);
            let failures = control.memory.statistics.failures();
            let share = explicit.share_of_stable_step(&view);
            automatic.choice.see(share, failures);
        }
    }

    /// One step of an implicit scheme, if it is time to try one and it is accurate.
    fn try_implicit(
        &mut self,
        control: &mut Control<S>,
        end: S,
    ) -> Result<Option<StepReport<S>>, StepError> {
        let unknowns = self.layout.unknowns;
        let Some(automatic) = &mut self.automatic else {
            return Ok(None);
        };
        let scheme = implicit(&control.memory.tolerance, automatic.is_second);
        let Some(size) = automatic.choice.implicit_trial(scheme, unknowns) else {
            return Ok(None);
        };
        let size = S::from_f64(size).minimum(control.memory.largest);
        if !self.is_candidate(scheme, control) || self.size_towards(end, size)?.is_some() {
            return Ok(None);
        }
        let (own, usual) = (self.in_use, self.step);
        let past = self.stepper.past(&self.state);
        if !self.goes_over_to(scheme, control) {
            self.wait_longer();
            return Ok(None);
        }
        let tried = self.attempt(control, size);
        if let Ok(Tried::Made(report)) = tried {
            self.count(0, report.step.to_f64());
            let accuracy = control.accuracy;
            self.step = control.memory.controller.next(size, report.error, accuracy);
            self.accept(control);
            self.gone_on(control, usual);
            return Ok(Some(report));
        }
        self.count(0, 0.0);
        let statistics = &mut control.memory.statistics;
        match tried {
            Err(error) => _ = statistics.note_failure(&error.failure),
            Ok(_) => statistics.rejected_by_error += 1,
        }
        self.return_to_scheme(own, &past, control);
        self.wait_longer();
        Ok(None)
    }

    /// The next trial waits twice as long as this one did.
    fn wait_longer(&mut self) {
        if let Some(automatic) = &mut self.automatic {
            automatic.choice.wait_longer();
        }
    }

    /// Goes over to the explicit scheme for some steps, if it is time to try it.
    fn try_explicit(&mut self, control: &mut Control<S>) {
        let explicit = Scheme::EemExplicit;
        if !self.is_candidate(explicit, control) {
            return;
        }
        let Some(automatic) = &mut self.automatic else {
            return;
        };
        let size = self.step.to_f64();
        if automatic.choice.tries_explicit(size) {
            let previous = self.in_use;
            if !self.goes_over_to(explicit, control) {
                return self.wait_longer();
            }
            if let Some(automatic) = &mut self.automatic {
                automatic.previous = previous;
                let size = automatic.choice.begin_trial(size);
                self.step = S::from_f64(size).minimum(self.step);
            }
        }
    }

    /// Ends the trial of the explicit scheme, if enough is known.
    fn judge_trial(&mut self, control: &mut Control<S>) {
        let Some(automatic) = &mut self.automatic else {
            return;
        };
        match automatic.choice.judge(self.step.to_f64()) {
            Verdict::None => {}
            Verdict::Keep => control.memory.statistics.changes_of_scheme += 1,
            Verdict::Return(size) => {
                let scheme = automatic.previous;
                // Without the memory that it had, the explicit scheme is gone on with, whose steps have their size.
                if self.goes_over_to(scheme, control) {
                    self.step = S::from_f64(size);
                }
            }
        }
    }

    /// The present scheme has taken the place of one whose steps had this size.
    fn gone_on(&mut self, control: &mut Control<S>, last: S) {
        control.memory.statistics.changes_of_scheme += 1;
        if let Some(automatic) = &mut self.automatic {
            automatic.choice.change(last.to_f64());
        }
    }

    /// Steps the elements by another scheme from now on; false, with a note in the statistics, if there is no memory
    /// for it.
    fn goes_over_to(&mut self, scheme: Scheme, control: &mut Control<S>) -> bool {
        match self.use_scheme(scheme) {
            Ok(()) => {
                *control = self.control_of(control.memory.after_change());
                true
            }
            Err(too_large) => {
                control.memory.statistics.too_large = Some(too_large);
                false
            }
        }
    }

    /// Steps by the scheme from before a trial again, with what it knew; a note says so if its memory is gone.
    fn return_to_scheme(
        &mut self,
        scheme: Scheme,
        (past, explicit): &(SavedPast<S>, Option<SavedExplicit<S>>),
        control: &mut Control<S>,
    ) {
        if self.in_use == scheme || self.goes_over_to(scheme, control) {
            self.stepper.restore(past, explicit.as_ref());
        }
    }

    /// The same while nothing controls the steps; an error, and nothing has changed, if there is no memory for it.
    pub(super) fn use_scheme(&mut self, scheme: Scheme) -> Result<(), TooLarge> {
        let Some(automatic) = &mut self.automatic else {
            return Ok(());
        };
        let elements = (&automatic.elements[..], &self.layout);
        let (rockets, limit) = (self.loads.rocket_lines(), automatic.memory_limit);
        let systems = Systems::new(scheme, elements, &self.conduction, &rockets, limit)?;
        automatic.evaluations += self.stepper.evaluations();
        let parts = Parts {
            scheme,
            masses: &self.masses,
            elements: &automatic.elements,
            layout: &self.layout,
            conduction: &self.conduction,
            loads: &self.loads,
        };
        let placed = Placed {
            nodes: &automatic.elements,
            layout: &self.layout,
        };
        let groups = Groups::new(self.stepper.take_elements(), scheme, placed);
        self.stepper = Stepper::new(groups, systems, parts, &self.state);
        self.stepper.set_motion_first(automatic.is_motion_first);
        // As after a restart: each scheme has its own way to them.
        let state = &mut self.state;
        self.stepper.each_mut(|group| group.find_energies(state));
        self.in_use = scheme;
        self.has_stepped = false;
        Ok(())
    }

    /// What a checkpoint keeps of the choice of a scheme.
    pub(super) fn saved_choice(&self) -> Option<SavedChoice> {
        let automatic = self.automatic.as_ref();
        automatic.map(|automatic| SavedChoice {
            scheme: self.in_use,
            previous: automatic.previous,
            choice: automatic.choice,
        })
    }

    /// The choice of a checkpoint, if it can be one of this run.
    pub(super) fn choice_in(
        &self,
        checkpoint: &Checkpoint<S>,
    ) -> Result<Option<SavedChoice>, RestoreError> {
        let Some(automatic) = &self.automatic else {
            return Ok(None);
        };
        let choice = checkpoint.choice;
        let suits = |scheme: Scheme| {
            let is_suited = scheme.closing() == Closing::Increments;
            CANDIDATES.contains(&scheme) && (is_suited || !automatic.is_second)
        };
        match choice {
            Some(saved) if !suits(saved.scheme) || !suits(saved.previous) => {
                Err(RestoreError::Scheme {
                    checkpoint: saved.scheme,
                    simulation: self.scheme,
                })
            }
            found => Ok(found),
        }
    }

    /// Goes on from a saved choice, whose scheme is in use.
    pub(super) fn restore_choice(&mut self, saved: Option<SavedChoice>) {
        if let (Some(automatic), Some(saved)) = (&mut self.automatic, saved) {
            automatic.choice = saved.choice;
            automatic.previous = saved.previous;
        }
    }
}

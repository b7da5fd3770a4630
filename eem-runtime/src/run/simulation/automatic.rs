//! `Scheme::Auto`: the scheme that follows the motion with the least effort.

use super::attempt::start;
use super::memory::Control;
use super::{Run, Stepped, Tried};
use crate::element::state::Energy;
use crate::run::checkpoint::{Checkpoint, RestoreError, SavedChoice};
use crate::step::automatic::{CANDIDATES, Verdict};
use crate::step::control::Controller;
use crate::step::error::StepFailure;
use crate::step::explicit::{REAL_LIMIT, SavedExplicit};
use crate::step::scheme::{Closing, Scheme};
use crate::step::solver::SavedPast;
use eem_material::number::scalar::Scalar;

/// Relaxation times in the longest step in which no difference alternates.
const MOST_RESOLVED: f64 = 2.0;

/// The scheme in use, with its history and the energies of the elements as it evaluated them.
pub(super) struct SchemeAtWork {
    pub(super) scheme: Scheme,
    past: SavedPast,
    explicit: Option<SavedExplicit>,
    energies: Vec<Energy>,
}

impl Run {
    /// An accurate step by the scheme that is likely to be the cheapest; the state is unchanged if there is none.
    pub(super) fn step_of_choice(&mut self, control: &mut Control, end: f64) -> Stepped {
        self.judge_trial(control);
        if self.in_use.closing() == Closing::Explicit {
            self.measure_stability(control);
        } else {
            self.try_explicit(control);
        }
        if self.try_implicit(control, end).is_some() {
            return Ok(());
        }
        self.step_by_some_scheme(control, end)
    }

    /// Whether steps may change the scheme. A history for gradients has steps of one scheme.
    pub(super) fn may_change_scheme(&self) -> bool {
        #[cfg(feature = "gradients")]
        if self.history.is_some() && self.in_use.has_adjoint() {
            return false;
        }
        self.scheme == Scheme::Auto
    }

    /// Takes the damped scheme for constant steps that are longer than the present scheme resolves the relaxation of conduction and
    /// dashpots, if it is to be chosen and there is memory for it. With a tolerance their errors are seen.
    pub(super) fn damp_fixed_steps(&mut self) {
        if self.control.is_some() || self.in_use.is_damped() || !self.may_change_scheme() {
            return;
        }
        let most = match self.in_use.closing() {
            Closing::Explicit => REAL_LIMIT,
            _ => MOST_RESOLVED,
        };
        let fastest = self.fastest_relaxation();
        if fastest.is_some_and(|(time, _)| self.step > most * time) {
            // Without memory for it, the present scheme goes on, with a warning.
            _ = self.use_scheme(Scheme::EemDamped);
        }
    }

    /// A step of the present scheme, or of another one if it finds none.
    fn step_by_some_scheme(&mut self, control: &mut Control, end: f64) -> Stepped {
        let (own, usual) = (self.in_use, self.step);
        let Err(mut failed) = self.counted_step(control, end) else {
            return Ok(());
        };
        let StepFailure::TooSmall { too_large, .. } = &mut failed.failure else {
            return Err(failed);
        };
        let before = self.scheme_at_work();
        for &scheme in &CANDIDATES {
            if scheme != own
                && self.is_candidate(scheme, control)
                && self.switches_to(scheme, control)
            {
                self.step = usual;
                if self.counted_step(control, end).is_ok() {
                    self.record_switch(control, usual);
                    return Ok(());
                }
            }
        }
        self.return_to_scheme(&before, control);
        *too_large = control.memory.statistics.too_large;
        Err(failed)
    }

    /// Whether a scheme suits the scene and the tolerance.
    fn is_candidate(&self, scheme: Scheme, control: &Control) -> bool {
        let suits = self.automatic.needs.allows(scheme);
        suits && control.memory.tolerance.check(scheme.accuracy()).is_ok()
    }

    /// A step of the present scheme, whose effort is counted.
    fn counted_step(&mut self, control: &mut Control, end: f64) -> Stepped {
        let before = self.stepper.evaluations();
        let found = self.find_accurate_step(control, end);
        let time = if found.is_ok() { self.report.step } else { 0.0 };
        self.count(before, time);
        found
    }

    /// Counts the evaluations beyond `before`, for a step of this size, s; zero if it failed.
    fn count(&mut self, before: u64, time: f64) {
        let evaluations = self.stepper.evaluations() - before;
        let scheme = (self.in_use, self.layout.unknowns);
        self.automatic.selection.note(scheme, evaluations, time);
    }

    /// From time to time compares the explicit step with the limit of stability.
    fn measure_stability(&mut self, control: &Control) {
        if self.automatic.selection.looks()
            && let Some(share) = self.stepper.share_of_stable_step(&start!(self, self.step))
        {
            let failures = control.memory.statistics.failures();
            self.automatic.selection.see(share, failures);
        }
    }

    /// One step of another implicit scheme, if a trial is due and the step is accurate.
    fn try_implicit(&mut self, control: &mut Control, end: f64) -> Option<()> {
        let (scheme, size) = self.implicit_trial(control)?;
        if self.size_towards(end, size).is_some() {
            return None;
        }
        let (before, usual) = (self.scheme_at_work(), self.step);
        let spent = self.automatic.selection.spent;
        if size <= control.memory.largest && self.switches_to(scheme, control) {
            let tried = self.attempt(control, size);
            if let Ok(Tried::Made) = tried {
                self.count(0, self.report.step);
                self.find_next_size(control, size);
                self.accept(control);
                self.record_switch(control, usual);
                return Some(());
            }
            self.count(0, 0.0);
            let statistics = &mut control.memory.statistics;
            match tried {
                Err(error) => _ = statistics.note_failure(&error.failure),
                Ok(Tried::Rejected(_)) => statistics.rejected_by_error += 1,
                Ok(_) => {}
            }
            self.return_to_scheme(&before, control);
        }
        self.automatic.selection.reject_implicit(self.in_use, spent);
        None
    }

    /// The implicit scheme whose trial is due, and the size of its step, s.
    fn implicit_trial(&mut self, control: &Control) -> Option<(Scheme, f64)> {
        let selection = &mut self.automatic.selection;
        let is_limited = self.in_use == Scheme::EemExplicit && selection.is_limited();
        let is_due = is_limited || selection.has_settled(self.step);
        if !is_due || !selection.may_try_implicit() {
            return None;
        }
        let (tolerance, unknowns) = (&control.memory.tolerance, self.layout.unknowns);
        let suits = |scheme: Scheme| self.is_candidate(scheme, control);
        let (own, selection) = (self.in_use, &self.automatic.selection);
        let scheme = selection.next_in_turn(own, (tolerance, unknowns), &suits)?;
        let selection = &mut self.automatic.selection;
        let size = selection.implicit_trial([own, scheme], unknowns, tolerance.relative)?;
        Some((scheme, size))
    }

    /// Switches to the explicit scheme for some steps, if a trial is due.
    fn try_explicit(&mut self, control: &mut Control) {
        let size = self.step;
        if !self.is_candidate(Scheme::EemExplicit, control)
            || !self.automatic.selection.tries_explicit(size)
        {
            return;
        }
        let previous = self.in_use;
        if !self.switches_to(Scheme::EemExplicit, control) {
            return self.automatic.selection.reject_explicit();
        }
        self.automatic.previous = previous;
        let size = self.automatic.selection.begin_trial(size);
        self.step = Scalar::minimum(size, self.step);
    }

    /// Ends the trial of the explicit scheme, if enough is known.
    fn judge_trial(&mut self, control: &mut Control) {
        match self.automatic.selection.judge(self.step) {
            Verdict::None => {}
            Verdict::Keep => control.memory.statistics.changes_of_scheme += 1,
            Verdict::Return(size) => {
                // Without memory for it, the explicit scheme continues with its own steps.
                if self.switches_to(self.automatic.previous, control) {
                    self.step = size;
                }
            }
        }
    }

    /// Records a switch of the scheme and the previous step size.
    fn record_switch(&mut self, control: &mut Control, last: f64) {
        control.memory.statistics.changes_of_scheme += 1;
        self.automatic.selection.change(last);
    }

    /// Switches to a scheme. False, with a note in the statistics, if there is no memory for it.
    fn switches_to(&mut self, scheme: Scheme, control: &mut Control) -> bool {
        if let Err(too_large) = self.use_scheme(scheme) {
            control.memory.statistics.too_large = Some(too_large);
            return false;
        }
        // The errors of earlier steps mean nothing for another scheme.
        control.memory.controller = Controller::new();
        *control = Control {
            // The step goes on to look at loads.
            horizon: control.horizon,
            ..self.control_of(control.memory)
        };
        true
    }

    /// The scheme in use with its history, which [`resume_scheme`](Self::resume_scheme) restores.
    pub(super) fn scheme_at_work(&self) -> SchemeAtWork {
        let (past, explicit) = self.stepper.past(&self.state);
        SchemeAtWork {
            scheme: self.in_use,
            past,
            explicit,
            energies: self.state.energies.clone(),
        }
    }

    /// Returns to the scheme before a trial, if there is memory for it.
    fn return_to_scheme(&mut self, before: &SchemeAtWork, control: &mut Control) {
        if self.in_use == before.scheme || self.switches_to(before.scheme, control) {
            self.resume_scheme(before);
        }
    }

    /// Restores the history of the scheme in use and its energies; the state must be that of `scheme_at_work`.
    pub(super) fn resume_scheme(&mut self, before: &SchemeAtWork) {
        self.stepper.restore(&before.past, before.explicit.as_ref());
        self.state.energies.copy_from_slice(&before.energies);
    }

    /// The choice of a scheme for a checkpoint; `None` unless the scheme is `Scheme::Auto`.
    pub(super) fn saved_choice(&self) -> Option<SavedChoice> {
        (self.scheme == Scheme::Auto).then_some(SavedChoice {
            scheme: self.in_use,
            previous: self.automatic.previous,
            selection: self.automatic.selection,
        })
    }

    /// The choice of a scheme in a checkpoint, if it suits this scene.
    pub(super) fn choice_in(
        &self,
        checkpoint: &Checkpoint,
    ) -> Result<Option<SavedChoice>, RestoreError> {
        let saved = checkpoint.choice.filter(|_| self.scheme == Scheme::Auto);
        let suits = |scheme: Scheme| {
            let is_choice = CANDIDATES.contains(&scheme) || scheme.is_damped();
            is_choice && self.automatic.needs.allows(scheme)
        };
        match saved {
            Some(own) if !(suits(own.scheme) && suits(own.previous)) => Err(RestoreError::Scheme {
                checkpoint: own.scheme,
                simulation: self.scheme,
            }),
            saved => Ok(saved),
        }
    }

    /// Continues from a saved choice, whose scheme is in use.
    pub(super) fn restore_choice(&mut self, saved: Option<SavedChoice>) {
        if let Some(saved) = saved.filter(|_| self.scheme == Scheme::Auto) {
            self.automatic.selection = saved.selection;
            self.automatic.previous = saved.previous;
        }
    }
}

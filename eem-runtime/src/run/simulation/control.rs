//! Step control: steps are tried, and repeated with a smaller size until they are accurate. Settings of steps.

use core::mem;

use super::memory::{Control, Guard, History, SMALLEST, Seen, Snapshot};
use super::start::{check_step, check_tolerance, find_speeds};
use super::{Run, Simulation, Stepped, Tried};
use crate::element::state::State;
use crate::run::checkpoint::SavedControl;
use crate::scene::error::SceneError;
use crate::step::control::{AFTER_FAILURE, StepStatistics, Tolerance, length};
use crate::step::error::{StepError, StepFailure, StepLimit};
use crate::step::explicit::Demand;
use crate::step::newton::NewtonSettings;
use crate::step::samples::Component;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::{Scalar, is_positive};

/// The fraction of its size with which a step that would pass over a load is tried again.
const AFTER_PASSING: f64 = 0.5;

/// # Step control and settings
impl<const D: usize> Simulation<D> {
    /// Switches step control on: steps get the size that the tolerance requires. The present size is tried first.
    ///
    /// A step that fails, is not accurate or does not prove its laws is repeated with a smaller size.
    /// [`step`](Self::step), [`run_until`](Self::run_until), events, recorders and checkpoints work as with
    /// constant steps. Schemes that do not estimate their error make each step in two halves, with one
    /// report for both.
    ///
    /// # Errors
    ///
    /// [`SceneError::Tolerance`], [`SceneError::AbsoluteTolerance`] or [`SceneError::ToleranceTime`] if a tolerance or its
    /// time is invalid, or the tolerance below what the scheme can reach; [`SceneError::FixedSteps`] for the variational schemes.
    ///
    /// ```
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    /// scene.spring(Hooke { stiffness: 1.0, natural_length: 1.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.control_steps(Tolerance::new(1e-6))?;
    /// run.run_until(5.0)?;
    /// let exact = 1.0 + 0.1 * 5.0_f64.cos();
    /// assert!((run.position(ends[1])?[0] - exact).abs() < 5e-6);
    /// assert!(run.step_statistics().is_some_and(|steps| steps.accepted > 100));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn control_steps(&mut self, tolerance: Tolerance) -> Result<(), SceneError> {
        // With a tolerance, errors of conduction and dashpots are seen.
        let in_use = if self.run.scheme == Scheme::Auto && self.run.in_use.is_damped() {
            self.run.automatic.needs.first(self.run.scheme)
        } else {
            self.run.in_use
        };
        check_tolerance(&tolerance, (self.run.scheme, in_use))?;
        if in_use != self.run.in_use {
            self.run.use_scheme(in_use)?;
        }
        self.run.set_control(Some(SavedControl::new(tolerance)));
        Ok(())
    }

    /// Switches step control off: all further steps have the [present size](Self::step_size) and use the [scheme in
    /// use](Self::scheme_in_use). [`Scheme::Auto`] takes [`Scheme::EemDamped`] instead if steps of this size do not
    /// resolve the relaxation of conduction or dashpots in the present state, until steps are controlled again.
    pub fn fix_steps(&mut self) {
        self.run.control = None;
        self.run.damp_fixed_steps();
    }

    /// The tolerance of step control; `None` if it is off.
    #[must_use]
    pub fn tolerance(&self) -> Option<Tolerance> {
        Some(self.run.control.as_ref()?.memory.tolerance)
    }

    /// Statistics of step control; `None` if it is off.
    #[must_use]
    pub fn step_statistics(&self) -> Option<StepStatistics> {
        Some(self.run.control.as_ref()?.memory.statistics)
    }

    /// Limits the size of controlled steps, s: smallest and largest. By default there are none; but no step is below 16 ε
    /// times the time or the last step. Where nothing moves, steps grow without limit; loads that are functions of time are
    /// seen before they set in, see [`shortest_load`](crate::Scene::shortest_load).
    ///
    /// # Errors
    ///
    /// [`SceneError::StepLimits`] unless both are positive and finite, the first is not above the second, and steps
    /// are [controlled](Self::control_steps). The old limits remain.
    pub fn limit_steps(&mut self, [smallest, largest]: [f64; 2]) -> Result<(), SceneError> {
        let is_range = smallest > 0.0 && smallest <= largest && largest < f64::MAX;
        match &mut self.run.control {
            Some(control) if is_range => {
                control.memory.smallest = smallest;
                control.memory.largest = largest;
                Ok(())
            }
            control => Err(SceneError::StepLimits {
                smallest,
                largest,
                is_controlled: control.is_some(),
            }),
        }
    }

    /// The size of the next steps, s.
    #[must_use]
    pub const fn step_size(&self) -> f64 {
        self.run.step
    }

    /// Changes the size of the next steps, s. This is allowed at any time, as all laws hold step by step.
    ///
    /// # Errors
    ///
    /// [`SceneError::Step`] unless it is finite and at least 2⁻⁵¹¹ s, 1.5e-154 s; the old size remains.
    pub fn set_step_size(&mut self, step: f64) -> Result<(), SceneError> {
        check_step(step)?;
        self.run.step = step;
        self.run.damp_fixed_steps();
        Ok(())
    }

    /// Whether the explicit scheme corrects the energy of a step by motion before heat.
    #[must_use]
    pub fn is_motion_first(&self) -> bool {
        self.run.is_motion_first()
    }

    /// Selects how the explicit scheme corrects the energy of a step: first by heat (default), or first by motion.
    /// Heat is more accurate and changes the entropy production of elements in the step by at most 0.3 %; motion
    /// leaves it unchanged. No effect on other schemes.
    pub fn set_motion_first(&mut self, is_motion_first: bool) {
        self.run.stepper.set_motion_first(is_motion_first);
        if self.run.scheme == Scheme::Auto {
            self.run.automatic.is_motion_first = is_motion_first;
        }
    }

    /// The settings of Newton's method.
    #[must_use]
    pub const fn newton_settings(&self) -> NewtonSettings {
        self.run.effort.settings
    }

    /// Changes the settings of Newton's method.
    ///
    /// # Errors
    ///
    /// [`SceneError::NewtonSettings`] unless there is at least one iteration and the tolerance lies between 0 and
    /// 1; the old settings remain.
    pub fn set_newton_settings(&mut self, settings: NewtonSettings) -> Result<(), SceneError> {
        self.run.set_newton_settings(settings)
    }
}

impl Run {
    /// Begins step control by a tolerance, or by the default one of a scheme that needs it.
    pub(super) fn begin_control(&mut self, tolerance: Option<Tolerance>) {
        if let Some(tolerance) = &tolerance {
            self.find_first_step(tolerance);
        }
        let default = (self.scheme == Scheme::Auto).then(Tolerance::default);
        self.set_control(tolerance.or(default).map(SavedControl::new));
    }

    /// Finds the first step for a tolerance, and the velocities of moved anchors within it.
    fn find_first_step(&mut self, tolerance: &Tolerance) {
        let accuracy = self.in_use.accuracy();
        let step = self.least.first_step(tolerance.relative, accuracy);
        // Longer than the rounding of the time.
        let least = SMALLEST * f64::EPSILON * self.start.abs();
        self.step = Scalar::maximum(step, least);
        let mut velocities = self.state.velocities.values().to_vec();
        // Those of a longer step have been found.
        let span = [self.start, self.step];
        if self.masses.are_coupled() && find_speeds(&self.loads, span, &mut velocities).is_empty() {
            let write = |all: &mut [f64]| all.copy_from_slice(&velocities);
            self.state.velocities.write(write);
            self.state.follow_velocities(self.dimension, &self.masses);
        }
    }

    /// Continues step control from its history; `None` switches it off.
    pub(super) fn set_control(&mut self, memory: Option<SavedControl>) {
        self.control = memory.map(|memory| Box::new(self.control_of(memory)));
    }

    /// Step control of the scheme in use with this history.
    pub(super) fn control_of(&self, memory: SavedControl) -> Control {
        let accuracy = self.in_use.accuracy();
        let accuracy = match memory.tolerance.over {
            Some(_) => accuracy.over_time(),
            None => accuracy,
        };
        let halves = accuracy.has_halves().then(|| self.new_halves());
        Control {
            memory,
            accuracy,
            horizon: None,
            seen: Seen {
                value: vec![0.0; self.dimension],
                seen: vec![Component::default(); self.dimension],
            },
            halves,
        }
    }

    /// One step by the scheme in use, of the present size but not beyond `end`.
    #[inline]
    pub(super) fn step_of_fixed_size(&mut self, end: f64) -> Result<(), StepError> {
        let end = self.stop_before(end);
        let full = self.step;
        let last = self.size_towards(end, full);
        let size = last.unwrap_or(full);
        if let Err(error) = self.make_step(size) {
            return Err(self.with_shorter(error, size));
        }
        if last.is_some() {
            self.arrive_at(end);
        }
        Ok(())
    }

    /// One step by the scheme in use, not beyond `end`, of an accurate size; by another scheme if that is allowed and
    /// cheaper.
    pub(super) fn step_towards(&mut self, end: f64, may_switch: bool) -> Stepped {
        // A step in the scheme goes to a time within one that has looked.
        let horizon = may_switch.then_some(end);
        let end = self.stop_before(end);
        let may_switch = may_switch && self.may_change_scheme();
        let history = self.history();
        let found = self.with_control(|run, control| match control {
            None => run.step_by(run.step),
            Some(control) => {
                control.horizon = horizon;
                if may_switch {
                    run.step_of_choice(control, end)
                } else {
                    run.find_accurate_step(control, end)
                }
            }
        });
        if found.is_err() {
            let control = self.control.as_ref();
            let statistics = control.map(|control| control.memory.statistics);
            self.restore_history(&history);
            if let (Some(control), Some(statistics)) = (&mut self.control, statistics) {
                control.memory.statistics = statistics;
            }
        }
        found
    }

    /// Calls a function with step control taken out of the simulation; it is put back even if a load panics.
    fn with_control<T>(&mut self, act: impl FnOnce(&mut Self, Option<&mut Control>) -> T) -> T {
        let control = self.control.take();
        let mut guard = Guard::new((self, control), |(run, control)| {
            run.control = control.take();
        });
        let (run, control) = &mut guard.value;
        act(run, control.as_deref_mut())
    }

    /// An accurate step of the scheme in use, not beyond `end`.
    pub(super) fn find_accurate_step(&mut self, control: &mut Control, end: f64) -> Stepped {
        let usual = self.step;
        loop {
            let memory = &control.memory;
            let least = Scalar::maximum(self.step, memory.smallest);
            let full = Scalar::minimum(least, memory.largest);
            self.step = full;
            let arriving = self.size_towards(end, full);
            let size = arriving.unwrap_or(full);
            let (next, limit) = match self.attempt(control, size) {
                Ok(Tried::Made) => {
                    // A step that the end has shortened says nothing about the next ones.
                    if !(size < full) {
                        self.find_next_size(control, size);
                    }
                    if arriving.is_some() {
                        self.arrive_at(end);
                    }
                    self.accept(control);
                    return Ok(());
                }
                Ok(Tried::Rejected(error)) => {
                    control.memory.statistics.rejected_by_error += 1;
                    let next = size * control.accuracy.left_after(error);
                    (next, StepLimit::Error { error, worst: None })
                }
                Ok(Tried::Unseen(load)) => (AFTER_PASSING * size, StepLimit::Load { load }),
                Err(error) => {
                    if !control.memory.statistics.note_failure(&error.failure) {
                        return Err(error);
                    }
                    let limit = StepLimit::Failure(Box::new(error.failure));
                    (AFTER_FAILURE * size, limit)
                }
            };
            let smallest = control.smallest(self.time(), usual);
            // Also if `next` is not a number.
            if !(smallest <= next) {
                return Err(self.too_small(control, [usual, size, smallest], limit));
            }
            self.step = next;
        }
    }

    /// Finds the size of the next step from that of the last one and its error.
    pub(super) fn find_next_size(&mut self, control: &mut Control, size: f64) {
        let controller = &mut control.memory.controller;
        self.step = controller.next(size, self.report.error, control.accuracy);
    }

    /// The error of a step of the usual size that would have to be smaller than allowed: the last attempt had this size and
    /// this limit.
    #[cold]
    fn too_small(
        &mut self,
        control: &mut Control,
        [usual, size, smallest]: [f64; 3],
        mut limit: StepLimit,
    ) -> StepError {
        if let StepLimit::Error { worst, .. } = &mut limit {
            *worst = self.worst_error(control, size);
        }
        let failure = StepFailure::TooSmall {
            smallest,
            is_set: smallest <= control.memory.smallest,
            limit: Box::new(limit),
            too_large: control.memory.statistics.too_large,
        };
        self.failed(usual, failure)
    }

    /// Counts an accepted step.
    pub(super) fn accept(&self, control: &mut Control) {
        let memory = &mut control.memory;
        memory.statistics.accepted += 1;
        let momentum = length(self.state.momenta.values());
        memory.largest_momentum = Scalar::maximum(memory.largest_momentum, momentum);
    }

    /// Undoes the last step.
    pub(super) fn undo(&mut self) {
        self.unresolved.undo();
        self.with_control(|run, control| {
            if let Some(halves) = control.and_then(|control| control.halves.as_ref()) {
                return run.return_to(halves);
            }
            mem::swap(&mut run.state, &mut run.next);
            run.has_stepped = false;
            run.stepper.undo();
        });
    }

    /// Another step from the beginning of the one that was undone, of this size; as accurate as that one if possible.
    pub(super) fn step_again(&mut self, size: f64) -> Stepped {
        self.with_control(|run, control| {
            let Some(control) = control else {
                return run.step_by(size);
            };
            if let Some(halves) = &control.halves {
                return run.step_in_halves(halves, size);
            }
            match run.try_step(size, Demand::Within(control.memory.tolerance)) {
                Ok(Tried::Made) => Ok(()),
                _ => run.step_by(size),
            }
        })
    }

    /// The history of step control and of the choice of a scheme.
    pub(super) fn history(&self) -> History {
        History {
            step: self.step,
            control: self.control.as_ref().map(|control| control.memory),
            choice: self.saved_choice(),
        }
    }

    /// Forgets the steps since this history.
    pub(super) fn restore_history(&mut self, history: &History) {
        self.step = history.step;
        let choice = history.choice;
        let mut too_large = None;
        if let Some(saved) = choice.filter(|saved| saved.scheme != self.in_use) {
            // Without memory for that scheme, the present one continues.
            too_large = self.use_scheme(saved.scheme).err();
            self.set_control(history.control);
        }
        if let (Some(control), Some(before)) = (&mut self.control, history.control) {
            control.memory = before;
            control.memory.statistics.too_large = too_large.or(before.statistics.too_large);
        }
        self.restore_choice(choice);
    }

    /// A copy of everything that further steps change.
    pub(super) fn snapshot(&self) -> Snapshot {
        Snapshot {
            state: State::clone(&self.state),
            past: self.stepper.past(&self.state),
            history: self.history(),
            worst: self.worst,
            corrections: self.corrections,
        }
    }

    pub(super) fn return_to_snapshot(&mut self, snapshot: &Snapshot) {
        // First the scheme, which evaluates energies in its own way and has a history of its own.
        self.restore_history(&snapshot.history);
        self.state.copy_all_from(&snapshot.state);
        let (past, explicit) = &snapshot.past;
        self.stepper.restore(past, explicit.as_ref());
        (self.worst, self.corrections) = (snapshot.worst, snapshot.corrections);
        self.has_stepped = false;
    }

    pub(super) fn is_motion_first(&self) -> bool {
        let own = self.stepper.is_motion_first();
        let own = own.filter(|_| self.scheme != Scheme::Auto);
        own.unwrap_or(self.automatic.is_motion_first)
    }

    pub(super) fn set_newton_settings(
        &mut self,
        settings: NewtonSettings,
    ) -> Result<(), SceneError> {
        let NewtonSettings {
            max_iterations,
            tolerance,
        } = settings;
        if max_iterations == 0 || !is_positive(tolerance) || tolerance >= 1.0 {
            return Err(SceneError::NewtonSettings {
                max_iterations,
                tolerance,
            });
        }
        self.effort.settings = settings;
        Ok(())
    }
}

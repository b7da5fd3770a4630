//! Steps whose size follows from an accuracy: they are tried, judged, and kept or made again.

use core::mem;

use super::compiled::Functions;
use super::control_memory::{Control, SMALLEST};
use super::{Simulation, Tried};
use crate::run::checkpoint::SavedControl;
use crate::scene::error::SceneError;
use crate::step::control::{AFTER_FAILURE, Controller, Estimate, StepStatistics, Tolerance, norm};
use crate::step::error::{StepError, StepFailure, StepLimit};
use crate::step::explicit::Demand;
use crate::step::newton::StepReport;
use eem_material::number::scalar::{Discord, Mask, Real};

/// # Step control
impl<const D: usize, S: Real> Simulation<D, S> {
    /// Switches step control on: steps get the size that the tolerance requires. The present size is tried first.
    ///
    /// A step that fails, is not accurate or does not prove its laws is repeated with a smaller size.
    /// [`step`](Self::step), [`run_until`](Self::run_until), events, recorders and checkpoints work as with
    /// constant steps. A report covers both halves of a step.
    ///
    /// # Errors
    ///
    /// [`SceneError::Tolerance`] or [`SceneError::AbsoluteTolerance`] if a tolerance is invalid, or below what the
    /// scheme can reach; [`SceneError::FixedSteps`] for the variational schemes.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use eem::prelude::*;
    /// use eem::Tolerance;
    ///
    /// /// A linear spring.
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|lambda: Stretch| 0.5 * k * (lambda - length).powi(2))]
    /// struct Spring {
    ///     k: f64,
    ///     length: f64,
    /// }
    ///
    /// let mut scene = Scene::<1>::new();
    /// let wall = scene.anchor([0.0]);
    /// let mass = scene.mass(1.0, [1.1], [0.0]);
    /// scene.spring(Spring { k: 1.0, length: 1.0 }, [wall, mass]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.control_steps(Tolerance::new(1e-6))?;
    /// run.run_until(5.0)?;
    ///
    /// let exact = 1.0 + 0.1 * 5.0_f64.cos();
    /// assert!((run.position(mass)?[0] - exact).abs() < 5e-6);
    /// assert!(run.step_statistics().is_some_and(|steps| steps.accepted > 100));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn control_steps(&mut self, tolerance: Tolerance<S>) -> Result<(), SceneError> {
        let memory = self.new_control(tolerance);
        self.check_control(Some(memory))?;
        self.go_on_with(Some(memory));
        Ok(())
    }

    /// What control remembers before the first step.
    pub(super) fn new_control(&self, tolerance: Tolerance<S>) -> SavedControl<S> {
        SavedControl {
            tolerance,
            controller: Controller::new(),
            statistics: StepStatistics::default(),
            largest_momentum: S::zero(),
            smallest: S::from_f64(SMALLEST) * S::EPSILON * self.step,
            largest: S::MAX,
        }
    }

    /// An error unless steps can be controlled like this.
    pub(super) fn check_control(&self, memory: Option<SavedControl<S>>) -> Result<(), SceneError> {
        let Some(memory) = memory else {
            return Ok(());
        };
        let checked = if self.scheme.may_change_steps() {
            memory.tolerance.check(self.in_use.accuracy())
        } else {
            let scheme = self.scheme.name();
            Err(SceneError::FixedSteps { scheme })
        };
        checked.inspect_err(|_| self.part())
    }

    /// Controls steps like this, or makes all of one size.
    pub(super) fn go_on_with(&mut self, memory: Option<SavedControl<S>>) {
        self.control = memory.map(|memory| Box::new(self.control_of(memory)));
    }

    /// What controls steps of the scheme in use like this.
    pub(super) fn control_of(&self, memory: SavedControl<S>) -> Control<S> {
        let accuracy = self.in_use.accuracy();
        let halves = (accuracy.estimate == Estimate::Halves).then(|| self.room_for_halves());
        Control {
            memory,
            accuracy,
            halves,
        }
    }

    /// Switches step control off: all further steps have the [present size](Self::step_size) and use the [scheme in
    /// use](Self::scheme_in_use).
    pub fn fix_steps(&mut self) {
        self.control = None;
    }

    /// The tolerance of step control; `None` if it is off.
    #[must_use]
    pub fn tolerance(&self) -> Option<Tolerance<S>> {
        self.control
            .as_ref()
            .map(|control| control.memory.tolerance)
    }

    /// Statistics of step control; `None` if it is off.
    #[must_use]
    pub fn step_statistics(&self) -> Option<StepStatistics> {
        self.control
            .as_ref()
            .map(|control| control.memory.statistics)
    }

    /// Limits the size of controlled steps, s: smallest and largest. By default the smallest is 16 ε times the
    /// first size, and there is no largest. The smallest is never below 16 ε times the time. Where nothing moves,
    /// steps grow without limit: set the largest step if a load sets in later.
    ///
    /// # Errors
    ///
    /// [`SceneError::StepLimits`] unless both are positive and finite, the first is not above the second, and steps
    /// are [controlled](Self::control_steps). The old limits remain.
    pub fn limit_steps(&mut self, [smallest, largest]: [S; 2]) -> Result<(), SceneError> {
        let is_range = S::zero().less(smallest) & smallest.at_most(largest) & largest.less(S::MAX);
        match &mut self.control {
            Some(control) if is_range.all() => {
                control.memory.smallest = smallest;
                control.memory.largest = largest;
                Ok(())
            }
            control => {
                let is_controlled = control.is_some();
                self.part();
                Err(SceneError::StepLimits {
                    smallest: smallest.to_f64(),
                    largest: largest.to_f64(),
                    is_controlled,
                })
            }
        }
    }

    /// A step that is accurate, not beyond `end`.
    pub(super) fn controlled_step(&mut self, end: S) -> Result<StepReport<S>, StepError> {
        if S::LANES > 1 {
            // Each of the numbers needs steps of its own.
            return Err(self.refused(Discord.into()));
        }
        let memory = self.memory();
        let found = self.with_control(|run, control| match control {
            None => run.step_by(run.step),
            Some(control) if run.automatic.is_some() => run.step_of_choice(control, end),
            Some(control) => run.find_accurate_step(control, end),
        });
        if found.is_err() {
            self.remember_uncounted(memory);
        }
        found
    }

    /// Does something with the control taken out of the run, which gets it back even where a load panics.
    pub(super) fn with_control<T>(
        &mut self,
        act: impl FnOnce(&mut Self, Option<&mut Control<S>>) -> T,
    ) -> T {
        let control = self.control.take();
        let mut held = Held { run: self, control };
        let Held { run, control } = &mut held;
        act(run, control.as_deref_mut())
    }

    /// An accurate step of the scheme in use, not beyond `end`.
    pub(super) fn find_accurate_step(
        &mut self,
        control: &mut Control<S>,
        end: S,
    ) -> Result<StepReport<S>, StepError> {
        loop {
            let memory = &control.memory;
            self.step = self.step.maximum(memory.smallest).minimum(memory.largest);
            let full = self.step;
            let arriving = self.size_towards(end, full)?;
            let size = arriving.unwrap_or(full);
            let mut controller = control.memory.controller;
            let (next, limit) = match self.attempt(control, size) {
                Ok(Tried::Made(mut report)) => {
                    // A step that the end has shortened says nothing about the next ones.
                    if !size.less(full).all() {
                        self.step = controller.next(size, report.error, control.accuracy);
                        control.memory.controller = controller;
                    }
                    if arriving.is_some() {
                        self.arrive_at(end, &mut report);
                    }
                    self.accept(control);
                    return Ok(report);
                }
                Ok(Tried::Refused(error)) => {
                    control.memory.statistics.rejected_by_error += 1;
                    let next = size * control.accuracy.left_after(error);
                    let error = error.to_f64();
                    (next, StepLimit::Error { error })
                }
                Err(error) => {
                    let statistics = &mut control.memory.statistics;
                    if !statistics.note_failure(&error.failure) {
                        return Err(error);
                    }
                    let next = S::from_f64(AFTER_FAILURE) * size;
                    (next, StepLimit::Failure(Box::new(error.failure)))
                }
            };
            let smallest = control.smallest(self.time());
            // Also where it is not a number.
            if !smallest.at_most(next).all() {
                let smallest = smallest.to_f64();
                let too_large = control.memory.statistics.too_large;
                return Err(self.failed(StepFailure::TooSmall {
                    smallest,
                    limit,
                    too_large,
                }));
            }
            self.step = next;
        }
    }

    /// A step of this size and its error; the state is what it was if there is none.
    pub(super) fn attempt(
        &mut self,
        control: &mut Control<S>,
        size: S,
    ) -> Result<Tried<S>, StepError> {
        let Control {
            memory,
            accuracy,
            halves,
        } = control;
        match halves {
            Some(halves) => self.try_halves(halves, (memory, *accuracy), size),
            None => self.try_step(size, Demand::Within(memory.tolerance)),
        }
    }

    pub(super) fn accept(&self, control: &mut Control<S>) {
        let memory = &mut control.memory;
        memory.statistics.accepted += 1;
        let momentum = norm(self.state.momenta.values().iter().copied());
        memory.largest_momentum = memory.largest_momentum.maximum(momentum);
    }

    /// Takes back the step that has just been made.
    pub(super) fn undo(&mut self) {
        (Functions::get().undo)(self);
    }

    pub(super) fn undo_here(&mut self) {
        self.with_control(|run, control| {
            match control.and_then(|control| control.halves.as_ref()) {
                Some(halves) => run.return_to(halves),
                None => run.swap_back(),
            }
        });
    }

    fn swap_back(&mut self) {
        mem::swap(&mut self.state, &mut self.next);
        self.has_stepped = false;
        self.stepper.undo();
    }

    /// Another step from where the last one began, of this size.
    pub(super) fn step_again(&mut self, size: S) -> Result<StepReport<S>, StepError> {
        self.with_control(|run, control| match control {
            Some(Control {
                halves: Some(halves),
                ..
            }) => run.step_in_halves(halves, size),
            Some(control) => {
                // As accurate as the last one, if that can be.
                let demand = Demand::Within(control.memory.tolerance);
                match run.try_step(size, demand) {
                    Ok(Tried::Made(report)) => Ok(report),
                    _ => run.step_by(size),
                }
            }
            None => run.step_by(size),
        })
    }
}

/// A simulation whose control has been taken out. It gets it back, and the state from which a step began, even
/// where a load panics.
struct Held<'a, const D: usize, S: Real> {
    run: &'a mut Simulation<D, S>,
    control: Option<Box<Control<S>>>,
}

impl<const D: usize, S: Real> Drop for Held<'_, D, S> {
    fn drop(&mut self) {
        let halves = self
            .control
            .as_mut()
            .and_then(|control| control.halves.as_mut());
        if let Some(halves) = halves.filter(|halves| halves.is_under_way) {
            halves.is_under_way = false;
            self.run.return_to(halves);
        }
        self.run.control = self.control.take();
    }
}

//! The error of a step from its two halves, for schemes without an estimate of their own.
//!
//! A step of the size H is made whole, and in two halves. The halves are kept; their difference from the whole
//! step estimates their error,
//!
//! ```text
//! error = |y_H − y_{H/2, H/2}| max(1/(2ᵖ − 1), r₁)
//! ```
//!
//! with the tolerance r₁ of one step. The share is that of an expansion in H, which ends where the difference is as large as the quantity
//! itself, so that it is at most this. Else two steps that are both wrong, by a whole amplitude each, would pass a loose tolerance.
//!
//! Every part is a step of the scheme like any other, and proves its laws. The estimate needs only the order p of the
//! scheme, so that it stays right where the motion is stiff or conduction is fast.

use super::attempt::explicit_view;
use super::guard::or_restore;
use super::memory::{Control, Halves};
use super::stepper::Stepper;
use super::{Simulation, StepResult, Tried};
use crate::element::state::State;
use crate::step::control::{Kinds, LoadRounding, Scales, Unknown};
use crate::step::error::{StepError, WorstError};
use crate::step::explicit::Demand;

impl<const D: usize> Simulation<D> {
    /// Work arrays for a whole step and for its two halves.
    pub(super) fn new_halves(&self) -> Halves {
        let (past, _) = self.stepper.past(&self.state);
        let mut slots = Vec::new();
        for (element, _) in &self.loads.temperatures {
            slots.push(self.thermal_slot(*element).ok());
        }
        let counts = [self.masses.len(), self.layout.thermal];
        Halves {
            before: State::clone(&self.state),
            past,
            whole: State::clone(&self.state),
            kinds: Kinds {
                are_strains: self.viscous_strains(),
                are_given: self.prescribed_momenta(),
            },
            rounding: LoadRounding::new(&self.loads, slots, counts),
        }
    }

    /// A step of this size and its error; the state is unchanged if the step fails or is rejected.
    pub(super) fn attempt(&mut self, control: &mut Control, size: f64) -> Result<Tried, StepError> {
        if let Some(load) = self.unseen_load(control, size)? {
            return Ok(Tried::Unseen(load));
        }
        let (memory, accuracy) = (&control.memory, control.accuracy);
        let Some(halves) = &mut control.halves else {
            return self.try_step(size, Demand::Within(memory.tolerance));
        };
        let mut report = self.step_twice(halves, size)?;
        let ends = [&halves.before, &*self.state];
        let accurate = (accuracy, size);
        let least = (memory.largest_momentum, &self.least);
        let scales = Scales::new(D, &memory.tolerance, accurate, ends, least);
        if self.flies(size, &scales, accuracy.order()) {
            self.return_to(halves);
            return Ok(Tried::Rejected(f64::INFINITY));
        }
        let states = [&halves.whole, &*self.state];
        report.error = scales.error(states, &halves.kinds, None);
        if accuracy.holds_back(report.error) {
            let span = [halves.before.time.value, size];
            halves.rounding.find(&self.loads, &self.least, span);
            let beyond = scales.error(states, &halves.kinds, Some(&halves.rounding));
            let accurate = (memory.tolerance.relative, accuracy);
            // After a step the next state is the one before it.
            let ends = [&*self.next, &*self.state];
            let mut ends = ends.into_iter();
            let rests = ends.all(|state| self.least.all_rest(D, [&halves.before, state]));
            report.error = if rests {
                beyond
            } else {
                self.least.hidden(beyond, size, accurate)
            };
        }
        if accuracy.accepts(report.error) {
            return Ok(Tried::Made(report));
        }
        self.return_to(halves);
        Ok(Tried::Rejected(report.error))
    }

    /// A whole step, stored in `halves`, and one in two halves. If one fails, the state is that before both.
    pub(super) fn step_twice(&mut self, halves: &mut Halves, size: f64) -> StepResult {
        halves.before.copy_all_from(&self.state);
        self.stepper.save_past_to(&mut halves.past);
        let whole = self.step_by(size)?;
        halves.whole.copy_from(&self.state);
        self.return_to(halves);
        let mut report = self.step_in_halves(halves, size)?;
        report.iterations += whole.iterations;
        Ok(report)
    }

    /// Two steps of half a size. If one fails, the state is that before both.
    pub(super) fn step_in_halves(&mut self, halves: &Halves, size: f64) -> StepResult {
        let half = 0.5 * size;
        let first = self.step_by(half)?;
        let second = or_restore(self, |run| run.return_to(halves), |run| run.step_by(half))?;
        Ok(first.and(second))
    }

    /// Goes back to the beginning of the step for which `halves` was filled.
    pub(super) fn return_to(&mut self, halves: &Halves) {
        self.has_stepped = false;
        self.state.copy_all_from(&halves.before);
        self.stepper.restore(&halves.past, None);
    }

    /// Which momenta, by coordinate, are those of moved anchors. Empty without any.
    fn prescribed_momenta(&self) -> Vec<bool> {
        let mut are_prescribed = Vec::new();
        for (node, _) in &self.loads.motions {
            are_prescribed.resize(self.masses.len() * D, false);
            are_prescribed[node.index * D..][..D].fill(true);
        }
        are_prescribed
    }

    /// Which viscous variables are strains of solids.
    #[doc(hidden)]
    #[must_use]
    pub fn viscous_strains(&self) -> Vec<bool> {
        let mut are_strains = vec![false; self.layout.viscous];
        for &[group, place] in &self.places {
            let shape = self.shapes[group as usize];
            let elements = self.stepper.elements(group as usize);
            let first = elements.slots(place as usize).viscous;
            are_strains[first..first + shape.dashpots].fill(!shape.is_spring);
        }
        are_strains
    }

    /// The unknown with the largest error in a step of this size, which was rejected; the state is unchanged.
    #[cold]
    pub(super) fn worst_error(&mut self, control: &mut Control, size: f64) -> Option<WorstError> {
        let (unknown, [error, allowed]) = match (&mut control.halves, &mut self.stepper) {
            (None, Stepper::Explicit(explicit)) => {
                self.has_stepped = false;
                let (view, next) = (explicit_view!(self, size), &mut *self.next);
                let tolerance = &control.memory.tolerance;
                explicit.worst_error(&view, tolerance, next).ok()??
            }
            (Some(halves), _) => {
                self.step_twice(halves, size).ok()?;
                let tolerance = &control.memory.tolerance;
                let ends = [&halves.before, &*self.state];
                let least = (control.memory.largest_momentum, &self.least);
                let accuracy = control.accuracy;
                let scales = Scales::new(D, tolerance, (accuracy, size), ends, least);
                let states = [&halves.whole, &*self.state];
                let span = [halves.before.time.value, size];
                halves.rounding.find(&self.loads, &self.least, span);
                let worst = scales.worst(states, &halves.kinds, &halves.rounding);
                self.return_to(halves);
                worst?
            }
            (None, Stepper::Newton(_)) => return None,
        };
        let kind = match unknown {
            Unknown::Position(_) => ("position", "m", "`with_position`"),
            Unknown::Momentum(_) => ("momentum", "kg m/s", "`with_momentum`"),
            Unknown::Viscous(index) if self.viscous_strains()[index] => {
                ("viscous strain", "", "`with_position`")
            }
            Unknown::Viscous(_) => ("viscous stretch", "m", "`with_position`"),
            Unknown::Temperature(_) => ("temperature", "K", "`with_temperature`"),
        };
        let place = match unknown {
            Unknown::Position(index) | Unknown::Momentum(index) => {
                format!("{} along axis {}", self.scene.node(index / D), index % D)
            }
            Unknown::Viscous(_) | Unknown::Temperature(_) => self.element_of(unknown)?,
        };
        let (quantity, unit, setting) = kind;
        Some(WorstError {
            of: format!("the {quantity} of {place}"),
            unit,
            error,
            allowed,
            setting,
        })
    }

    /// The element with an internal variable.
    fn element_of(&self, unknown: Unknown) -> Option<String> {
        self.places.iter().find_map(|&[group, place]| {
            let elements = self.stepper.elements(group as usize);
            let slots = elements.slots(place as usize);
            let own = slots.viscous..slots.viscous + self.shapes[group as usize].dashpots;
            let is_it = match unknown {
                Unknown::Viscous(index) => own.contains(&index),
                Unknown::Temperature(slot) => slots.thermal == Some(slot),
                Unknown::Position(_) | Unknown::Momentum(_) => false,
            };
            is_it.then(|| elements.handle(place as usize).to_string())
        })
    }
}

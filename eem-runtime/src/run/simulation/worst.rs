//! The unknown whose error limits a step, in words.

use super::Simulation;
use super::attempt::explicit_view;
use super::memory::Control;
use super::stepper::Stepper;
use crate::step::control::{Scales, Unknown};
use crate::step::error::WorstError;

impl<const D: usize> Simulation<D> {
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

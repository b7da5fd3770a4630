//! The error of a step from its two halves, for schemes that have no estimate of their own.
//!
//! A step of the size H is made at once, and in two halves. The halves are what is kept; their difference from the
//! whole says how accurate they are,
//!
//! ```text
//! error = |y_H − y_{H/2, H/2}|/(2ᵖ − 1)
//! ```
//!
//! Every part is a step of the scheme like any other, and proves its laws. The estimate asks nothing of the
//! scheme but its order p, so that it stays right where the motion is stiff or conduction is fast.

use super::control_memory::Halves;
use super::{Simulation, Tried};
use crate::element::state::State;
use crate::run::checkpoint::SavedControl;
use crate::step::control::{Accuracy, Kinds, Scales};
use crate::step::error::StepError;
use crate::step::newton::StepReport;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// Memory for the two ways of a step.
    pub(super) fn room_for_halves(&self) -> Halves<S> {
        let (past, _) = self.stepper.past(&self.state);
        Halves {
            before: State::clone(&self.state),
            past,
            whole: State::clone(&self.state),
            kinds: Kinds {
                are_strains: self.viscous_strains(),
                are_given: self.given_momenta(),
            },
            is_under_way: false,
        }
    }

    /// A step of this size in two halves, unless they are not accurate; the state is what it was if a part
    /// fails.
    pub(super) fn try_halves(
        &mut self,
        halves: &mut Halves<S>,
        (memory, accuracy): (&SavedControl<S>, Accuracy),
        size: S,
    ) -> Result<Tried<S>, StepError> {
        halves.before.copy_all_from(&self.state);
        self.stepper.save_past_to(&mut halves.past);
        let whole = self.step_by(size)?;
        halves.whole.copy_from(&self.state);
        self.return_to(halves);
        let mut report = self.step_in_halves(halves, size)?;
        report.iterations += whole.iterations;
        let ends = [&halves.before, &*self.state];
        let largest = memory.largest_momentum;
        let scales = Scales::new(&memory.tolerance, accuracy, ends, largest);
        let share = S::from_f64(accuracy.order().exp2() - 1.0).recip();
        report.error = share * scales.error([&halves.whole, &self.state], &halves.kinds);
        if accuracy.accepts(report.error) {
            return Ok(Tried::Made(report));
        }
        self.return_to(halves);
        Ok(Tried::Refused(report.error))
    }

    /// Two steps of half a size.
    pub(super) fn step_in_halves(
        &mut self,
        halves: &mut Halves<S>,
        size: S,
    ) -> Result<StepReport<S>, StepError> {
        let half = S::from_f64(0.5) * size;
        let first = self.step_by(half)?;
        halves.is_under_way = true;
        let second = self.step_by(half);
        halves.is_under_way = false;
        match second {
            Ok(second) => Ok(first.and(second)),
            Err(error) => {
                self.return_to(halves);
                Err(error)
            }
        }
    }

    /// Goes back to where the last step began.
    pub(super) fn return_to(&mut self, halves: &Halves<S>) {
        self.has_stepped = false;
        self.state.copy_all_from(&halves.before);
        self.stepper.restore(&halves.past, None);
    }

    /// Which momenta, by coordinate, are those of nodes that are moved.
    fn given_momenta(&self) -> Vec<bool> {
        let mut are_given = Vec::new();
        for (node, _) in &self.loads.motions {
            are_given.resize(self.masses.len() * D, false);
            are_given[node.index * D..][..D].fill(true);
        }
        are_given
    }

    /// Which viscous variables are strains of solids.
    fn viscous_strains(&self) -> Vec<bool> {
        let mut are_strains = vec![false; self.layout.viscous];
        for &[group, place] in &self.places {
            let shape = self.shapes[group as usize];
            let elements = self.stepper.elements(group as usize);
            let first = elements.slots(place as usize).viscous;
            are_strains[first..first + shape.dashpots].fill(!shape.is_spring);
        }
        are_strains
    }
}

//! Steps of a history that are made again, from snapshots.

use super::super::Simulation;
use super::super::guard::Guard;
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::history::Kept;
use crate::run::gradient::snapshots::{Record, Snapshot};
use eem_material::number::compensated::Sum;

impl<const D: usize> Simulation<D> {
    /// Calls a function that makes steps, and restores everything afterwards.
    pub(super) fn with_steps_again<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.snapshot();
        let reservoirs = self.conduction.reservoirs.clone();
        let (iterations, end) = (self.effort.history.clone(), self.effort.end);
        let guard = Guard::new(self, |run| {
            run.return_to_snapshot(&before);
            run.conduction.reservoirs = reservoirs;
            (run.effort.history, run.effort.end) = (iterations, end);
        });
        act(&mut *guard.value)
    }

    /// Makes steps again that end in the state `last` after `end` steps, and returns their states.
    pub(super) fn states_before(
        &mut self,
        (end, last): (usize, &State),
        kept: &mut Record,
    ) -> Result<Kept, GradientError> {
        loop {
            let pass = kept.next_pass(end);
            let [from, to] = pass.steps;
            if let Some(snapshot) = kept.at(from) {
                self.return_to_state(snapshot);
            }
            let mut states = Kept::new(&self.state, to - from + 1);
            self.make_again([from, to], kept, |state| {
                if pass.keeps_all {
                    states.keep(state);
                }
            })?;
            if !pass.keeps_all {
                kept.pass(self.snapshot_of(to));
            } else if states.ends_in(last) {
                return Ok(states);
            } else {
                let time = last.time.value;
                return Err(GradientError::NotRepeatable { time });
            }
        }
    }

    /// Makes the steps `from..to` again, from the present state, and passes each new state to a function.
    pub(super) fn make_again(
        &mut self,
        [from, to]: [usize; 2],
        kept: &Record,
        mut see: impl FnMut(&State),
    ) -> Result<(), GradientError> {
        for step in from..to {
            self.look()?;
            self.step_by(kept.size(step))?;
            if let Some(time) = kept.arrival(step + 1) {
                self.state.time = Sum::new(time);
            }
            see(&self.state);
        }
        Ok(())
    }

    /// The present state, after `index` steps, with what the next step depends on.
    pub(super) fn snapshot_of(&self, index: usize) -> Snapshot {
        let (past, _) = self.stepper.past(&self.state);
        Snapshot {
            index,
            state: State::clone(&self.state),
            past,
        }
    }

    /// Goes back to the state of a snapshot.
    pub(super) fn return_to_state(&mut self, snapshot: &Snapshot) {
        self.state.copy_all_from(&snapshot.state);
        self.stepper.restore(&snapshot.past, None);
    }
}

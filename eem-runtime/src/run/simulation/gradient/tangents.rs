//! The tangents of a run: the steps of a history once more, from the first to the last, with the changes of all states.

use core::mem;
use std::borrow::Cow;

use super::derivatives::{Of, Passage};
use super::directions::{Change, Forward, along};
use super::inputs::Made;
use super::no_adjoint;
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::history::Kept;
use crate::run::gradient::input::Input;
use crate::run::gradient::result::quotient;
use crate::run::gradient::series::Sensitivities;
use crate::run::gradient::snapshots::{Record, Snapshot};
use crate::run::recorder::{Column, Quantity};
use crate::run::simulation::Simulation;
use crate::run::simulation::memory::Guard;
use crate::run::simulation::stepper::Stepper;
use crate::step::adjoint::Tangents;
use eem_material::number::compensated::Sum;

/// A function that is called with every state of a history and the number of steps before it.
type Visit<'a, const D: usize> = dyn FnMut(&mut Simulation<D>, (usize, &mut State), &Forward<D>) -> Result<(), GradientError>
    + 'a;

/// # Gradients
impl<const D: usize> Simulation<D> {
    /// The derivatives of quantities by some inputs in all states since [`keep_history`](Self::keep_history): a table with the
    /// time and a column for each quantity and input, `z by stiffness of element 0 (Spring)`; of a vector for each component.
    ///
    /// They are those of the steps that were made, as in a [`gradient`](Self::gradient). That differentiates one number by all inputs;
    /// this method differentiates any number of quantities at all times by a few inputs, each at a fraction of the time of the run.
    ///
    /// # Errors
    ///
    /// As [`gradient`](Self::gradient); [`GradientError::UnknownParameter`], [`GradientError::NoParameterDerivatives`],
    /// [`GradientError::NoSeries`], [`GradientError::Component`] or [`GradientError::Scene`] for inputs that the scene does not have.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{History, Input};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let stone = scene.mass(2.0, [0.0], [3.0]);
    /// scene.force(stone, |t| [4.0 * t]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    ///
    /// // q = 3t + a t³/6m with a = 4 N/s
    /// let inputs = [Input::mass(stone), Input::force(stone, |t| [t]).named("a", "N/s")];
    /// let table = run.sensitivities(&inputs, [("q", Quantity::Position(stone))])?;
    /// let heads: Vec<String> = table.columns().iter().map(|column| column.head()).collect();
    /// assert_eq!(heads, ["time (s)", "q_x by mass of node 0 (m/kg)", "q_x by a (m/(N/s))"]);
    /// for (input, by) in [-1.0 / 6.0, 1.0 / 12.0].into_iter().enumerate() {
    ///     let last = table.of(0, input).and_then(|column| column.last());
    ///     assert!(last.is_some_and(|last| (last - by).abs() < 1e-5));
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sensitivities<N: Into<String>>(
        &mut self,
        inputs: &[Input<D>],
        quantities: impl IntoIterator<Item = (N, Quantity<D>)>,
    ) -> Result<Sensitivities, GradientError> {
        let mut asked = Vec::new();
        let mut columns = vec![Column::of(
            "time".to_owned(),
            Cow::Borrowed("s"),
            Vec::new(),
        )];
        for (name, quantity) in quantities {
            quantity.present(self)?;
            for name in quantity.columns(&name.into()) {
                for input in inputs {
                    let unit = quotient(quantity.unit(), &self.unit_of(input));
                    let name = format!("{name} by {}", input.name());
                    columns.push(Column::of(name, unit.into(), Vec::new()));
                }
            }
            asked.push(quantity);
        }
        self.on_history(|run, kept| {
            let passage = run.passage();
            let changes = inputs.iter().map(|input| run.change_by(input, &passage));
            let changes = changes.collect::<Result<_, _>>()?;
            let mut sums = vec![0.0; inputs.len()];
            let see = &mut (|run: &mut Self, at: (usize, &mut State), way: &Forward<D>| {
                let mut places = columns.iter_mut();
                if let Some(time) = places.next() {
                    time.push(at.1.time.value);
                }
                for quantity in &asked {
                    for component in 0..quantity.columns("").len() {
                        sums.fill(0.0);
                        let of = (quantity, component);
                        run.add_rates((at.1, 1.0), of, way, &mut sums)?;
                        for (&sum, column) in sums.iter().zip(&mut places) {
                            column.push(sum);
                        }
                    }
                }
                Ok(())
            });
            run.go_forward(kept, (passage, changes), see)
        })?;
        Ok(Sensitivities {
            columns,
            inputs: inputs.len(),
        })
    }

    /// Adds the changes of a component of a quantity in a state, times a weight, in each direction.
    pub(super) fn add_rates(
        &mut self,
        weighted: (&State, f64),
        of: (&Quantity<D>, usize),
        way: &Forward<D>,
        sums: &mut [f64],
    ) -> Result<(), GradientError> {
        let see = &mut (|of: Of<'_>, by: f64| {
            let directions = way.changes.iter().zip(&way.directions);
            for (sum, (change, direction)) in sums.iter_mut().zip(directions) {
                *sum += along((change, &direction.old), of, by);
            }
        });
        self.see_derivatives(weighted, of, &way.passage, see)
    }

    /// Goes through a history from its first state on, with the changes of its states in some directions.
    pub(super) fn go_forward(
        &mut self,
        kept: &Record,
        (passage, changes): (Passage<D>, Vec<Change<D>>),
        see: &mut Visit<'_, D>,
    ) -> Result<(), GradientError> {
        let last = State::clone(&self.run.state);
        let mut ends = [(); 2].map(|()| last.clone());
        let Some(mut here) = kept.at(0).cloned() else {
            return Err(GradientError::NoHistory);
        };
        match kept.all() {
            Some(all) => all.load::<D>(0, &self.run.masses, &mut ends[1]),
            None => ends[1].clone_from(&here.state),
        }
        let mut way = self.way_forward(&ends[1], passage, changes)?;
        see(self, (0, &mut ends[1]), &way)?;
        if let Some(all) = kept.all() {
            return self.follow(kept, (0, all), &mut ends, &mut way, see);
        }
        let mut from = 0;
        while from < kept.len() {
            self.return_to_state(&here);
            let to = kept.len().min(from + kept.block());
            let mut states = Kept::new(&self.run.state, to - from + 1);
            self.make_again([from, to], kept, |state| states.keep(state))?;
            here = self.snapshot_of(to);
            if to == kept.len() && !states.ends_in(&last) {
                let time = last.time.value;
                return Err(GradientError::NotRepeatable { time });
            }
            self.follow(kept, (from, &states), &mut ends, &mut way, see)?;
            from = to;
        }
        Ok(())
    }

    /// Goes through the steps between these states, of which the first follows `from` steps.
    fn follow(
        &mut self,
        kept: &Record,
        (from, states): (usize, &Kept),
        [old, new]: &mut [State; 2],
        way: &mut Forward<D>,
        see: &mut Visit<'_, D>,
    ) -> Result<(), GradientError> {
        for at in 0..states.len() {
            mem::swap(old, new);
            states.load::<D>(at + 1, &self.run.masses, new);
            self.push((kept.size(from + at), [old, new]), way)?;
            see(self, (from + at + 1, new), way)?;
        }
        Ok(())
    }

    /// A way forward before its first step.
    fn way_forward(
        &mut self,
        start: &State,
        passage: Passage<D>,
        changes: Vec<Change<D>>,
    ) -> Result<Forward<D>, GradientError> {
        let Stepper::Newton(newton) = self.run.stepper.of_mut::<D>() else {
            return Err(no_adjoint(self.run.in_use, self.time()));
        };
        let system = newton.solver.tangent_mut();
        let tangents = Tangents::new(
            &passage.layout,
            &self.run.masses,
            &self.run.conduction,
            system,
        );
        let directions = changes.iter().map(|change| {
            let heat = &change.heat;
            let is_warmed = !(heat.conductances.is_empty() && heat.reservoirs.is_empty());
            let start = change.start_at(start.time.value);
            let parameters = change.parameters.clone();
            tangents.direction(start, parameters, is_warmed)
        });
        Ok(Forward {
            directions: directions.collect(),
            heats: changes.iter().map(|change| change.heat.clone()).collect(),
            anchors: self.run.masses.anchors().collect(),
            passage,
            changes,
            tangents,
        })
    }

    /// Takes a step: from the changes of its old state to those of its new one.
    fn push(&mut self, made: Made<'_>, way: &mut Forward<D>) -> Result<(), GradientError> {
        self.find_loads(made, &mut way.passage);
        self.enter(made, way);
        let (tangents, directions) = (&mut way.tangents, &mut way.directions);
        let heats = &way.heats;
        self.differentiate(made, &way.passage, |past, loaded, groups, system| {
            tangents.step_forward(past, loaded, groups, system, (directions, heats))
        })?;
        let time = made.1[1].time.value;
        for direction in &mut way.directions {
            for (oven, _) in &self.run.loads.ovens {
                // An oven keeps no entropy: what it receives is booked as heat after the step.
                direction.new.reservoirs[*oven] = 0.0;
            }
            mem::swap(&mut direction.old, &mut direction.new);
            if !direction.old.is_finite() {
                return Err(GradientError::NotFinite { time });
            }
        }
        Ok(())
    }

    /// Calls a function that makes steps, and restores everything afterwards.
    pub(super) fn with_steps_again<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.run.snapshot();
        let reservoirs = self.run.conduction.reservoirs.clone();
        let (iterations, end) = (self.run.effort.history.clone(), self.run.effort.end);
        let guard = Guard::new(self, |run| {
            run.run.return_to_snapshot(&before);
            run.run.conduction.reservoirs = reservoirs;
            (run.run.effort.history, run.run.effort.end) = (iterations, end);
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
            let ([from, to], keeps_all) = kept.next_pass(end);
            if let Some(snapshot) = kept.at(from) {
                self.return_to_state(snapshot);
            }
            let mut states = Kept::new(&self.run.state, to - from + 1);
            self.make_again([from, to], kept, |state| {
                if keeps_all {
                    states.keep(state);
                }
            })?;
            if !keeps_all {
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
            self.run.step_by(kept.size(step))?;
            if let Some(time) = kept.arrival(step + 1) {
                self.run.state.time = Sum::new(time);
            }
            see(&self.run.state);
        }
        Ok(())
    }

    /// The present state, after `index` steps, with what the next step depends on.
    pub(super) fn snapshot_of(&self, index: usize) -> Snapshot {
        let (past, _) = self.run.stepper.past(&self.run.state);
        Snapshot {
            index,
            state: State::clone(&self.run.state),
            past,
        }
    }

    /// Goes back to the state of a snapshot.
    pub(super) fn return_to_state(&mut self, snapshot: &Snapshot) {
        self.run.state.copy_all_from(&snapshot.state);
        self.run.stepper.restore(&snapshot.past, None);
    }
}

//! The gradient of a run: the adjoint of its steps, from the last to the first.

mod checks;
mod derivatives;
mod directions;
mod inputs;
mod seeds;
mod tangents;

use core::mem;
use core::ops::ControlFlow;

use super::memory::Guard;
use super::stepper::Stepper;
use super::{Run, Simulation};
use crate::algebra::add;
use crate::algebra::system::LinearSystem;
use crate::element::group::{Group, StepView};
use crate::element::handle::Element;
use crate::element::layout::Layout;
use crate::element::phase::Phase;
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::history::History;
use crate::run::gradient::input::Objective;
use crate::run::gradient::result::Gradient;
use crate::run::gradient::snapshots::Record;
use crate::step::adjoint::{Adjoint, NoAdjoint, PastStep, PerVariable, RocketStep};
use crate::step::control::length;
use crate::step::scheme::Scheme;
use derivatives::Passage;
use inputs::{Made, Way, Weighted};
use seeds::Seeds;

/// # Gradients
impl<const D: usize> Simulation<D> {
    /// Keeps the states of all further steps for [`gradient`](Self::gradient). This costs memory, but changes no bit of the run;
    /// [`Scheme::Auto`] keeps a scheme through whose steps gradients can be taken.
    pub fn keep_history(&mut self, history: History) {
        let (past, _) = self.run.stepper.past(&self.run.state);
        self.run.history = Some(Box::new(Record::new(&self.run.state, past, history)));
    }

    /// The derivatives of an objective with respect to all inputs of the run since [`keep_history`](Self::keep_history):
    /// parameters of materials, masses, gravity, conductances, temperatures of reservoirs, and the state at the start.
    ///
    /// They are those of the steps that were made, with their sizes kept, to rounding times the growth of errors along the
    /// motion. All of them together cost less than the run, or a few runs where steps are made again, however many inputs there
    /// are.
    ///
    /// # Errors
    ///
    /// [`GradientError`]: for steps of other schemes than [`Scheme::EemTemperature`] or [`Scheme::EemEntropy`]; without a
    /// history, or with one that does not end at the present state; for a quantity without derivatives or a time at which no step
    /// ends. Nothing has changed then.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{History, Objective};
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - 1.0).powi(2))]
    /// struct Spring { stiffness: f64 }
    ///
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    /// let spring = scene.spring(Spring { stiffness: 4.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.001)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    ///
    /// // q = 1 + 0.1 cos(ωt) with ω² = k/m = 4/s².
    /// let gradient = run.gradient(&Objective::at_end(Quantity::Position(ends[1])))?;
    /// assert!((gradient.by_position(ends[1])?[0] - 2.0_f64.cos()).abs() < 1e-6);
    /// let by_stiffness = -0.1 * 2.0_f64.sin() / 4.0;
    /// assert!((gradient.by_parameter(spring, "stiffness")? - by_stiffness).abs() < 1e-7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn gradient(&mut self, objective: &Objective<D>) -> Result<Gradient<D>, GradientError> {
        self.on_history(|run, kept| run.gradient_of(kept, &[(1.0, objective)]))
    }

    /// Calls a function in every step that gradients, tangents and their checks go through. If it returns
    /// [`ControlFlow::Break`], they end with [`GradientError::Stopped`], and nothing has changed.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{GradientError, History, Objective};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(1.0, [0.0], [2.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    /// let mut left = 5;
    /// run.watch_gradients(move || {
    ///     left -= 1;
    ///     if left > 0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    /// });
    /// let place = Objective::at_end(Quantity::Position(mass));
    /// assert_eq!(run.gradient(&place).unwrap_err(), GradientError::Stopped);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn watch_gradients(
        &mut self,
        watch: impl FnMut() -> ControlFlow<()> + Send + Sync + 'static,
    ) {
        self.run.watch = Some(Box::new(watch));
    }

    /// Calls the function of [`watch_gradients`](Self::watch_gradients); an error if it stops the computation.
    fn look(&mut self) -> Result<(), GradientError> {
        match self.run.watch.as_mut().map(|watch| watch()) {
            Some(ControlFlow::Break(())) => Err(GradientError::Stopped),
            _ => Ok(()),
        }
    }

    /// The derivatives of an objective J at an event, which ends the history. The time of the event changes with the inputs α
    /// such that another objective φ keeps its value there:
    ///
    /// ```text
    /// dJ/dα + ν dφ/dα,      ν = −(dJ/dh)/(dφ/dh)      with the size h of the last step
    /// ```
    ///
    /// For [`Objective::time`] as J these are the derivatives of the time of the event.
    ///
    /// # Errors
    ///
    /// As [`gradient`](Self::gradient); [`GradientError::NoTimeDerivative`] if the scene has functions of time;
    /// [`GradientError::Grazing`] if φ does not change with the time, to rounding; [`GradientError::NoHistory`] without a step.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{History, Objective};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(1.0, [-1.0], [2.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.3)?;
    /// run.keep_history(History::default());
    /// let passes = Event::rising(|run: &Simulation<1>| Ok(run.position(mass)?[0]));
    /// run.run_until_event(9.0, &mut [passes])?;
    ///
    /// // t = −q/v
    /// let place = Objective::at_end(Quantity::Position(mass));
    /// let gradient = run.gradient_at_event(&Objective::time(), &place)?;
    /// assert!((gradient.by_velocity(mass)?[0] + 0.25).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn gradient_at_event(
        &mut self,
        objective: &Objective<D>,
        event: &Objective<D>,
    ) -> Result<Gradient<D>, GradientError> {
        self.on_history(|run, kept| {
            let mut rate = |of: &Objective<D>| {
                let way = run.go_back(kept, &[(1.0, of)], 1)?;
                let by_size = way.found.by_end_time()?;
                let rounding = way.last.ok_or(GradientError::NoHistory)?.rounding();
                Ok::<_, GradientError>((by_size, rounding))
            };
            let [(of_event, rounding), (of_objective, _)] = [rate(event)?, rate(objective)?];
            if of_event.abs() <= rounding {
                return Err(GradientError::Grazing {
                    time: kept.time(),
                    rate: of_event,
                });
            }
            let follows = -(of_objective / of_event);
            run.gradient_of(kept, &[(1.0, objective), (follows, event)])
        })
    }

    /// Calls a function with the history, and restores everything afterwards.
    fn on_history<T>(
        &mut self,
        act: impl FnOnce(&mut Self, &mut Record) -> Result<T, GradientError>,
    ) -> Result<T, GradientError> {
        let taken = self.run.history.take();
        // Also after a panic of a user's function.
        let mut guard = Guard::new((self, taken), |(run, taken)| {
            if let Some(kept) = taken {
                kept.forget_passing();
            }
            run.run.history = taken.take();
        });
        let (run, taken) = &mut guard.value;
        let Some(kept) = taken else {
            return Err(GradientError::NoHistory);
        };
        kept.return_to(run.time());
        run.check_history(kept)?;
        if kept.all().is_some() {
            act(run, kept)
        } else {
            run.with_steps_again(|run| act(run, kept))
        }
    }

    fn gradient_of(
        &mut self,
        kept: &mut Record,
        objectives: Weighted<'_, D>,
    ) -> Result<Gradient<D>, GradientError> {
        let way = self.go_back(kept, objectives, usize::MAX)?;
        let mut found = way.found;
        found.start = way.adjoint.costate;
        if let Some((_, objective)) = objectives.first() {
            found.unit = objective.unit();
        }
        for (_, series) in &mut found.vectors {
            series.0.reverse();
        }
        for (_, series) in &mut found.numbers {
            series.0.reverse();
        }
        found.sizes.reverse();
        if let Some(start) = kept.times().next() {
            found.started = start;
        }
        Ok(found)
    }

    /// Goes back over this many of the last steps, or over all if there are fewer.
    fn go_back(
        &mut self,
        kept: &mut Record,
        objectives: Weighted<'_, D>,
        steps: usize,
    ) -> Result<Way<D>, GradientError> {
        let mut seeds = Seeds::new(kept, objectives)?;
        let mut way = self.way_back()?;
        let [mut old, mut new] = [(); 2].map(|()| State::clone(&self.run.state));
        let mut end = kept.len();
        let stop = end.saturating_sub(steps);
        self.add_seeds((end, &mut new), (kept, &mut seeds), &mut way)?;
        let at_end = self.effect(&way.adjoint.costate, &new);
        let mut largest = at_end;
        while end > stop {
            let again;
            let states = if let Some(all) = kept.all() {
                all
            } else {
                again = self.states_before((end, &new), kept)?;
                &again
            };
            let first = end - states.len();
            for at in (first.max(stop)..end).rev() {
                states.load::<D>(at - first, &self.run.masses, &mut old);
                self.reverse((kept.size(at), [&old, &new]), &mut way)?;
                largest = largest.max(self.effect(&way.adjoint.costate, &old));
                self.add_seeds((at, &mut old), (kept, &mut seeds), &mut way)?;
                mem::swap(&mut old, &mut new);
            }
            end = first;
        }
        if !seeds.value.is_finite() {
            let time = kept.time();
            return Err(GradientError::NotFinite { time });
        }
        way.found.value = seeds.value;
        way.found.growth = if at_end > 0.0 { largest / at_end } else { 1.0 };
        Ok(way)
    }

    /// A way back before its first step.
    fn way_back(&mut self) -> Result<Way<D>, GradientError> {
        let passage = self.passage();
        let found = self.no_gradient(&passage);
        let mut anchors = Vec::new();
        if self.run.masses.are_coupled() {
            let (all, are_moved) = (self.run.masses.anchors(), self.run.are_moved());
            anchors.extend(all.map(|node| (node, are_moved[node])));
        }
        let Stepper::Newton(newton) = self.run.stepper.of_mut::<D>() else {
            return Err(no_adjoint(self.run.in_use, self.time()));
        };
        let system = newton.solver.tangent_mut();
        Ok(Way {
            adjoint: Adjoint::new(
                &passage.layout,
                &self.run.masses,
                system,
                found.start.clone(),
            ),
            paths: self.run.conduction.path_ends(),
            by_reservoirs: vec![0.0; self.run.conduction.reservoirs.len()],
            by_speeds: Vec::new(),
            passage,
            anchors,
            by_size: 0.0,
            last: None,
            found,
        })
    }

    /// Takes a step back: from the derivatives with respect to its new state to those with respect to its old one.
    fn reverse(&mut self, made: Made<'_>, way: &mut Way<D>) -> Result<(), GradientError> {
        self.find_loads(made, &mut way.passage);
        for (oven, _) in &self.run.loads.ovens {
            // An oven keeps no entropy: what it receives is booked as heat after the step.
            way.adjoint.costate.reservoirs[*oven] = 0.0;
        }
        let (adjoint, found) = (&mut way.adjoint, &mut way.found);
        let see = &mut (|element: Element, values: &[f64]| {
            add(&mut found.elements[element.index()].values, 1.0, values);
        });
        self.differentiate(made, &way.passage, |past, loaded, groups, system| {
            adjoint.step_back(past, loaded, groups, system, see)
        })?;
        if !way.adjoint.costate.is_finite() {
            let time = made.1[1].time.value;
            return Err(GradientError::NotFinite { time });
        }
        Self::find_by_speeds(way);
        self.add_step(made, way);
        self.add_series(made, way);
        self.add_size(made, way);
        Ok(())
    }

    /// Passes a step that was made, the elements and the system to its adjoint or its tangents.
    fn differentiate(
        &mut self,
        (step, [old, new]): Made<'_>,
        passage: &Passage<D>,
        by: impl FnOnce(
            &PastStep<'_>,
            (&Layout, &[RocketStep<D>]),
            &mut [Box<dyn Group<D>>],
            &mut LinearSystem<1>,
        ) -> Result<(), NoAdjoint>,
    ) -> Result<(), GradientError> {
        self.look()?;
        // The elements are evaluated elsewhere than at the ends of their last step.
        self.run.has_stepped = false;
        let Stepper::Newton(newton) = self.run.stepper.of_mut::<D>() else {
            return Ok(());
        };
        let view = StepView {
            phase: Phase::Whole,
            step,
            per_step: step.recip(),
            state: old,
            conduction: &passage.conduction,
            loads: &newton.loads,
            stages: &[],
            masses: &self.run.masses,
        };
        let held = &passage.held;
        let past = PastStep { view, new, held };
        let loaded = (&passage.layout, &passage.rockets[..]);
        let system = newton.solver.tangent_mut();
        let found = by(&past, loaded, &mut newton.groups, system);
        found.map_err(|error| match error {
            NoAdjoint::Singular => GradientError::Singular {
                time: new.time.value,
            },
            NoAdjoint::State(error) => error.into(),
        })
    }

    /// An error unless all steps of the history have an adjoint.
    fn check_history(&self, kept: &Record) -> Result<(), GradientError> {
        for (scheme, time) in kept.schemes().chain([(self.run.in_use, self.time())]) {
            if !scheme.has_adjoint() {
                return Err(no_adjoint(scheme, time));
            }
        }
        let mut others = kept
            .schemes()
            .filter(|&(scheme, _)| scheme != self.run.in_use);
        if others.next().is_some() {
            let time = kept.end_before(self.run.in_use);
            return Err(GradientError::HistoryBroken { time });
        }
        if kept.ends_in(&self.run.state) {
            return Ok(());
        }
        kept.check()?;
        let time = kept.time();
        Err(GradientError::HistoryBroken { time })
    }

    /// The effect of a relative change of a state on the objective, at most: `|λ_q||q| + |λ_v||v| + |λ_γ||q| + |λ_θ||θ|`.
    fn effect(&self, costate: &PerVariable, state: &State) -> f64 {
        let distance = length(state.positions.values());
        length(&costate.positions) * distance
            + length(&costate.velocities) * length(&self.velocities_in(state))
            + length(&costate.viscous) * distance
            + length(&costate.temperatures) * length(&state.temperatures)
    }
}

impl Run {
    /// Keeps the step that was just made.
    pub(super) fn keep_step(&mut self, size: f64) {
        if let Some(history) = &mut self.history
            && history.keep(size, self.in_use, [&self.next, &self.state])
        {
            history.snapshot(&self.state, || self.stepper.past(&self.state).0);
        }
    }
}

#[cold]
fn no_adjoint(scheme: Scheme, time: f64) -> GradientError {
    let scheme = scheme.name();
    GradientError::NoAdjoint { scheme, time }
}

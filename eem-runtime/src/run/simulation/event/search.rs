//! Search for events by repeating one step.
//!
//! The state after a step is a continuous function of the step size, and all laws hold for every size. So an event
//! within a step is located by repeating the step with other sizes, without interpolation; the state at the event obeys
//! the laws like any other.

use core::ops::ControlFlow;

use super::{Bracket, Event, Mark, Simulation};
use crate::run::simulation::compiled::Aim;
use crate::run::simulation::memory::or_restore;
use crate::run::simulation::run::RunEnd;
use crate::run::simulation::{Run, Stepped};
use crate::step::error::{StepError, StepFailure};
use crate::step::newton::StepReport;
use eem_material::number::scalar::Scalar;

/// The finest resolution of the time of an event, in units in the last place.
const SHARPEST: f64 = 4.0;

impl<const D: usize> Simulation<D> {
    /// Steps until the time `end`, s, or until the first of some events.
    ///
    /// The run stops just behind the event, at most the tolerance of the event after the change of sign, or
    /// where its function is zero, and returns its index in `events`: the first, if several have happened
    /// ([`Event::has_happened`]). A run that continues from there does not find the same event again. A
    /// function that is zero at the beginning has no sign until its first nonzero value.
    ///
    /// Signs are compared at the ends of steps: of three changes within a step one is found, not necessarily the first;
    /// of two none. Everything else is as in [`run_until`](Self::run_until).
    ///
    /// # Errors
    ///
    /// As [`run_until`](Self::run_until); [`StepFailure::EventTolerance`] if a tolerance is negative
    /// or not a number; [`StepFailure::EventFunction`] if a function is not a number, and
    /// [`StepFailure::EventError`] if it fails, with the simulation as it was before the step that led there.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut run = Simulation::new(Scene::<2>::new(), Scheme::EemEntropy, 0.5)?;
    /// let noon = Event::falling(|run: &Simulation<2>| Ok(run.time().cos())).within(1e-9);
    /// assert_eq!(run.run_until_event(9.0, &mut [noon])?, RunEnd::Event(0));
    /// let late = run.time() - core::f64::consts::FRAC_PI_2;
    /// assert!((0.0..=1e-9).contains(&late));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_until_event(
        &mut self,
        end: f64,
        events: &mut [Event<'_, D>],
    ) -> Result<RunEnd, StepError> {
        if events.is_empty() {
            self.run.expect_finite(end)?;
        }
        self.run_until_event_with(end, events, |_, _| ControlFlow::Continue(()))
    }

    /// Like [`run_until_event`](Self::run_until_event), and calls `observer` after every step, as
    /// [`run_until_with`](Self::run_until_with) does.
    ///
    /// The observer sees the shortened step that ends at an event, not the trials of the search.
    ///
    /// # Errors
    ///
    /// As [`run_until_event`](Self::run_until_event).
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(1.0, [-1.0], [2.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.3)?;
    ///
    /// let passes = Event::crossing(|run: &Simulation<1>| Ok(run.position(mass)?[0]));
    /// let mut recorder = Recorder::new(&run, [("q", Quantity::Position(mass))])?;
    /// run.run_until_event_with(10.0, &mut [passes], |run, report| recorder.observe(run, report))?;
    /// let times = recorder.column("time").ok_or("no time")?;
    /// assert_eq!(times.len(), 3);
    /// assert!((times[2] - 0.5).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_until_event_with(
        &mut self,
        end: f64,
        events: &mut [Event<'_, D>],
        mut observer: impl FnMut(&Self, &StepReport) -> ControlFlow<()>,
    ) -> Result<RunEnd, StepError> {
        for event in &mut *events {
            event.mark.has_happened = false;
        }
        if !(self.time() <= end) {
            return Err(self.run.refused(StepFailure::End { end }));
        }
        self.begin_search(events)?;
        while self.run.is_before(end) {
            let before = (!events.is_empty()).then(|| self.run.history());
            self.run.advance(Aim::Towards(end))?;
            if let Some(before) = before {
                let restore = |run: &mut Self| run.run.restore_history(&before);
                or_restore(self, restore, |run| {
                    end_at_event(&mut WithEvents { run, events }, end)
                })?;
            }
            let report = self.run.report;
            let stopped = observer(self, &report).is_break();
            if let Some(first) = events.iter().position(Event::has_happened) {
                return Ok(RunEnd::Event(first));
            }
            if stopped {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Reached)
    }

    /// Evaluates the functions at the present state.
    fn begin_search(&self, events: &mut [Event<'_, D>]) -> Result<(), StepError> {
        for (event, place) in events.iter_mut().zip(0..) {
            let value = event.mark.tolerance;
            if value.is_nan() || value < 0.0 {
                return Err(self.run.refused(StepFailure::EventTolerance {
                    event: place,
                    value,
                }));
            }
            let before = event.value(place, self);
            event.mark.before = before.map_err(|failure| self.run.refused(failure))?;
        }
        Ok(())
    }
}

/// A run with its events, whatever the dimension.
trait Watched {
    fn run(&mut self) -> &mut Run;

    /// What is known of an event, if there are so many.
    fn mark(&mut self, place: usize) -> Option<&mut Mark>;

    /// The function of an event at the present state.
    fn value(&mut self, place: usize) -> Result<f64, StepFailure>;
}

struct WithEvents<'a, 'f, const D: usize> {
    run: &'a mut Simulation<D>,
    events: &'a mut [Event<'f, D>],
}

impl<const D: usize> Watched for WithEvents<'_, '_, D> {
    fn run(&mut self) -> &mut Run {
        &mut self.run.run
    }

    fn mark(&mut self, place: usize) -> Option<&mut Mark> {
        Some(&mut self.events.get_mut(place)?.mark)
    }

    fn value(&mut self, place: usize) -> Result<f64, StepFailure> {
        self.events[place].value(place, self.run)
    }
}

/// Ends the last step at the first event in it, if there is one, and marks the events that have happened then.
fn end_at_event(watched: &mut dyn Watched, end: f64) -> Stepped {
    let mut is_located = false;
    let mut places = 0;
    while watched.mark(places).is_some() {
        // An earlier event of the list may have shortened the step.
        let after = value_or_undo(watched, places)?;
        let whole = watched.run().report.step;
        let mark = watched.mark(places);
        let bracket = mark.and_then(|mark| mark.see(after).bracket(whole));
        if let Some(bracket) = bracket {
            is_located = true;
            if let Err(error) = locate(watched, bracket, end, places) {
                return end_at_event_in_half(watched, whole, end, error);
            }
        }
        places += 1;
    }
    for place in 0..places {
        let after = is_located
            .then(|| value_or_undo(watched, place))
            .transpose()?;
        let step = watched.run().report.step;
        if let Some(mark) = watched.mark(place) {
            let mark = mark.see(after.unwrap_or(mark.after));
            mark.has_happened = mark.bracket(step).is_some();
            mark.before = mark.after;
        }
    }
    Ok(())
}

/// Used when the step that would end at the event has failed: makes a step of half the size instead, which is kept, and
/// searches for events in it.
fn end_at_event_in_half(
    watched: &mut dyn Watched,
    whole: f64,
    end: f64,
    error: StepError,
) -> Stepped {
    let is_of_event = matches!(
        error.failure,
        StepFailure::EventFunction { .. } | StepFailure::EventError { .. }
    );
    let run = watched.run();
    let middle = run.time() + 0.5 * whole;
    if run.control.is_none() || is_of_event || !run.is_before(middle) {
        return Err(error);
    }
    run.advance(Aim::InSchemeTowards(middle))?;
    end_at_event(watched, end)
}

/// Replaces the last step by a shorter one that ends just behind the event.
fn locate(watched: &mut dyn Watched, mut bracket: Bracket, end: f64, place: usize) -> Stepped {
    let whole = watched.run().report;
    let scale = whole.time.abs() + whole.step;
    let sharpest = SHARPEST * f64::EPSILON * scale;
    let tolerance = watched.mark(place).map_or(0.0, |mark| mark.tolerance);
    let resolution = Scalar::maximum(tolerance, sharpest);
    let (mut is_behind, mut is_shorter) = (true, false);
    while let Some(size) = bracket.candidate(resolution) {
        watched.run().undo();
        watched.run().advance(Aim::Again(size))?;
        let value = value_or_undo(watched, place)?;
        is_behind = bracket.narrow(size, value);
        is_shorter |= is_behind;
    }
    if is_behind {
        return Ok(());
    }
    let run = watched.run();
    run.undo();
    if is_shorter {
        return run.advance(Aim::Again(bracket.high));
    }
    run.advance(Aim::Again(whole.step))?;
    #[expect(clippy::float_cmp, reason = "whether the step ended there")]
    if whole.time == end {
        run.arrive_at(end);
    }
    Ok(())
}

/// The function of an event at the present state. If it fails, the last step is undone.
fn value_or_undo(watched: &mut dyn Watched, place: usize) -> Result<f64, StepError> {
    let value = or_restore(
        watched,
        |watched| watched.run().undo(),
        |watched| watched.value(place),
    );
    let run = watched.run();
    value.map_err(|failure| run.failed(run.step, failure))
}

impl Mark {
    /// Takes the value of the function at the end of the step.
    const fn see(&mut self, after: f64) -> &mut Self {
        self.after = after;
        self
    }

    /// Step sizes around the change of sign within a step, if there is one in the sense of the event.
    fn bracket(&self, step: f64) -> Option<Bracket> {
        Bracket::new(self.sense, step, [self.before, self.after])
    }
}

impl<const D: usize> Event<'_, D> {
    /// The function in a state; an error unless it is a number.
    fn value(&mut self, place: usize, run: &Simulation<D>) -> Result<f64, StepFailure> {
        let value = (self.function)(run).map_err(|error| StepFailure::EventError {
            event: place,
            reason: error.to_string(),
        })?;
        if value.is_nan() {
            return Err(StepFailure::EventFunction { event: place });
        }
        Ok(value)
    }
}

//! A scene in motion.

mod audit;
mod check;
mod control;
mod control_memory;
mod event;
pub(crate) mod generic;
mod halves;
mod inspect;
pub(crate) mod linearize;
mod resume;
pub(crate) mod run;
mod settings;
mod start;
mod stepper;
mod totals;
pub(crate) mod values;

use core::fmt;
use core::sync::atomic::{AtomicBool, Ordering};

use crate::element::conduction::Conduction;
use crate::element::group::StepView;
use crate::element::handle::SceneId;
use crate::element::layout::{Layout, Shape};
use crate::element::masses::Masses;
use crate::element::phase::Phase;
use crate::element::state::State;
use crate::number::compact::compact;
use crate::number::scalar::{Discord, Mask, Real};
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::scene::loads::Loads;
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::{Demand, ExplicitView};
use crate::step::newton::StepReport;
use crate::step::outcome::{Attempt, Corrections};
use crate::step::scheme::Scheme;
use crate::step::solver::Effort;
use check::{check_end, check_solids, check_step};
use control_memory::Control;
use start::initial_state;
use stepper::{Newton, Parts, Stepper};
use totals::check_totals;

/// What the elements share during the next step; borrows only the fields that it names.
macro_rules! view {
    ($simulation:ident, $phase:expr, $state:expr, [$loads:expr, $stages:expr]) => {
        StepView {
            phase: $phase,
            step: $simulation.step,
            per_step: $simulation.step.recip(),
            state: $state,
            conduction: &$simulation.conduction,
            loads: $loads,
            stages: $stages,
            masses: &$simulation.masses,
        }
    };
}
use view;

/// A scene that is stepped through time by one scheme.
///
/// A step either succeeds, or returns an error and leaves everything as it was.
pub struct Simulation<const D: usize, S: Real = f64> {
    scene: SceneId,
    scheme: Scheme,
    step: S,
    masses: Masses<S>,
    /// The group and the place in it of each element.
    places: Vec<[u32; 2]>,
    /// What the elements of each group have.
    shapes: Vec<Shape>,
    layout: Layout,
    conduction: Conduction<S>,
    loads: Loads<S, D>,
    stepper: Stepper<S, D>,
    effort: Effort<S>,
    /// None while all steps have the size that they are given.
    control: Option<Box<Control<S>>>,
    state: Box<State<S>>,
    /// Where the next state is written.
    next: Box<State<S>>,
    /// The last step succeeded, and the elements still know what they did in it.
    has_stepped: bool,
    /// The report with the largest `|defect|/bound` so far.
    worst: Option<StepReport<S>>,
    corrections: Corrections<S>,
    /// Something failed while S was several numbers: alone, some of them might not have failed, so that
    /// nothing that follows counts. Never set where S is a single number.
    has_parted: AtomicBool,
}

/// A step that was tried.
enum Tried<S> {
    /// It is made.
    Made(StepReport<S>),
    /// Its error is so many tolerances; nothing has changed.
    Refused(S),
}

impl<const D: usize, S: Real> fmt::Debug for Simulation<D, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("scheme", &self.scheme)
            .field("step", &self.step)
            .field("state", &self.state)
            .finish_non_exhaustive()
    }
}

impl<const D: usize, S: Real> Simulation<D, S> {
    /// Checks a scene and makes it ready to be stepped by `scheme` with the time step `step`, s.
    ///
    /// # Errors
    ///
    /// The first thing that is wrong with the scene, its initial state or the step.
    pub fn new(scene: Scene<D, S>, scheme: Scheme, step: S) -> Result<Self, SceneError> {
        scene.check()?;
        let has_solids = scene.groups.iter().any(|group| !group.shape().is_spring);
        if has_solids {
            check_solids(scheme)?;
        }
        check_step(step)?;
        let mut layout = scene.layout();
        let conduction = Conduction::new(&scene.conductors, &scene.reservoirs, &layout);
        let mut state = Box::new(initial_state(&scene, &layout));
        let places = scene
            .elements
            .iter()
            .map(|entry| [entry.group, entry.place].map(compact))
            .collect();
        let shapes = scene.groups.iter().map(|group| group.shape()).collect();
        let masses = Masses::new(scene.nodes.iter().map(|node| node.mass), scene.pairs);
        state.follow_velocities(D, &masses);
        // Large, and all that it said is in the masses and in the state.
        drop(scene.nodes);
        let parts = Parts {
            scheme,
            masses: &masses,
            elements: &scene.elements,
            layout: &layout,
            conduction: &conduction,
            loads: &scene.loads,
        };
        let stepper = Stepper::new(scene.groups, parts, &mut state)?;
        layout.forget_places();
        let run = Self {
            scene: scene.id,
            scheme,
            step,
            masses,
            places,
            shapes,
            layout,
            conduction,
            loads: scene.loads,
            stepper,
            effort: Effort::new(),
            control: None,
            next: state.clone(),
            state,
            has_stepped: false,
            worst: None,
            corrections: Corrections::none(),
            has_parted: AtomicBool::new(false),
        };
        check_totals(&run.ledger())?;
        Ok(run)
    }

    /// One step of the present size, or of the one that [step control](Self::control_steps) finds.
    ///
    /// # Errors
    ///
    /// [`StepError`] if the scheme has no new state, or Newton's method does not find it. The
    /// simulation is then as it was before.
    pub fn step(&mut self) -> Result<StepReport<S>, StepError> {
        if self.control.is_some() {
            return self.controlled_step(S::from_f64(f64::INFINITY));
        }
        self.single_step()
    }

    /// One step of the present size.
    fn single_step(&mut self) -> Result<StepReport<S>, StepError> {
        match self.try_step(Demand::None)? {
            Tried::Made(report) => Ok(report),
            Tried::Refused(_) => unreachable!("a step without a tolerance has no error"),
        }
    }

    /// One step of the present size, unless it estimates its own error and that is not within what is
    /// demanded.
    fn try_step(&mut self, demand: Demand<S>) -> Result<Tried<S>, StepError> {
        self.has_stepped = false;
        self.effort.restart();
        let Attempt { error, outcome } = match self.find_next(demand) {
            Ok(attempt) => attempt,
            Err(failure) => return Err(self.failed(failure)),
        };
        let Some(outcome) = outcome else {
            return Ok(Tried::Refused(error));
        };
        core::mem::swap(&mut self.state, &mut self.next);
        self.has_stepped = true;
        let report = StepReport {
            time: self.time(),
            step: self.step,
            iterations: self.effort.history.len(),
            update: self.effort.end.update,
            residual: self.effort.end.residual,
            defect: outcome.defect,
            bound: outcome.bound,
            production: outcome.production,
            least_production: outcome.least_production,
            correction: outcome.correction.abs(),
            error,
        };
        self.corrections.note(outcome.correction);
        self.note_worst(&report);
        Ok(Tried::Made(report))
    }

    /// Writes the next state.
    fn find_next(&mut self, demand: Demand<S>) -> Result<Attempt<S>, StepFailure> {
        if self.has_parted() {
            // An experiment that ignores failed steps and waits for something would loop forever.
            return Err(Discord.into());
        }
        check_end(self.time() + self.step)?;
        self.evaluate_loads()?;
        let (effort, next) = (&mut self.effort, &mut *self.next);
        let newton = match &mut self.stepper {
            Stepper::Newton(newton) => newton,
            Stepper::Explicit(explicit) => {
                let view = ExplicitView {
                    step: self.step,
                    state: &self.state,
                    conduction: &self.conduction,
                    loads: &self.loads,
                    masses: &self.masses,
                };
                return explicit.step(&view, demand, next);
            }
        };
        let Newton {
            groups,
            solver,
            loads,
            stages,
            between,
        } = &mut **newton;
        let Some(between) = between else {
            let view = view!(self, Phase::Whole, &self.state, [loads, stages]);
            return Ok(Attempt::made(solver.solve(groups, &view, effort, next)?));
        };
        let view = view!(self, Phase::Mechanics, &self.state, [loads, stages]);
        let motion = solver.solve(groups, &view, effort, between)?;
        let view = view!(self, Phase::Heat, between, [loads, stages]);
        let heat = solver.solve(groups, &view, effort, next)?;
        Ok(Attempt::made(motion.and(heat)))
    }

    /// Keeps a report if it comes closer to its bound than all before.
    fn note_worst(&mut self, report: &StepReport<S>) {
        let is_worse = self.worst.is_none_or(|worst| {
            let (own, other) = (report.defect.abs(), worst.defect.abs());
            (other * report.bound).less(own * worst.bound).any()
        });
        if is_worse {
            self.worst = Some(*report);
        }
    }

    /// The loads of the next step.
    fn evaluate_loads(&mut self) -> Result<(), StepFailure> {
        if self.loads.are_none() {
            return Ok(());
        }
        let span = [self.time(), self.step];
        let Stepper::Newton(newton) = &mut self.stepper else {
            return Ok(());
        };
        newton.evaluate_loads(
            &self.loads,
            &self.masses,
            self.scheme,
            span,
            self.state.positions.values(),
        )
    }

    /// Whether several numbers in one S have to be run one by one.
    #[inline]
    pub(crate) fn has_parted(&self) -> bool {
        S::LANES > 1 && self.has_parted.load(Ordering::Relaxed)
    }

    /// Notes that something is not possible for several numbers together; nothing for a single one.
    pub(crate) fn part(&self) {
        if S::LANES > 1 {
            self.has_parted.store(true, Ordering::Relaxed);
        }
    }

    #[cold]
    fn failed(&self, failure: StepFailure) -> StepError {
        self.part();
        StepError {
            time: self.time().to_f64(),
            step: self.step.to_f64(),
            failure,
            history: self
                .effort
                .history
                .iter()
                .map(|iteration| iteration.to_f64())
                .collect(),
        }
    }

    /// The time, s.
    #[must_use]
    pub fn time(&self) -> S {
        self.state.time.value
    }

    /// The scheme.
    #[must_use]
    pub const fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Number of unknowns of the global system of one Newton iteration; none for an explicit scheme.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.stepper.sets() * self.layout.unknowns
    }

    /// Whether several numbers in one S can go through a step together: in the dense elimination of a
    /// few unknowns, whose pivots are on the diagonal, in a scheme with one set of forces, or in the explicit
    /// one; and with weight for all of them or for none.
    pub(crate) fn suits_lanes(&self) -> bool {
        self.stepper.suits_lanes(self.unknowns()) && self.loads.suit_lanes()
    }
}

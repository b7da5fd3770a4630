//! A scene in motion.

// The documentation shows methods in this order.
mod compiled;

pub(crate) mod run;

pub(crate) mod event;

mod inspect;

mod control;

pub(crate) mod change;

mod controller;

mod meters;

#[cfg(feature = "gradients")]
mod gradient;

mod resume;

pub(crate) mod attempt;
mod automatic;
pub(crate) mod generic;
mod halves;
mod memory;
pub(crate) mod start;
mod stepper;
mod stepping;
mod unseen;
pub(crate) mod warning;

use core::any::Any;
use core::sync::atomic::AtomicBool;
use core::{fmt, mem};

use crate::algebra::indices;
use crate::element::conduction::Conduction;
use crate::element::group::{ElementTotals, Stiffness};
use crate::element::handle::{Element, Handle};
use crate::element::layout::{Layout, Shape, Slots};
use crate::element::lineage::Lineage;
use crate::element::masses::Masses;
use crate::element::state::State;
#[cfg(feature = "gradients")]
use crate::run::gradient::history::Watch;
#[cfg(feature = "gradients")]
use crate::run::gradient::snapshots::Record;
use crate::run::ledger::Ledger;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::scene::loads::SceneLoads;
use crate::scene::plan::{Entries, Plan};
use crate::scene::refused::RefusedScene;
use crate::step::control::{LeastScales, Tolerance, length};
use crate::step::error::{StepError, StepFailure};
use crate::step::newton::StepReport;
use crate::step::outcome::Corrections;
use crate::step::scheme::Scheme;
use crate::step::solver::Effort;
use crate::step::timed::TimedLoad;
use memory::{Automatic, Control, Unresolved};
use start::{FirstState, Needs, Outline, Used, find_entropies};
use stepper::{Memory, Newton, Stepper};
use stepping::Stepping;

/// A run: a scene, a scheme and the present state.
///
/// | to | methods |
/// |---|---|
/// | begin and go on | [`new`](Self::new), [`step`](Self::step), [`run_until`](Self::run_until), [`run_at`](Self::run_at), [`run_until_event`](Self::run_until_event) |
/// | look | [`time`](Self::time), [`position`](Self::position), [`temperature`](Self::temperature), [`ledger`](Self::ledger), or a [`Recorder`](crate::Recorder) |
/// | choose steps and scheme | [`control_steps`](Self::control_steps), [`set_step_size`](Self::set_step_size), [`with_scheme`](Self::with_scheme) |
/// | act | [`set_force`](Self::set_force), [`set_motion`](Self::set_motion), [`set_temperature_of`](Self::set_temperature_of) |
/// | save | [`checkpoint`](Self::checkpoint), [`restore`](Self::restore) |
///
/// A step either succeeds, or returns an error and leaves everything unchanged.
pub struct Simulation<const D: usize> {
    run: Run,
}

/// A run in a space of any dimension: what does not call functions of the user with a [`Simulation`]. It is compiled once.
struct Run {
    dimension: usize,
    scene: Lineage,
    scheme: Scheme,
    /// The scheme of the present steps; it differs from `scheme` for `Scheme::Auto`.
    in_use: Scheme,
    automatic: Automatic,
    step: f64,
    masses: Masses,
    /// The group of each element, and its index there.
    places: Vec<[u32; 2]>,
    /// Capabilities of the elements of each group.
    shapes: Vec<Shape>,
    layout: Layout,
    conduction: Conduction,
    loads: SceneLoads,
    /// Whether there are loads, thermostats or ovens.
    has_loads: bool,
    /// A [`Stepper`] of the dimension.
    stepper: Box<dyn Stepping>,
    /// The least scales of errors, from the initial state.
    least: LeastScales,
    effort: Effort,
    /// `None` without step control.
    control: Option<Box<Control>>,
    state: Box<State>,
    /// Memory for the new state; after a step the old one.
    next: Box<State>,
    /// Whether the last step succeeded, and the elements still have the values at its ends.
    has_stepped: bool,
    /// The time at which the run began, s.
    start: f64,
    /// The positions of anchors before a controller moved them for the first time, m, by node.
    homes: Vec<(usize, Vec<f64>)>,
    /// The states since the call of `keep_history`; `None` without it.
    #[cfg(feature = "gradients")]
    history: Option<Box<Record>>,
    #[cfg(feature = "gradients")]
    watch: Option<Box<Watch>>,
    /// Whether `meter_heat` or a recorder needs the sums of dissipation and heat.
    wants_meters: AtomicBool,
    /// The report with the largest `|defect|/bound` so far.
    worst: Option<StepReport>,
    corrections: Corrections,
    unresolved: Unresolved,
    /// Of the last step that was made.
    report: StepReport,
}

/// A step that was made, whose report is in the simulation, or why it failed.
type Stepped = Result<(), StepError>;

/// A step that was tried.
enum Tried {
    /// It succeeded.
    Made,
    /// Its error, in units of the tolerance, is too large; nothing has changed.
    Rejected(f64),
    /// It was not made, because it would pass over this load.
    Unseen(TimedLoad),
}

impl<const D: usize> fmt::Debug for Simulation<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("scheme", &self.run.scheme)
            .field("step", &self.run.step)
            .field("state", &self.run.state)
            .finish_non_exhaustive()
    }
}

impl<const D: usize> Simulation<D> {
    /// A simulation of a scene with steps of this size, s, or by a tolerance, in the place of an earlier one, and in its memory if
    /// that fits.
    fn begin(
        slot: &mut Option<Self>,
        mut scene: Scene<D>,
        scheme: Scheme,
        (step, tolerance): (f64, Option<Tolerance>),
    ) -> Result<&mut Self, RefusedScene<D>> {
        let shapes = scene.shapes();
        let needs = Needs::of(&scene.plan, &scene.groups, &shapes);
        let in_use = needs.first(scheme);
        let mut errors = scene.plan.check(&scene.groups);
        needs.check_run((scheme, in_use), (step, tolerance), &mut errors);
        if !errors.is_empty() {
            return Err(RefusedScene::new(scene, errors));
        }
        let outline = Outline::new(&scene.plan, shapes);
        let run = match Self::take(slot, &mut scene, outline, (scheme, in_use, needs), step) {
            Ok(run) => run,
            Err(errors) => return Err(RefusedScene::new(scene, errors)),
        };
        run.run.begin_control(tolerance);
        Ok(run)
    }

    /// A simulation with the contents of a scene, without step control, unless its initial state is invalid.
    fn take<'s>(
        slot: &'s mut Option<Self>,
        scene: &mut Scene<D>,
        outline: Outline,
        schemes: (Scheme, Scheme, Needs),
        step: f64,
    ) -> Result<&'s mut Self, Vec<SceneError>> {
        let (_, in_use, _) = schemes;
        slot.take_if(|used| !used.run.fits(&scene.plan, &outline, in_use));
        let (newton, used) = slot.take().and_then(|used| used.run.into_newton()).unzip();
        let mut start = FirstState::new(&scene.plan, &outline, step, used)?;
        let plan = &mut scene.plan;
        let memory = if let Some(newton) = newton {
            Memory::Used(newton)
        } else {
            let site = outline.site(&plan.loads);
            let systems = Memory::new(in_use, site, plan.memory_limit);
            systems.map_err(|error| vec![error.into()])?
        };
        let groups = mem::take(&mut scene.groups);
        let parts = (in_use, outline.site(&plan.loads));
        let entries = &mut plan.entries;
        let stepper = Stepper::new(
            groups,
            memory,
            parts,
            &mut start.state,
            &mut |state, all| {
                find_entropies(all, state, parts.1)?;
                // The entries of the scene are large, and now contained in masses, state and groups.
                *entries = Entries::default();
                Ok(())
            },
        );
        let stepper = stepper.map_err(|(errors, groups)| {
            scene.groups = groups;
            errors
        })?;
        let run = Run::new(plan, (outline, start), Box::new(stepper), schemes, step);
        Ok(slot.insert(Self { run }))
    }
}

impl Run {
    /// What another run of the same kind can use.
    fn into_newton<const D: usize>(self) -> Option<(Box<Newton<D>>, Used)> {
        let (stepper, used) = self.into_used();
        match *(stepper as Box<dyn Any>).downcast().ok()? {
            Stepper::Newton(newton) => Some((newton, used)),
            Stepper::Explicit(_) => None,
        }
    }

    fn into_used(self) -> (Box<dyn Stepping>, Used) {
        let used = Used {
            effort: self.effort.renewed(),
            state: self.state,
            next: self.next,
        };
        (self.stepper, used)
    }

    /// The run of a plan, whose entries are already used.
    fn new(
        plan: &mut Plan,
        (outline, start): (Outline, FirstState),
        stepper: Box<dyn Stepping>,
        (scheme, in_use, needs): (Scheme, Scheme, Needs),
        step: f64,
    ) -> Self {
        let dimension = plan.dimension();
        let Outline {
            masses,
            places,
            shapes,
            mut layout,
            conduction,
            ..
        } = outline;
        let FirstState {
            effort,
            state,
            next,
        } = start;
        let loads = mem::replace(&mut plan.loads, SceneLoads::none(dimension));
        layout.forget_places();
        let moved = loads.moved_in_time();
        let gravity = length(&loads.gravity);
        let before = (&*state, gravity, &moved[..]);
        let elements = |state: &State, see: &mut dyn FnMut(Stiffness<'_>)| {
            stepper.stiffness(state, &mut |_, point| see(point));
        };
        let least = LeastScales::new(&elements, (&masses, &conduction), before);
        let next = match next {
            None => state.clone(),
            Some(mut next) => {
                next.copy_all_from(&state);
                next
            }
        };
        Self {
            dimension,
            scene: plan.lineage.clone(),
            scheme,
            in_use,
            automatic: Automatic::new(needs, plan.memory_limit),
            step,
            masses,
            places,
            shapes,
            layout,
            conduction,
            has_loads: !loads.are_none(),
            loads,
            least,
            stepper,
            effort,
            control: None,
            next,
            state,
            has_stepped: false,
            start: plan.start,
            homes: Vec::new(),
            #[cfg(feature = "gradients")]
            history: None,
            #[cfg(feature = "gradients")]
            watch: None,
            wants_meters: AtomicBool::new(false),
            worst: None,
            corrections: Corrections::none(),
            unresolved: Unresolved::none(),
            report: StepReport::none(),
        }
    }

    /// The present time, s.
    fn time(&self) -> f64 {
        self.state.time.value
    }

    /// The ledger of a state but for its linear momentum, whatever steps led there.
    fn ledger_in(&self, state: &State) -> Ledger<0> {
        let mut totals = ElementTotals::new();
        self.stepper.add_totals(state, &mut totals);
        let (reservoirs, gravity) = (&self.conduction.reservoirs, &self.loads.gravity);
        Ledger::of(state, &self.masses, &totals, reservoirs, gravity)
    }

    /// All elements in the order of creation: group and place, and the capabilities of the group.
    fn all_places(&self) -> impl Iterator<Item = ([usize; 2], Shape)> {
        let places = self.places.iter().map(|&place| indices(place));
        places.map(|place| (place, self.shapes[place[0]]))
    }

    /// An error unless an element is a spring of this scene.
    fn expect_spring(&self, element: Element, quantity: &'static str) -> Result<(), SceneError> {
        self.expect_own(&element)?;
        if self.shape(element).is_spring {
            return Ok(());
        }
        Err(SceneError::NotASpring { element, quantity })
    }

    fn is_oven(&self, reservoir: usize) -> bool {
        let mut ovens = self.loads.ovens.iter();
        ovens.any(|&(oven, _)| oven == reservoir)
    }

    /// The capabilities of an element of this scene.
    fn shape(&self, element: Element) -> Shape {
        self.shapes[self.place(element)[0]]
    }

    /// The group of an element of this scene, and its index there.
    fn place(&self, element: Element) -> [usize; 2] {
        indices(self.places[element.index()])
    }

    /// The state indices of an element of this scene.
    fn slots(&self, element: Element) -> Slots {
        self.stepper.slots(self.place(element))
    }

    fn thermal_slot(&self, element: Element) -> Result<usize, SceneError> {
        self.expect_own(&element)?;
        let slot = self.slots(element).thermal;
        slot.ok_or(SceneError::NotThermal { element })
    }

    fn expect_own<H: Handle>(&self, handle: &H) -> Result<(), SceneError> {
        self.scene.expect(handle)
    }

    /// The error of a step of this size, with the iterations so far.
    #[cold]
    fn failed(&self, size: f64, failure: StepFailure) -> StepError {
        StepError {
            step: size,
            history: self.effort.history.as_slice().into(),
            ..self.refused(failure)
        }
    }

    /// The error of a run that ends before its first step.
    #[cold]
    fn refused(&self, failure: StepFailure) -> StepError {
        StepError {
            time: self.time(),
            step: self.step,
            failure,
            shorter: None,
            history: Box::default(),
        }
    }
}

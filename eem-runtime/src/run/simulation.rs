//! A scene in motion.

mod attempt;
mod audit;
mod automatic;
mod automatic_memory;
mod check;
mod compiled;
mod control;
mod control_memory;
pub(crate) mod event;
pub(crate) mod generic;
mod generic_temperature;
mod groups;
mod halves;
mod inspect;
pub(crate) mod linearize;
mod remembering;
mod resume;
pub(crate) mod run;
mod sampling;
mod settings;
mod shorter;
mod start;
mod stepper;
mod totals;
pub(crate) mod values;
mod viscous_strain;

use core::fmt;
use core::mem;
use core::sync::atomic::{AtomicBool, Ordering};

use crate::element::conduction::Conduction;
use crate::element::layout::{Layout, Shape};
use crate::element::lineage::Lineage;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::scene::loads::Loads;
use crate::scene::refused::RefusedScene;
use crate::step::automatic::first;
use crate::step::control::Tolerance;
use crate::step::error::{StepError, StepFailure};
use crate::step::newton::StepReport;
use crate::step::outcome::Corrections;
use crate::step::scheme::Scheme;
use crate::step::solver::Effort;
use automatic_memory::Automatic;
use check::{check_all, needs_implicit};
use control_memory::Control;
use eem_material::number::scalar::Real;
use start::{begin_groups, initial_state, places_in, systems_of};
use stepper::{Parts, Stepper};

/// A run: a scene, a scheme and the present state.
///
/// A step either succeeds, or returns an error and leaves everything unchanged.
pub struct Simulation<const D: usize, S: Real = f64> {
    scene: Lineage,
    scheme: Scheme,
    /// The same, unless it is chosen on the way.
    in_use: Scheme,
    /// Where the scheme is chosen on the way.
    automatic: Option<Box<Automatic<S>>>,
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
    /// See [`new`](Self::new), compiled here.
    pub(super) fn begin(
        mut scene: Scene<D, S>,
        scheme: Scheme,
        step: S,
    ) -> Result<Self, RefusedScene<D, S>> {
        let errors = check_all(&scene, first(scheme, needs_implicit(&scene)), step);
        if !errors.is_empty() {
            return Err(RefusedScene::new(scene, errors));
        }
        Self::take(&mut scene, scheme, step).map_err(|errors| RefusedScene::new(scene, errors))
    }

    /// Takes what a scene consists of, unless something is wrong with its initial state.
    fn take(scene: &mut Scene<D, S>, scheme: Scheme, step: S) -> Result<Self, Vec<SceneError>> {
        let is_second = needs_implicit(scene);
        let in_use = first(scheme, is_second);
        let mut layout = scene.layout();
        let conduction = Conduction::new(&scene.conductors, &scene.reservoirs, &layout);
        let mut state = Box::new(initial_state(scene, &layout, step)?);
        let places = places_in(scene);
        let shapes = scene.groups.iter().map(|group| group.shape()).collect();
        let masses = scene.masses();
        state.follow_velocities(D, &masses);
        let systems = systems_of(scene, in_use, &layout, &conduction)?;
        let groups = begin_groups(scene, in_use, (&layout, &masses), &mut state)?;
        // Large, and all that they said is in the masses and in the state.
        drop((mem::take(&mut scene.nodes), mem::take(&mut scene.pairs)));
        let elements = mem::take(&mut scene.elements);
        let loads = mem::replace(&mut scene.loads, Loads::none());
        let parts = Parts {
            scheme: in_use,
            masses: &masses,
            elements: &elements,
            layout: &layout,
            conduction: &conduction,
            loads: &loads,
        };
        let stepper = Stepper::new(groups, systems, parts, &state);
        let automatic = (scheme == Scheme::Auto)
            .then(|| Box::new(Automatic::new(elements, is_second, scene.memory_limit)));
        if automatic.is_none() {
            layout.forget_places();
        }
        let mut run = Self {
            scene: scene.lineage.clone(),
            scheme,
            in_use,
            automatic,
            step,
            masses,
            places,
            shapes,
            layout,
            conduction,
            loads,
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
        if run.automatic.is_some() {
            run.go_on_with(Some(run.new_control(Tolerance::default())));
        }
        Ok(run)
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
            shorter: None,
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

    /// The scheme of the next step; it differs from [`scheme`](Self::scheme) for [`Scheme::Auto`].
    #[must_use]
    pub const fn scheme_in_use(&self) -> Scheme {
        self.in_use
    }

    /// Number of unknowns of the linear system in a Newton iteration; 0 for the explicit scheme.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.stepper.sets() * self.layout.unknowns
    }

    /// Whether several numbers in one S can go through a step together: in the dense elimination of a
    /// few unknowns, whose pivots are on the diagonal, in a scheme with one set of forces, or in the explicit
    /// one; and with weight for all of them or for none.
    pub(crate) fn suits_lanes(&self) -> bool {
        self.control.is_none()
            && self.stepper.suits_lanes(self.unknowns())
            && self.loads.suit_lanes()
    }
}

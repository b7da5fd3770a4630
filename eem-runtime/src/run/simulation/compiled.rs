//! Simulations in one to three dimensions are compiled with this crate.
//!
//! Generic functions are compiled again in every optimised program that calls them: a program with one material took 30
//! CPU seconds, and 5 without those of `Simulation`; 2 without the groups of `element/group/springs.rs`. So a simulation begins
//! in a function of this crate or, for other dimensions, in one that is compiled where it is used. From there on it is a [`Run`].

use super::start::Outline;
use super::stepper::Stepper;
use super::{Run, Simulation, Stepped};
use crate::algebra::indices;
#[cfg(not(test))]
use crate::element::group::springs::of_dimension;
use crate::scene::Scene;
use crate::scene::plan::Plan;
use crate::scene::refused::RefusedScene;
use crate::step::control::Tolerance;
use crate::step::error::StepError;
use crate::step::newton::StepReport;
use crate::step::scheme::Scheme;

/// The kind of a step.
#[derive(Clone, Copy, Debug)]
pub(super) enum Aim {
    /// To this time, s, or to an earlier one.
    Towards(f64),
    /// The same without a change of the scheme.
    InSchemeTowards(f64),
    /// Of this size, s, after the last step has been undone.
    Again(f64),
}

impl<const D: usize> Simulation<D> {
    /// Checks a scene and prepares it for steps of the size `step`, s, with `scheme`.
    ///
    /// Steps have this size unless [`control_steps`](Self::control_steps) is called. [`Scheme::Auto`] uses step
    /// control from the start, with [`Tolerance::default`](crate::Tolerance::default) unless you set another; `step`
    /// is then the first size to try.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with the scene, its initial state, the scheme or the step, together with the scene.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// scene.mass(2.0, [0.0], [3.0]);
    /// let refused = Simulation::new(scene, Scheme::EemTemperature, -0.1).unwrap_err();
    /// assert_eq!(refused.errors().len(), 1);
    ///
    /// let run = Simulation::new(refused.into_scene(), Scheme::EemTemperature, 0.1)?;
    /// assert_eq!(run.ledger().kinetic_energy, 9.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(scene: Scene<D>, scheme: Scheme, step: f64) -> Result<Self, RefusedScene<D>> {
        Self::of_scene(scene, scheme, (step, None))
    }

    /// The same in the place of an earlier run, and in its memory if that fits. Numbers are written anew, so that the bits are the
    /// same.
    pub(crate) fn new_in(
        slot: &mut Option<Self>,
        scene: Scene<D>,
        scheme: Scheme,
        step: f64,
    ) -> Result<&mut Self, RefusedScene<D>> {
        begin_of()(slot, scene, scheme, (step, None))
    }

    fn of_scene(
        scene: Scene<D>,
        scheme: Scheme,
        steps: (f64, Option<Tolerance>),
    ) -> Result<Self, RefusedScene<D>> {
        let mut slot = None;
        begin_of()(&mut slot, scene, scheme, steps)?;
        Ok(slot.unwrap_or_else(|| unreachable!("it has begun")))
    }

    /// Checks a scene and prepares it for steps that a tolerance [controls](Self::control_steps). The first step follows from
    /// the scene: it is `r^(1/p)/ω` with the relative tolerance r, the order p of the scheme and the rate ω of the fastest
    /// vibration, damper or path of heat; `r^(1/p)` s where nothing has a rate. If it is too long it is repeated, and if it is
    /// too short the second one may be 10⁴ times as long.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new) and [`control_steps`](Self::control_steps), together with the scene.
    ///
    /// ```
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// // At rest, pushed by 5 t² N.
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [0.0])];
    /// scene.spring(Hooke { stiffness: 100.0, natural_length: 1.0 }, ends);
    /// scene.force(ends[1], |t| [5.0 * t * t]);
    /// let mut run = Simulation::with_tolerance(scene, Scheme::EemEntropy4, Tolerance::new(1e-6))?;
    /// run.run_until(2.0)?;
    ///
    /// // x = 5 (t² − 2 (1 − cos ωt)/ω²)/k
    /// let exact = 1.0 + 0.05 * (4.0 - 0.02 * (1.0 - 20.0_f64.cos()));
    /// assert!((run.position(ends[1])?[0] - exact).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_tolerance(
        scene: Scene<D>,
        scheme: Scheme,
        tolerance: Tolerance,
    ) -> Result<Self, RefusedScene<D>> {
        // The first step is found in the scene; 1 s until then.
        Self::of_scene(scene, scheme, (1.0, Some(tolerance)))
    }

    /// Makes one step of the present size, or of the size that [step control](Self::control_steps) chooses.
    ///
    /// # Errors
    ///
    /// [`StepError`] if there is no new state, or Newton's method does not find it. The simulation is unchanged
    /// then.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(2.0, [0.0], [3.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.5)?;
    /// let report = run.step()?;
    /// assert_eq!((report.time, run.position(mass)?[0]), (0.5, 1.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step(&mut self) -> Result<StepReport, StepError> {
        self.run.advance(Aim::Towards(f64::INFINITY))?;
        Ok(self.run.report)
    }
}

impl Run {
    /// Makes one step, whose report is in the run.
    pub(super) fn advance(&mut self, aim: Aim) -> Stepped {
        self.begin_meters();
        let made = match aim {
            Aim::Towards(end) | Aim::InSchemeTowards(end) if self.control.is_none() => {
                self.step_of_fixed_size(end)
            }
            Aim::Towards(end) => self.step_towards(end, true),
            Aim::InSchemeTowards(end) => self.step_towards(end, false),
            Aim::Again(size) => self.step_again(size),
        };
        self.unresolved.last = 0;
        made?;
        if self.report.unresolved > 0 {
            self.note_unresolved();
        }
        Ok(())
    }
}

/// See [`begin`](Simulation::begin).
type Begin<const D: usize> = fn(
    &mut Option<Simulation<D>>,
    Scene<D>,
    Scheme,
    (f64, Option<Tolerance>),
) -> Result<&mut Simulation<D>, RefusedScene<D>>;

/// Not for the unit tests of this crate, which run no simulation: everything behind a `static` is compiled.
#[cfg(not(test))]
static LINE: Begin<1> = Simulation::begin;
#[cfg(not(test))]
static PLANE: Begin<2> = Simulation::begin;
#[cfg(not(test))]
static SPACE: Begin<3> = Simulation::begin;

/// The function of this crate if it has one. A branch that a constant rules out is not compiled.
#[inline]
fn begin_of<const D: usize>() -> Begin<D> {
    #[cfg(not(test))]
    if const { 1 <= D && D <= 3 } {
        return *of_dimension(D, [&LINE, &PLANE, &SPACE]);
    }
    Simulation::begin
}

impl<const D: usize> Simulation<D> {
    /// Whether another run can begin in the memory of this one: its scene is small and has neither solids nor loads but gravity.
    pub(crate) fn is_reusable(&self) -> bool {
        let Stepper::Newton(newton) = self.stepper() else {
            return false;
        };
        let is_small = newton.solver.is_renewable() && !self.run.masses.are_coupled();
        is_small && self.run.loads.are_at_most_weight()
    }
}

impl Run {
    /// Whether a scene with this outline, stepped by this scheme, differs from that of this run in numbers only.
    pub(super) fn fits(&self, scene: &Plan, outline: &Outline, scheme: Scheme) -> bool {
        let masses = &outline.masses;
        let are_alike = scheme == self.in_use
            && !masses.are_coupled()
            && scene.loads.are_at_most_weight()
            && scene.loads.have_weight() == self.loads.have_weight()
            && masses.anchors().eq(self.masses.anchors())
            && masses.len() == self.masses.len()
            && (&outline.places, &outline.shapes) == (&self.places, &self.shapes)
            && outline.conduction.joins_like(&self.conduction);
        if !are_alike {
            return false;
        }
        for (&place, entry) in self.places.iter().zip(&scene.entries.elements) {
            if !are_same(self.stepper.nodes(indices(place)), &entry.nodes) {
                return false;
            }
        }
        true
    }
}

/// Whether stored indices of nodes are these.
fn are_same(stored: &[u32], nodes: &[usize]) -> bool {
    let mut both = stored.iter().zip(nodes);
    stored.len() == nodes.len() && both.all(|(&own, &node)| own as usize == node)
}

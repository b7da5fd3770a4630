//! What a run calls: its stepper, whatever the dimension.

use core::any::Any;
use core::mem;

use super::stepper::{Memory, Stepper, each, evaluate_loads};
use crate::algebra::memory::{MemoryLimit, TooLarge};
use crate::element::group::{ElementTotals, Elements, Group, Misfit, Stiffness};
use crate::element::handle::Element;
use crate::element::layout::Slots;
use crate::element::state::State;
use crate::step::control::{Tolerance, Unknown};
use crate::step::error::StepFailure;
use crate::step::explicit::{Demand, SavedExplicit, Site, View};
use crate::step::outcome::Attempt;
use crate::step::scheme::Scheme;
use crate::step::solver::{Effort, SavedPast};
use eem_material::number::digest::Digest;

/// A [`Stepper`] of some dimension, with which a run is compiled once and not for each dimension.
pub(super) trait Stepping: Any + Send + Sync {
    /// Writes the state after a step. It is rejected if the scheme estimates its error and that is not within the demand.
    fn step(
        &mut self,
        start: &View<'_>,
        demand: Demand,
        effort: &mut Effort,
        next: &mut State,
    ) -> Result<Attempt, StepFailure>;

    /// Evaluates the loads of a step of an implicit scheme.
    fn evaluate_loads(&mut self, start: &View<'_>, scheme: Scheme) -> Result<(), StepFailure>;

    /// The unknown of an explicit scheme with the largest error in a step that was rejected, and what is allowed.
    fn worst_error(
        &mut self,
        start: &View<'_>,
        tolerance: &Tolerance,
        next: &mut State,
    ) -> Option<(Unknown, [f64; 2])>;

    /// A step relative to the limit of stability of an explicit scheme.
    fn share_of_stable_step(&mut self, start: &View<'_>) -> Option<f64>;

    /// Whether an explicit scheme closes defects of energy by motion before heat.
    fn is_motion_first(&self) -> Option<bool>;

    fn set_motion_first(&mut self, is_motion_first: bool);

    /// Makes an explicit scheme evaluate everything in a state anew.
    fn forget(&mut self, state: &mut State);

    /// Takes another scheme for the present state, unless there is no memory for it.
    fn change(
        &mut self,
        scheme: Scheme,
        site: Site<'_>,
        limit: MemoryLimit,
        state: &mut State,
    ) -> Result<(), TooLarge>;

    /// How often all elements have been evaluated, at all stages.
    fn evaluations(&self) -> u64;

    /// The history on which the step from this state depends.
    fn past(&self, state: &State) -> (SavedPast, Option<SavedExplicit>);

    /// Overwrites a saved history of Newton's method.
    fn save_past_to(&self, past: &mut SavedPast);

    /// Continues from a saved history.
    fn restore(&mut self, past: &SavedPast, saved: Option<&SavedExplicit>);

    /// Undoes the effect of the last step on the history.
    fn undo(&mut self);

    /// Number of groups.
    fn groups(&self) -> usize;

    /// A group.
    fn elements(&self, group: usize) -> &dyn Elements;
}

impl dyn Stepping {
    /// The stepper of this dimension.
    pub(super) fn of<const D: usize>(&self) -> &Stepper<D> {
        let stepper = (self as &dyn Any).downcast_ref();
        stepper.unwrap_or_else(|| unreachable!("a run has one dimension"))
    }

    pub(super) fn of_mut<const D: usize>(&mut self) -> &mut Stepper<D> {
        let stepper = (self as &mut dyn Any).downcast_mut();
        stepper.unwrap_or_else(|| unreachable!("a run has one dimension"))
    }
}

/// All elements; one of them has the index of its group and its place there.
impl dyn Stepping {
    /// All groups.
    pub(super) fn all(&self) -> impl Iterator<Item = &dyn Elements> {
        (0..self.groups()).map(|group| self.elements(group))
    }

    pub(super) fn slots(&self, [group, place]: [usize; 2]) -> Slots {
        self.elements(group).slots(place)
    }

    pub(super) fn nodes(&self, [group, place]: [usize; 2]) -> &[u32] {
        self.elements(group).nodes(place)
    }

    pub(super) fn handle(&self, [group, place]: [usize; 2]) -> Element {
        self.elements(group).handle(place)
    }

    /// Calls a function with the stiffness of each element.
    pub(super) fn stiffness(&self, state: &State, see: &mut dyn FnMut([usize; 2], Stiffness<'_>)) {
        for (index, group) in self.all().enumerate() {
            let mut place = 0;
            group.stiffness(state, &mut |point| {
                see([index, place], point);
                place += 1;
            });
        }
    }

    pub(super) fn add_totals(&self, state: &State, totals: &mut ElementTotals) {
        for group in self.all() {
            group.add_totals(state, totals);
        }
    }

    pub(super) fn find_energies(&self, state: &mut State) {
        for group in self.all() {
            group.find_energies(state);
        }
    }

    /// Adds all parameters.
    pub(super) fn digest(&self, digest: &mut Digest) {
        for group in self.all() {
            group.digest(digest);
        }
    }

    /// An error unless the elements can be in a state.
    pub(super) fn audit(&self, state: &State) -> Result<(), Misfit> {
        self.all().try_for_each(|group| group.audit(state))
    }
}

impl<const D: usize> Stepping for Stepper<D> {
    fn step(
        &mut self,
        start: &View<'_>,
        demand: Demand,
        effort: &mut Effort,
        next: &mut State,
    ) -> Result<Attempt, StepFailure> {
        match self {
            Self::Newton(newton) => newton.step(start, effort, next),
            Self::Explicit(explicit) => explicit.step(start, demand, next),
        }
    }

    fn evaluate_loads(&mut self, start: &View<'_>, scheme: Scheme) -> Result<(), StepFailure> {
        match self {
            Self::Newton(newton) => {
                evaluate_loads((&mut newton.loads, &mut newton.stages), start, scheme)
            }
            Self::Explicit(_) => Ok(()),
        }
    }

    fn worst_error(
        &mut self,
        start: &View<'_>,
        tolerance: &Tolerance,
        next: &mut State,
    ) -> Option<(Unknown, [f64; 2])> {
        let worst = self.explicit()?.worst_error(start, tolerance, next);
        worst.ok()?
    }

    fn share_of_stable_step(&mut self, start: &View<'_>) -> Option<f64> {
        Some(self.explicit()?.share_of_stable_step(start))
    }

    fn is_motion_first(&self) -> Option<bool> {
        match self {
            Self::Newton(_) => None,
            Self::Explicit(explicit) => Some(explicit.is_motion_first()),
        }
    }

    fn set_motion_first(&mut self, is_motion_first: bool) {
        if let Some(explicit) = self.explicit() {
            explicit.set_motion_first(is_motion_first);
        }
    }

    fn forget(&mut self, state: &mut State) {
        if let Some(explicit) = self.explicit() {
            explicit.forget();
            // As after a restart.
            let own: &dyn Stepping = self;
            own.find_energies(state);
        }
    }

    fn change(
        &mut self,
        scheme: Scheme,
        site: Site<'_>,
        limit: MemoryLimit,
        state: &mut State,
    ) -> Result<(), TooLarge> {
        let memory = Memory::new(scheme, site, limit)?;
        let elements = match self {
            Self::Newton(newton) => each(mem::take(&mut newton.groups), Group::into_loose),
            Self::Explicit(explicit) => explicit.take_elements(),
        };
        let stepper = Self::new(
            elements,
            memory,
            (scheme, site),
            state,
            &mut |state, all| {
                // As after a restart: each scheme evaluates energies in its own way.
                for group in all {
                    group.find_energies(state);
                }
                Ok(())
            },
        );
        *self = stepper.unwrap_or_else(|_| unreachable!("nothing was checked"));
        Ok(())
    }

    fn evaluations(&self) -> u64 {
        match self {
            Self::Newton(newton) => {
                let stages = u64::try_from(newton.stages.len().max(1)).unwrap_or(u64::MAX);
                newton.solver.evaluations().saturating_mul(stages)
            }
            Self::Explicit(explicit) => explicit.evaluations(),
        }
    }

    fn past(&self, state: &State) -> (SavedPast, Option<SavedExplicit>) {
        match self {
            Self::Newton(newton) => (newton.solver.past(), None),
            Self::Explicit(explicit) => (SavedPast::none(), Some(explicit.save(state))),
        }
    }

    fn save_past_to(&self, past: &mut SavedPast) {
        if let Self::Newton(newton) = self {
            newton.solver.save_past_to(past);
        }
    }

    fn restore(&mut self, past: &SavedPast, saved: Option<&SavedExplicit>) {
        match self {
            Self::Newton(newton) => newton.solver.restore(past),
            Self::Explicit(explicit) => match saved {
                Some(saved) => explicit.restore(saved),
                None => explicit.forget(),
            },
        }
    }

    fn undo(&mut self) {
        match self {
            Self::Newton(newton) => newton.solver.undo(),
            Self::Explicit(explicit) => explicit.undo(),
        }
    }

    fn groups(&self) -> usize {
        match self {
            Self::Newton(newton) => newton.groups.len(),
            Self::Explicit(explicit) => explicit.groups(),
        }
    }

    fn elements(&self, group: usize) -> &dyn Elements {
        match self {
            Self::Newton(newton) => newton.groups[group].elements(),
            Self::Explicit(explicit) => explicit.elements(group),
        }
    }
}

//! The initial guess of Newton's method.
//!
//! ```text
//! q¹ = q⁰ + (h/m)(p⁰ + ½h F)      F: the mean force of the step, predicted from those of the last ones
//! ```

use core::ops::Range;

use super::balance::Balance;
use super::{Search, Solver};
use crate::algebra::{combined, scaled, vector};
use crate::element::group::{Old, StepView, points};
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::step::error::StepFailure;
use crate::step::solver::past::SavedPast;

/// The initial guess of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Start {
    /// The usual one of the scheme: predicted motion and internal variables, or the old state.
    Predicted,
    /// Predicted motion, old internal variables.
    Motion,
    /// The old state.
    Rest,
    /// The old state, with temperatures corrected by factors.
    RestByFactors,
}

impl<const D: usize> Search<'_, D> {
    /// Starts at the old state, or at a predicted motion if the scheme uses one.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "a step calls it in one place, but states at rest in another"
    )]
    pub(super) fn begin(&mut self, start: Start) -> Result<(), StepFailure> {
        let (solver, view) = (&mut *self.solver, self.view);
        for (node, force) in solver.old_force.iter_mut().enumerate() {
            *force = scaled(-1.0, &view.loads.total_force(node));
        }
        solver.lengths.fill(f64::MAX);
        let mut old = Old {
            force: &mut solver.old_force,
            lengths: &mut solver.lengths,
            before: match start {
                Start::Predicted => solver.past.history.before(view.step),
                Start::Motion | Start::Rest | Start::RestByFactors => None,
            },
            by_factors: start == Start::RestByFactors,
        };
        for group in &mut *self.groups {
            group.begin(view, &mut old)?;
        }
        solver.place_moved_anchors(view);
        if !solver.coupling.is_none() {
            solver.coupling.drive(solver.scheme.tableau(), view);
        }
        solver.start(view, start);
        Ok(())
    }
}

impl<const D: usize> Solver<D> {
    /// Sets inertia and impulses that do not change during the step.
    pub(super) fn weigh(&mut self, view: &StepView<'_>) {
        let rule = self.scheme.tableau();
        for node in &mut self.nodes {
            let force = force_of_set(rule, node, (&self.old_force, view));
            node.weigh(view, &self.sets[node.set as usize], force);
        }
    }

    /// How many nodes move.
    pub(super) fn moving(&self) -> usize {
        self.nodes.len() / self.sets.len()
    }

    /// The indices of the nodes of a set of unknowns in `nodes`.
    pub(super) fn range_of_set(&self, set: usize) -> Range<usize> {
        set * self.moving()..(set + 1) * self.moving()
    }

    /// The nodes of a set of unknowns.
    pub(super) fn nodes_of_set(&self, set: usize) -> &[Balance<D>] {
        &self.nodes[self.range_of_set(set)]
    }

    /// The inertia of 1 kg in the rows of each set: 2/h with one set, 1/s.
    #[inline]
    pub(super) fn inertias(&self, view: &StepView<'_>) -> [f64; MOST_SETS] {
        let mut inertias = [0.0; MOST_SETS];
        for (inertia, set) in inertias.iter_mut().zip(&self.sets) {
            *inertia = set.inertia * view.per_step;
        }
        inertias
    }

    /// Sets moved anchors to their positions at the end of the step, or at the stage of each set.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Search::begin`")]
    fn place_moved_anchors(&mut self, view: &StepView<'_>) {
        for set in 0..self.sets.len() {
            let first = self.trial.first_of_set(set);
            for &node in &view.loads.moved {
                self.trial.displacements[first + node] = if view.phase.moves() {
                    motion_in_set(self.scheme.tableau(), set, node, view)
                } else {
                    [0.0; D]
                };
            }
        }
    }

    /// Sets moving nodes to their predicted positions, and interface temperatures to the old ones.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Search::begin`")]
    fn start(&mut self, view: &StepView<'_>, start: Start) {
        let is_coupled = !self.coupling.is_none();
        let momenta = points::<D>(view.state.momenta.values());
        let (values, right, solution) = self.tangent.renew();
        for interface in &self.interfaces {
            let theta = view.state.temperatures[interface.slot];
            self.trial.interface.set(interface.in_trial, theta);
            (right[interface.row], solution[interface.row]) = ([0.0], [0.0]);
        }
        let is_at_rest = matches!(start, Start::Rest | Start::RestByFactors);
        let is_predicted = !is_at_rest && view.phase.moves() && !self.scheme.is_classical();
        let half_step = 0.5 * view.step;
        let predictor = self.past.history.predictor();
        let rule = self.scheme.tableau();
        for node in &mut self.nodes {
            let set = &self.sets[node.set as usize];
            let force = force_of_set(rule, node, (&self.old_force, view));
            node.weigh(view, set, force);
            node.per_length = inverse_length(self.lengths[node.node]);
            let mut displacement = [0.0; D];
            if is_predicted && is_coupled {
                displacement = node.flight;
            } else if is_predicted {
                let mobility = set.time * view.step * node.per_mass;
                let momentum = &momenta[node.node];
                let force = self.past.predicted(predictor, node.node);
                displacement = vector(|axis| mobility * (momentum[axis] + half_step * force[axis]));
            }
            // The displacement from the old state is the first correction.
            *node.rows_mut(solution) = displacement;
            self.trial.displacements[node.in_trial] = displacement;
            self.trial.carries[node.in_trial] = [0.0; D];
            node.balance([&displacement, &[0.0; D]], values, right);
        }
        self.couple(view);
    }

    /// Adds the inertia of masses that couple nodes to the system of an iteration.
    #[inline]
    pub(super) fn couple(&mut self, view: &StepView<'_>) {
        if !self.coupling.is_none() {
            self.couple_sets(view);
        }
    }

    #[inline(never)]
    fn couple_sets(&mut self, view: &StepView<'_>) {
        let inertias = self.inertias(view);
        for (set, &inertia) in inertias.iter().enumerate().take(self.sets.len()) {
            self.find_factors(set);
            let first = self.nodes_of_set(set).first().map_or(0, Balance::row);
            let (values, right) = self.tangent.parts();
            let right = &mut right.as_flattened_mut()[first..];
            self.coupling.balance::<D>(set, inertia, values, right);
        }
    }

    /// Prepares the impulses of the displacements beyond flight in a set, where masses couple nodes.
    pub(super) fn find_factors(&mut self, set: usize) {
        let nodes = &self.nodes[self.range_of_set(set)];
        let factors = self.coupling.factors.as_chunks_mut::<D>().0;
        for (node, factors) in nodes.iter().zip(factors.chunks_exact_mut(2)) {
            let [moved, _] = node.moved(&self.trial);
            factors[0] = node.change(&self.trial);
            factors[1] = vector(|axis| moved[axis].abs());
        }
    }

    /// Removes the last step from the history of the predictor.
    pub(crate) fn undo(&mut self) {
        if !self.scheme.is_classical() {
            self.past.history.forget();
        }
    }

    /// The history on which the initial guess of the next step depends.
    pub(crate) fn past(&self) -> SavedPast {
        match self.stages {
            None => self.past.save(),
            Some(_) => SavedPast::none(),
        }
    }

    /// Saves the history into an earlier one, without allocation.
    pub(crate) fn save_past_to(&self, past: &mut SavedPast) {
        if self.stages.is_none() {
            self.past.save_to(past);
        }
    }

    /// Restores a saved history.
    pub(crate) fn restore(&mut self, past: &SavedPast) {
        if self.stages.is_none() {
            self.past.restore(past);
        }
    }
}

/// The reciprocal of a unit of length, 1/m; 1 for a node without elements, whose unit is given as `f64::MAX`.
#[inline]
fn inverse_length(length: f64) -> f64 {
    #[expect(clippy::float_cmp, reason = "a mark, not a length")]
    if length == f64::MAX {
        1.0
    } else {
        length.recip()
    }
}

/// The displacement of a moved anchor from the old state to the stage of a set, m.
fn motion_in_set<const D: usize>(
    rule: Option<&Tableau>,
    set: usize,
    node: usize,
    view: &StepView<'_>,
) -> [f64; D] {
    let Some(rule) = rule else {
        return view.loads.motion(node);
    };
    match rule.path {
        None => view.stages[rule.stage_of(set)].motion(node),
        Some(path) => {
            let motions = view.stages.iter().map(|support| support.motion(node));
            combined(path.supports.to_stages[set], motions)
        }
    }
}

/// The part of the force on a node that does not change during a step, in the rows of its set of unknowns.
#[inline]
fn force_of_set<const D: usize>(
    rule: Option<&Tableau>,
    of: &Balance<D>,
    (old, view): (&[[f64; D]], &StepView<'_>),
) -> [f64; D] {
    let Some(rule) = rule else {
        return old_force(old, of.node);
    };
    let loads = view.stages.iter();
    let forces = loads.map(|loads| scaled(-1.0, &loads.total_force(of.node)));
    combined(rule.positions[of.set as usize], forces)
}

/// The part of the force on a node that depends on the old state and the loads only, N.
#[inline]
pub(super) fn old_force<const D: usize>(forces: &[[f64; D]], node: usize) -> [f64; D] {
    forces.get(node).copied().unwrap_or([0.0; D])
}

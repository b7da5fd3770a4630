//! The end of a step through stages: positions and momenta from the forces at the stages.

use crate::algebra::{combined, difference, scaled};
use crate::element::group::{Along, StepView, points};
use crate::element::impulse::Impulses;
use crate::element::state::State;
use crate::element::tableau::Ending;
use crate::element::tally::Tally;
use crate::step::certificate::{Motion, NodeStep, Speeds};
use crate::step::error::StepFailure;
use crate::step::solver::closing::masses::move_node;
use crate::step::solver::stages::Stages;
use crate::step::solver::{Search, Solver};
use eem_material::number::compensated::Sum;

impl<const D: usize> Search<'_, D> {
    /// New positions and momenta, all finite, and the work of loads and supports.
    pub(super) fn move_through_stages(
        &mut self,
        next: &mut State,
        (motion, tally): (&mut Motion<D>, &mut Tally),
    ) -> Result<(), StepFailure> {
        let Some(mut stages) = self.solver.stages.take() else {
            return Ok(());
        };
        let found = self.find_stages(&mut stages);
        let (solver, view) = (&mut *self.solver, self.view);
        let moved = found.and_then(|()| match stages.rule.ending {
            Ending::Increments {
                displacements,
                impulses,
            } => {
                solver.judge_stages(&stages, view, (&mut *motion, &mut *tally));
                let weights = [displacements, impulses];
                solver.move_along_path(&mut stages, weights, view, next, (&mut *motion, tally))
            }
            Ending::StageByStage | Ending::Forces(_) => {
                solver.move_to_end(&stages, view, next, motion)
            }
        });
        solver.stages = Some(stages);
        moved?;
        solver.move_supports(view, next, motion);
        motion.work(next.work.change(view.state.work));
        Ok(())
    }

    /// Finds the impulses of all stages.
    fn find_stages(&mut self, stages: &mut Stages<D>) -> Result<(), StepFailure> {
        let (rule, view) = (stages.rule, self.view);
        for stage in 0..rule.stages() {
            if matches!(rule.ending, Ending::StageByStage)
                && let Some(set) = rule.set_of(stage)
            {
                if rule.positions[set][stage] == 0.0 {
                    self.solver.move_to_stage(stages, view, set);
                } else {
                    self.solve_for_stage(stages, set)?;
                }
            }
            let solver = &mut *self.solver;
            let mut impulses = Impulses::new(&mut stages.impulses, stage);
            for (node, impulse) in impulses.iter_mut().enumerate() {
                *impulse = scaled(view.step, &view.stages[stage].total_force(node));
            }
            let (along, magnitudes) = (Along::Stage(stage), &mut solver.magnitudes);
            for group in &mut *self.groups {
                group.add_impulse(view, &solver.trial, along, &mut impulses, magnitudes);
            }
            (solver.rockets).add_impulses((stage, view.step), &mut impulses, magnitudes);
        }
        Ok(())
    }

    /// `(m/(ch) + h w A)(q_i − q⁰) = p⁰ + Σ_{j<i} w_j h G_j + h w (load − A q⁰)`, where `A q_i` is the force found
    /// at the stage.
    fn solve_for_stage(&mut self, stages: &mut Stages<D>, set: usize) -> Result<(), StepFailure> {
        let Some(mut secant) = stages.secant.take() else {
            return Ok(());
        };
        let (solver, view) = (&mut *self.solver, self.view);
        secant.clear();
        for group in &mut *self.groups {
            group.add_secant(set, view, &solver.trial, &mut secant);
        }
        let own = stages.rule.stage_of(set);
        let (before, weights) = stages.rule.positions[set].split_at(own);
        let weight = view.step * weights[0];
        let momenta = points::<D>(view.state.momenta.values());
        let inertia = solver.inertias(view)[set];
        let (values, right) = secant.parts();
        for (mass, right) in solver.nodes_of_set(set).iter().zip(right) {
            values[mass.secant_diagonal as usize] += inertia * mass.mass;
            let impulse = stages.combined(mass.node, before);
            let load = view.stages[own].total_force::<D>(mass.node);
            for (axis, right) in right.iter_mut().enumerate() {
                *right += momenta[mass.node][axis] + impulse[axis] + weight * load[axis];
            }
        }
        let solved = secant.solve();
        if solved.is_ok() {
            for (at, &displacement) in solver.range_of_set(set).zip(secant.solution()) {
                solver.place(solver.nodes[at].in_trial, displacement);
            }
        }
        stages.secant = Some(secant);
        Ok(solved?)
    }
}

impl<const D: usize> Solver<D> {
    /// `q_i − q⁰ = c (h/m)(p⁰ + Σ_j w_j h G_j)` with the total forces G of the stages before.
    fn move_to_stage(&mut self, stages: &Stages<D>, view: &StepView<'_>, set: usize) {
        let weights = stages.rule.positions[set];
        let time = self.sets[set].time * view.step;
        let momenta = points::<D>(view.state.momenta.values());
        for at in self.range_of_set(set) {
            let mass = &self.nodes[at];
            let impulse = stages.combined(mass.node, weights);
            let displacement = mass.displacement(time, &momenta[mass.node], &impulse);
            self.place(mass.in_trial, displacement);
        }
    }

    /// Sets the displacement of a node in a set.
    fn place(&mut self, in_trial: usize, displacement: [f64; D]) {
        self.trial.displacements[in_trial] = displacement;
        self.trial.carries[in_trial] = [0.0; D];
    }

    fn move_to_end(
        &self,
        stages: &Stages<D>,
        view: &StepView<'_>,
        next: &mut State,
        motion: &mut Motion<D>,
    ) -> Result<(), StepFailure> {
        let (rule, momenta) = (stages.rule, points::<D>(view.state.momenta.values()));
        let last = self.trial.displacements_of_set(rule.sets() - 1);
        for mass in self.nodes_of_set(0) {
            let node = mass.node;
            let displacement = &match rule.ending {
                Ending::Forces(weights) => {
                    let impulse = stages.combined(node, weights);
                    mass.displacement(view.step, &momenta[node], &impulse)
                }
                Ending::StageByStage | Ending::Increments { .. } => last[node],
            };
            let impulse = stages.combined(node, rule.weights);
            let moved = [displacement, &[0.0; D], &impulse];
            move_node(node, moved, view.state, next)?;
            let load = |stage: usize| view.stages[stage].force(node);
            self.add_work(stages, node, &load, &mut next.work);
            let speeds = Speeds::OfMass(mass.per_mass);
            let moved = NodeStep::new((view.state, node), speeds, displacement, &impulse);
            let weight = weight_of(view, node);
            motion.see(&moved, Some(&weight), view.step);
        }
        Ok(())
    }

    /// Adds `h Σ b_i f_i·v_i` of a node, with the velocities that the rule gives to the stages, J.
    pub(super) fn add_work(
        &self,
        stages: &Stages<D>,
        node: usize,
        force: &dyn Fn(usize) -> [f64; D],
        work: &mut Sum,
    ) {
        let mut sums = [0.0; D];
        let rule = stages.rule;
        for (stage, (&weight, shares)) in rule.weights.iter().zip(rule.motion).enumerate() {
            let moved = (0..).map(|set| self.trial.displacements_of_set(set)[node]);
            let (force, motion) = (force(stage), combined(shares, moved));
            for axis in 0..D {
                sums[axis] += weight * force[axis] * motion[axis];
            }
        }
        for sum in sums {
            work.add(sum);
        }
    }
}

/// The weight of a node in a step through stages, N.
pub(super) fn weight_of<const D: usize>(view: &StepView<'_>, node: usize) -> [f64; D] {
    let loads = &view.stages[0];
    difference(&loads.total_force(node), &loads.force(node))
}

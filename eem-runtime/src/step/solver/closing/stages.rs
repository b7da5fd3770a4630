//! The end of a step through stages: positions and momenta from the forces at the stages.

use crate::algebra::{scaled, vector};
use crate::element::group::{Along, Group, StepView, points};
use crate::element::impulse::Impulses;
use crate::element::state::State;
use crate::element::tableau::Ending;
use crate::element::tally::Tally;
use crate::step::certificate::{Motion, NodeStep, Speeds};
use crate::step::error::StepFailure;
use crate::step::solver::Solver;
use crate::step::solver::closing::masses::move_node;
use crate::step::solver::stages::Stages;

impl<const D: usize> Solver<D> {
    /// New positions and momenta, all finite, and the work of loads and supports.
    pub(super) fn move_through_stages(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        next: &mut State,
        (motion, tally): (&mut Motion<D>, &mut Tally),
    ) -> Result<(), StepFailure> {
        let Some(mut stages) = self.stages.take() else {
            return Ok(());
        };
        let found = self.find_stages(&mut stages, groups, view);
        let moved = found.and_then(|()| match stages.rule.ending {
            Ending::Increments {
                displacements,
                impulses,
            } => {
                self.judge_stages(&stages, view, (&mut *motion, &mut *tally));
                let weights = [displacements, impulses];
                self.move_along_path(&mut stages, weights, view, next, (&mut *motion, tally))
            }
            Ending::StageByStage | Ending::Forces(_) => {
                self.move_to_end(&stages, view, next, motion)
            }
        });
        self.stages = Some(stages);
        moved?;
        self.move_supports(view, next, motion);
        motion.work(next.work.change(view.state.work));
        Ok(())
    }

    /// Finds the impulses of all stages and, except along paths, the displacements at the end of the step.
    fn find_stages(
        &mut self,
        stages: &mut Stages<D>,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
    ) -> Result<(), StepFailure> {
        let rule = stages.rule;
        for stage in 0..rule.stages() {
            if matches!(rule.ending, Ending::StageByStage)
                && let Some(set) = rule.set_of(stage)
            {
                if rule.positions[set][stage] == 0.0 {
                    self.move_to_stage(stages, view, set);
                } else {
                    self.solve_for_stage(stages, groups, view, set)?;
                }
            }
            let mut impulses = Impulses::new(&mut stages.impulses, stage);
            for (node, impulse) in impulses.iter_mut().enumerate() {
                *impulse = scaled(view.step, &view.stages[stage].total_force(node));
            }
            for group in groups.iter_mut() {
                let along = Along::Stage(stage);
                let magnitudes = &mut self.magnitudes;
                group.add_impulse(view, &self.trial, along, &mut impulses, magnitudes);
            }
            let at = (stage, view.step);
            (self.rockets).add_impulses(at, &mut impulses, &mut self.magnitudes);
        }
        let momenta = points::<D>(view.state.momenta.values());
        for mass in self.nodes_of_set(0).iter().map(|node| &node.place) {
            let node = mass.node();
            stages.ends[node] = match rule.ending {
                Ending::StageByStage => self.trial.displacements_of_set(rule.sets() - 1)[node],
                Ending::Forces(weights) => {
                    let (impulse, mobility) =
                        (stages.combined(node, weights), view.step * mass.per_mass);
                    vector(|axis| mobility * (momenta[node][axis] + impulse[axis]))
                }
                // `move_along_path` finds the displacements from those of the stages.
                Ending::Increments { .. } => break,
            };
        }
        Ok(())
    }

    /// `q_i − q⁰ = c (h/m)(p⁰ + Σ_j w_j h G_j)` with the total forces G of the stages before.
    fn move_to_stage(&mut self, stages: &Stages<D>, view: &StepView<'_>, set: usize) {
        let weights = stages.rule.positions[set];
        let time = self.sets[set].time;
        let momenta = points::<D>(view.state.momenta.values());
        for at in self.range_of_set(set) {
            let mass = self.nodes[at].place;
            let (momentum, impulse) =
                (&momenta[mass.node()], stages.combined(mass.node(), weights));
            let mobility = time * view.step * mass.per_mass;
            let displacement = vector(|axis| mobility * (momentum[axis] + impulse[axis]));
            self.place(mass.in_trial(), displacement);
        }
    }

    /// `(m/(ch) + h w A)(q_i − q⁰) = p⁰ + Σ_{j<i} w_j h G_j + h w (load − A q⁰)`, where `A q_i` is the force found
    /// at the stage.
    fn solve_for_stage(
        &mut self,
        stages: &mut Stages<D>,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        set: usize,
    ) -> Result<(), StepFailure> {
        let Some(mut secant) = stages.secant.take() else {
            return Ok(());
        };
        secant.clear();
        for group in groups.iter_mut() {
            group.add_secant(set, view, &self.trial, &mut secant);
        }
        let rule = stages.rule;
        let own = rule.stage_of(set);
        let (before, weight) = (
            &rule.positions[set][..own],
            view.step * rule.positions[set][own],
        );
        let momenta = points::<D>(view.state.momenta.values());
        let inertia = self.inertias(view)[set];
        let nodes = self.nodes_of_set(set);
        let (values, right) = secant.parts();
        for (mass, right) in nodes.iter().map(|node| &node.place).zip(right) {
            values[mass.secant_diagonal()] += inertia * mass.mass;
            let node = mass.node();
            let impulse = stages.combined(node, before);
            let load = view.stages[own].total_force::<D>(node);
            for (axis, right) in right.iter_mut().enumerate() {
                *right += momenta[node][axis] + impulse[axis] + weight * load[axis];
            }
        }
        let solved = secant.solve();
        if solved.is_ok() {
            for (at, &displacement) in self.range_of_set(set).zip(secant.solution()) {
                self.place(self.nodes[at].place.in_trial(), displacement);
            }
        }
        stages.secant = Some(secant);
        solved.map_err(|_| StepFailure::SingularTangent)
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
        let none = [0.0; D];
        for mass in self.nodes_of_set(0).iter().map(|node| &node.place) {
            let node = mass.node();
            let displacement = &stages.ends[node];
            let impulse = stages.combined(node, stages.rule.weights);
            move_node(node, [displacement, &none, &impulse], view.state, next)?;
            for axis in 0..D {
                let load = |stage: usize| view.stages[stage].force::<D>(node)[axis];
                next.work.add(self.work(stages, node, axis, &load));
            }
            let moved = NodeStep {
                speeds: Speeds::OfMass(mass.per_mass),
                position: &points(view.state.positions.values())[node],
                momentum: &points(view.state.momenta.values())[node],
                displacement,
                impulse: &impulse,
            };
            let (total, load) = (
                view.stages[0].total_force::<D>(node),
                view.stages[0].force::<D>(node),
            );
            let weight = vector(|axis| total[axis] - load[axis]);
            motion.see(&moved, Some(&weight), view.step);
        }
        Ok(())
    }

    /// `h Σ b_i f_i v_i` of a coordinate, with the velocities that the rule gives to the stages, J.
    pub(super) fn work(
        &self,
        stages: &Stages<D>,
        node: usize,
        axis: usize,
        force: &dyn Fn(usize) -> f64,
    ) -> f64 {
        let rule = stages.rule;
        let mut work = 0.0;
        for (stage, (&weight, shares)) in rule.weights.iter().zip(rule.motion).enumerate() {
            let mut motion = 0.0;
            for (set, &share) in shares.iter().enumerate() {
                let displacement = self.trial.displacements_of_set(set)[node][axis];
                motion += share * displacement;
            }
            work += weight * force(stage) * motion;
        }
        work
    }
}

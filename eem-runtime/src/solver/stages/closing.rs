//! The end of a step: the new state from the found forces, temperatures and rates of the stages.

use core::array;

use super::StageSolver;
use super::assemble::{inertia, loads};
use crate::certificate::{Care, Certificate, Kept, Motion, NodeStep, Reach, Tally};
use crate::error::StepFailure;
use crate::group::{StageGroup, StageView, points};
use crate::scalar::Real;
use crate::scheme::variational_4;
use crate::solver::closing::{energy_change, move_node};
use crate::state::State;

impl<S: Real, const D: usize> StageSolver<S, D> {
    /// Writes the new state to `next`, from what was found at the stages.
    ///
    /// The forces of the middle are `A q_m`, so that its displacements come from one linear solve;
    /// those of the end and the momenta follow explicitly.
    pub(super) fn close(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        next: &mut State<S>,
    ) -> Result<Certificate<S>, StepFailure> {
        self.find_forces(groups, view, 0);
        self.move_to_middle(groups, view)?;
        self.find_forces(groups, view, 1);
        self.move_to_end(view);
        self.find_forces(groups, view, 2);
        next.copy_books(view.state);
        next.time.add(view.step);
        self.move_masses(view, next)?;
        self.move_anchors(view, next);
        for group in groups.iter_mut() {
            group.close(view, next)?;
        }
        Ok(self.certify(view, next))
    }

    /// What the new state says of the energy; the scheme promises nothing.
    fn certify(&self, view: &StageView<'_, S>, next: &State<S>) -> Certificate<S> {
        let mut motion = Motion::new(Kept::None);
        for mass in &self.masses[1] {
            let node = mass.node();
            let displacement = &self.trial.displacements[1][node];
            let impulse =
                array::from_fn(|axis| next.momenta.change(node * D + axis, &view.state.momenta));
            let moved = NodeStep {
                per_mass: mass.per_mass,
                position: &points(view.state.positions.values())[node],
                momentum: &points(view.state.momenta.values())[node],
                displacement,
                impulse: &impulse,
            };
            let (total, load) = (
                view.loads[0].total_force::<D>(node),
                view.loads[0].force::<D>(node),
            );
            let weight = array::from_fn(|axis| total[axis] - load[axis]);
            motion.see(&moved, Some(&weight), view.step);
        }
        motion.work(next.work.change(view.state.work));
        let internal = energy_change(&view.conduction.reservoirs, [view.state, next]);
        let tally = Tally::new(Care::Quick);
        Certificate::new(&motion, &tally, internal, Reach::none)
    }

    /// New positions and momenta, all finite, and the work of the loads.
    fn move_masses(&self, view: &StageView<'_, S>, next: &mut State<S>) -> Result<(), StepFailure> {
        let weights = variational_4::STEP.map(|weight| view.step * S::from_f64(weight));
        for mass in &self.masses[1] {
            let node = mass.node();
            let mut impulse = [S::zero(); D];
            for (forces, weight) in self.forces.iter().zip(weights) {
                for (impulse, &force) in impulse.iter_mut().zip(&forces[node]) {
                    *impulse += weight * force;
                }
            }
            let displacement = &self.trial.displacements[1][node];
            let none = [S::zero(); D];
            move_node(node, [displacement, &none, &impulse], view.state, next)?;
            let loads = view.loads.each_ref().map(|loads| loads.force::<D>(node));
            for axis in 0..D {
                let load = loads.map(|load| load[axis]);
                let work = self.work(node, axis, |stage| load[stage]);
                next.work.add(work);
            }
        }
        Ok(())
    }

    /// New positions of the anchors that are moved, and the work that this takes.
    fn move_anchors(&self, view: &StageView<'_, S>, next: &mut State<S>) {
        let old = &view.state.positions;
        for &node in &view.loads[0].moved {
            for axis in 0..D {
                let displacement = self.trial.displacements[1][node][axis];
                next.positions.advance(node * D + axis, old, displacement);
                // The support bears the forces of the springs.
                let work = self.work(node, axis, |stage| -self.forces[stage][node][axis]);
                next.work.add(work);
            }
        }
    }

    /// `h Σ b_i f_i v_i` of a coordinate, with the velocities of the quadratic motion, J.
    fn work(&self, node: usize, axis: usize, force: impl Fn(usize) -> S) -> S {
        let displacements = self.trial.displacements.each_ref();
        let [middle, end] = displacements.map(|all| all[node][axis]);
        let stages = variational_4::STEP.iter().zip(variational_4::MOTION);
        let terms = stages.enumerate().map(|(stage, (&weight, motion))| {
            let [by_middle, by_end] = motion.map(S::from_f64);
            S::from_f64(weight) * force(stage) * (by_middle * middle + by_end * end)
        });
        terms.fold(S::zero(), |sum, term| sum + term)
    }

    /// Loads less forces of the elements at a stage, N.
    fn find_forces(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        stage: usize,
    ) {
        for (node, force) in self.forces[stage].iter_mut().enumerate() {
            *force = view.loads[stage].total_force(node);
        }
        for group in groups.iter_mut() {
            group.subtract_forces(stage, &self.trial, &mut self.forces[stage]);
        }
    }

    /// `(2m/h + (h/12) A)(q_m − q⁰) = p⁰ − (h/12)(2F_0 + A q⁰)`, with the loads among the forces.
    fn move_to_middle(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.secant.clear();
        for group in groups.iter_mut() {
            group.add_secant(view, &self.trial, &mut self.secant);
        }
        let momenta = points::<S, D>(view.state.momenta.values());
        let start = view.step * S::from_f64(variational_4::MIDDLE_AND_END[0][0]);
        let (values, right) = self.secant.parts();
        for (mass, right) in self.masses[0].iter().zip(right) {
            values[mass.secant_diagonal()] += inertia(mass.mass, 0, view.step);
            let node = mass.node();
            let loads = loads::<S, D>(view, 0, node);
            let weight = view.loads[0].total_force::<D>(node);
            for (axis, right) in right.iter_mut().enumerate() {
                // The loads of both stages, and the springs of the start.
                let springs = self.forces[0][node][axis] - weight[axis];
                *right += momenta[node][axis] + loads[axis] + start * springs;
            }
        }
        self.secant
            .solve()
            .map_err(|_| StepFailure::SingularTangent)?;
        for at in 0..self.masses[0].len() {
            let mass = self.masses[0][at];
            self.place(view, 0, mass.node(), self.secant.solution()[at]);
        }
        Ok(())
    }

    /// `q¹ − q⁰ = (h/m)(p⁰ + (h/6)(G_0 + 2G_m))` with the total forces G.
    fn move_to_end(&mut self, view: &StageView<'_, S>) {
        let momenta = points::<S, D>(view.state.momenta.values());
        let weights =
            variational_4::MIDDLE_AND_END[1].map(|weight| view.step * S::from_f64(weight));
        for at in 0..self.masses[1].len() {
            let mass = self.masses[1][at];
            let mut displacement = momenta[mass.node()];
            for (forces, weight) in self.forces.iter().zip(weights) {
                for (sum, &force) in displacement.iter_mut().zip(&forces[mass.node()]) {
                    *sum += weight * force;
                }
            }
            let mobility = view.step / mass.mass;
            let displacement = displacement.map(|momentum| mobility * momentum);
            self.place(view, 1, mass.node(), displacement);
        }
    }

    /// Moves a node of the middle or the end.
    fn place(&mut self, view: &StageView<'_, S>, half: usize, node: usize, displacement: [S; D]) {
        let old = &points::<S, D>(view.state.positions.values())[node];
        self.trial.displacements[half][node] = displacement;
        let position = array::from_fn(|axis| old[axis] + displacement[axis]);
        self.trial.positions[1 + half][node] = position;
    }
}

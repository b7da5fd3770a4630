//! The end of a step along the paths of its stages, from the displacements that were found.
//!
//! ```text
//! w_j = u_j − c_j (h/m) p⁰,   q¹ = q⁰ + (h/m) p⁰ + Σ_j displacements_j w_j,   p¹ = p⁰ + (m/h) Σ_j impulses_j w_j
//! ```
//!
//! with the displacements `u_j` of the stages. Forces do not enter, so that stiff forces do not amplify rounding. Their
//! own rounding acts along the arms, and so has no torque on a path that gives positions and momenta at its stages. The
//! residuals of the balances at the stages are judged.
//!
//! The supports of moved anchors do
//!
//! ```text
//! work = h Σ_i b_i (F_i·q̇_i + v_i·ṗ_i),     p = M v of what a solid has at the anchor
//! ```
//!
//! with the forces F of the elements and the motion of the path at the stages, and polynomials for v and p.

use crate::algebra::{add, combined, difference, scaled, vector};
use crate::element::group::StepView;
use crate::element::state::State;
use crate::element::tableau::{MOST_STAGES, Path};
use crate::element::tally::Tally;
use crate::step::certificate::{Motion, NodeStep, Speeds};
use crate::step::error::StepFailure;
use crate::step::newton::Largest;
use crate::step::solver::Solver;
use crate::step::solver::closing::masses::{carry, follow_coupled_masses, move_node};
use crate::step::solver::closing::stages::weight_of;
use crate::step::solver::coupling::find_changes;
use crate::step::solver::stages::Stages;

impl<const D: usize> Solver<D> {
    /// Judges the balances of the nodes at all stages.
    pub(super) fn judge_stages(
        &mut self,
        stages: &Stages<D>,
        view: &StepView<'_>,
        (motion, tally): (&mut Motion<D>, &mut Tally),
    ) {
        let inertias = self.inertias(view);
        let mut largest = Largest::default();
        for (set, weights) in stages.rule.positions.iter().enumerate() {
            let nodes = self.range_of_set(set);
            self.find_factors(set);
            self.coupling.find_impulses(Some(set), inertias[set]);
            for (index, moving) in self.nodes[nodes].iter().enumerate() {
                let node = moving.node;
                let [gained, terms] = (self.coupling).impulse((index, moving), &self.trial);
                let is_single = self.coupling.is_none();
                let terms = if is_single { [0.0; D] } else { terms };
                let impulse = stages.combined(node, weights);
                let residual = difference(&gained, &impulse);
                largest.see_all(&residual);
                let mut magnitude = match self.magnitudes.get(node) {
                    None => 0.0,
                    Some(&magnitude) => {
                        let mut way = [0.0; D];
                        for (other, share) in stages.rule.ways_of_residual(set).enumerate() {
                            let moved = &self.trial.displacements_of_set(other)[node];
                            add(&mut way, share, moved);
                        }
                        motion.fall_short(&residual, &way, view.per_step);
                        magnitude
                    }
                };
                for (&weight, impulse) in weights.iter().zip(&stages.impulses[node]) {
                    for &impulse in impulse {
                        magnitude += (weight * impulse).abs();
                    }
                }
                tally.balance_node(&residual, [&gained, &terms], magnitude);
            }
        }
        self.final_residual = largest.found();
    }

    /// Sets new positions and momenta, all finite, and adds the work of loads.
    pub(super) fn move_along_path(
        &mut self,
        stages: &mut Stages<D>,
        [displacements, impulses]: [&[f64]; 2],
        view: &StepView<'_>,
        next: &mut State,
        (motion, tally): (&mut Motion<D>, &mut Tally),
    ) -> Result<(), StepFailure> {
        self.change_velocities(stages, impulses, view);
        for (index, moving) in self.nodes_of_set(0).iter().enumerate() {
            let node = moving.node;
            let state = view.state;
            // The compensation of rounding of the momentum moves the node, too.
            let (mobility, [rate, carry]) = match stages.changes.get(node) {
                None => (view.step * moving.per_mass, state.momenta.point::<D>(node)),
                Some(_) => (view.step, state.velocities.point::<D>(node)),
            };
            let (flight, mut rest) = (scaled(mobility, rate), scaled(mobility, carry));
            for (&weight, change) in displacements.iter().zip(self.changes(index)) {
                add(&mut rest, weight, &change);
            }
            let coupled = self.coupling.found(index).zip(stages.changes.get(node));
            let (impulse, speeds) = if let Some(([&impulse, _], &change)) = coupled {
                let [&old, _] = state.velocities.point::<D>(node);
                let none = [0.0; D];
                (next.velocities).advance_point(node, &state.velocities, [&change, &none]);
                (impulse, Speeds::Given { old, change })
            } else {
                let gained = combined(impulses, self.changes(index));
                let impulse = scaled(moving.mass * view.per_step, &gained);
                (impulse, Speeds::OfMass(moving.per_mass))
            };
            let displacement = vector(|axis| flight[axis] + rest[axis]);
            move_node(node, [&flight, &rest, &impulse], state, next)?;
            let moved = NodeStep::new((state, node), speeds, &displacement, &impulse);
            motion.see(&moved, None, view.step);
            if !self.magnitudes.is_empty() {
                let terms = self.terms_of_gain(index, impulses, view.per_step);
                tally.force(moved.energy_of_rounding(&terms));
            }
            self.see_loads(stages, view, &moved, node, (next, motion));
        }
        if !stages.changes.is_empty() {
            follow_coupled_masses::<D>(view, next);
        }
        Ok(())
    }

    /// `w_j` of the moving node with this index at all stages, m.
    fn changes(&self, index: usize) -> impl Iterator<Item = [f64; D]> + '_ {
        let sets = 0..self.sets.len();
        sets.map(move |set| self.nodes_of_set(set)[index].change(&self.trial))
    }

    /// `Σ_j |weights_j w_j|/h` of the moving node with this index, m/s.
    #[cold]
    fn terms_of_gain(&self, index: usize, weights: &[f64], per_step: f64) -> [f64; D] {
        let mut terms = [0.0; D];
        for (&weight, change) in weights.iter().zip(self.changes(index)) {
            for axis in 0..D {
                terms[axis] += (weight * change[axis]).abs() * per_step;
            }
        }
        terms
    }

    /// Where masses couple nodes: finds the changes of their velocities, and the impulses that follow.
    fn change_velocities(&mut self, stages: &mut Stages<D>, weights: &[f64], view: &StepView<'_>) {
        if stages.changes.is_empty() {
            return;
        }
        for index in 0..self.moving() {
            let node = self.nodes[index].node;
            let gained = combined(weights, self.changes(index));
            stages.changes[node] = scaled(view.per_step, &gained);
        }
        let factors = self.coupling.factors.as_chunks_mut::<D>().0;
        for (node, factors) in self.nodes.iter().zip(factors.chunks_exact_mut(2)) {
            let change = &stages.changes[node.node];
            (factors[0], factors[1]) = (*change, vector(|axis| change[axis].abs()));
        }
        self.coupling.find_impulses(None, 1.0);
    }

    /// Adds work and impulse of loads and weight on a node in the step.
    fn see_loads(
        &self,
        stages: &Stages<D>,
        view: &StepView<'_>,
        moved: &NodeStep<'_, D>,
        node: usize,
        (next, motion): (&mut State, &mut Motion<D>),
    ) {
        if !view.stages[0].has_total_force() && self.rockets.are_none() {
            return;
        }
        let load = |stage: usize| {
            let force = view.stages[stage].force(node);
            self.rockets.add_to(force, [stage, node])
        };
        self.add_work(stages, node, &load, &mut next.work);
        for (weight, moved) in weight_of::<D>(view, node).iter().zip(moved.displacement) {
            motion.work(weight * moved);
        }
        for (stage, &weight) in stages.rule.weights.iter().enumerate() {
            let total = view.stages[stage].total_force(node);
            let total = self.rockets.add_to(total, [stage, node]);
            let impulse = scaled(view.step * weight, &total);
            let displacement = &self.trial.displacements_of_set(stage)[node];
            motion.push([moved.position, displacement], &impulse);
        }
    }

    /// Sets moved anchors to their new positions, and adds the work of their supports.
    pub(super) fn move_supports(
        &self,
        view: &StepView<'_>,
        next: &mut State,
        motion: &mut Motion<D>,
    ) {
        let Some(stages) = &self.stages else {
            return;
        };
        for &node in &view.loads.moved {
            let (old, displacement) = (&view.state.positions, view.loads.motion(node));
            (next.positions).advance_point(node, old, [&displacement, &[0.0; D]]);
            // The support bears the forces of the elements.
            let support = |stage: usize| scaled(-view.per_step, &stages.impulses[node][stage]);
            self.add_work(stages, node, &support, &mut next.work);
            if let Some(path) = stages.rule.path
                && view.masses.are_coupled()
            {
                self.carry(node, (stages, &path), view, (next, motion));
            }
        }
    }

    /// Moves the mass of a solid at a moved anchor; the support does the work.
    fn carry(
        &self,
        node: usize,
        (stages, path): (&Stages<D>, &Path),
        view: &StepView<'_>,
        (next, motion): (&mut State, &mut Motion<D>),
    ) {
        let [&old, _] = view.state.velocities.point::<D>(node);
        let changes = changes_at_stages::<D>(path, node, view);
        let impulses = self.impulses_at_stages(node, (stages, path), view);
        for (stage, &weight) in stages.rule.weights.iter().enumerate() {
            for axis in 0..D {
                let speed = old[axis] + changes[stage][axis];
                next.work.add(weight * speed * impulses[stage][axis]);
            }
        }
        let (displacement, weight) = (view.loads.motion(node), weight_of(view, node));
        carry((node, &displacement), Some(&weight), view, (next, motion));
    }

    /// `h ṗ = h Σ_b M_mb v̇_b` of a moved anchor at the stages, N s.
    fn impulses_at_stages(
        &self,
        node: usize,
        (stages, path): (&Stages<D>, &Path),
        view: &StepView<'_>,
    ) -> [[f64; D]; MOST_STAGES] {
        let mut impulses = [[0.0; D]; MOST_STAGES];
        for pair in view.masses.held() {
            let other = match pair.nodes() {
                [a, b] if a == node => b,
                [a, b] if b == node => a,
                _ => continue,
            };
            let changes = if view.loads.moved.binary_search(&other).is_ok() {
                changes_at_stages(path, other, view)
            } else {
                self.changes_of_mass(other, stages, view)
            };
            let rates = differentiated(stages.rule.motion, &changes);
            add(impulses.as_flattened_mut(), pair.mass, rates.as_flattened());
        }
        impulses
    }

    /// The change of the velocity of a node from the old state to each stage, m/s; zero for a fixed anchor.
    fn changes_of_mass(
        &self,
        node: usize,
        stages: &Stages<D>,
        view: &StepView<'_>,
    ) -> [[f64; D]; MOST_STAGES] {
        let masses = self.nodes_of_set(0);
        let mut beyond = [[0.0; D]; MOST_STAGES];
        if let Ok(index) = masses.binary_search_by_key(&node, |mass| mass.node) {
            for (beyond, change) in beyond.iter_mut().zip(self.changes(index)) {
                *beyond = scaled(view.per_step, &change);
            }
        }
        differentiated(stages.rule.motion, &beyond)
    }
}

/// The change of the velocity of a moved anchor from the old state to each stage, m/s.
fn changes_at_stages<const D: usize>(
    path: &Path,
    node: usize,
    view: &StepView<'_>,
) -> [[f64; D]; MOST_STAGES] {
    let mut changes = [[0.0; D]; MOST_STAGES];
    find_changes(path, node, view, changes.as_flattened_mut());
    changes
}

/// `h ẋ` at the stages of a polynomial x(t) that vanishes at the start of the step, from its values at the stages.
fn differentiated<const D: usize>(
    motion: &[&[f64]],
    values: &[[f64; D]; MOST_STAGES],
) -> [[f64; D]; MOST_STAGES] {
    let mut rates = [[0.0; D]; MOST_STAGES];
    for (rate, shares) in rates.iter_mut().zip(motion) {
        *rate = combined(shares, *values);
    }
    rates
}

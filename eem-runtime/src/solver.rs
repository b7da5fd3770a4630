//! One step of a whole scene: Newton's method, then the closing evaluation.

use crate::error::{NewtonIteration, StateError, StepFailure};
use crate::group::{Group, StepView, Trial};
use crate::layout::Layout;
use crate::newton::{NewtonSettings, is_last};
use crate::scalar::Real;
use crate::state::State;
use crate::system::LinearSystem;

/// How often an update is halved to bring all elements back to admissible states.
const HALVINGS: u32 = 30;

/// Working memory of a step; nothing in it outlives the step.
#[derive(Clone, Debug)]
pub(crate) struct Solver<S> {
    pub(crate) settings: NewtonSettings<S>,
    /// m per node; `None` for anchors.
    masses: Vec<Option<S>>,
    dimension: usize,
    system: LinearSystem<S>,
    trial: Trial<S>,
    /// Displacements and seen temperatures before the last update, and the update.
    previous: [Vec<S>; 2],
    correction: [Vec<S>; 2],
    /// The part of the nodal forces that the old state decides, N.
    old_force: Vec<S>,
    impulse: Vec<S>,
    /// What kept the last update from being applied in full.
    obstacle: Option<StateError>,
    /// What each iteration did.
    pub(crate) history: Vec<Iteration<S>>,
}

/// One iteration of Newton's method.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Iteration<S> {
    /// The largest momentum residual before the update, N s.
    pub(crate) residual: S,
    /// The largest scaled update.
    pub(crate) update: S,
}

impl<S: Real> Iteration<S> {
    /// The same in double precision.
    pub(crate) fn to_f64(self) -> NewtonIteration {
        NewtonIteration {
            residual: self.residual.to_f64(),
            update: self.update.to_f64(),
        }
    }
}

impl<S: Real> Solver<S> {
    pub(crate) fn new(masses: Vec<Option<S>>, dimension: usize, layout: &Layout) -> Self {
        let settings = NewtonSettings::default();
        let coordinates = vec![S::zero(); masses.len() * dimension];
        let temperatures = vec![S::zero(); layout.coupled.len()];
        Self {
            settings,
            masses,
            dimension,
            system: LinearSystem::new(layout.unknowns),
            trial: Trial {
                displacements: coordinates.clone(),
                positions: coordinates.clone(),
                seen_temperatures: temperatures.clone(),
                temperatures: temperatures.clone(),
            },
            previous: [coordinates.clone(), temperatures.clone()],
            correction: [coordinates.clone(), temperatures],
            old_force: coordinates.clone(),
            impulse: coordinates,
            obstacle: None,
            history: Vec::new(),
        }
    }

    /// Finds the trial state whose forces move the scene to it.
    pub(crate) fn iterate<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.history.clear();
        self.history.reserve(self.settings.max_iterations);
        self.begin(groups, view)?;
        let mut share = self.advance(groups, view)?;
        while self.history.len() < self.settings.max_iterations {
            let residual = self.assemble(groups, view);
            self.system
                .solve()
                .map_err(|_| StepFailure::SingularTangent)?;
            let before = self.history.last().filter(|_| share == S::one());
            let before = before.map(|last| last.update);
            let update = self.correct(groups, view);
            self.history.push(Iteration { residual, update });
            if !update.is_finite() {
                break;
            }
            share = self.advance(groups, view)?;
            if share == S::one() && is_last(update, before, self.settings.tolerance) {
                return Ok(());
            }
        }
        let update = self
            .history
            .last()
            .map_or(f64::NAN, |last| last.update.to_f64());
        Err(match self.obstacle.take() {
            Some(obstacle) => obstacle.into(),
            None => StepFailure::NotConverged { update },
        })
    }

    /// Residual and tangent at given global unknowns, with the local ones solved for.
    pub(crate) fn linearize<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        unknowns: &[S],
    ) -> Result<(Vec<S>, Vec<S>), StepFailure> {
        self.history.clear();
        self.begin(groups, view)?;
        self.distribute(view, unknowns);
        for (slot, unknown) in view.layout.coupled.iter().enumerate() {
            let change = unknown.map_or(S::zero(), |at| unknowns[at] - self.previous[1][slot]);
            self.correction[1][slot] = change;
        }
        let no_change = vec![S::zero(); unknowns.len()];
        let mut before = None;
        loop {
            self.advance(groups, view)?;
            let residual = self.assemble(groups, view);
            if before.is_some_and(|update| update <= S::EPSILON) {
                break;
            }
            self.remember();
            self.distribute(view, &no_change);
            self.correction[1].fill(S::zero());
            let update = correct_locally(groups, view, &no_change);
            self.history.push(Iteration { residual, update });
            let stagnated = before.is_some_and(|before| update >= before);
            if !update.is_finite() || self.history.len() > self.settings.max_iterations {
                let update = update.to_f64();
                return Err(StepFailure::NotConverged { update });
            }
            if stagnated && update <= self.settings.tolerance {
                break;
            }
            before = Some(update);
        }
        let residual = self.system.right().iter().map(|&entry| -entry).collect();
        Ok((residual, self.system.matrix().to_vec()))
    }

    /// Writes the displacements among global unknowns to the correction.
    fn distribute(&mut self, view: &StepView<'_, S>, unknowns: &[S]) {
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let own = node * self.dimension..(node + 1) * self.dimension;
            for (axis, change) in self.correction[0][own].iter_mut().enumerate() {
                *change = first.map_or(S::zero(), |first| unknowns[first + axis]);
            }
        }
    }

    /// Starts at the old state, with free flight as the first correction.
    fn begin<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.old_force.fill(S::zero());
        for group in groups.iter_mut() {
            group.begin(view, &mut self.old_force)?;
        }
        self.trial.displacements.fill(S::zero());
        self.trial
            .seen_temperatures
            .copy_from_slice(&view.state.temperatures);
        self.remember();
        self.correction[1].fill(S::zero());
        let momenta = view.state.momenta.values();
        for (node, mass) in self.masses.iter().enumerate() {
            let own = node * self.dimension..(node + 1) * self.dimension;
            for (change, &p) in self.correction[0][own.clone()]
                .iter_mut()
                .zip(&momenta[own])
            {
                *change = mass.map_or(S::zero(), |m| view.step * p / m);
            }
        }
        Ok(())
    }

    fn remember(&mut self) {
        self.previous[0].copy_from_slice(&self.trial.displacements);
        self.previous[1].copy_from_slice(&self.trial.seen_temperatures);
    }

    /// Applies the correction, or as much of it as leaves every element in an admissible state, and
    /// evaluates there. Returns the share that was applied.
    fn advance<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<S, StepFailure> {
        let mut share = S::one();
        let mut halvings = 0;
        self.obstacle = None;
        loop {
            self.apply(share, view);
            for group in groups.iter_mut() {
                group.apply(share);
            }
            let trial = &mut self.trial;
            match groups
                .iter_mut()
                .try_for_each(|group| group.evaluate(view, trial))
            {
                Ok(()) => return Ok(share),
                Err(error) if halvings == HALVINGS => return Err(error.into()),
                Err(error) => {
                    self.obstacle = Some(error);
                    share *= S::from_f64(0.5);
                    halvings += 1;
                }
            }
        }
    }

    fn apply(&mut self, share: S, view: &StepView<'_, S>) {
        let trial = &mut self.trial;
        let old = view.state.positions.values();
        for (at, &old) in old.iter().enumerate() {
            trial.displacements[at] = self.previous[0][at] + share * self.correction[0][at];
            trial.positions[at] = old + trial.displacements[at];
        }
        for slot in 0..trial.seen_temperatures.len() {
            trial.seen_temperatures[slot] =
                self.previous[1][slot] + share * self.correction[1][slot];
        }
    }

    /// Residual and tangent of the momentum balances, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// and of `Θ − θ* = 0` for the temperatures that neighbours see. Returns the largest entry of R.
    fn assemble<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> S {
        self.system.clear();
        for group in groups.iter_mut() {
            group.assemble(view, &self.trial, &mut self.system);
        }
        let mut largest = S::zero();
        let momenta = view.state.momenta.values();
        for (node, mass) in self.masses.iter().enumerate() {
            let (Some(mass), Some(first)) = (*mass, view.layout.nodes[node]) else {
                continue;
            };
            let inertia = (mass + mass) / view.step;
            for axis in 0..self.dimension {
                let (at, row) = (node * self.dimension + axis, first + axis);
                let rest = momenta[at] + momenta[at] - view.step * self.old_force[at];
                self.system.add(row, row, inertia);
                self.system
                    .add_right(row, rest - inertia * self.trial.displacements[at]);
                largest = largest.maximum(self.system.right()[row].abs());
            }
        }
        largest
    }

    /// Distributes the solution; the largest scaled update.
    fn correct<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> S {
        self.remember();
        let solution = self.system.right();
        let length = longest(groups);
        let mut largest = S::zero();
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let Some(first) = *first else { continue };
            for axis in 0..self.dimension {
                let change = solution[first + axis];
                self.correction[0][node * self.dimension + axis] = change;
                largest = largest.maximum((change / length).abs());
            }
        }
        for (slot, unknown) in view.layout.coupled.iter().enumerate() {
            let change = unknown.map_or(S::zero(), |at| solution[at]);
            self.correction[1][slot] = change;
            largest = largest.maximum((change / self.trial.seen_temperatures[slot]).abs());
        }
        largest.maximum(correct_locally(groups, view, solution))
    }

    /// Writes the new state to `next`, from the forces, temperatures and rates that were found.
    ///
    /// Where the nodal forces are `A q_m`, the displacements come from them by one linear solve,
    ///
    /// ```text
    /// (2m/h + ½h A) Δq = 2p⁰ − h A q⁰,      Δp = −h A (q⁰ + ½Δq)
    /// ```
    pub(crate) fn close<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        self.system.clear();
        let mut has_secant = true;
        for group in groups.iter_mut() {
            has_secant &= group.add_secant(view, &mut self.system);
        }
        if has_secant {
            self.solve_secant(view)?;
        }
        for (impulse, &force) in self.impulse.iter_mut().zip(&self.old_force) {
            *impulse = -view.step * force;
        }
        for group in groups.iter_mut() {
            group.add_impulse(view, &self.trial, &mut self.impulse);
        }
        next.copy_from(view.state);
        next.time.add(0, view.step);
        for (node, mass) in self.masses.iter().enumerate() {
            if mass.is_some() {
                for at in node * self.dimension..(node + 1) * self.dimension {
                    next.positions.add(at, self.trial.displacements[at]);
                    next.momenta.add(at, self.impulse[at]);
                }
            }
        }
        for group in groups.iter_mut() {
            group.close(view, &self.trial, next);
        }
        for group in groups.iter_mut() {
            group.settle(next)?;
        }
        Ok(())
    }

    fn solve_secant(&mut self, view: &StepView<'_, S>) -> Result<(), StepFailure> {
        let momenta = view.state.momenta.values();
        for (node, mass) in self.masses.iter().enumerate() {
            let (Some(mass), Some(first)) = (*mass, view.layout.nodes[node]) else {
                continue;
            };
            for axis in 0..self.dimension {
                let momentum = momenta[node * self.dimension + axis];
                self.system
                    .add(first + axis, first + axis, (mass + mass) / view.step);
                self.system.add_right(first + axis, momentum + momentum);
            }
        }
        for unknown in view.layout.coupled.iter().flatten() {
            self.system.add(*unknown, *unknown, S::one());
        }
        self.system
            .solve()
            .map_err(|_| StepFailure::SingularTangent)?;
        let solution = self.system.right();
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let Some(first) = *first else { continue };
            for axis in 0..self.dimension {
                self.trial.displacements[node * self.dimension + axis] = solution[first + axis];
            }
        }
        Ok(())
    }
}

/// The longest measure of the old state, the unit of lengths.
fn longest<S: Real, const D: usize>(groups: &[Box<dyn Group<S, D>>]) -> S {
    let measures = groups.iter().map(|group| group.largest_measure());
    measures.fold(S::zero(), S::maximum)
}

/// Corrects the local unknowns for given global corrections; the largest scaled update.
fn correct_locally<S: Real, const D: usize>(
    groups: &mut [Box<dyn Group<S, D>>],
    view: &StepView<'_, S>,
    solution: &[S],
) -> S {
    let length = longest(groups);
    let updates = groups
        .iter_mut()
        .map(|group| group.correct(view, solution, length));
    updates.fold(S::zero(), S::maximum)
}

//! One step of a whole scene: Newton's method, then the closing evaluation.

mod assemble;
mod closing;
mod linearize;
mod stages;

use crate::error::{NewtonIteration, StateError, StepFailure};
use crate::group::{Group, StepView, Trial};
use crate::layout::Layout;
use crate::newton::{NewtonSettings, is_last};
use crate::scalar::Real;
use crate::scheme::Scheme;
use crate::state::State;
use crate::system::LinearSystem;
pub(crate) use stages::{Effort, Staged};

/// How often an update is halved to bring all elements back to admissible states.
const HALVINGS: u32 = 30;

/// Parts of a step through which a solution is followed when it is not found at once.
const STAGES: u8 = 8;

/// Iterations for which memory is kept; settings that ask for more allocate when they get there.
const LONGEST_HISTORY: usize = 4096;

/// Working memory of a step; nothing in it outlives the step.
#[derive(Clone, Debug)]
pub(crate) struct Solver<S> {
    pub(crate) settings: NewtonSettings<S>,
    /// m per node; `None` for anchors.
    masses: Vec<Option<S>>,
    dimension: usize,
    scheme: Scheme,
    system: LinearSystem<S>,
    trial: Trial<S>,
    /// Displacements and seen temperatures before the last update, and the update.
    previous: [Vec<S>; 2],
    correction: [Vec<S>; 2],
    /// The part of the nodal forces that the old state decides, N.
    old_force: Vec<S>,
    impulse: Vec<S>,
    /// The unit of length of each node: its shortest element in the old state; 1 m without.
    lengths: Vec<S>,
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
    pub(crate) fn new(
        scheme: Scheme,
        masses: Vec<Option<S>>,
        dimension: usize,
        layout: &Layout,
    ) -> Self {
        let settings = NewtonSettings::default();
        let lengths = vec![S::one(); masses.len()];
        let coordinates = vec![S::zero(); masses.len() * dimension];
        let temperatures = vec![S::zero(); layout.coupled.len()];
        Self {
            settings,
            masses,
            dimension,
            scheme,
            system: LinearSystem::new(layout.unknowns),
            trial: Trial {
                displacements: coordinates.clone(),
                positions: coordinates.clone(),
                seen_temperatures: temperatures.clone(),
            },
            previous: [coordinates.clone(), temperatures.clone()],
            correction: [coordinates.clone(), temperatures],
            old_force: coordinates.clone(),
            impulse: coordinates,
            lengths,
            obstacle: None,
            history: Vec::new(),
        }
    }

    /// Forgets the last step.
    pub(crate) fn restart(&mut self) {
        // Two parts of a staggered step, each followed through all stages at worst.
        let parts = 2 * usize::from(STAGES + 1);
        let most = self.settings.max_iterations.saturating_mul(parts);
        self.history.clear();
        self.history.reserve(most.min(LONGEST_HISTORY));
    }

    /// The state after the step, or after the part of it that the view names.
    pub(crate) fn solve<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        self.iterate(groups, view)?;
        self.close(groups, view, next)
    }

    /// Finds the trial state whose forces move the scene to it.
    ///
    /// If that fails from the start of the scheme, an EEM scheme follows its solution from a small
    /// step to the full one.
    fn iterate<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        let failure = match self.start_and_converge(groups, view) {
            Err(failure) if self.scheme.follows_its_solution() => failure,
            done => return done,
        };
        self.follow(groups, view).map_err(|_| failure)
    }

    fn start_and_converge<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.begin(groups, view)?;
        let share = self.advance(groups, view)?;
        self.converge(groups, view, share)
    }

    /// The solution for growing parts of the step, each starting from the one before.
    fn follow<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        let number = |stage: u8| S::from_f64(f64::from(stage));
        let mut before = None;
        for stage in (1..=STAGES).map(number) {
            let part = StepView {
                step: view.step * stage / number(STAGES),
                ..*view
            };
            match before {
                None => self.start_and_converge(groups, &part)?,
                Some(before) => {
                    self.extrapolate(groups, stage / before);
                    let share = self.advance(groups, &part)?;
                    self.converge(groups, &part, share)?;
                }
            }
            before = Some(stage);
        }
        Ok(())
    }

    /// Makes displacements larger by a factor and leaves everything else.
    fn extrapolate<const D: usize>(&mut self, groups: &mut [Box<dyn Group<S, D>>], factor: S) {
        self.remember();
        for (node, mass) in self.masses.iter().enumerate() {
            let growth = mass.map_or(S::zero(), |_| factor - S::one());
            for at in node * self.dimension..(node + 1) * self.dimension {
                self.correction[0][at] = growth * self.previous[0][at];
            }
        }
        self.correction[1].fill(S::zero());
        for group in groups {
            group.hold();
        }
    }

    /// Newton's method from the trial state, which was reached by the given share of a correction.
    fn converge<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        mut share: S,
    ) -> Result<(), StepFailure> {
        let mut before = None;
        for _ in 0..self.settings.max_iterations {
            let residual = self.assemble(groups, view);
            let solved = self.system.solve();
            solved.map_err(|_| StepFailure::SingularTangent)?;
            let update = self.correct(groups, view);
            self.history.push(Iteration { residual, update });
            if !update.is_finite() {
                break;
            }
            let full = share == S::one();
            share = self.advance(groups, view)?;
            let before = before.replace(update).filter(|_| full);
            if share == S::one() && is_last(update, before, self.settings.tolerance) {
                return Ok(());
            }
        }
        Err(match self.obstacle.take() {
            Some(obstacle) => obstacle.into(),
            None => StepFailure::NotConverged {
                update: before.map_or(f64::NAN, Real::to_f64),
            },
        })
    }

    /// Starts at the old state, with free flight as the first correction if the scheme wants it.
    fn begin<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        for (old, &load) in self.old_force.iter_mut().zip(&view.loads.total_force) {
            *old = -load;
        }
        for group in groups.iter_mut() {
            group.begin(view, &mut self.old_force)?;
        }
        self.lengths.fill(S::MAX);
        for group in groups.iter() {
            group.shorten(&mut self.lengths);
        }
        for length in &mut self.lengths {
            if *length == S::MAX {
                *length = S::one();
            }
        }
        if view.phase.moves() {
            self.trial.displacements.copy_from_slice(&view.loads.motion);
        } else {
            self.trial.displacements.fill(S::zero());
        }
        self.trial
            .seen_temperatures
            .copy_from_slice(&view.state.temperatures);
        self.remember();
        self.correction[0].fill(S::zero());
        self.correction[1].fill(S::zero());
        if !(view.phase.moves() && self.scheme.starts_in_free_flight()) {
            return Ok(());
        }
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
            let trial = &self.trial;
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
}

//! One step of a whole scene through three stages: Newton's method, then the closing evaluation.
//!
//! What [`Solver`](super::Solver) is to the schemes with one set of forces per step this is to
//! [`Scheme::Variational4`]; they start, converge, follow a solution and give up alike.

mod assemble;
mod closing;
mod linearize;

use super::{HALVINGS, Iteration, STAGES as PARTS};
use crate::error::{StateError, StepFailure};
use crate::group::{StageGroup, StageTrial, StageView};
use crate::layout::Layout;
use crate::loads::{Loads, StepLoads};
use crate::newton::{NewtonSettings, is_last};
use crate::scalar::Real;
use crate::scheme::Scheme;
use crate::state::State;
use crate::system::LinearSystem;

/// A scene that is stepped through stages.
pub(crate) struct Staged<S: Real, const D: usize> {
    pub(crate) groups: Vec<Box<dyn StageGroup<S, D>>>,
    pub(crate) solver: StageSolver<S>,
    /// What acts at the times of the stages of the next step.
    pub(crate) loads: [StepLoads<S>; 3],
}

impl<S: Real, const D: usize> Staged<S, D> {
    pub(crate) fn new(
        groups: Vec<Box<dyn StageGroup<S, D>>>,
        masses: Vec<Option<S>>,
        layout: &Layout,
    ) -> Self {
        let loads = [(); 3].map(|()| StepLoads::new(masses.len() * D, layout));
        Self {
            groups,
            solver: StageSolver::new(masses, D, layout),
            loads,
        }
    }

    /// Evaluates the loads at the start, the middle and the end of the step from `time` by `step`.
    pub(crate) fn evaluate_loads(
        &mut self,
        loads: &Loads<S, D>,
        masses: &[Option<S>],
        layout: &Layout,
        [time, step]: [S; 2],
        q0: &[S],
    ) -> Result<(), StepFailure> {
        let times = [time, time + S::from_f64(0.5) * step, time + step];
        for (stage, time) in self.loads.iter_mut().zip(times) {
            let span = [time, S::zero()];
            stage.evaluate(loads, masses, layout, Scheme::Variational4, span, q0)?;
        }
        Ok(())
    }
}

/// How hard a step tries, and what it did.
#[derive(Debug)]
pub(crate) struct Effort<'a, S> {
    pub(crate) settings: NewtonSettings<S>,
    pub(crate) history: &'a mut Vec<Iteration<S>>,
}

/// Working memory of a step; nothing in it outlives the step.
#[derive(Clone, Debug)]
pub(crate) struct StageSolver<S> {
    /// m per node; `None` for anchors.
    masses: Vec<Option<S>>,
    dimension: usize,
    system: LinearSystem<S>,
    /// The system of the closing solution for the middle.
    closing: LinearSystem<S>,
    trial: StageTrial<S>,
    /// Displacements of the middle and the end, seen temperatures of the start and the end: before
    /// the last update, and the update.
    previous: [[Vec<S>; 2]; 2],
    correction: [[Vec<S>; 2]; 2],
    /// Loads less forces of the elements at the stages, N.
    forces: [Vec<S>; 3],
    /// The unit of length of each node: its shortest element in the old state; 1 m without.
    lengths: Vec<S>,
    /// What kept the last update from being applied in full.
    obstacle: Option<StateError>,
}

impl<S: Real> StageSolver<S> {
    fn new(masses: Vec<Option<S>>, dimension: usize, layout: &Layout) -> Self {
        let lengths = vec![S::one(); masses.len()];
        let coordinates = || vec![S::zero(); masses.len() * dimension];
        let temperatures = || vec![S::zero(); layout.coupled.len()];
        let unknowns = || {
            let pair = |of: &dyn Fn() -> Vec<S>| [of(), of()];
            [pair(&coordinates), pair(&temperatures)]
        };
        Self {
            dimension,
            system: LinearSystem::new(2 * layout.unknowns),
            closing: LinearSystem::new(layout.unknowns),
            trial: StageTrial {
                displacements: [(); 2].map(|()| coordinates()),
                positions: [(); 3].map(|()| coordinates()),
                seen_temperatures: [(); 3].map(|()| temperatures()),
            },
            previous: unknowns(),
            correction: unknowns(),
            forces: [(); 3].map(|()| coordinates()),
            lengths,
            obstacle: None,
            masses,
        }
    }

    /// The state after the step.
    pub(crate) fn solve<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        effort: &mut Effort<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        if let Err(failure) = self.start_and_converge(groups, view, effort) {
            self.follow(groups, view, effort).map_err(|_| failure)?;
        }
        self.close(groups, view, next)
    }

    fn start_and_converge<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        effort: &mut Effort<'_, S>,
    ) -> Result<(), StepFailure> {
        self.begin(groups, view);
        let share = self.advance(groups, view)?;
        self.converge(groups, view, share, effort)
    }

    /// The solution for growing parts of the step, each starting from the one before.
    fn follow<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        effort: &mut Effort<'_, S>,
    ) -> Result<(), StepFailure> {
        let number = |part: u8| S::from_f64(f64::from(part));
        for part in 1..=PARTS {
            let shorter = StageView {
                step: view.step * number(part) / number(PARTS),
                ..*view
            };
            if part == 1 {
                self.start_and_converge(groups, &shorter, effort)?;
            } else {
                self.extrapolate(groups, number(part) / number(part - 1));
                let share = self.advance(groups, &shorter)?;
                self.converge(groups, &shorter, share, effort)?;
            }
        }
        Ok(())
    }

    /// Makes displacements larger by a factor and leaves everything else.
    fn extrapolate<const D: usize>(&mut self, groups: &mut [Box<dyn StageGroup<S, D>>], factor: S) {
        self.remember();
        for half in 0..2 {
            for (node, mass) in self.masses.iter().enumerate() {
                let growth = mass.map_or(S::zero(), |_| factor - S::one());
                for at in node * self.dimension..(node + 1) * self.dimension {
                    self.correction[0][half][at] = growth * self.previous[0][half][at];
                }
            }
            self.correction[1][half].fill(S::zero());
        }
        for group in groups {
            group.hold();
        }
    }

    /// Newton's method from the trial stages, which were reached by the given share of a correction.
    fn converge<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        mut share: S,
        effort: &mut Effort<'_, S>,
    ) -> Result<(), StepFailure> {
        let mut before = None;
        for _ in 0..effort.settings.max_iterations {
            let residual = self.assemble(groups, view);
            let solved = self.system.solve();
            solved.map_err(|_| StepFailure::SingularTangent)?;
            let update = self.correct(groups, view);
            effort.history.push(Iteration { residual, update });
            if !update.is_finite() {
                break;
            }
            let full = share == S::one();
            share = self.advance(groups, view)?;
            let before = before.replace(update).filter(|_| full);
            if share == S::one() && is_last(update, before, effort.settings.tolerance) {
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

    /// Starts at the old state, with free flight as the first correction.
    fn begin<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) {
        self.lengths.fill(S::MAX);
        for group in groups.iter_mut() {
            group.begin(view);
            group.shorten(&mut self.lengths);
        }
        for length in &mut self.lengths {
            if *length == S::MAX {
                *length = S::one();
            }
        }
        let trial = &mut self.trial;
        trial.positions[0].copy_from_slice(view.state.positions.values());
        for (displacements, loads) in trial.displacements.iter_mut().zip(&view.loads[1..]) {
            displacements.copy_from_slice(&loads.motion);
        }
        for (seen, loads) in trial.seen_temperatures.iter_mut().zip(view.loads) {
            seen.copy_from_slice(&view.state.temperatures);
            for (seen, prescribed) in seen.iter_mut().zip(&loads.prescribed) {
                *seen = prescribed.map_or(*seen, |prescribed| prescribed.end);
            }
        }
        self.remember();
        let momenta = view.state.momenta.values();
        for (half, share) in [0.5, 1.0].map(S::from_f64).into_iter().enumerate() {
            let flight = self.correction[0][half].iter_mut().zip(momenta);
            for (at, (change, &p)) in flight.enumerate() {
                let mass = self.masses[at / self.dimension];
                *change = mass.map_or(S::zero(), |m| share * view.step * p / m);
            }
            self.correction[1][half].fill(S::zero());
        }
    }

    fn remember(&mut self) {
        let trial = &self.trial;
        for half in 0..2 {
            self.previous[0][half].copy_from_slice(&trial.displacements[half]);
            self.previous[1][half].copy_from_slice(&trial.seen_temperatures[2 * half]);
        }
    }

    /// Applies the correction, or as much of it as leaves every element in admissible states, and
    /// evaluates there. Returns the share that was applied.
    fn advance<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
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

    fn apply(&mut self, share: S, view: &StageView<'_, S>) {
        let trial = &mut self.trial;
        let old = view.state.positions.values();
        for half in 0..2 {
            let displacements = &mut trial.displacements[half];
            for (at, &old) in old.iter().enumerate() {
                let change = share * self.correction[0][half][at];
                displacements[at] = self.previous[0][half][at] + change;
                trial.positions[1 + half][at] = old + displacements[at];
            }
            let seen = &mut trial.seen_temperatures[2 * half];
            for (slot, seen) in seen.iter_mut().enumerate() {
                *seen = self.previous[1][half][slot] + share * self.correction[1][half][slot];
            }
        }
        let [start, middle, end] = &mut trial.seen_temperatures;
        for (slot, prescribed) in view.loads[1].prescribed.iter().enumerate() {
            let mean = S::from_f64(0.5) * (start[slot] + end[slot]);
            middle[slot] = prescribed.map_or(mean, |prescribed| prescribed.end);
        }
    }
}

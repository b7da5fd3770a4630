//! One step of a whole scene: Newton's method, then the closing evaluation.

mod begin;
mod closing;
mod iteration;
mod linearize;
mod places;
mod stages;

use crate::conduction::Conduction;
use crate::error::{NewtonIteration, StateError, StepFailure};
use crate::group::{Group, Sites, StepView, Trial, points};
use crate::layout::Layout;
use crate::newton::{NewtonSettings, is_last};
use crate::pattern::Pattern;
use crate::scalar::Real;
use crate::scene::ElementEntry;
use crate::scheme::Scheme;
use crate::state::State;
use crate::system::LinearSystem;
use places::{MovingNode, Seen, moving, seen};
pub(crate) use stages::{Effort, Staged};

/// How often an update is halved to bring all elements back to admissible states.
const HALVINGS: u32 = 30;

/// Parts of a step through which a solution is followed when it is not found at once.
const STAGES: u8 = 8;

/// Iterations for which memory is kept; settings that ask for more allocate when they get there.
const LONGEST_HISTORY: usize = 4096;

/// An update whose square is below this many ε leaves nothing to correct: it is applied to the
/// forces through the tangent. What that leaves out, the square times a curvature of the order of
/// one, is small beside the roundings of a force.
const NEGLIGIBLE: f64 = 1.0 / 1024.0;

/// Working memory of a step; nothing in it outlives the step.
#[derive(Debug)]
pub(crate) struct Solver<S, const D: usize> {
    pub(crate) settings: NewtonSettings<S>,
    scheme: Scheme,
    /// The nodes that move.
    masses: Vec<MovingNode<S, D>>,
    /// The rows of the temperatures that neighbours see, and their thermal slots.
    seen: Vec<Seen>,
    /// The system of an iteration.
    tangent: LinearSystem<S, 1>,
    /// The system that closes a step.
    secant: LinearSystem<S, D>,
    trial: Trial<S, D>,
    /// Displacements and seen temperatures before the last update, and the update.
    previous: (Vec<[S; D]>, Vec<S>),
    correction: (Vec<[S; D]>, Vec<S>),
    /// The part of the nodal forces that the old state decides, N.
    old_force: Vec<[S; D]>,
    impulse: Vec<[S; D]>,
    /// The reciprocal of the unit of length of each node: its shortest element in the old state;
    /// 1 m without.
    per_length: Vec<S>,
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

impl<S: Real, const D: usize> Solver<S, D> {
    pub(crate) fn new(
        scheme: Scheme,
        masses: &[Option<S>],
        elements: &[ElementEntry<S>],
        layout: &Layout,
        conduction: &Conduction<S>,
    ) -> Self {
        let pattern = Pattern::of_tangent(elements, layout, conduction, D);
        let tangent = LinearSystem::new(&pattern, D);
        let secant = LinearSystem::new(&Pattern::of_secant(elements, layout, D), 1);
        let sites = Sites {
            layout,
            conduction,
            tangent: &tangent,
            secant: &secant,
            shift: [0; 2],
        };
        let (moving, seen) = (moving(masses, &sites), seen(&sites));
        let points = vec![[S::zero(); D]; masses.len()];
        let temperatures = vec![S::zero(); layout.coupled.len()];
        Self {
            settings: NewtonSettings::default(),
            scheme,
            masses: moving,
            seen,
            tangent,
            secant,
            trial: Trial {
                displacements: points.clone(),
                positions: points.clone(),
                seen_temperatures: temperatures.clone(),
            },
            previous: (points.clone(), temperatures.clone()),
            correction: (points.clone(), temperatures),
            old_force: points.clone(),
            impulse: points,
            per_length: vec![S::one(); masses.len()],
            obstacle: None,
            history: Vec::new(),
        }
    }

    /// Where elements write.
    pub(crate) fn sites<'a>(
        &'a self,
        layout: &'a Layout,
        conduction: &'a Conduction<S>,
    ) -> Sites<'a, S, D> {
        Sites {
            layout,
            conduction,
            tangent: &self.tangent,
            secant: &self.secant,
            shift: [0; 2],
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
    pub(crate) fn solve(
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
    fn iterate(
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

    fn start_and_converge(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.begin(groups, view)?;
        let share = self.advance(groups, view, Look::On)?;
        self.converge(groups, view, share)
    }

    /// The solution for growing parts of the step, each starting from the one before.
    fn follow(
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
                    let share = self.advance(groups, &part, Look::On)?;
                    self.converge(groups, &part, share)?;
                }
            }
            before = Some(stage);
        }
        Ok(())
    }

    /// Makes displacements larger by a factor and leaves everything else.
    fn extrapolate(&mut self, groups: &mut [Box<dyn Group<S, D>>], factor: S) {
        self.remember();
        for mass in &self.masses {
            let growth = factor - S::one();
            let moved = self.previous.0[mass.node];
            self.correction.0[mass.node] = moved.map(|component| growth * component);
        }
        self.correction.1.fill(S::zero());
        for group in groups {
            group.hold();
        }
    }

    /// Newton's method from the trial state, which was reached by the given share of a correction.
    fn converge(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        mut share: S,
    ) -> Result<(), StepFailure> {
        let mut before = None;
        for _ in 0..self.settings.max_iterations {
            let residual = self.balance(view);
            let solved = self.tangent.solve();
            solved.map_err(|_| StepFailure::SingularTangent)?;
            let update = self.correct(groups);
            self.history.push(Iteration { residual, update });
            if !update.is_finite() {
                break;
            }
            let full = share == S::one();
            let before = before.replace(update).filter(|_| full);
            let is_last = is_last(update, before, self.settings.tolerance);
            if is_last && update * update <= S::from_f64(NEGLIGIBLE) * S::EPSILON {
                self.apply(S::one(), view);
                for group in groups.iter_mut() {
                    group.extrapolate();
                }
                return Ok(());
            }
            let look = if is_last { Look::Back } else { Look::On };
            share = self.advance(groups, view, look)?;
            if is_last && share == S::one() {
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

    fn remember(&mut self) {
        self.previous.0.copy_from_slice(&self.trial.displacements);
        self.previous
            .1
            .copy_from_slice(&self.trial.seen_temperatures);
    }

    /// Applies the correction, or as much of it as leaves every element in an admissible state, and
    /// evaluates there. Returns the share that was applied.
    fn advance(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        look: Look,
    ) -> Result<S, StepFailure> {
        let mut share = S::one();
        let mut halvings = 0;
        self.obstacle = None;
        loop {
            self.apply(share, view);
            let is_end = look == Look::Back && share == S::one();
            match self.evaluate(groups, view, share, !is_end) {
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

    /// The responses at the trial state, which is a share of the local corrections away, and the
    /// system of the next iteration if there is to be one.
    fn evaluate(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        share: S,
        goes_on: bool,
    ) -> Result<(), StateError> {
        let trial = &self.trial;
        if !goes_on {
            let mut groups = groups.iter_mut();
            return groups.try_for_each(|group| group.evaluate(view, trial, share, None));
        }
        self.tangent.clear();
        let system = &mut self.tangent;
        let mut groups = groups.iter_mut();
        groups.try_for_each(|group| group.evaluate(view, trial, share, Some(system)))
    }

    /// The trial a share of the correction away from where it was.
    fn apply(&mut self, share: S, view: &StepView<'_, S>) {
        let trial = &mut self.trial;
        let old = points::<S, D>(view.state.positions.values());
        for mass in &self.masses {
            let node = mass.node;
            let (from, by) = (&self.previous.0[node], &self.correction.0[node]);
            for axis in 0..D {
                let displacement = from[axis] + share * by[axis];
                trial.displacements[node][axis] = displacement;
                trial.positions[node][axis] = old[node][axis] + displacement;
            }
        }
        for seen in &self.seen {
            let from = self.previous.1[seen.slot];
            trial.seen_temperatures[seen.slot] = from + share * self.correction.1[seen.slot];
        }
    }
}

/// What an evaluation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    /// Another iteration.
    On,
    /// Closing the step.
    Back,
}

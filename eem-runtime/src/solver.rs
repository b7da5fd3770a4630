//! One step of a whole scene: Newton's method, then the closing evaluation.

mod balance;
mod begin;
mod closing;
mod effort;
mod iteration;
mod linearize;

mod past;
mod places;
mod secant;
mod stages;

use crate::conduction::Conduction;
use crate::error::{StateError, StepFailure};
use crate::group::{Group, Sites, StepView, Trial};
use crate::layout::Layout;
use crate::loads::StepLoads;
use crate::masses::Masses;
use crate::newton::{NewtonSettings, is_last};
use crate::pattern::Pattern;
use crate::scalar::{Mask, Real, natural_power};
use crate::scene::ElementEntry;
use crate::scheme::{Closing, Scheme};
use crate::state::State;
use crate::system::LinearSystem;
use balance::Balance;
pub(crate) use effort::{Effort, Iteration};
use past::Past;
pub(crate) use past::SavedPast;
use places::{Seen, moving, seen};
use secant::Secant;
pub(crate) use stages::Staged;

/// How often an update is halved to bring all elements back to admissible states.
const HALVINGS: u32 = 30;

/// Parts of a step through which a solution is followed when it is not found at once.
const STAGES: u8 = 8;

/// An update whose square is below this many ε leaves nothing to correct: it is applied to the
/// forces through the tangent. What that leaves out, the square times a curvature of the order of
/// one, is small beside the roundings of a force.
const NEGLIGIBLE: f64 = 1.0 / 1024.0;

/// Working memory of a step; nothing in it outlives the step but the forces of the last ones.
#[derive(Debug)]
pub(crate) struct Solver<S: Real, const D: usize> {
    scheme: Scheme,
    /// The nodes that move, in the order of their unknowns.
    nodes: Vec<Balance<S, D>>,
    /// The temperatures that neighbours see.
    seen: Vec<Seen>,
    /// The system of an iteration.
    tangent: LinearSystem<S, 1>,
    /// The system that closes a step, if the scheme closes it by one.
    secant: Option<Secant<S, D>>,
    trial: Trial<S, D>,
    /// 2/h, 1/s: the inertia of a mass.
    twice_per_step: S,
    /// The part of the nodal forces that the old state and the loads decide, N; empty where nothing has
    /// a part in it.
    old_force: Vec<[S; D]>,
    past: Past<S, D>,
    /// The reciprocal of the unit of length of each node that moves: its shortest element in the old
    /// state; 1 m without.
    per_length: Vec<S>,
    /// What kept the last update from being applied in full.
    obstacle: Option<StateError>,
}

impl<S: Real, const D: usize> Solver<S, D> {
    pub(crate) fn new(
        scheme: Scheme,
        masses: &Masses<S>,
        elements: &[ElementEntry<S>],
        layout: &Layout,
        conduction: &Conduction<S>,
        loads: &StepLoads<S>,
    ) -> Self {
        let has_old_force = scheme.has_old_forces() || loads.has_total_force();
        let pattern = Pattern::of_tangent(elements, layout, conduction, D);
        let tangent = LinearSystem::new(&pattern, D);
        let secant = (scheme.closing() == Closing::Secant).then(|| {
            Secant::new(&tangent, masses.moving(), || {
                Pattern::of_secant(elements, layout, D)
            })
        });
        let sites = Sites {
            layout,
            conduction,
            tangent: &tangent,
            secant: secant.as_ref().and_then(Secant::apart),
            shift: [0; 2],
        };
        let nodes = moving(masses, &sites).into_iter().map(Balance::new);
        let nodes: Vec<_> = nodes.collect();
        let seen = seen(&sites);
        let points = vec![[S::zero(); D]; masses.len()];
        // Nobody asks for any unless some are seen.
        let slots = if seen.is_empty() { 0 } else { layout.thermal };
        Self {
            scheme,
            past: Past::none(masses.len()),
            nodes,
            seen,
            tangent,
            secant,
            trial: Trial {
                displacements: points.clone(),
                seen_temperatures: vec![S::zero(); slots],
                settled: S::Mask::none(),
            },
            twice_per_step: S::zero(),
            old_force: if has_old_force {
                points.clone()
            } else {
                Vec::new()
            },
            per_length: vec![S::one(); masses.len()],
            obstacle: None,
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
            secant: self.secant.as_ref().and_then(Secant::apart),
            shift: [0; 2],
        }
    }

    /// The state after the step, or after the part of it that the view names.
    pub(crate) fn solve(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        self.iterate(groups, view, effort)?;
        self.close(groups, view, next)
    }

    /// Finds the trial state whose forces move the scene to it.
    ///
    /// If that fails from the start of the scheme, an EEM scheme follows its solution from a small
    /// step to the full one; several numbers in one do not, as some of them need not have failed.
    fn iterate(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
    ) -> Result<(), StepFailure> {
        let failure = match self.start_and_converge(groups, view, effort) {
            Err(failure) if S::LANES == 1 && self.scheme.follows_its_solution() => failure,
            done => return done,
        };
        self.follow(groups, view, effort).map_err(|_| failure)
    }

    fn start_and_converge(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
    ) -> Result<(), StepFailure> {
        self.begin(groups, view)?;
        self.converge(groups, view, effort)
    }

    /// The solution for growing parts of the step, each starting from the one before.
    #[cold]
    fn follow(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
    ) -> Result<(), StepFailure> {
        let number = |stage: u8| S::from_f64(f64::from(stage));
        let mut before = None;
        for stage in (1..=STAGES).map(number) {
            let part = StepView {
                step: view.step * stage / number(STAGES),
                ..*view
            };
            match before {
                None => self.start_and_converge(groups, &part, effort)?,
                Some(before) => {
                    self.extrapolate(groups, &part, stage / before);
                    self.converge(groups, &part, effort)?;
                }
            }
            before = Some(stage);
        }
        Ok(())
    }

    /// Newton's method from the trial state. Where S is several numbers, those that are done keep
    /// what they have found until the last one is.
    fn converge(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
    ) -> Result<(), StepFailure> {
        let NewtonSettings {
            max_iterations,
            tolerance,
        } = effort.settings;
        let mut before = None;
        let mut look = Look::On;
        // Those that are done, and those for which the next look is the last.
        let (mut settled, mut last) = (S::Mask::none(), S::Mask::none());
        for left in (0..=max_iterations).rev() {
            let is_full = self.advance(groups, view, look)?;
            if is_full && look == Look::Back {
                return Ok(());
            }
            settled = self.settle(settled | last);
            if left == 0 {
                break;
            }
            let residual = self.residual();
            let solved = self.tangent.solve();
            solved.map_err(|_| StepFailure::SingularTangent)?;
            let update = self.correct(groups);
            effort.note(residual, update, settled);
            if !update.is_finite() {
                break;
            }
            let before = before.replace(update).filter(|_| is_full);
            look = Look::On;
            last = S::Mask::none();
            let ends = is_last(update, before, tolerance) & !settled;
            if ends.any() {
                let negligible = S::from_f64(NEGLIGIBLE) * S::EPSILON;
                let is_done = ends & (update * update).at_most(negligible);
                if is_done.any() {
                    for group in groups.iter_mut() {
                        group.extrapolate(self.tangent.solution(), settled);
                    }
                    if (settled | is_done).all() {
                        return Ok(());
                    }
                    settled = self.settle(settled | is_done);
                }
                last = ends & !is_done;
                if (settled | last).all() {
                    look = Look::Back;
                }
            }
        }
        Err(match self.obstacle.take() {
            Some(obstacle) => obstacle.into(),
            None => StepFailure::NotConverged {
                update: before.map_or(f64::NAN, Real::to_f64),
            },
        })
    }

    /// Lets everybody know which of several numbers are done while others are not.
    #[inline]
    fn settle(&mut self, settled: S::Mask) -> S::Mask {
        if S::LANES == 1 {
            return S::Mask::none();
        }
        self.trial.settled = settled;
        settled
    }

    /// Evaluates at the trial state, to which the correction has been applied, or as much of it as
    /// leaves every element in an admissible state. Returns whether that is all of it.
    #[inline]
    fn advance(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        look: Look,
    ) -> Result<bool, StepFailure> {
        if self.obstacle.is_some() {
            self.obstacle = None;
        }
        let (mut share, mut goes_on) = (S::one(), look == Look::On);
        while let Err(error) = self.evaluate(groups, view, goes_on) {
            share = self.retreat(groups, share, error)?;
            goes_on = true;
        }
        Ok(share == S::one())
    }

    /// Half the share of the correction that failed, applied. Several numbers in one do not go back, as
    /// some of them need not have failed.
    #[cold]
    #[inline(never)]
    fn retreat(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        share: S,
        error: StateError,
    ) -> Result<S, StepFailure> {
        let half = S::from_f64(0.5);
        if S::LANES > 1 || share <= natural_power(half, HALVINGS) {
            return Err(error.into());
        }
        self.obstacle = Some(error);
        let share = half * share;
        // As much as is left.
        self.take_back(share);
        for group in groups {
            group.apply(share);
        }
        Ok(share)
    }

    /// The responses at the trial state, and what they add to the system of the next iteration if there is
    /// to be one.
    #[inline]
    fn evaluate(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        goes_on: bool,
    ) -> Result<(), StateError> {
        let trial = &self.trial;
        for group in groups {
            let system = goes_on.then_some(&mut self.tangent);
            group.evaluate(view, trial, system)?;
        }
        Ok(())
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

//! One step of a whole scene: Newton's method until the step that is closed from its trial proves its laws.

mod balance;
mod begin;
mod closing;
mod conclusion;
mod effort;
mod iteration;
mod linearize;
mod past;
mod places;
mod stages;
mod starts;

use crate::certificate::Certificate;
use crate::conduction::{Conduction, SeenTemperatures};
use crate::error::{StateError, StepFailure};
use crate::group::{Group, Sites, StepView, Trial};
use crate::handle::Element;
use crate::layout::Layout;
use crate::loads::StepLoads;
use crate::masses::Masses;
use crate::newton::{NewtonSettings, is_last};
use crate::pattern::Pattern;
use crate::scalar::{Mask, Real, natural_power};
use crate::scene::ElementEntry;
use crate::scheme::Scheme;
use crate::system::LinearSystem;
use balance::Balance;
use conclusion::{Conclusion, Progress, Target};
pub(crate) use effort::{Effort, Iteration};
use past::Past;
pub(crate) use past::SavedPast;
use places::{Seen, moving, seen};
pub(crate) use stages::Staged;

/// How often an update is halved to bring all elements back to admissible states.
const HALVINGS: u32 = 30;

/// Parts of a step through which a solution is followed when it is not found at once.
const CONTINUATION_STEPS: u8 = 8;

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
    /// An attempt may be given up early.
    has_other_starts: bool,
    /// The nodes that are anchors.
    anchors: Vec<usize>,
    /// The magnitude of what the forces on each node are computed from, N s; empty unless it has been
    /// asked for.
    magnitudes: Vec<S>,
    /// The largest residual of the momentum balances where the step was closed, N s.
    final_residual: S,
    /// What kept the last update from being applied in full.
    obstacle: Option<StateError>,
    /// The element whose own energy balance was off by most when it was last asked.
    worst: Option<Element>,
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
        let sites = Sites {
            layout,
            conduction,
            tangent: &tangent,
            secant: None,
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
            trial: Trial {
                displacements: points.clone(),
                rests: points.clone(),
                seen: SeenTemperatures::new(slots),
                is_start: false,
                settled: S::Mask::none(),
            },
            twice_per_step: S::zero(),
            old_force: if has_old_force {
                points.clone()
            } else {
                Vec::new()
            },
            per_length: vec![S::one(); masses.len()],
            has_other_starts: false,
            anchors: masses.anchors().collect(),
            magnitudes: Vec::with_capacity(if scheme.is_exact() { masses.len() } else { 0 }),
            final_residual: S::zero(),
            obstacle: None,
            worst: None,
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
            secant: None,
            shift: [0; 2],
        }
    }

    /// Newton's method from the trial state. Where S is several numbers, those that are done keep
    /// what they have found until the last one is.
    ///
    /// A step is taken at a trial where the elements have been evaluated, when the last update is small
    /// and what is closed from there proves its laws. Otherwise the iteration goes on until rounding
    /// stops it.
    fn converge(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
        target: &mut Target<'_, S>,
    ) -> Result<Option<Certificate<S>>, StepFailure> {
        let NewtonSettings {
            max_iterations,
            tolerance,
        } = effort.settings;
        let tolerance = target.tolerance(tolerance);
        let mut before = None;
        let mut purpose = Purpose::Iterate;
        let mut progress = Progress::new();
        // Those that are done, and those for which the next look is the last.
        let (mut settled, mut last) = (S::Mask::none(), S::Mask::none());
        for left in (0..=max_iterations).rev() {
            let is_full = self.advance(groups, view, purpose)?;
            if is_full && purpose == Purpose::Close {
                match self.conclude(groups, view, target, &mut progress) {
                    Conclusion::Found(certificate) => {
                        effort.conclude(self.final_residual);
                        return Ok(certificate);
                    }
                    Conclusion::Refused(failure) => return Err(failure),
                    Conclusion::Open(is_enough) => {
                        settled = self.settle(is_enough);
                        last = S::Mask::none();
                        before = effort.history.last().map(|last| last.update);
                        self.linearize_again(groups, view)?;
                    }
                }
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
            let previous = before.replace(update).filter(|_| is_full);
            purpose = Purpose::Iterate;
            let ends = is_last(update, previous, tolerance) & !settled;
            let is_stuck = self.scheme.is_exact() && progress.is_stuck(update, previous, settled);
            if S::LANES > 1 && is_stuck {
                // Alone, some of them might go on from here otherwise than others.
                break;
            }
            if self.has_other_starts && progress.is_hopeless() {
                break;
            }
            last = ends;
            if is_stuck || (ends.any() && (settled | last).all()) {
                purpose = Purpose::Close;
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
        purpose: Purpose,
    ) -> Result<bool, StepFailure> {
        if self.obstacle.is_some() {
            self.obstacle = None;
        }
        let (mut share, mut goes_on) = (S::one(), purpose == Purpose::Iterate);
        while let Err(error) = self.evaluate(groups, view, goes_on) {
            share = self.retreat(groups, share, error)?;
            goes_on = true;
        }
        Ok(share.equal(S::one()).all())
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
        if S::LANES > 1 || share.at_most(natural_power(half, HALVINGS)).all() {
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
enum Purpose {
    /// Another iteration.
    Iterate,
    /// Closing the step.
    Close,
}

//! The reference: two independent discretisations whose difference bounds their errors.
//!
//! Both are schemes of the library, of the same order but with different equations: one is Gauss collocation on q, p, γ
//! and s, the other an action by Simpson's rule. They share the elements' formulas and Newton's method, but no source of
//! errors. So where they agree, the error of each is at most of the size of the difference. Their first step is the
//! smallest step of all settings divided by `r`, with `r^p ≥ 100` for their order p, so that a setting of the same order
//! has at least a hundred times the error of the reference. The step is halved until the difference is at most a hundredth of
//! each error of a setting, until halving no longer helps, or up to a limit.

use crate::course::{Build, Course, NoEnd, Watched, run};
use crate::progress::Progress;
use crate::quantity::{DOUBT, EndState, PerQuantity, StateQuantity};
use eem_runtime::{RocketError, SceneError, Scheme, StepError};

/// Two schemes of one order.
#[derive(Clone, Copy, Debug)]
struct Pair {
    schemes: [Scheme; 2],
    /// `r`, the smallest step of all settings divided by the first step: 4⁴ ≥ 100, 16² ≥ 100.
    first: u32,
}

const FOURTH_ORDER: Pair = Pair {
    schemes: [Scheme::Gauss4, Scheme::Variational4],
    first: 4,
};

/// For scenes with solids, rockets or dashpots in parallel with springs, which those schemes do not step.
const SECOND_ORDER: Pair = Pair {
    schemes: [Scheme::EemEntropy, Scheme::Midpoint],
    first: 16,
};

/// Halving a step helps if it reduces the difference at least to this fraction; in second order it becomes a quarter.
const HELPS: f64 = 0.5;

/// Why the references were not refined further.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReferenceEnd {
    /// They agree to a hundredth of every error.
    Agreed,
    /// Smaller steps do not bring them closer: the remaining difference is rounding, amplified along the motion.
    /// For a chaotic motion it is large.
    Floor,
    /// The steps are as small as [`Study::refinement`](crate::Study::refinement) allows.
    Limit,
    /// One of them failed with its smallest steps.
    Failed(StepError),
    /// The user provided them.
    Given,
}

/// The two reference solutions and their difference.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct StudyReference {
    /// The states at the end time; errors are differences from the first. `None` if they failed.
    pub states: Option<[EndState; 2]>,
    /// Their schemes, unless they were given.
    pub schemes: Option<[Scheme; 2]>,
    /// Their step, s, unless they were given.
    pub step: Option<f64>,
    /// Why they were not refined further.
    pub end: ReferenceEnd,
}

impl StudyReference {
    /// The relative difference of the two references; infinite if they failed. `None` if the scene has no such
    /// quantity.
    #[must_use]
    pub fn doubt(&self, quantity: StateQuantity) -> Option<f64> {
        match &self.states {
            Some([first, second]) => second.difference(first, quantity),
            None => Some(f64::INFINITY),
        }
    }

    /// The relative differences of the references in all kinds of quantities.
    pub(crate) fn doubts(&self) -> PerQuantity {
        StateQuantity::ALL.map(|quantity| self.doubt(quantity))
    }

    /// The differences of a state from the first reference; not a number if the references failed.
    pub(crate) fn differences(&self, state: &EndState) -> PerQuantity {
        if let Some([first, _]) = &self.states {
            return state.differences(first);
        }
        let unknown = |quantity| (!state.values(quantity).is_empty()).then_some(f64::NAN);
        StateQuantity::ALL.map(unknown)
    }

    /// The kinds of quantities in which the references differ too much to state the error of one of these states.
    fn open(&self, ends: &[EndState]) -> [bool; 4] {
        let doubts = self.doubts();
        let mut open = [false; 4];
        for end in ends {
            for (index, difference) in self.differences(end).into_iter().enumerate() {
                let (Some(difference), Some(doubt)) = (difference, doubts[index]) else {
                    continue;
                };
                open[index] |= difference.is_finite() && doubt > DOUBT * difference;
            }
        }
        open
    }
}

/// The settings of a search for references.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search<'a> {
    /// The end time, s.
    pub(crate) end_time: f64,
    /// The largest number of steps of a setting.
    pub(crate) finest: u32,
    /// The largest factor by which the steps may be smaller than those.
    pub(crate) refinement: u32,
    /// The end states of all settings.
    pub(crate) ends: &'a [EndState],
}

impl Search<'_> {
    /// Refines two runs until they agree, or cannot.
    pub(crate) fn run<const D: usize>(
        self,
        build: &Build<'_, D>,
        progress: &mut Progress<'_>,
    ) -> Result<StudyReference, NoEnd> {
        let mut pair = FOURTH_ORDER;
        let mut found: Option<StudyReference> = None;
        let mut factor = pair.first;
        loop {
            let Some(steps) = self.steps(factor, pair) else {
                return Ok(found.unwrap_or(StudyReference {
                    states: None,
                    schemes: Some(pair.schemes),
                    step: None,
                    end: ReferenceEnd::Limit,
                }));
            };
            let planned = 2 * u64::from(steps);
            progress.plan(planned);
            let next = match solve(build, pair.schemes, (steps, self.end_time), progress) {
                Err(NoEnd::Scene(
                    SceneError::NotForSolids { .. }
                    | SceneError::NoDrag { .. }
                    | SceneError::Rocket(RocketError::Scheme { .. }),
                )) if pair.first == FOURTH_ORDER.first => {
                    pair = SECOND_ORDER;
                    factor = pair.first;
                    progress.drop_planned(planned);
                    continue;
                }
                result => result?,
            };
            let (next, is_done) = self.judge(found, next);
            if is_done {
                return Ok(next);
            }
            found = Some(next);
            factor = factor.saturating_mul(2);
        }
    }

    /// The number of steps if each is `factor` times smaller than the smallest of all settings; `None` beyond the limit,
    /// which never excludes the first factor.
    fn steps(&self, factor: u32, pair: Pair) -> Option<u32> {
        let is_within = factor <= self.refinement.max(pair.first);
        self.finest.checked_mul(factor).filter(|_| is_within)
    }

    /// The better one of two pairs of references, and whether the search ends with it.
    fn judge(
        &self,
        before: Option<StudyReference>,
        mut next: StudyReference,
    ) -> (StudyReference, bool) {
        let open = next.open(self.ends);
        if next.states.is_some() && !open.contains(&true) {
            next.end = ReferenceEnd::Agreed;
            return (next, true);
        }
        let Some(mut before) = before.filter(|before| before.states.is_some()) else {
            return (next, false);
        };
        if next.states.is_none() {
            before.end = next.end;
            return (before, true);
        }
        let doubts = [before.doubts(), next.doubts()];
        let is_helped = (0..open.len()).any(|index| {
            let pair = doubts[0][index].zip(doubts[1][index]);
            open[index] && pair.is_some_and(|(old, new)| new <= HELPS * old)
        });
        if !is_helped {
            next.end = ReferenceEnd::Floor;
        }
        (next, !is_helped)
    }
}

/// A pair of runs.
fn solve<const D: usize>(
    build: &Build<'_, D>,
    schemes: [Scheme; 2],
    (steps, end_time): (u32, f64),
    progress: &mut Progress<'_>,
) -> Result<StudyReference, NoEnd> {
    let mut end = |scheme| {
        let course = Course::equal(scheme, steps, end_time);
        let finished = run(build, &course, Watched::Momenta, progress);
        finished.map(|finished| finished.end)
    };
    let (states, end) = match (end(schemes[0])?, end(schemes[1])?) {
        (Ok(first), Ok(second)) => (Some([first, second]), ReferenceEnd::Limit),
        (Err(error), _) | (_, Err(error)) => (None, ReferenceEnd::Failed(error)),
    };
    Ok(StudyReference {
        states,
        schemes: Some(schemes),
        step: Some(end_time / f64::from(steps)),
        end,
    })
}

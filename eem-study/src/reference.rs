//! What is taken for the exact state at the end time: two solutions that know nothing of each other.
//!
//! Both are runs of a scheme of the library, of the same order but with other equations: in one Gauss
//! collocation on q, p, γ and s, in the other an action by Simpson's rule. They share the elements' formulas and
//! Newton's method, and nothing of what makes their errors. Where they agree, the error of each is therefore of
//! the size of the difference at most. Their step is the smallest of all settings over `r`, `r^p ≥ 100` with
//! their order p, so that an error of a setting of the same order is a hundred times that of the reference;
//! then it is halved until the difference is at most a hundredth of each error that it has to judge, until
//! halving no longer helps, or up to a limit.

use crate::course::{Build, Course};
use crate::grid::Grid;
use crate::measure::end_state;
use crate::quantity::{EndState, PerQuantity, StateQuantity};
use crate::statement::DOUBT;
use eem_runtime::RocketError;
use eem_runtime::SceneError;
use eem_runtime::Scheme;
use eem_runtime::StepError;

/// Two schemes of one order.
#[derive(Clone, Copy, Debug)]
struct Pair {
    schemes: [Scheme; 2],
    /// How many times smaller than the smallest step the first ones are: 4⁴ ≥ 100, 16² ≥ 100.
    first: u32,
}

const FOURTH_ORDER: Pair = Pair {
    schemes: [Scheme::Gauss4, Scheme::Variational4],
    first: 4,
};

/// For scenes with solids or rockets, which those schemes do not step.
const SECOND_ORDER: Pair = Pair {
    schemes: [Scheme::EemEntropy, Scheme::Midpoint],
    first: 16,
};

/// Halving a step has helped if the references are so much closer then; a scheme of second order comes closer by 4.
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
    /// They were given.
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
    /// Two states that were given.
    pub(crate) const fn given(states: [EndState; 2]) -> Self {
        Self {
            states: Some(states),
            schemes: None,
            step: None,
            end: ReferenceEnd::Given,
        }
    }

    /// The relative difference of the two references; infinite if they failed. `None` if the scene has no such
    /// quantity.
    #[must_use]
    pub fn doubt(&self, quantity: StateQuantity) -> Option<f64> {
        match &self.states {
            Some([first, second]) => second.difference(first, quantity),
            None => Some(f64::INFINITY),
        }
    }

    /// The same for every kind.
    pub(crate) fn doubts(&self) -> PerQuantity {
        StateQuantity::ALL.map(|quantity| self.doubt(quantity))
    }

    /// The difference of a state from the first of the two; not a number if they failed.
    pub(crate) fn differences(&self, state: &EndState) -> PerQuantity {
        if let Some([first, _]) = &self.states {
            return state.differences(first);
        }
        let unknown = |quantity| (!state.values(quantity).is_empty()).then_some(f64::NAN);
        StateQuantity::ALL.map(unknown)
    }

    /// The kinds in which two references are too far from each other for one of the errors of these states.
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

/// What a search for references goes by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search<'a> {
    /// s.
    pub(crate) end_time: f64,
    /// The most steps of a setting.
    pub(crate) finest: u32,
    /// How many times smaller the steps may be.
    pub(crate) refinement: u32,
    /// The ends of all settings.
    pub(crate) ends: &'a [EndState],
}

impl Search<'_> {
    /// Refines two runs until they agree, or cannot. Calls `note` with the steps that come, `(planned, 0)`,
    /// and with those that are done, `(0, made)`.
    pub(crate) fn run<const D: usize>(
        self,
        build: &Build<'_, D, f64>,
        mut note: impl FnMut(u64, u64),
    ) -> Result<StudyReference, SceneError> {
        let mut pair = FOURTH_ORDER;
        let mut found: Option<StudyReference> = None;
        let mut factor = pair.first;
        loop {
            let Some(grid) = self.grid(factor, pair) else {
                return Ok(limited(found, pair));
            };
            let planned = 2 * u64::from(grid.steps);
            note(planned, 0);
            let next = match solve(build, (pair, self.end_time), grid) {
                Err(
                    SceneError::NotForSolids { .. }
                    | SceneError::Rocket(RocketError::Scheme { .. }),
                ) if pair.first == FOURTH_ORDER.first => {
                    pair = SECOND_ORDER;
                    factor = pair.first;
                    note(0, planned);
                    continue;
                }
                result => result?,
            };
            note(0, planned);
            let (next, is_done) = self.judge(found, next);
            if is_done {
                return Ok(next);
            }
            found = Some(next);
            factor = factor.saturating_mul(2);
        }
    }

    /// The steps of references, `factor` times smaller than the smallest; `None` beyond the limit. The first
    /// are always allowed.
    fn grid(&self, factor: u32, pair: Pair) -> Option<Grid> {
        if factor > self.refinement.max(pair.first) {
            return None;
        }
        Grid::divided(self.end_time, u64::from(self.finest) * u64::from(factor))
    }

    /// Which of two pairs of references to go on with, and whether it is good enough or as good as can be.
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
        let pairs = before.doubts().into_iter().zip(next.doubts()).zip(open);
        let helps = |((old, new), is_open): ((Option<f64>, Option<f64>), bool)| {
            let (Some(old), Some(new)) = (old, new) else {
                return false;
            };
            is_open && new <= HELPS * old
        };
        let is_helped = pairs.into_iter().any(helps);
        if !is_helped {
            next.end = ReferenceEnd::Floor;
        }
        (next, !is_helped)
    }
}

/// A pair of runs.
fn solve<const D: usize>(
    build: &Build<'_, D, f64>,
    (pair, end_time): (Pair, f64),
    grid: Grid,
) -> Result<StudyReference, SceneError> {
    let [first, second] = pair
        .schemes
        .map(|scheme| Course::on_grid(scheme, grid, end_time));
    let states = (end_state(build, &first)?, end_state(build, &second)?);
    let (states, end) = match states {
        (Ok(first), Ok(second)) => (Some([first, second]), ReferenceEnd::Limit),
        (Err(error), _) | (_, Err(error)) => (None, ReferenceEnd::Failed(error)),
    };
    Ok(StudyReference {
        states,
        schemes: Some(pair.schemes),
        step: Some(grid.step),
        end,
    })
}

/// The finest references within the limit.
fn limited(found: Option<StudyReference>, pair: Pair) -> StudyReference {
    found.unwrap_or(StudyReference {
        states: None,
        schemes: Some(pair.schemes),
        step: None,
        end: ReferenceEnd::Limit,
    })
}

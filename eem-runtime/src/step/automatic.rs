//! Which scheme takes least to follow a motion: an explicit one, or an implicit one.
//!
//! An explicit scheme is the cheaper one until stability, and not accuracy, limits its steps. Where it does, one
//! step of an implicit scheme is tried, so long that it would be the cheaper one; it is gone on with if that step is
//! accurate. From time to time the explicit scheme is tried for some steps again, and gone on with if it took
//! less for the same time. After a trial that failed the next one waits twice as long, so that trials never take
//! more than a share of a run.
//!
//! Effort is counted and not measured, so that two runs take the same steps.

use crate::algebra::system::MOST_FIXED;
use crate::element::tableau::Tableau;
use crate::step::control::Tolerance;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::Real;

/// The relative tolerance from which on order 2 takes less than order 6 where steps are limited by stability.
const ROUGH: f64 = 1e-4;

/// Steps between two looks at the fastest motion.
const LOOK_EVERY: u32 = 10;

/// Looks in succession at which stability limits the steps, or finds that some failed, before another scheme is tried.
const LIMITED_LOOKS: u32 = 2;

/// The share of the longest stable step, by a bound, from which on stability limits it.
const NEARLY_UNSTABLE: f64 = 0.6;

/// How much cheaper an implicit step has to be to be tried, and the explicit one to be gone on with.
const MARGIN: f64 = 1.5;

/// Iterations of Newton's method in a step that has not been made yet, and the steps of one in two halves.
const ITERATIONS: f64 = 4.0;
const PARTS: f64 = 3.0;

/// Trials wait until the effort is so many times that of one.
const PATIENCE: f64 = 4.0;

/// Explicit steps of a trial, unless they take so many times as much as implicit ones.
const TRIAL_STEPS: u32 = 6;
const HOPELESS: f64 = 4.0;

/// By how much implicit steps change when the motion has become another one.
const OTHER_MOTION: f64 = 4.0;

/// What the evaluations of an explicit trial, and of building elements twice, come to.
const EXPLICIT_TRIAL: f64 = 400.0;

/// How much of what is known of earlier steps is left after another one.
const MEMORY: f64 = 0.8;

/// The scheme with which a run begins that was asked for this one.
pub(crate) const fn first(asked: Scheme, is_second: bool) -> Scheme {
    match asked {
        Scheme::Auto if is_second => Scheme::EemTemperature,
        Scheme::Auto => Scheme::EemExplicit,
        own => own,
    }
}

/// The implicit scheme for a tolerance.
pub(crate) fn implicit<S: Real>(tolerance: &Tolerance<S>, is_second: bool) -> Scheme {
    let is_rough = tolerance.relative.to_f64() >= ROUGH;
    if is_rough || is_second {
        Scheme::EemTemperature
    } else {
        Scheme::EemEntropy6
    }
}

/// All that are tried where one does not find a step, in this order.
pub(crate) const CANDIDATES: [Scheme; 4] = [
    Scheme::EemTemperature,
    Scheme::EemEntropy,
    Scheme::EemEntropy6,
    Scheme::EemExplicit,
];

/// What an evaluation of all elements by a scheme takes, with its share of a solution for so many unknowns, in
/// evaluations by the explicit scheme; measured on pendulums and on a chain of 16 springs.
fn weight(scheme: Scheme, unknowns: usize) -> f64 {
    let dense = match scheme {
        Scheme::EemExplicit => return 1.0,
        Scheme::EemTemperature => 2.0,
        Scheme::EemEntropy => 3.0,
        _ => 6.0,
    };
    if unknowns > MOST_FIXED {
        8.0 * dense
    } else {
        dense
    }
}

fn stages(scheme: Scheme) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "at most three")]
    let stages = scheme.tableau().map_or(1, Tableau::stages) as f64;
    stages
}

/// What a run with [`Scheme::Auto`] remembers of its schemes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Choice {
    /// Effort and time, s, of the last steps of the present scheme, earlier ones counting less.
    recent: [f64; 2],
    /// Steps of the present scheme.
    steps: u32,
    /// Looks in succession at which stability limited the steps, or since which a step had failed.
    limited: u32,
    /// Steps that had failed at the last look.
    failures: u64,
    /// Effort per time, 1/s, and last step, s, of the scheme before it.
    before: [f64; 2],
    /// Whether the present scheme is the explicit one on trial.
    is_on_trial: bool,
    /// The size of implicit steps when the explicit scheme was tried in vain, s; zero before.
    tried: f64,
    /// All effort so far, that from which on the other kind may be tried, and that between two trials; none before
    /// the first.
    spent: f64,
    due: f64,
    wait: Option<f64>,
}

/// What has been learnt of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// Nothing yet, or there is no trial.
    None,
    /// The present scheme is gone on with.
    Keep,
    /// The one before it is gone on with, in steps of this size, s.
    Return(f64),
}

impl Choice {
    /// All numbers, none of which is ever negative or infinite.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        let pairs = [self.recent, self.before, [self.spent, self.due]];
        let on_trial = f64::from(u8::from(self.is_on_trial));
        let single = [Some(self.tried), self.wait, Some(on_trial)];
        pairs
            .into_iter()
            .flatten()
            .chain(single.into_iter().flatten())
    }

    /// Before the first step.
    pub(crate) const fn new() -> Self {
        Self {
            recent: [0.0; 2],
            steps: 0,
            limited: 0,
            failures: 0,
            before: [0.0; 2],
            is_on_trial: false,
            tried: 0.0,
            spent: 0.0,
            due: 0.0,
            wait: None,
        }
    }

    /// Takes in what a scheme with so many unknowns did: its evaluations, and the time that they were for, s; none for
    /// steps that were not kept.
    pub(crate) fn note(
        &mut self,
        (scheme, unknowns): (Scheme, usize),
        evaluations: u64,
        time: f64,
    ) {
        #[expect(clippy::cast_precision_loss, reason = "a count of far less than 2⁵³")]
        let effort = weight(scheme, unknowns) * evaluations as f64;
        self.spent += effort;
        let [sum, span] = self.recent;
        self.recent = [MEMORY * sum + effort, MEMORY * span + time];
        if time > 0.0 {
            self.steps = self.steps.saturating_add(1);
        }
    }

    /// Effort per time of the present scheme, 1/s.
    fn rate(&self) -> f64 {
        self.recent[0] / self.recent[1]
    }

    /// Whether it is time to look how fast the fastest motion is.
    pub(crate) const fn looks(&self) -> bool {
        self.steps > 0 && self.steps.is_multiple_of(LOOK_EVERY)
    }

    /// Takes in such a look: what share of the longest stable step the present one is, and how many steps have
    /// failed so far.
    pub(crate) const fn see(&mut self, share: f64, failures: u64) {
        let has_failed = failures > self.failures;
        self.failures = failures;
        self.limited = if share > NEARLY_UNSTABLE || has_failed {
            self.limited + 1
        } else {
            0
        };
    }

    /// The size of an implicit step that would be cheaper than explicit ones over the same time, if it is time
    /// to try one, s.
    pub(crate) fn implicit_trial(&mut self, scheme: Scheme, unknowns: usize) -> Option<f64> {
        if self.limited < LIMITED_LOOKS {
            return None;
        }
        let effort = PARTS * ITERATIONS * weight(scheme, unknowns) * stages(scheme);
        if self.wait.is_none() {
            self.wait_for(PATIENCE * effort);
        }
        (self.spent >= self.due).then(|| MARGIN * effort / self.rate())
    }

    /// Whether the explicit scheme is to be tried again, where implicit steps have this size, s.
    pub(crate) fn tries_explicit(&mut self, size: f64) -> bool {
        let alike = self.tried / OTHER_MOTION..=self.tried * OTHER_MOTION;
        if self.tried > 0.0 && !alike.contains(&size) {
            // What the last trial has shown does not count any more.
            self.tried = size;
            self.wait_for(PATIENCE * EXPLICIT_TRIAL);
        }
        self.spent >= self.due
    }

    /// Another scheme is gone on with, after steps of this size, s.
    pub(crate) fn change(&mut self, last: f64) {
        self.leave(last);
        self.is_on_trial = false;
        self.tried = 0.0;
        self.wait_for(PATIENCE * EXPLICIT_TRIAL);
    }

    /// The explicit scheme is on trial, after steps of this size, s; the size of its own last ones, s.
    pub(crate) fn begin_trial(&mut self, last: f64) -> f64 {
        let [_, own] = self.before;
        self.leave(last);
        self.is_on_trial = true;
        own
    }

    fn leave(&mut self, last: f64) {
        self.before = [self.rate(), last];
        self.recent = [0.0; 2];
        (self.steps, self.limited) = (0, 0);
    }

    /// What has been learnt of the explicit scheme on trial.
    pub(crate) fn judge(&mut self, present: f64) -> Verdict {
        let [rate, last] = self.before;
        let is_hopeless = self.steps > 0 && self.rate() > HOPELESS * rate;
        if !self.is_on_trial || !is_hopeless && self.steps < TRIAL_STEPS {
            return Verdict::None;
        }
        self.is_on_trial = false;
        if MARGIN * self.rate() < rate {
            self.wait = None;
            return Verdict::Keep;
        }
        self.leave(present);
        self.recent = [rate * last, last];
        self.tried = last;
        self.wait_longer();
        Verdict::Return(last)
    }

    /// A trial failed.
    pub(crate) fn wait_longer(&mut self) {
        self.limited = 0;
        self.wait_for(2.0 * self.wait.unwrap_or_default());
    }

    fn wait_for(&mut self, effort: f64) {
        self.wait = Some(effort);
        self.due = self.spent + effort;
    }
}

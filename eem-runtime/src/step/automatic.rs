//! The choice between explicit and implicit schemes by their cost.
//!
//! An explicit scheme is cheaper until stability, and not accuracy, limits its steps. Then one step of an implicit scheme is
//! tried, so long that it would be cheaper; the run continues with that scheme if the step is accurate. From time to time
//! the explicit scheme is tried for some steps again, and kept if it took less effort for the same time. The wait doubles
//! after each failed trial, so that trials take a bounded fraction of a run.
//!
//! Effort is counted and not measured, so that two runs take the same steps.

use crate::algebra::system::MOST_FIXED;
use crate::element::tableau::Tableau;
use crate::step::control::Tolerance;
use crate::step::scheme::Scheme;

/// The relative tolerance above which order 2 is cheaper than order 6 where stability limits the steps.
const ROUGH: f64 = 1e-4;

/// Steps between two checks of the fastest motion.
const LOOK_EVERY: u32 = 10;

/// Checks in succession that find steps limited by stability or failed, before another scheme is tried.
const LIMITED_LOOKS: u32 = 2;

/// A step above this fraction of the bound for the longest stable one is limited by stability.
const NEARLY_UNSTABLE: f64 = 0.6;

/// Cost ratio required before switching, in either direction.
const MARGIN: f64 = 1.5;

/// Expected Newton iterations of a step, and the steps of an error estimate: one, and its two halves.
const ITERATIONS: f64 = 4.0;
const PARTS: f64 = 3.0;

/// Trials wait for this multiple of their own effort.
const PATIENCE: f64 = 4.0;

/// Explicit steps of a trial, and the cost ratio at which it ends early.
const TRIAL_STEPS: u32 = 6;
const HOPELESS: f64 = 4.0;

/// The ratio of the sizes of implicit steps above which the motion counts as a different one.
const OTHER_MOTION: f64 = 4.0;

/// The effort of an explicit trial, including building the elements twice.
const EXPLICIT_TRIAL: f64 = 400.0;

/// The factor by which each step reduces the weight of the earlier ones.
const MEMORY: f64 = 0.8;

/// The scheme with which a run set to `asked` begins; some scenes need an implicit scheme of order 2.
pub(crate) const fn first(asked: Scheme, needs_second: bool) -> Scheme {
    match asked {
        Scheme::Auto if needs_second => Scheme::EemTemperature,
        Scheme::Auto => Scheme::EemExplicit,
        own => own,
    }
}

/// The implicit scheme for a tolerance.
pub(crate) fn implicit(tolerance: &Tolerance, needs_second: bool) -> Scheme {
    let is_rough = tolerance.relative >= ROUGH;
    if is_rough || needs_second {
        Scheme::EemTemperature
    } else {
        Scheme::EemEntropy6
    }
}

/// The schemes that are tried, in this order, if the present one finds no step.
pub(crate) const CANDIDATES: [Scheme; 4] = [
    Scheme::EemTemperature,
    Scheme::EemEntropy,
    Scheme::EemEntropy6,
    Scheme::EemExplicit,
];

/// The effort of evaluating all elements and solving for the unknowns, in units of an evaluation by the explicit scheme;
/// measured on pendulums and on a chain of 16 springs.
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

/// The history of schemes in a run with [`Scheme::Auto`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Choice {
    /// Effort and time, s, of the last steps of the present scheme, earlier ones counting less.
    pub(crate) recent: [f64; 2],
    /// Steps of the present scheme.
    pub(crate) steps: u32,
    /// Checks in succession that found steps limited by stability or failed.
    pub(crate) limited: u32,
    /// Failed steps at the last check.
    pub(crate) failures: u64,
    /// Effort per time, 1/s, and last step, s, of the previous scheme.
    pub(crate) before: [f64; 2],
    /// Whether the present scheme is the explicit one on trial.
    pub(crate) is_on_trial: bool,
    /// The size of implicit steps at the last failed trial of the explicit scheme, s; zero before.
    pub(crate) tried: f64,
    /// All effort so far, the effort from which on the next trial may begin, and that between two trials, `None` before the
    /// first.
    pub(crate) spent: f64,
    pub(crate) due: f64,
    pub(crate) wait: Option<f64>,
}

/// The outcome of a trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// Not decided, or there is no trial.
    None,
    /// Continue with the present scheme.
    Keep,
    /// Return to the previous scheme, with steps of this size, s.
    Return(f64),
}

impl Choice {
    /// All numbers except counts; valid ones are finite and not negative.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        let ([a, b], [c, d]) = (self.recent, self.before);
        let on_trial = f64::from(u8::from(self.is_on_trial));
        let all = [a, b, c, d, self.spent, self.due, self.tried];
        all.into_iter().chain(self.wait).chain([on_trial])
    }

    /// All counts.
    pub(crate) fn counts(&self) -> [u64; 3] {
        [self.steps.into(), self.limited.into(), self.failures]
    }

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

    /// Adds the effort of evaluations by a scheme. The time, s, is that of the step, zero if it was rejected.
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

    /// Whether the fastest motion is due for a check.
    pub(crate) const fn looks(&self) -> bool {
        self.steps > 0 && self.steps.is_multiple_of(LOOK_EVERY)
    }

    /// Takes the result of a check: the present step as a fraction of the longest stable one, and the number of failed steps
    /// so far.
    pub(crate) const fn see(&mut self, fraction: f64, failures: u64) {
        let has_failed = failures > self.failures;
        self.failures = failures;
        self.limited = if fraction > NEARLY_UNSTABLE || has_failed {
            self.limited + 1
        } else {
            0
        };
    }

    /// The size of an implicit step that would be cheaper than explicit ones over the same time, if a trial is due, s.
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

    /// Whether a trial of the explicit scheme is due, for implicit steps of this size, s.
    pub(crate) fn tries_explicit(&mut self, size: f64) -> bool {
        let alike = self.tried / OTHER_MOTION..=self.tried * OTHER_MOTION;
        if self.tried > 0.0 && !alike.contains(&size) {
            // The last trial was for another motion.
            self.tried = size;
            self.wait_for(PATIENCE * EXPLICIT_TRIAL);
        }
        self.spent >= self.due
    }

    /// Switches to another scheme, after steps of this size, s.
    pub(crate) fn change(&mut self, last: f64) {
        self.leave(last);
        self.is_on_trial = false;
        self.tried = 0.0;
        self.wait_for(PATIENCE * EXPLICIT_TRIAL);
    }

    /// Starts a trial of the explicit scheme after steps of this size, s; returns the last step of the previous scheme, s.
    pub(crate) fn begin_trial(&mut self, last: f64) -> f64 {
        let [_, previous] = self.before;
        self.leave(last);
        self.is_on_trial = true;
        previous
    }

    fn leave(&mut self, last: f64) {
        self.before = [self.rate(), last];
        self.recent = [0.0; 2];
        (self.steps, self.limited) = (0, 0);
    }

    /// The outcome of the trial of the explicit scheme so far, given the size of its present step, s.
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

    /// Doubles the wait after a failed trial.
    pub(crate) fn wait_longer(&mut self) {
        self.limited = 0;
        self.wait_for(2.0 * self.wait.unwrap_or_default());
    }

    fn wait_for(&mut self, effort: f64) {
        self.wait = Some(effort);
        self.due = self.spent + effort;
    }
}

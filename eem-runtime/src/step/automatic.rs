//! The choice among the exact schemes by their cost.
//!
//! Two things can make another scheme cheaper than the present one:
//!
//! - An explicit scheme is usually cheaper until stability, and not accuracy, limits its steps. Then one step of an implicit scheme
//!   is tried; much later also where nothing is known to limit them, as the formula below may be wrong. From time to time the explicit scheme is tried for some steps again, and kept if it took less effort for the same
//!   time.
//! - Which order is cheaper depends on the tolerance: errors of `(h/T)ᵖ⁺¹` that shall be `r^(1 + 1/p)` allow the step
//!   `h = T r^(1/p)`, with the time scale T of the motion. For a motion that is stiff or not smooth this is wrong. So the
//!   formula only decides which scheme is tried first and how soon; one step decides whether it is kept.
//!
//! The one step of an implicit scheme is so long that it would be cheaper than the present scheme over the same time; the run
//! continues with that scheme if the step is accurate. Each failed trial doubles the wait for the next one of its kind, so that
//! trials take a bounded fraction of a run.
//!
//! Effort is counted and not measured, so that two runs take the same steps.

use crate::algebra::system::MOST_FIXED;
use crate::element::tableau::Tableau;
use crate::step::control::Tolerance;
use crate::step::scheme::Scheme;

/// The relative tolerance from which on order 2 is tried first where stability limits the steps.
const ROUGH: f64 = 1e-4;

/// Steps between two checks of the fastest motion.
const LOOK_EVERY: u32 = 10;

/// Checks in succession that find steps limited by stability or failed, before another scheme is tried.
const LIMITED_LOOKS: u32 = 2;

/// A step above this fraction of the bound for the longest stable one is limited by stability.
const NEARLY_UNSTABLE: f64 = 0.6;

/// Steps that grow by more than this factor are not yet limited by their error, so that their cost says nothing.
const GROWING: f64 = 1.5;

/// Cost ratio required before switching, in either direction.
const MARGIN: f64 = 1.5;

/// Expected Newton iterations of a step, and the steps of an error estimate: one, and its two halves.
const ITERATIONS: f64 = 4.0;
const PARTS: f64 = 3.0;

/// Trials wait for this multiple of their own effort.
const PATIENCE: f64 = 4.0;

/// Where stability limits the explicit scheme, one in so many trials is not of the first candidate.
const CYCLE: usize = 4;

/// Explicit steps of a trial, and the cost ratio at which it ends early.
const TRIAL_STEPS: u32 = 6;
const HOPELESS: f64 = 4.0;

/// The ratio of the sizes of implicit steps above which the motion counts as a different one.
const OTHER_MOTION: f64 = 4.0;

/// The effort of an explicit trial, including building the elements twice.
const EXPLICIT_TRIAL: f64 = 400.0;

/// The factor by which each step reduces the weight of the earlier ones.
const MEMORY: f64 = 0.8;

/// The schemes with which a run can begin: the first one that can step the scene.
pub(crate) const FIRST: [Scheme; 2] = [Scheme::EemExplicit, Scheme::EemTemperature];

/// The schemes among which `Scheme::Auto` chooses, in the order in which they are tried if the present one finds no step.
pub(crate) const CANDIDATES: [Scheme; 5] = [
    Scheme::EemTemperature,
    Scheme::EemEntropy,
    Scheme::EemEntropy6,
    Scheme::EemEntropy4,
    Scheme::EemExplicit,
];

/// The implicit candidates to be tried instead of the present scheme, in this order. Where stability limits the explicit scheme,
/// only the first one and those that are likely to be cheaper: longer steps may fail slowly.
fn implicit(
    present: Scheme,
    tolerance: &Tolerance,
    unknowns: usize,
) -> impl Iterator<Item = Scheme> + Clone {
    use Scheme::{EemEntropy, EemEntropy4, EemEntropy6, EemExplicit, EemTemperature};
    let relative = tolerance.relative;
    let all = if relative >= ROUGH {
        [EemTemperature, EemEntropy6, EemEntropy4, EemEntropy]
    } else {
        [EemEntropy6, EemTemperature, EemEntropy4, EemEntropy]
    };
    let gain = move |scheme| expected_gain([all[0], scheme], unknowns, relative);
    let is_worth_it = move |&scheme: &Scheme| match present {
        EemExplicit => scheme == all[0] || gain(scheme) > MARGIN,
        _ => scheme != present,
    };
    all.into_iter().filter(is_worth_it)
}

/// The effort of evaluating all elements at a stage and solving for its unknowns, in units of an evaluation by the explicit
/// scheme; for dense systems measured on pendulums, for sparse ones on a chain of 16 springs and a block of 36 cells.
fn weight(scheme: Scheme, unknowns: usize) -> f64 {
    let [dense, sparse] = match scheme {
        Scheme::EemExplicit => return 1.0,
        Scheme::EemTemperature | Scheme::EemDamped => [2.0, 16.0],
        Scheme::EemEntropy => [3.0, 24.0],
        Scheme::EemEntropy4 => [5.0, 56.0],
        _ => [6.0, 64.0],
    };
    if unknowns > MOST_FIXED { sparse } else { dense }
}

/// The expected effort of a step of an implicit scheme with its estimate of the error.
fn effort_of_step(scheme: Scheme, unknowns: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "at most three")]
    let stages = scheme.tableau().map_or(1, Tableau::stages) as f64;
    PARTS * ITERATIONS * weight(scheme, unknowns) * stages
}

/// The cost of a smooth motion by an implicit scheme over that by another one, given the relative tolerance r: a step by r^(1/p).
fn expected_gain([present, other]: [Scheme; 2], unknowns: usize, relative: f64) -> f64 {
    let cost = |scheme: Scheme| {
        let step = relative.powf(f64::from(scheme.order()).recip());
        effort_of_step(scheme, unknowns) / step
    };
    cost(present) / cost(other)
}

/// When the next trial of a kind may begin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct TrialClock {
    /// The effort of the run from which on it may begin.
    pub(crate) due: f64,
    /// The effort between the last two, `None` before the first.
    pub(crate) wait: Option<f64>,
}

impl TrialClock {
    /// Not planned yet, given all effort so far.
    pub(crate) const fn new(spent: f64) -> Self {
        Self {
            due: spent,
            wait: None,
        }
    }

    /// Waits for this effort, given all effort so far.
    const fn wait_for(&mut self, effort: f64, spent: f64) {
        self.wait = Some(effort);
        self.due = spent + effort;
    }

    /// All effort at the last trial.
    fn last(&self) -> f64 {
        self.due - self.wait.unwrap_or_default()
    }

    /// Doubles the wait after a failed trial, and waits for at least this effort.
    fn wait_longer(&mut self, least: f64, spent: f64) {
        let doubled = 2.0 * self.wait.unwrap_or_default();
        self.wait_for(doubled.max(least), spent);
    }
}

/// The history of schemes in a run with [`Scheme::Auto`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SchemeSelection {
    /// Effort of the last steps of the present scheme and their time, s, earlier ones counting less.
    pub(crate) recent_effort: f64,
    pub(crate) recent_time: f64,
    /// Steps of the present scheme, and the size of the last one that was due, s.
    pub(crate) steps: u32,
    pub(crate) size: f64,
    /// Checks in succession that found steps limited by stability or failed.
    pub(crate) limited_checks: u32,
    /// Failed steps at the last check.
    pub(crate) failures: u64,
    /// Effort per time, 1/s, and last step, s, of the previous scheme.
    pub(crate) previous_rate: f64,
    pub(crate) previous_step: f64,
    /// Whether the present scheme is the explicit one on trial.
    pub(crate) is_on_trial: bool,
    /// The size of implicit steps at the last failed trial of the explicit scheme, s; zero before.
    pub(crate) tried_at: f64,
    /// All effort so far.
    pub(crate) spent: f64,
    /// Trials of the explicit scheme, of implicit ones, and how many of the latter have failed since the last switch.
    pub(crate) explicit_trials: TrialClock,
    pub(crate) implicit_trials: TrialClock,
    pub(crate) failed_trials: u32,
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

impl SchemeSelection {
    /// All numbers except counts; valid ones are finite and not negative.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let [explicit, implicit] = [self.explicit_trials, self.implicit_trials];
        let mut all = vec![
            self.recent_effort,
            self.recent_time,
            self.size,
            self.previous_rate,
            self.previous_step,
            self.tried_at,
            self.spent,
            explicit.due,
            implicit.due,
            f64::from(u8::from(self.is_on_trial)),
        ];
        all.extend(explicit.wait);
        all.extend(implicit.wait);
        all
    }

    /// All counts.
    pub(crate) fn counts(&self) -> [u64; 4] {
        [
            self.steps.into(),
            self.limited_checks.into(),
            self.failures,
            self.failed_trials.into(),
        ]
    }

    pub(crate) fn new() -> Self {
        Self::default()
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
        self.recent_effort = MEMORY * self.recent_effort + effort;
        self.recent_time = MEMORY * self.recent_time + time;
        if time > 0.0 {
            self.steps = self.steps.saturating_add(1);
        }
    }

    /// Effort per time of the present scheme, 1/s.
    fn rate(&self) -> f64 {
        self.recent_effort / self.recent_time
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
        let is_limited = fraction > NEARLY_UNSTABLE || has_failed;
        self.limited_checks = if is_limited {
            self.limited_checks + 1
        } else {
            0
        };
    }

    /// Takes the size of the step that is due, s. Whether the steps of the present scheme have stopped growing.
    pub(crate) fn has_settled(&mut self, size: f64) -> bool {
        let has_settled = size < GROWING * self.size;
        self.size = size;
        has_settled
    }

    /// Whether stability limits the steps of the explicit scheme.
    pub(crate) const fn is_limited(&self) -> bool {
        self.limited_checks >= LIMITED_LOOKS
    }

    /// Whether the next trial of an implicit scheme may begin; the first one is still to be planned.
    pub(crate) fn may_try_implicit(&self) -> bool {
        let clock = self.implicit_trials;
        !self.is_on_trial && (clock.wait.is_none() || self.spent >= clock.due)
    }

    /// The implicit scheme whose turn it is to be tried instead of the present one, among those that suit the scene.
    pub(crate) fn next_in_turn(
        &self,
        present: Scheme,
        (tolerance, unknowns): (&Tolerance, usize),
        suits: &dyn Fn(Scheme) -> bool,
    ) -> Option<Scheme> {
        let others = implicit(present, tolerance, unknowns);
        let mut others = others.filter(|&scheme| suits(scheme));
        let (turn, count) = (self.failed_trials as usize, others.clone().count());
        let index = match present {
            // What limits the explicit scheme may only set in, so that the cheapest trial is repeated before a long one.
            Scheme::EemExplicit if turn % CYCLE < CYCLE - 1 || count < 2 => 0,
            Scheme::EemExplicit => 1 + turn / CYCLE % (count - 1),
            _ => turn.checked_rem(count)?,
        };
        others.nth(index)
    }

    /// The size of a step of an implicit scheme that would be cheaper than the present scheme over the same time, if a trial is
    /// due, s.
    pub(crate) fn implicit_trial(
        &mut self,
        [present, scheme]: [Scheme; 2],
        unknowns: usize,
        relative: f64,
    ) -> Option<f64> {
        let effort = effort_of_step(scheme, unknowns);
        // Longer if the tolerance makes another cost likely.
        let gain = expected_gain([present, scheme], unknowns, relative);
        let is_explicit = present == Scheme::EemExplicit;
        if is_explicit && !self.is_limited() {
            let wait = self.implicit_trials.wait.unwrap_or(PATIENCE * effort);
            if self.spent < self.implicit_trials.last() + wait / gain {
                return None;
            }
            self.implicit_trials.wait = Some(wait);
            return Some(MARGIN * effort / self.rate());
        }
        if self.implicit_trials.wait.is_none() {
            // Of the explicit scheme it is known that stability limits it.
            let gain = if is_explicit { 1.0 } else { gain };
            let wait = PATIENCE * effort / gain;
            self.implicit_trials.wait_for(wait, self.spent);
        }
        let is_first = self.failed_trials == 0;
        let is_due = self.spent >= self.implicit_trials.due
            && (is_first || self.spent >= self.implicit_trials.last() + PATIENCE * effort);
        is_due.then(|| MARGIN * effort / self.rate())
    }

    /// Records a failed trial of an implicit scheme instead of the present one, given all effort before it.
    pub(crate) fn reject_implicit(&mut self, present: Scheme, before: f64) {
        self.limited_checks = 0;
        self.failed_trials = self.failed_trials.saturating_add(1);
        let least = match present {
            // It is already known that stability limits it.
            Scheme::EemExplicit => 0.0,
            _ => PATIENCE * (self.spent - before),
        };
        self.implicit_trials.wait_longer(least, self.spent);
    }

    /// Whether a trial of the explicit scheme is due, for implicit steps of this size, s.
    pub(crate) fn tries_explicit(&mut self, size: f64) -> bool {
        let alike = self.tried_at / OTHER_MOTION..=self.tried_at * OTHER_MOTION;
        if self.tried_at > 0.0 && !alike.contains(&size) {
            // The last trial was for another motion.
            self.tried_at = size;
            self.expect_explicit();
        }
        self.spent >= self.explicit_trials.due
    }

    /// Waits as long as for the first trial of the explicit scheme.
    fn expect_explicit(&mut self) {
        let wait = PATIENCE * EXPLICIT_TRIAL;
        self.explicit_trials.wait_for(wait, self.spent);
    }

    /// Switches to another scheme, after steps of this size, s.
    pub(crate) fn change(&mut self, last: f64) {
        self.leave(last);
        self.is_on_trial = false;
        self.tried_at = 0.0;
        self.failed_trials = 0;
        self.implicit_trials = TrialClock::new(self.spent);
        self.expect_explicit();
    }

    /// Starts a trial of the explicit scheme after steps of this size, s; returns the last step of the previous scheme, s.
    pub(crate) fn begin_trial(&mut self, last: f64) -> f64 {
        let previous = self.previous_step;
        self.leave(last);
        self.is_on_trial = true;
        previous
    }

    fn leave(&mut self, last: f64) {
        (self.previous_rate, self.previous_step) = (self.rate(), last);
        (self.recent_effort, self.recent_time) = (0.0, 0.0);
        (self.steps, self.size, self.limited_checks) = (0, 0.0, 0);
    }

    /// The outcome of the trial of the explicit scheme so far, given the size of its present step, s.
    pub(crate) fn judge(&mut self, present: f64) -> Verdict {
        let (rate, last) = (self.previous_rate, self.previous_step);
        let is_hopeless = self.steps > 0 && self.rate() > HOPELESS * rate;
        if !self.is_on_trial || !is_hopeless && self.steps < TRIAL_STEPS {
            return Verdict::None;
        }
        self.is_on_trial = false;
        if MARGIN * self.rate() < rate {
            self.failed_trials = 0;
            self.implicit_trials = TrialClock::new(self.spent);
            return Verdict::Keep;
        }
        self.leave(present);
        (self.recent_effort, self.recent_time) = (rate * last, last);
        self.tried_at = last;
        self.reject_explicit();
        Verdict::Return(last)
    }

    /// Records a failed trial of the explicit scheme.
    pub(crate) fn reject_explicit(&mut self) {
        self.limited_checks = 0;
        self.explicit_trials.wait_longer(0.0, self.spent);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Effort of explicit steps of 1 ms until a trial of order 6 begins, and the size of its step.
    fn first_trial(selection: &mut SchemeSelection, relative: f64) -> (f64, f64) {
        let schemes = [Scheme::EemExplicit, Scheme::EemEntropy6];
        let before = selection.spent;
        loop {
            selection.note((Scheme::EemExplicit, 2), 12, 1e-3);
            if let Some(size) = selection.implicit_trial(schemes, 2, relative) {
                return (selection.spent - before, size);
            }
        }
    }

    /// 3 parts, 4 iterations, 3 stages of weight 6: 216 evaluations for a step of r^(1/6), 12 for one of r^(1/8).
    #[test]
    fn an_explicit_scheme_that_nothing_limits_is_compared_with_order_6_in_time() {
        let relative = 1e-6_f64;
        let gain = 12.0 / relative.powf(0.125) / (216.0 / relative.powf(1.0 / 6.0));
        let mut selection = SchemeSelection::new();
        for wait in [1.0, 2.0, 4.0] {
            let (effort, size) = first_trial(&mut selection, relative);
            let expected = wait * 4.0 * 216.0 / gain;
            assert!((effort - expected).abs() <= 12.0, "{effort} {expected}");
            assert!((size - 1.5 * 216.0 / 12.0 * 1e-3).abs() < 1e-12, "{size}");
            selection.reject_implicit(Scheme::EemExplicit, selection.spent);
        }
    }
}

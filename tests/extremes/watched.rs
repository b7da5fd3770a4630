//! A run whose steps are judged one by one, and the record of it.

use eem::Checkpoint;
use eem::prelude::*;
use serde_json::Value;

use super::judge::{self, Verdict};
use super::rounding::{ROUNDINGS, share, worse};
use super::stored::Stored;
use super::world::Facts;

/// How many broken laws a record keeps the words of.
const WORDS: usize = 3;

/// A simulation under the eyes of the judge.
pub(crate) struct Watched<const D: usize> {
    pub(crate) run: Simulation<D>,
    pub(crate) facts: Facts<D>,
    state: Stored,
    pub(crate) record: Record,
}

/// What happened so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Record {
    pub(crate) steps: usize,
    pub(crate) iterations: usize,
    /// In one step.
    pub(crate) most_iterations: usize,
    /// ΔE − work − heat of the last step by the judge, J.
    pub(crate) defect: f64,
    /// 64 ε (A + A⁺) of it, J.
    pub(crate) bound: f64,
    /// The largest |defect|/bound by the judge.
    pub(crate) worst: f64,
    /// The largest |ΔE|/bound by the report.
    pub(crate) worst_reported: f64,
    /// The largest defect of a momentum, in ε of its terms.
    pub(crate) worst_momentum: f64,
    /// Steps in which it is above 64, as rounding of forces explains.
    pub(crate) loose: usize,
    /// Steps whose bound is far above the rounding of their energies.
    pub(crate) wide: usize,
    /// Steps that broke a law, and the words of the first ones.
    pub(crate) broken_steps: usize,
    pub(crate) broken: Vec<String>,
    /// The error that the run ended with.
    pub(crate) refused: Option<StepError>,
}

/// The exact schemes of at most second order, with their one force at the middle of a step, by which the judge counts
/// loads: those that the kinds of extremes are tried with. All exact ones are held to the laws.
pub(crate) const EXACT: [Scheme; 3] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Staggered,
];

/// The two energy–entropy–momentum forms.
pub(crate) const FORMS: [Scheme; 2] = [Scheme::EemEntropy, Scheme::EemTemperature];

impl<const D: usize> Watched<D> {
    pub(crate) fn new(run: Simulation<D>, facts: Facts<D>) -> Self {
        let state = Stored::of(&run);
        Self {
            run,
            facts,
            state,
            record: Record::default(),
        }
    }

    /// One step, judged if the scheme is exact. A step that fails must leave everything as it was.
    pub(crate) fn step(&mut self) -> Result<StepReport, StepError> {
        let saved = self.run.checkpoint();
        let scheme = self.run.scheme_in_use();
        match self.run.step() {
            Ok(report) => {
                // Which scheme has made the step is not known where it has changed.
                let is_same = self.run.scheme_in_use() == scheme;
                self.facts.scheme = if is_same { scheme } else { self.run.scheme() };
                self.judge(&report);
                Ok(report)
            }
            Err(error) => {
                if essence(&self.run.checkpoint()) != essence(&saved) {
                    self.record
                        .complain(vec![format!("{error}: the state has changed")]);
                }
                let explained = judge::explained(&self.facts, &self.state, &error);
                self.record.complain(explained.into_iter().collect());
                self.record.refused = Some(error.clone());
                Err(error)
            }
        }
    }

    /// Up to `count` steps, until one is refused.
    pub(crate) fn steps(&mut self, count: usize) -> &Record {
        for _ in 0..count {
            if self.step().is_err() {
                break;
            }
        }
        &self.record
    }

    fn judge(&mut self, report: &StepReport) {
        let record = &mut self.record;
        record.steps += 1;
        record.iterations += report.iterations;
        record.most_iterations = record.most_iterations.max(report.iterations);
        if !self.run.scheme().is_exact() {
            return;
        }
        let after = Stored::of(&self.run);
        let is_controlled = self.run.tolerance().is_some();
        self.facts.has_halves = is_controlled && self.run.scheme_in_use() != Scheme::EemExplicit;
        let Verdict {
            defect,
            bound,
            momentum,
            is_wide,
            broken,
            ..
        } = judge::check_step(&self.facts, &self.state, &after, report);
        record.worst = worse(record.worst, share(defect, bound));
        record.worst_reported = worse(record.worst_reported, share(defect, report.bound));
        record.worst_momentum = worse(record.worst_momentum, momentum);
        record.loose += usize::from(momentum > ROUNDINGS);
        record.wide += usize::from(is_wide);
        (record.defect, record.bound) = (defect, bound);
        record.complain(broken);
        self.state = after;
    }

    /// The state as the judge sees it, after the last step.
    pub(crate) fn stored(&self) -> &Stored {
        &self.state
    }
}

/// What a step that fails must leave as it was: all but what step control counts, and the digests of the entries, of which
/// one is of these counts.
fn essence(checkpoint: &Checkpoint) -> Value {
    let mut text = serde_json::to_value(checkpoint).expect("a checkpoint can be written");
    if let Some(Value::Object(control)) = text.get_mut("control") {
        control.remove("statistics");
        text.as_object_mut().and_then(|all| all.remove("seals"));
    }
    text
}

impl Record {
    /// Notes broken laws of one step, if there are any.
    fn complain(&mut self, broken: Vec<String>) {
        self.broken_steps += usize::from(!broken.is_empty());
        let room = WORDS.saturating_sub(self.broken.len());
        self.broken.extend(broken.into_iter().take(room));
    }

    /// Whether no law was broken by a step that was taken.
    pub(crate) fn is_lawful(&self) -> bool {
        self.broken_steps == 0
    }

    /// Why the run ended, `LawNotKept` for instance; empty if it did not.
    pub(crate) fn refusal(&self) -> String {
        let failure = self
            .refused
            .as_ref()
            .map(|error| format!("{:?}", error.failure));
        let text = failure.unwrap_or_default();
        let end = text.find([' ', '(', '{']).unwrap_or(text.len());
        let (name, rest) = text.split_at(end);
        match (name, rest.strip_prefix('(')) {
            // `State(Stretch { … })`: the inner name says more.
            ("State", Some(inner)) => inner.split([' ', '(', '{']).next().unwrap_or("").to_owned(),
            _ => name.to_owned(),
        }
    }
}

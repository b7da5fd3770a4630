//! A run whose steps are judged one by one, and the record of it.

use eem::prelude::*;

use super::judge::{self, Verdict};
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
    /// The largest |defect|/bound by the judge.
    pub(crate) worst: f64,
    /// Steps that broke a law, and the words of the first ones.
    pub(crate) broken_steps: usize,
    pub(crate) broken: Vec<String>,
    /// The error that the run ended with.
    pub(crate) refused: Option<StepError>,
}

/// Whether a scheme is held to the laws here.
pub(crate) fn is_exact(scheme: Scheme) -> bool {
    EXACT.contains(&scheme)
}

/// The schemes that are held to the laws here: those of at most second order, with their one force at the middle of a
/// step, by which the judge counts loads. Those of higher order are in `tests/laws`.
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
    pub(crate) fn step(&mut self) -> Result<StepReport<f64>, StepError> {
        let saved = self.run.checkpoint();
        match self.run.step() {
            Ok(report) => {
                self.judge(&report);
                Ok(report)
            }
            Err(error) => {
                if self.run.checkpoint() != saved {
                    self.record
                        .complain(vec![format!("{error}: the state has changed")]);
                }
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

    fn judge(&mut self, report: &StepReport<f64>) {
        let record = &mut self.record;
        record.steps += 1;
        record.iterations += report.iterations;
        record.most_iterations = record.most_iterations.max(report.iterations);
        if !is_exact(self.run.scheme()) {
            return;
        }
        let after = Stored::of(&self.run);
        let Verdict {
            defect,
            bound,
            broken,
            ..
        } = judge::check_step(&self.facts, &self.state, &after, report);
        let share = (defect / bound).abs();
        // Nothing moved and nothing is there: 0/0 is no defect.
        let share = if defect.abs() > 0.0 || defect.is_nan() {
            share
        } else {
            0.0
        };
        record.worst = if share > record.worst || share.is_nan() {
            share
        } else {
            record.worst
        };
        record.defect = defect;
        record.complain(broken);
        self.state = after;
    }

    /// The state as the judge sees it, after the last step.
    pub(crate) fn stored(&self) -> &Stored {
        &self.state
    }
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

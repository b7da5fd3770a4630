//! An experiment that keeps every bit of a run, and counts who moved together and who alone.

use std::sync::atomic::{AtomicUsize, Ordering};

use eem::prelude::*;
use eem::{Experiment, MemberFailure, Members, Outputs, Real};

/// What a member differs in, in the unit of what it stands for.
pub(crate) type Input = [f64; 3];

/// Nodes and elements of a scene.
pub(crate) struct Parts {
    pub(crate) nodes: Vec<Node>,
    pub(crate) elements: Vec<Element>,
}

/// A scene whose numbers depend on those of an input.
pub(crate) trait Case<const D: usize>: Sync {
    fn scene<S: Real>(&self, input: [S; 3]) -> (Scene<D, S>, Parts);
}

/// All that is seen of a run.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seen {
    /// The bits of all numbers, step by step.
    pub(crate) bits: Vec<u64>,
    /// Newton iterations in all.
    pub(crate) iterations: usize,
}

/// Runs a case for so many steps.
pub(crate) struct Watched<C> {
    case: C,
    steps: usize,
    together: AtomicUsize,
    alone: AtomicUsize,
}

impl<C> Watched<C> {
    pub(crate) fn new(case: C, steps: usize) -> Self {
        Self {
            case,
            steps,
            together: AtomicUsize::new(0),
            alone: AtomicUsize::new(0),
        }
    }

    /// How many runs of several members and of one have reached their end.
    pub(crate) fn counts(&self) -> [usize; 2] {
        [&self.together, &self.alone].map(|count| count.load(Ordering::Relaxed))
    }
}

impl<const D: usize, C: Case<D>> Experiment<D> for Watched<C> {
    type Input = Input;
    type Handles = Parts;
    type Output = Seen;

    fn build<S: Real>(&self, members: Members<'_, Input, S>) -> (Scene<D, S>, Parts) {
        self.case
            .scene([0, 1, 2].map(|k| members.number(|input| input[k])))
    }

    fn observe<S: Real>(
        &self,
        run: &mut Simulation<D, S>,
        parts: Parts,
        members: Members<'_, Input, S>,
    ) -> Result<Outputs<Seen>, MemberFailure> {
        let (mut seen, mut iterations) = (Vec::new(), 0);
        for _ in 0..self.steps {
            let report = run.step()?;
            iterations += report.iterations;
            seen.extend([report.time, report.update, report.residual]);
            for &node in &parts.nodes {
                seen.extend(run.position(node)?.iter());
                seen.extend(run.momentum(node)?.iter());
            }
            for &element in &parts.elements {
                seen.extend([run.force(element)?, run.internal_energy(element)?]);
                seen.extend(run.temperature(element));
                seen.extend(run.entropy(element));
                seen.extend(run.viscous_stretch(element, 0));
            }
            let ledger = run.ledger();
            seen.extend([ledger.balance, ledger.entropy, ledger.work, ledger.heat]);
        }
        let kind = if S::LANES > 1 {
            &self.together
        } else {
            &self.alone
        };
        kind.fetch_add(1, Ordering::Relaxed);
        Ok(members.outputs(|_, of| Seen {
            bits: seen.iter().map(|&number| of(number).to_bits()).collect(),
            iterations,
        }))
    }
}

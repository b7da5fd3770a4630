//! The numbers of a checkpoint as one list: what each must satisfy, and which cannot be edited.
//!
//! Nobody can choose what a run has accumulated, nor the rates with which an explicit scheme continues: they follow
//! from steps that a checkpoint does not contain. Computing the rates again would not give their bits, because a step
//! finds them in another way than the start of a run. So each such entry has a digest.

use super::Checkpoint;
use super::error::{RestoreError, expect_count};
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::digest::Digest;
use eem_material::number::scalar::{Mask, Real, is_positive};

/// What the numbers of an entry must satisfy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// Pairs of a value and a compensation as additions leave them: finite, and the compensation at most half a unit in
    /// the last place of the value v, which is at most ½ε|v|. Sums so small that this underflows are exact.
    Sum,
    Finite,
    Positive,
    /// Sums of squares may overflow.
    NotNegative,
    FiniteNotNegative,
    /// Only the digest is checked.
    None,
}

/// A list of numbers of a checkpoint.
#[derive(Debug)]
struct Entry<S> {
    name: &'static str,
    numbers: Vec<S>,
    rule: Rule,
    /// Whether a simulation of the same scene has as many.
    has_count: bool,
    /// Whether it follows from the steps.
    is_sealed: bool,
}

impl<S: Real> Entry<S> {
    fn new(name: &'static str, rule: Rule, numbers: impl IntoIterator<Item = S>) -> Self {
        Self {
            name,
            numbers: numbers.into_iter().collect(),
            rule,
            has_count: false,
            is_sealed: false,
        }
    }

    fn sum(name: &'static str, Sum { value, carry }: Sum<S>) -> Self {
        Self::new(name, Rule::Sum, [value, carry])
    }

    fn sums(name: &'static str, sums: &Compensated<S>) -> Self {
        let pairs = sums.sums().flat_map(|(value, carry)| [value, carry]);
        Self::new(name, Rule::Sum, pairs).counted()
    }

    const fn counted(mut self) -> Self {
        self.has_count = true;
        self
    }

    const fn sealed(mut self) -> Self {
        self.is_sealed = true;
        self
    }

    fn count(&self) -> usize {
        match self.rule {
            Rule::Sum => self.numbers.len() / 2,
            _ => self.numbers.len(),
        }
    }

    fn digest(&self) -> Digest {
        Digest::of(|digest| {
            for &number in &self.numbers {
                digest.number(number);
            }
            digest.count(self.numbers.len());
        })
    }

    /// An error unless the numbers satisfy the rule, and are as many as in a simulation.
    fn check(&self, simulation: &[Self]) -> Result<(), RestoreError> {
        let same = simulation.iter().find(|other| other.name == self.name);
        if let Some(other) = same.filter(|_| self.has_count) {
            expect_count(self.name, self.count(), other.count())?;
        }
        let is_not_negative = |number| S::zero().at_most(number).all();
        let is_met = |&number: &S| match self.rule {
            Rule::None => true,
            Rule::Sum | Rule::Finite => number.is_finite(),
            Rule::Positive => is_positive(number),
            Rule::NotNegative => is_not_negative(number),
            Rule::FiniteNotNegative => number.is_finite() && is_not_negative(number),
        };
        if let Some(number) = self.numbers.iter().find(|number| !is_met(number)) {
            return Err(RestoreError::Value {
                quantity: self.name,
                value: number.to_f64(),
                required: match self.rule {
                    Rule::Positive => "positive and finite",
                    Rule::NotNegative | Rule::FiniteNotNegative => "not negative",
                    Rule::None | Rule::Sum | Rule::Finite => "finite",
                },
            });
        }
        if self.rule == Rule::Sum {
            let half = S::from_f64(0.5) * S::EPSILON;
            for &[value, carry] in self.numbers.as_chunks().0 {
                if !carry.abs().at_most(half * value.abs()).all() {
                    return Err(RestoreError::Carry {
                        quantity: self.name,
                        value: value.to_f64(),
                        carry: carry.to_f64(),
                    });
                }
            }
        }
        Ok(())
    }
}

impl<S: Real> Checkpoint<S> {
    /// All numbers. The order of the sealed ones is part of the format.
    fn entries(&self) -> Vec<Entry<S>> {
        use Rule::{Finite, FiniteNotNegative, NotNegative, Positive};
        let (state, [last, before]) = (&self.state, &self.past.forces);
        let list = |name, list: &[S]| Entry::new(name, Finite, list.iter().copied()).counted();
        let temperatures = state.temperatures.iter().copied();
        let mut entries = vec![
            Entry::sums("coordinates", &state.positions),
            Entry::sums("momenta", &state.momenta),
            Entry::sums("velocities", &state.velocities),
            Entry::sums("viscous stretches", &state.viscous),
            Entry::sums("entropies", &state.entropies),
            Entry::sums("reservoir entropies", &state.reservoir_entropies).sealed(),
            Entry::sum("time", state.time),
            Entry::sum("work", state.work).sealed(),
            Entry::sum("heat", state.heat).sealed(),
            Entry::sum("thermostat entropy", state.thermostat_entropy).sealed(),
            Entry::sum("lost heat", state.dissipated).sealed(),
            Entry::new("time", NotNegative, [state.time.value]),
            Entry::new("temperatures", Positive, temperatures).counted(),
            Entry::new("step size", Positive, [self.step]),
            list("last forces", last),
            list("earlier forces", before),
            Entry::new("forces", Finite, last.iter().chain(before).copied()).sealed(),
            Entry::new("errors of predicted forces", NotNegative, self.past.errors).sealed(),
        ];
        if let Some(control) = &self.control {
            let last = control.controller.last;
            let last_step = last.into_iter().flatten();
            let momentum = control.largest_momentum;
            entries.extend([
                Entry::new("the smallest step", Positive, [control.smallest]).sealed(),
                Entry::new("the largest step", Positive, [control.largest]).sealed(),
                Entry::new("the largest momentum", FiniteNotNegative, [momentum]).sealed(),
                Entry::new("the last step under control", FiniteNotNegative, last_step).sealed(),
                Entry::new("step size", Positive, last.map(|[_, size]| size)),
            ]);
        }
        if let Some(saved) = &self.choice {
            let numbers = saved.choice.numbers().map(S::from_f64);
            entries.push(Entry::new("choice of a scheme", FiniteNotNegative, numbers).sealed());
        }
        if let Some(explicit) = &self.explicit {
            let targets = explicit.targets.iter();
            let targets = targets.flat_map(|sum| [sum.value, sum.carry]);
            let momentum = explicit.largest_momentum;
            let flags = [explicit.is_new, explicit.is_motion_first];
            let flags = flags.map(|flag| S::from_f64(f64::from(u8::from(flag))));
            let lists = explicit.lists();
            entries.push(Entry::new("targets", Rule::Sum, targets).counted().sealed());
            entries.extend(lists.map(|(name, numbers)| list(name, numbers).sealed()));
            entries.extend([
                Entry::sums("shares of reservoirs", &explicit.shares).sealed(),
                Entry::new("the largest momentum", NotNegative, [momentum]).sealed(),
                Entry::new("the energy defect", Rule::None, [explicit.residue]).sealed(),
                Entry::new("the start of a step", Rule::None, flags).sealed(),
            ]);
        }
        entries
    }

    /// The digests of all sealed entries.
    pub(super) fn digests(&self) -> Vec<Digest> {
        let entries = self.entries().into_iter();
        let sealed = entries.filter(|entry| entry.is_sealed);
        sealed.map(|entry| entry.digest()).collect()
    }

    /// An error unless all numbers can be those of a run of this simulation.
    pub(super) fn check_numbers(&self, simulation: &Self) -> Result<(), RestoreError> {
        let entries = self.entries();
        let others = simulation.entries();
        entries.iter().try_for_each(|entry| entry.check(&others))?;
        let sealed: Vec<_> = entries.iter().filter(|entry| entry.is_sealed).collect();
        expect_count("seals", self.seals.len(), sealed.len())?;
        let mut pairs = sealed.into_iter().zip(&self.seals);
        match pairs.find(|(entry, seal)| entry.digest() != **seal) {
            Some((entry, _)) => Err(RestoreError::Edited { entry: entry.name }),
            None => Ok(()),
        }
    }
}

//! All numbers of a checkpoint as one list of entries, with their rules and digests.
//!
//! The sums that a run has accumulated, and the rates with which an explicit scheme continues, must not be edited: they follow
//! from steps that a checkpoint does not contain. Computing the rates again would not give their bits, because a step
//! finds them in another way than the start of a run. So each such entry has a digest.

use std::borrow::Cow;

use super::Checkpoint;
use super::error::{RestoreError, expect_count};
use super::file::flat;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::digest::Digest;
use eem_material::number::scalar::is_positive;

/// A rule for the numbers of an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// Pairs of a value and a compensation as additions leave them: finite, and the compensation at most half a unit in
    /// the last place of the value v, which is at most ½ε|v|. Sums so small that this underflows are exact.
    Sum,
    Finite,
    Positive,
    /// Not negative, but possibly infinite: sums of squares may overflow.
    NotNegative,
    FiniteNotNegative,
    /// Only the digest is checked.
    None,
}

/// A list of numbers of a checkpoint.
struct Entry<'a> {
    name: &'static str,
    numbers: Cow<'a, [f64]>,
    rule: Rule,
    /// The number of values, if every simulation of the same scene has the same number.
    count: Option<usize>,
    /// Whether it follows from the steps, and has a digest.
    is_sealed: bool,
}

impl<'a> Entry<'a> {
    fn new(name: &'static str, rule: Rule, numbers: impl Into<Cow<'a, [f64]>>) -> Self {
        Self {
            name,
            numbers: numbers.into(),
            rule,
            count: None,
            is_sealed: false,
        }
    }

    fn sum(name: &'static str, Sum { value, carry }: Sum) -> Self {
        Self::new(name, Rule::Sum, vec![value, carry])
    }

    fn sums(name: &'static str, sums: &'a Compensated) -> Self {
        let mut pairs = Vec::with_capacity(2 * sums.values().len());
        for (value, carry) in sums.sums() {
            pairs.extend([value, carry]);
        }
        Self::new(name, Rule::Sum, pairs).counted(sums.values().len())
    }

    /// Counts as lists of their bytes, which numbers represent exactly.
    fn counts(name: &'static str, counts: &[u64]) -> Self {
        let mut bytes = Vec::new();
        for count in counts {
            bytes.extend(count.to_le_bytes().map(f64::from));
        }
        Self::new(name, Rule::None, bytes)
    }

    fn list(name: &'static str, list: &'a [f64]) -> Self {
        Self::new(name, Rule::Finite, list).counted(list.len())
    }

    fn counted(mut self, count: usize) -> Self {
        self.count = Some(count);
        self
    }

    fn sealed(mut self) -> Self {
        self.is_sealed = true;
        self
    }

    /// `Simulation::audit_meters` checks the number of its values.
    fn metered(mut self) -> Self {
        self.count = None;
        self.sealed()
    }

    fn digest(self) -> Digest {
        Digest::of(|digest| {
            for &number in &*self.numbers {
                digest.number(number);
            }
            digest.count(self.numbers.len());
        })
    }

    /// An error unless the numbers satisfy the rule, and are as many as in a simulation.
    fn check(self, simulation: &[Self]) -> Result<(), RestoreError> {
        let same = simulation.iter().find(|other| other.name == self.name);
        let counts = self.count.zip(same.and_then(|other| other.count));
        counts.map_or(Ok(()), |(own, other)| expect_count(self.name, own, other))?;
        let half = 0.5 * f64::EPSILON;
        let mut value = None;
        for &number in &*self.numbers {
            let (is_met, required) = match self.rule {
                Rule::None => (true, ""),
                Rule::Sum | Rule::Finite => (number.is_finite(), "finite"),
                Rule::Positive => (is_positive(number), "positive and finite"),
                Rule::NotNegative => (number >= 0.0, "not negative"),
                Rule::FiniteNotNegative => ((0.0..=f64::MAX).contains(&number), "not negative"),
            };
            if !is_met {
                return Err(RestoreError::Value {
                    quantity: self.name,
                    value: number,
                    required,
                });
            }
            // Every second number of a sum is the compensation of the value before it.
            let Some(value) = value.take().filter(|_| self.rule == Rule::Sum) else {
                value = Some(number);
                continue;
            };
            if !(number.abs() <= half * f64::abs(value)) {
                return Err(RestoreError::Carry {
                    quantity: self.name,
                    value,
                    carry: number,
                });
            }
        }
        Ok(())
    }
}

impl Checkpoint {
    /// All numbers. The order of the sealed ones is part of the format.
    fn entries(&self) -> Vec<Entry<'_>> {
        use Rule::{Finite, FiniteNotNegative, NotNegative, Positive};
        let (state, [last, before]) = (&self.state, &self.past.forces);
        let loads = &self.loads;
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
            Entry::sums("heat of dashpots", &state.meters.dissipated).metered(),
            Entry::sums("entropy production", &state.meters.produced).metered(),
            Entry::sums("conducted heat", &state.meters.conducted).metered(),
            Entry::new("temperatures", Positive, &state.temperatures)
                .counted(state.temperatures.len()),
            Entry::new("step size", Positive, vec![self.step]),
            Entry::new("set forces", Finite, &loads.forces).sealed(),
            Entry::new("set velocities", Finite, &loads.velocities).sealed(),
            Entry::new("set temperatures", Positive, &loads.temperatures).sealed(),
            Entry::list("last forces", last),
            Entry::list("earlier forces", before),
            Entry::new("forces", Finite, [&last[..], before].concat()).sealed(),
            Entry::new(
                "errors of predicted forces",
                NotNegative,
                &self.past.errors[..],
            )
            .sealed(),
            Entry::list("the start of the last step", &self.past.internal).sealed(),
            Entry::new("energies of elements", Rule::None, self.energies.numbers())
                .counted(self.energies.list.len())
                .sealed(),
        ];
        if let Some(control) = &self.control {
            let last = control.controller.last.as_ref();
            let last_step = last.map_or(&[][..], |last| &last[..]);
            let last_size = last.map_or(&[][..], |[_, size]| core::slice::from_ref(size));
            let momentum = control.largest_momentum;
            entries.extend([
                Entry::new(
                    "the smallest step",
                    FiniteNotNegative,
                    vec![control.smallest],
                )
                .sealed(),
                Entry::new("the largest step", Positive, vec![control.largest]).sealed(),
                Entry::new("the largest momentum", FiniteNotNegative, vec![momentum]).sealed(),
                Entry::new("the last step under control", FiniteNotNegative, last_step).sealed(),
                Entry::new("step size", Positive, last_size),
                Entry::counts("statistics of steps", &control.statistics.counts()).sealed(),
            ]);
        }
        if let Some(saved) = &self.choice {
            let numbers = saved.selection.numbers();
            entries.push(Entry::new("choice of a scheme", FiniteNotNegative, numbers).sealed());
            entries.push(Entry::counts("choice of a scheme", &saved.selection.counts()).sealed());
        }
        if let Some(explicit) = &self.explicit {
            let momentum = explicit.largest_momentum;
            let flag = |is_set: bool| f64::from(u8::from(is_set));
            let flags = vec![flag(explicit.is_new), flag(explicit.is_motion_first)];
            for (name, sums) in explicit.sums() {
                let entry = Entry::new(name, Rule::Sum, flat(sums));
                entries.push(entry.counted(sums.len()).sealed());
            }
            for (name, numbers) in explicit.lists() {
                entries.push(Entry::list(name, numbers).sealed());
            }
            entries.extend([
                Entry::new("the largest momentum", NotNegative, vec![momentum]).sealed(),
                Entry::new("the energy defect", Rule::None, vec![explicit.residue]).sealed(),
                Entry::new("the start of a step", Rule::None, flags).sealed(),
            ]);
        }
        entries
    }

    /// The names and digests of all sealed entries.
    pub(super) fn digests(&self) -> Vec<(&'static str, Digest)> {
        let mut digests = Vec::new();
        for entry in self.entries() {
            if entry.is_sealed {
                digests.push((entry.name, entry.digest()));
            }
        }
        digests
    }

    /// An error unless all numbers can be those of a run of this simulation.
    pub(super) fn check_numbers(&self, simulation: &Self) -> Result<(), RestoreError> {
        let others = simulation.entries();
        for entry in self.entries() {
            entry.check(&others)?;
        }
        let digests = self.digests();
        expect_count("seals", self.seals.len(), digests.len())?;
        for ((entry, digest), seal) in digests.into_iter().zip(&self.seals) {
            if digest != *seal {
                return Err(RestoreError::Edited { entry });
            }
        }
        Ok(())
    }
}

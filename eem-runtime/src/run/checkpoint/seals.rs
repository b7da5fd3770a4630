//! Whether what follows from the steps of a run is still what the run has saved.
//!
//! Nobody can choose what a run has booked, nor the rates with which an explicit scheme goes on: they follow from
//! steps that a checkpoint does not have. Recomputing the rates would not give their bits, as the closing of a step
//! finds them on another way than a first step. So each entry has a digest, and is believed with it only.

use super::choice::SavedChoice;
use super::control::SavedControl;
use super::error::RestoreError;
use super::expect::expect_count;
use crate::element::state::State;
use crate::step::explicit::SavedExplicit;
use crate::step::solver::SavedPast;
use eem_material::number::compensated::Sum;
use eem_material::number::digest::Digest;
use eem_material::number::scalar::Real;

/// A digest of each entry that follows from the steps of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(transparent)
)]
pub(crate) struct Seals(Vec<Digest>);

/// The parts of a checkpoint in which something follows from the steps.
#[derive(Clone, Copy)]
pub(super) struct Sealed<'a, S> {
    pub(super) state: &'a State<S>,
    pub(super) past: &'a SavedPast<S>,
    pub(super) control: Option<&'a SavedControl<S>>,
    pub(super) choice: Option<&'a SavedChoice>,
    pub(super) explicit: Option<&'a SavedExplicit<S>>,
}

impl Seals {
    /// Of nothing yet.
    pub(crate) const fn none() -> Self {
        Self(Vec::new())
    }

    /// Those of a checkpoint.
    pub(super) fn of<S: Real>(checkpoint: Sealed<'_, S>) -> Self {
        let entries = entries(checkpoint).into_iter();
        Self(entries.map(|(_, digest)| digest).collect())
    }

    /// An error with the first entry of a checkpoint that has been edited.
    pub(super) fn check<S: Real>(&self, checkpoint: Sealed<'_, S>) -> Result<(), RestoreError> {
        let entries = entries(checkpoint);
        expect_count("seals", self.0.len(), entries.len())?;
        let mut pairs = entries.into_iter().zip(&self.0);
        match pairs.find(|((_, found), saved)| found != *saved) {
            None => Ok(()),
            Some(((entry, _), _)) => Err(RestoreError::Edited { entry }),
        }
    }
}

/// An entry with the digest of its numbers.
type Entry = (&'static str, Digest);

fn entry<S: Real>(name: &'static str, numbers: impl IntoIterator<Item = S>) -> Entry {
    let mut count = 0;
    let digest = Digest::of(|digest| {
        for number in numbers {
            digest.number(number);
            count += 1;
        }
        digest.count(count);
    });
    (name, digest)
}

fn sums<S: Real>(name: &'static str, sums: impl IntoIterator<Item = (S, S)>) -> Entry {
    let pairs = sums.into_iter();
    entry(name, pairs.flat_map(|(value, carry)| [value, carry]))
}

/// All entries that follow from the steps.
fn entries<S: Real>(checkpoint: Sealed<'_, S>) -> Vec<Entry> {
    let mut entries = of_books(checkpoint.state).to_vec();
    let [last, before] = &checkpoint.past.forces;
    entries.push(entry("forces", last.iter().chain(before).copied()));
    entries.push(entry("errors of foretold forces", checkpoint.past.errors));
    entries.extend(checkpoint.control.into_iter().flat_map(of_control));
    entries.extend(checkpoint.choice.map(of_choice));
    entries.extend(checkpoint.explicit.into_iter().flat_map(of_explicit));
    entries
}

/// What steps have booked.
fn of_books<S: Real>(state: &State<S>) -> [Entry; 5] {
    let single = |name, sum: Sum<S>| sums(name, [(sum.value, sum.carry)]);
    [
        sums("reservoir entropies", state.reservoir_entropies.sums()),
        single("work", state.work),
        single("heat", state.heat),
        single("thermostat entropy", state.thermostat_entropy),
        single("lost heat", state.dissipated),
    ]
}

/// What step control has learnt; tolerances may be chosen.
fn of_control<S: Real>(control: &SavedControl<S>) -> [Entry; 4] {
    let last = control.controller.last.into_iter().flatten();
    [
        entry("the smallest step", [control.smallest]),
        entry("the largest step", [control.largest]),
        entry("the largest momentum", [control.largest_momentum]),
        entry("the last step under control", last),
    ]
}

fn of_choice(saved: &SavedChoice) -> Entry {
    entry("choice of a scheme", saved.choice.numbers())
}

/// With what an explicit scheme goes on.
fn of_explicit<S: Real>(explicit: &SavedExplicit<S>) -> Vec<Entry> {
    let of_sums = explicit.sums().map(|(name, all)| {
        let all = all.iter().map(|sum| (sum.value, sum.carry));
        sums(name, all)
    });
    let lists = explicit.lists();
    let flags = [explicit.is_new, explicit.is_motion_first];
    let lists = lists.map(|(name, list)| entry(name, list.iter().copied()));
    let booked = [
        entry("the largest momentum", [explicit.largest_momentum]),
        entry("what the energy is off by", [explicit.residue]),
        entry(
            "whether a step begins anew",
            flags.map(|flag| S::from_f64(f64::from(u8::from(flag)))),
        ),
    ];
    of_sums.into_iter().chain(lists).chain(booked).collect()
}

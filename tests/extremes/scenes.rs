//! Kind 9: scenes at random, of the ordinary class and far beyond it, and fresh hot steps.

use eem::prelude::*;

use super::drawing::{Class, Drawing};
use super::findings::{hot_as_found, hot_at_random};
use super::random::Random;
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, FORMS};

pub(crate) const FAMILIES: &[Family] = &[
    ordinary_in_plane,
    ordinary_in_space,
    wild_in_plane,
    wild_in_space,
    fresh_hot_steps,
];

/// Ordinary scenes that may be refused.
const REFUSED: f64 = 0.02;

/// Fresh hot steps that complete in each form.
const COMPLETE: f64 = 0.94;

fn ordinary_in_plane(effort: Effort) -> Tally {
    scenes::<2>("ordinary scenes in the plane", Class::Ordinary, effort, 11)
}

fn ordinary_in_space(effort: Effort) -> Tally {
    scenes::<3>("ordinary scenes in space", Class::Ordinary, effort, 12)
}

fn wild_in_plane(effort: Effort) -> Tally {
    scenes::<2>("wild scenes in the plane", Class::Wild, effort, 13)
}

fn wild_in_space(effort: Effort) -> Tally {
    scenes::<3>("wild scenes in space", Class::Wild, effort, 14)
}

/// Random scenes of one class. An ordinary scene whose springs leave the lengths of its class ends there.
fn scenes<const D: usize>(what: &str, class: Class, effort: Effort, seed: u64) -> Tally {
    let count = effort.of([4, 30, 2500]);
    let steps = effort.of([10, 20, 200]);
    // Without optimisation, a large scene costs as much as a hundred small ones.
    let most = effort.of([8, 12, 30]);
    let mut tally = Tally::new(format!("{count} {what}, {steps} steps each"));
    for index in 0..count {
        let mut random = Random::new(seed << 32 | index);
        let drawing = Drawing::<D>::at_random(&mut random, class, most);
        let scheme = EXACT[random.below(EXACT.len())];
        let label = format!("{what} {index}, {}", scheme.name());
        let mut watched = match drawing.world().start(scheme, drawing.step) {
            Ok(watched) => watched,
            // A wild temperature may be beyond the domain of its model.
            Err(error) => {
                *tally
                    .refused
                    .entry(format!("no scene: {}", first_word(&error)))
                    .or_default() += 1;
                continue;
            }
        };
        for _ in 0..steps {
            if watched.step().is_err() || (class == Class::Ordinary && !drawing.is_within(&watched))
            {
                break;
            }
        }
        let is_law = watched.record.refusal() == "LawNotKept";
        tally.add(&label, &watched.record);
        tally.claim(
            class == Class::Wild || !is_law,
            format!("{label}: LawNotKept"),
        );
        if let (Class::Ordinary, Some(error)) = (class, &watched.record.refused) {
            tally.note(format!("{index}: {error}"));
        }
    }
    if class == Class::Ordinary {
        let share = ratio(tally.runs - tally.completed, tally.runs);
        tally.claim(
            share < REFUSED || effort == Effort::Glance,
            format!("{share} are refused"),
        );
    }
    tally
}

fn first_word(error: &SceneError) -> String {
    let text = format!("{error:?}");
    text.split(|c: char| !c.is_alphanumeric())
        .nth(1)
        .unwrap_or_default()
        .to_owned()
}

fn ratio(part: usize, whole: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "for a percentage")]
    let [part, whole] = [part as f64, whole as f64];
    part / whole.max(1.0)
}

fn fresh_hot_steps(effort: Effort) -> Tally {
    let count = effort.of([100, 700, 333_333]);
    let mut tally = Tally::new(format!(
        "{count} fresh hot steps near an anchor in each exact scheme"
    ));
    for scheme in EXACT {
        let mut found = hot_as_found(scheme);
        let _ = found.step();
        tally.add(format!("the one found, {}", scheme.name()), &found.record);
        let mut random = Random::new(1);
        let (mut tried, mut done) = (0, 0);
        for index in 0..count {
            let Some(mut watched) = hot_at_random(&mut random, scheme) else {
                continue;
            };
            tried += 1;
            done += usize::from(watched.step().is_ok());
            tally.add(format!("step {index}, {}", scheme.name()), &watched.record);
        }
        let share = ratio(done, tried);
        tally.note(format!(
            "{}: {:.2} % complete",
            scheme.name(),
            100.0 * share
        ));
        let is_promised = FORMS.contains(&scheme);
        tally.claim(
            share >= COMPLETE || !is_promised,
            format!("{}: {share}", scheme.name()),
        );
    }
    tally
}

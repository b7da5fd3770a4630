//! The page `docs/extremes.md`: cases and results as Markdown.

use std::fmt::Write as _;
use std::time::{SystemTime, UNIX_EPOCH};

use super::extremes::kinds::Kind;
use super::extremes::tally::Tally;

/// The head of the page.
const HEAD: &str = "\
# Extremes

A step of an exact scheme (here `eem-entropy`, `eem-temperature`, `staggered`) satisfies the laws to rounding, or is rejected
with a typed error that leaves the state unchanged. This page lists attempts to break that. For every step, a *judge* evaluates
the laws from the stored states, with 32 digits and with code that shares nothing with the schemes; `tests/extremes/judge.rs`
documents its formulas and bounds.

- *Worst* is the largest energy defect of a step divided by its bound for rounding, 64 ε (A + A⁺). The limit is 1; a usual value
  is 0.007.
- *Iterations* are the mean and the maximum per step.
- *Errors* count the runs that ended with the error named.

Momenta, entropy production and stored entropies were checked in every step, too. A violated law appears as a line *Broken*.
";

/// The whole page.
pub(crate) fn markdown(
    results: &[(usize, &Kind, Vec<Tally>)],
    command: &str,
    date: &str,
) -> String {
    let mut text = format!("{HEAD}\nMade on {date} by\n\n```sh\n{command}\n```\n");
    for (number, kind, tallies) in results {
        section(&mut text, *number, kind, tallies).expect("a string takes all text");
    }
    text
}

fn section(text: &mut String, number: usize, kind: &Kind, tallies: &[Tally]) -> std::fmt::Result {
    writeln!(text, "\n## {number}. {}\n", kind.question)?;
    writeln!(
        text,
        "| case | runs | complete | steps | worst | iterations | errors |"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|")?;
    for tally in tallies {
        let refused: Vec<String> = tally
            .refused
            .iter()
            .map(|(error, count)| format!("{count} {error}"))
            .collect();
        let refused = if refused.is_empty() {
            "none".to_owned()
        } else {
            refused.join(", ")
        };
        writeln!(
            text,
            "| {} | {} | {} | {} | {:.1e} | {:.1}, ≤ {} | {refused} |",
            // A bar ends a cell.
            tally.what.replace('|', "\\|"),
            tally.runs,
            tally.completed,
            tally.steps,
            tally.worst,
            tally.mean_iterations(),
            tally.most_iterations,
        )?;
    }
    for tally in tallies.iter().filter(|tally| !tally.notes.is_empty()) {
        writeln!(text, "\n{}:\n", tally.what)?;
        for note in tally.notes.iter().take(NOTES) {
            writeln!(text, "- {note}")?;
        }
        let more = tally.notes.len().saturating_sub(NOTES);
        if more > 0 {
            writeln!(text, "- and {more} more")?;
        }
    }
    for tally in tallies.iter().filter(|tally| !tally.wrong.is_empty()) {
        writeln!(
            text,
            "\n**Broken**, {} times: {}\n",
            tally.wrong.len(),
            tally.what
        )?;
        for wrong in tally.wrong.iter().take(NOTES) {
            writeln!(text, "- {wrong}")?;
        }
    }
    Ok(())
}

/// The most notes that a family of runs is given room for.
const NOTES: usize = 20;

/// Seconds of a day.
const DAY: u64 = 86_400;

/// Today's date in UTC, YYYY-MM-DD.
pub(crate) fn today() -> String {
    let since = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    let [year, month, day] = civil(since.as_secs() / DAY);
    format!("{year}-{month:02}-{day:02}")
}

/// Year, month and day of the so many-th day since 1970-01-01 (Hinnant 2021, `civil_from_days`).
fn civil(days: u64) -> [u64; 3] {
    // Eras of 400 years begin on 1 March, so that the leap day is the last one of a year.
    let days = days + 719_468;
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let shifted = (5 * of_year + 2) / 153;
    let day = of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 {
        shifted + 3
    } else {
        shifted - 9
    };
    [year + 400 * era + u64::from(month <= 2), month, day]
}

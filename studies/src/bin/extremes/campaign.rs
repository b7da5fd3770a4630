//! Fresh random steps by every exact scheme: the subcommand `campaign`, and its table.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::sync::Mutex;

use clap::Args;
use rayon::prelude::*;

use super::extremes::campaign::{self, Outcome, Row};
use super::extremes::tally::Tally;
use eem_studies::claims::Claims;
use eem_studies::progress::Progress;
use eem_studies::terminal;

/// Scenes of one task.
const TASK: u64 = 64;

/// Complaints that are printed of a row, each of another law as far as there are others.
const PRINTED: usize = 12;

/// Fresh random steps by every exact scheme, at fixed steps and under step control; what broke a law is printed
/// with its seed.
#[derive(Clone, Debug, Args)]
pub(crate) struct Campaign {
    /// Steps of each row, refused ones included.
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    steps: usize,
    /// The first seed.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    from: u64,
    /// Only the rows whose name contains this, for instance `eem-explicit, fixed`; several times for several.
    #[arg(long, value_name = "ROW")]
    only: Vec<String>,
}

pub(crate) fn run(asked: &Campaign) -> Result<Claims, Box<dyn Error>> {
    let is_asked = |row: &Row| {
        let name = row.name();
        asked.only.is_empty() || asked.only.iter().any(|part| name.contains(part.as_str()))
    };
    let rows: Vec<Row> = campaign::rows().into_iter().filter(is_asked).collect();
    if rows.is_empty() {
        let names: Vec<String> = campaign::rows().iter().map(|row| row.name()).collect();
        return Err(format!("no such row; there are {}", names.join("; ")).into());
    }
    let progress = Mutex::new((Progress::new("steps", rows.len() * asked.steps), 0));
    let outcomes: Vec<(Row, Outcome, u64)> = rows
        .into_iter()
        .map(|row| {
            let (outcome, end) = of_row(row, asked, &progress);
            (row, outcome, end)
        })
        .collect();
    drop(progress);
    terminal::say(table(&outcomes)?);
    let mut claims = Claims::default();
    for (row, outcome, _) in &outcomes {
        for wrong in sample(outcome.all().wrong) {
            claims.holds(false, wrong);
        }
        for wrong in row.complaints(outcome) {
            claims.holds(false, wrong);
        }
    }
    Ok(claims)
}

/// As many scenes as it takes, and the seed after the last one.
fn of_row(row: Row, asked: &Campaign, progress: &Mutex<(Progress, usize)>) -> (Outcome, u64) {
    let mut outcome = Outcome::default();
    let (mut next, mut made) = (asked.from, 0);
    while made < asked.steps {
        let scenes = (asked.steps - made).div_ceil(row.steps_of_scene()) as u64;
        let end = next + scenes;
        let tasks: Vec<u64> = (0..scenes.div_ceil(TASK)).collect();
        let parts: Vec<Outcome> = tasks
            .into_par_iter()
            .map(|task| {
                let first = next + task * TASK;
                let part = row.run(first..end.min(first + TASK));
                if let Ok(mut progress) = progress.lock() {
                    progress.1 += tried(&part.all());
                    let done = progress.1;
                    progress.0.advance(done);
                }
                part
            })
            .collect();
        outcome = parts.into_iter().fold(outcome, Outcome::and);
        next = end;
        made = tried(&outcome.all());
    }
    (outcome, next)
}

/// Steps that were taken or refused.
fn tried(tally: &Tally) -> usize {
    tally.steps + campaign::refused(tally)
}

/// Some of the complaints, of as many laws as can be.
fn sample(wrong: Vec<String>) -> Vec<String> {
    let mut by_law: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for complaint in wrong {
        by_law.entry(law(&complaint)).or_default().push(complaint);
    }
    let each = PRINTED.div_ceil(by_law.len().max(1));
    let mut printed = Vec::new();
    for (law, complaints) in by_law {
        let count = complaints.len();
        printed.extend(complaints.into_iter().take(each));
        if count > each {
            printed.push(format!("{law}: in {count} scenes"));
        }
    }
    printed
}

/// The words of the last part of a complaint before its first number.
fn law(complaint: &str) -> String {
    let last = complaint.rsplit(": ").next().unwrap_or_default();
    let end = last.find(|c: char| c.is_ascii_digit());
    last[..end.unwrap_or(last.len())].trim().to_owned()
}

fn table(outcomes: &[(Row, Outcome, u64)]) -> Result<String, std::fmt::Error> {
    let mut text = String::from(
        "| scheme, steps | tried | Ok | refused | laws broken | worst ΔE/bound of the judge | of the report | \
         momenta, ε Σ∣q∣∣p∣ | steps above 64 | wide bounds | with singular forces | seeds to |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for (row, outcome, end) in outcomes {
        let all = outcome.all();
        let refused: Vec<String> = all
            .refused
            .iter()
            .map(|(name, count)| format!("{name} {count}"))
            .collect();
        let wide = |tally: &Tally| 100.0 * campaign::ratio(tally.wide, tally.steps);
        let [regular, singular] = &outcome.tallies;
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {} | {:.2} % | {:.2} % | {end} |",
            row.name(),
            tried(&all),
            all.steps,
            refused.join(", "),
            all.broken,
            all.worst,
            all.worst_reported,
            all.worst_momentum,
            all.loose,
            wide(regular),
            wide(singular),
        )?;
    }
    Ok(text)
}

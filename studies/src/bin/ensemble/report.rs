//! The answer on the terminal: quantiles for every scheme, and which unknown matters.

use comfy_table::Table;

use super::members::Sample;
use super::pendulum::{End, Spring};
use eem_studies::table::{self, scientific};
use eem_studies::terminal;

/// Five of a hundred members lie below the first of these, five above the last.
pub(crate) const QUANTILES: [f64; 3] = [0.05, 0.5, 0.95];

const HEADS: [&str; 9] = [
    "scheme",
    "completed",
    "θ 5 % (K)",
    "θ 50 % (K)",
    "θ 95 % (K)",
    "S − S₀ (J/K)",
    "energy defect",
    "least ΔS (J/K)",
    "members/s",
];

/// Prints a row for each scheme, and what the first one says about the unknowns.
pub(crate) fn print(springs: &[Spring], samples: &[Sample], end: f64) {
    let mut table = table::headed(HEADS);
    for sample in samples {
        table.add_row(row(sample));
    }
    terminal::say(format_args!("{table}\n"));
    terminal::say(format_args!(
        "{}, {end} s. θ: mean temperature in the last quarter of the time, which so many \
         members stay below; S − S₀: entropy that half of the members produce at most; energy \
         defect: max |E − E₀|/|E₀|, least ΔS: min Sₙ₊₁ − Sₙ, over all steps of all members.",
        match springs.len() {
            1 => "1 member".to_owned(),
            members => format!("{members} members"),
        }
    ));
    let Some(sample) = samples.first() else {
        return;
    };
    let failure = samples
        .iter()
        .find_map(|sample| Some((sample.scheme.name(), sample.failures().next()?)));
    if let Some((scheme, failure)) = failure {
        terminal::say(format_args!("The first to fail, {scheme}: {failure}."));
    }
    terminal::say(format_args!(
        "\nWhich unknown matters ({}):\n",
        sample.scheme.name()
    ));
    terminal::say(format_args!("{}\n", shares(springs, sample)));
    terminal::say(
        "Share: of the variance of the result, what a straight line over the unknown explains.",
    );
}

fn row(sample: &Sample) -> Vec<String> {
    let temperatures = sample.sorted(|end| end.temperature);
    let entropies = sample.sorted(|end| end.entropy);
    let total = real(sample.ends.len());
    let completed = 100.0 * real(temperatures.len()) / total;
    let mut cells = vec![sample.scheme.name().to_owned(), percent(completed)];
    for share in QUANTILES {
        cells.push(cell(quantile(&temperatures, share), 2));
    }
    cells.push(cell(quantile(&entropies, 0.5), 4));
    cells.push(scientific(sample.largest(|end| end.energy_defect)));
    cells.push(scientific(
        sample
            .largest(|end| end.entropy_loss)
            .map(|loss| 0.0 - loss),
    ));
    cells.push(format!("{:.0}", total / sample.elapsed.as_secs_f64()));
    cells
}

/// The share of each unknown in the variance of temperature and entropy.
fn shares(springs: &[Spring], sample: &Sample) -> Table {
    let mut table = table::headed(["unknown", "share in θ", "share in S − S₀"]);
    for (index, unknown) in Spring::UNKNOWNS.iter().enumerate() {
        let share = |quantity: fn(&End) -> f64| {
            let members = springs.iter().zip(&sample.ends);
            let pairs: Vec<_> = members
                .filter_map(|(spring, end)| {
                    let end = end.as_ref().ok()?;
                    Some((spring.values[index], quantity(end)))
                })
                .collect();
            percent(100.0 * correlation(&pairs).powi(2))
        };
        table.add_row([
            unknown.label.to_owned(),
            share(|end| end.temperature),
            share(|end| end.entropy),
        ]);
    }
    table
}

/// Σ (x − x̄)(y − ȳ) / √(Σ (x − x̄)² Σ (y − ȳ)²).
fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let count = real(pairs.len());
    let mean = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / count;
    let (x_mean, y_mean) = (mean(|pair| pair.0), mean(|pair| pair.1));
    let sum = |of: fn(f64, f64) -> f64| -> f64 {
        let terms = pairs.iter().map(|(x, y)| of(x - x_mean, y - y_mean));
        terms.sum()
    };
    sum(|x, y| x * y) / (sum(|x, _| x * x) * sum(|_, y| y * y)).sqrt()
}

/// The value that the given share of ascending values stays below.
pub(crate) fn quantile(ascending: &[f64], share: f64) -> Option<f64> {
    let last = ascending.len().checked_sub(1)?;
    let position = share * real(last);
    let below = (0..=last).rev().find(|&index| real(index) <= position)?;
    let next = ascending[(below + 1).min(last)];
    let part = position - real(below);
    Some(ascending[below] + part * (next - ascending[below]))
}

/// A dash where nothing, or a single member, has no share.
fn percent(value: f64) -> String {
    if value.is_finite() {
        format!("{value:.1} %")
    } else {
        "–".to_owned()
    }
}

fn cell(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
}

#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(crate) fn real(count: usize) -> f64 {
    count as f64
}

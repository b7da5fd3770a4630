//! Tables on the terminal, as Markdown has them.

use comfy_table::{Table, presets};

use super::first_law;
use super::record::{Outcome, Record};
use super::terminal;

/// An empty table with these heads.
pub fn headed(heads: impl IntoIterator<Item = impl Into<String>>) -> Table {
    let heads: Vec<String> = heads.into_iter().map(Into::into).collect();
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header(heads);
    table
}

/// Prints a row of cells per run and, below, when and why runs failed.
pub fn print<const N: usize>(
    heads: [&str; N],
    runs: &[Record],
    row: impl Fn(&Record) -> [String; N],
) {
    let mut table = headed(heads);
    for run in runs {
        table.add_row(row(run));
    }
    terminal::say(format_args!("{table}\n"));
    for run in runs {
        say_failure(run);
    }
}

/// When and why a run failed, if it did.
pub fn say_failure(run: &Record) {
    if let Outcome::Failed { time, reason } = &run.outcome {
        let scheme = &run.scheme;
        terminal::say(format_args!(
            "{scheme} failed after t = {time:.6} s: {reason}"
        ));
    }
}

/// How a run ended.
pub fn outcome(run: &Record) -> String {
    match run.outcome {
        Outcome::Completed => "completed".to_owned(),
        Outcome::Failed { time, .. } => format!("failed at {time:.1} s"),
    }
}

/// The last value of a column.
pub fn last(run: &Record, column: &str, format: impl FnOnce(f64) -> String) -> String {
    let last = run.column(column).and_then(|values| values.last().copied());
    cell(last, format)
}

/// max |E − E₀ − W|, J.
pub fn first_law_defect(run: &Record) -> String {
    scientific(first_law::largest_defect(run))
}

/// Two digits and a power of ten.
pub fn scientific(value: Option<f64>) -> String {
    cell(value, |value| format!("{value:.1e}"))
}

/// A quantity that the scene or the run does not have is a dash.
pub fn cell<T>(value: Option<T>, format: impl FnOnce(T) -> String) -> String {
    value.map_or_else(|| "–".to_owned(), format)
}

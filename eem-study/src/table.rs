//! A report as text: a table of all settings, failures, the reference, orders, recommendations; and CSV rows.

use core::fmt::{self, Write};

use crate::quantity::StateQuantity;
use crate::reference::{ReferenceEnd, StudyReference};
use crate::report::StudyReport;
use crate::row::{Statement, StudyRow};
use crate::setting::StepChoice;
use eem_material::number::readable::Readable;

/// A column of the table: its head and the cell of a row.
type Column = (&'static str, fn(&StudyRow) -> String);

const COLUMNS: [Column; 15] = [
    ("scheme", |row| row.setting.scheme.to_string()),
    ("h (s)", step),
    ("error of q", |row| error(row, StateQuantity::Positions)),
    ("of p", |row| error(row, StateQuantity::Momenta)),
    ("of θ", |row| error(row, StateQuantity::Temperatures)),
    ("of γ", |row| error(row, StateQuantity::ViscousStretches)),
    ("energy defect", |row| format!("{:.1e}", row.energy_defect)),
    ("least ΔS (J/K)", |row| {
        format!("{:.1e}", row.least_entropy_change)
    }),
    ("steps", |row| row.steps.to_string()),
    ("rejected", |row| row.rejected.to_string()),
    ("iterations", |row| row.iterations.to_string()),
    ("evaluations", |row| row.evaluations.to_string()),
    ("ms", |row| milliseconds(row.seconds)),
    ("median", |row| milliseconds(row.median_seconds)),
    ("set-up", |row| milliseconds(row.setup_seconds)),
];

/// The legend of the table.
const LEGEND: &str = "Errors at the end time, relative; ? where the references differ by more than 1 % of it. \
    `*`: no other setting is\nfaster and more accurate. ms: the steps alone, the least of all repeats.";

impl StudyReport {
    /// The heads of [`csv_rows`](Self::csv_rows).
    pub const CSV_HEADS: [&str; 11] = [
        "scheme",
        "tolerance",
        "step",
        "error_q",
        "error_p",
        "error_theta",
        "energy_defect",
        "steps",
        "rejected",
        "evaluations",
        "seconds",
    ];

    /// A row of cells per setting: errors at the end time, empty where they are absent or refused, and the
    /// minimum of the wall times. Numbers have 17 significant digits.
    pub fn csv_rows(&self) -> impl Iterator<Item = [String; 11]> {
        self.rows.iter().map(|row| {
            let number = |value: Option<f64>| {
                value.map_or_else(String::new, |value| format!("{value:.16e}"))
            };
            let error = |quantity| number(row.error(quantity));
            [
                row.setting.scheme.to_string(),
                number(row.setting.tolerance()),
                number(row.setting.step()),
                error(StateQuantity::Positions),
                error(StateQuantity::Momenta),
                error(StateQuantity::Temperatures),
                number(Some(row.energy_defect)),
                row.steps.to_string(),
                row.rejected.to_string(),
                row.evaluations.to_string(),
                number(Some(row.seconds)),
            ]
        })
    }
}

impl fmt::Display for StudyReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let front = self.front();
        let mut lines = vec![COLUMNS.map(|(head, _)| head.to_owned())];
        for row in &self.rows {
            let mut cells = COLUMNS.map(|(_, cell)| cell(row));
            // A star marks the best ones.
            if front.iter().any(|best| core::ptr::eq(*best, row)) {
                cells[0].push_str(" *");
            }
            lines.push(cells);
        }
        write_table(f, &lines)?;
        writeln!(f, "\n{LEGEND}")?;
        for row in &self.rows {
            if let Some(error) = &row.failure {
                writeln!(f, "{}: {error}.", row.setting)?;
            }
        }
        write_reference(f, &self.reference)?;
        write_orders(f, self)?;
        for &accuracy in &self.accuracies {
            let recommendation = self.recommend(accuracy).map_err(|_| fmt::Error)?;
            writeln!(f, "{recommendation}")?;
        }
        Ok(())
    }
}

/// The step or the tolerance.
fn step(row: &StudyRow) -> String {
    match row.setting.steps {
        StepChoice::Fixed(step) => Readable(step).to_string(),
        StepChoice::Tolerance(tolerance) => format!("tol. {}", Readable(tolerance)),
    }
}

fn error(row: &StudyRow, quantity: StateQuantity) -> String {
    match row.statement(quantity) {
        _ if row.failure.is_some() => "failed".to_owned(),
        Statement::Stated(error) => format!("{error:.1e}"),
        Statement::Refused { .. } => "?".to_owned(),
        Statement::Absent => "–".to_owned(),
    }
}

fn milliseconds(seconds: f64) -> String {
    format!("{:.3}", 1e3 * seconds)
}

/// Lines of cells below their heads, padded.
fn write_table(f: &mut fmt::Formatter<'_>, lines: &[[String; 15]]) -> fmt::Result {
    let width = |column: usize| {
        let widths = lines.iter().map(|line| line[column].chars().count());
        widths.max().unwrap_or(0)
    };
    let widths: [usize; 15] = core::array::from_fn(width);
    for (number, line) in lines.iter().enumerate() {
        for (cell, width) in line.iter().zip(widths) {
            write!(f, "| {cell:<width$} ")?;
        }
        writeln!(f, "|")?;
        if number == 0 {
            let rules = widths.map(|width| format!("|{:-<1$}", "", width + 2));
            writeln!(f, "{}|", rules.concat())?;
        }
    }
    Ok(())
}

/// The reference and its uncertainty.
fn write_reference(f: &mut fmt::Formatter<'_>, reference: &StudyReference) -> fmt::Result {
    f.write_str("References: ")?;
    match (reference.schemes, reference.step) {
        (Some([first, second]), Some(step)) => {
            write!(f, "{first} and {second} with h = {} s", Readable(step))?;
        }
        _ => f.write_str("as given")?,
    }
    let mut before = "; they differ by ";
    for quantity in StateQuantity::ALL {
        if let Some(doubt) = reference.doubt(quantity).filter(|doubt| doubt.is_finite()) {
            write!(f, "{before}{doubt:.0e} in {}", quantity.symbol())?;
            before = ", ";
        }
    }
    match &reference.end {
        ReferenceEnd::Agreed | ReferenceEnd::Given => f.write_char('.')?,
        ReferenceEnd::Floor => f.write_str(
            ".\nSmaller steps bring them no closer: rounding, or rounding that a chaotic motion has enlarged.",
        )?,
        ReferenceEnd::Limit => f.write_str(
            ".\nThat is not enough for all errors, and their steps are as small as `refinement` allows.",
        )?,
        ReferenceEnd::Failed(error) => write!(f, ".\nThey could not be refined further: {error}.")?,
    }
    f.write_char('\n')
}

/// The observed order of each scheme in the positions.
fn write_orders(f: &mut fmt::Formatter<'_>, report: &StudyReport) -> fmt::Result {
    let mut schemes: Vec<_> = report.rows.iter().map(|row| row.setting.scheme).collect();
    schemes.dedup();
    let mut before = "Orders of q between the two smallest steps: ";
    for scheme in schemes {
        if let Some(order) = report.order(scheme, StateQuantity::Positions) {
            write!(f, "{before}{scheme} {order:.2}")?;
            before = ", ";
        }
    }
    f.write_str(if before == ", " { ".\n" } else { "" })
}

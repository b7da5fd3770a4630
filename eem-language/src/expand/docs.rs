//! The documentation of the generated code: the model as formulas, each function with its cost.

use eem_symbolic::{Program, StageCount, TranscendentalCount};
use proc_macro2::TokenStream;
use quote::quote;

use super::equation::Equation;
use crate::checked::Checked;
use crate::units::Units;

// Expands to:
//
//     /// Generated from the free energy of the model:
//     ///
//     /// ```text
//     /// ψ = …
//     /// f = ∂ψ/∂lambda = …
//     /// ```
//     ///
//     /// | parameter | unit |
//     /// |---|---|
//     /// | `stiffness` | `N/m` |
pub(super) fn formulas(
    checked: &Checked<'_>,
    equations: &[Equation],
    units: &Units,
) -> TokenStream {
    let mut lines = vec![
        "Generated from the free energy of the model:".to_owned(),
        String::new(),
        "```text".to_owned(),
    ];
    let equations = equations.iter().flat_map(|equation| &equation.lines);
    lines.extend(equations.cloned());
    lines.push("```".to_owned());
    lines.extend(table_of_units(checked, units));
    doc(lines)
}

/// Empty for a model without units.
fn table_of_units(checked: &Checked<'_>, units: &Units) -> Vec<String> {
    let parameters = checked.parameters.iter();
    let rows = parameters.filter_map(|parameter| {
        let unit = units.of(parameter.origin)?;
        Some(format!("| `{}` | `{unit}` |", parameter.name))
    });
    let rows: Vec<String> = rows.collect();
    if rows.is_empty() {
        return rows;
    }
    let head = ["", "| parameter | unit |", "|---|---|"].map(str::to_owned);
    head.into_iter().chain(rows).collect()
}

/// `purpose` and what one call costs.
pub(super) fn function(purpose: &str, program: &Program) -> TokenStream {
    let count = program.operation_count();
    let both = StageCount {
        additions: count.old.additions + count.new.additions,
        multiplications: count.old.multiplications + count.new.multiplications,
        divisions: count.old.divisions + count.new.divisions,
        functions: count.old.functions + count.new.functions,
        kernels: count.old.kernels + count.new.kernels,
    };
    paragraphs(purpose, &operations(&both))
}

/// `purpose` and what the part that runs once per step costs.
pub(super) fn old_stage(purpose: &str, program: &Program) -> TokenStream {
    paragraphs(purpose, &operations(&program.operation_count().old))
}

/// `purpose` and what the part that runs once per iteration costs.
pub(super) fn new_stage(purpose: &str, program: &Program) -> TokenStream {
    let cost = operations(&program.operation_count().new);
    let transcendental = transcendental(program.transcendental_count());
    paragraphs(purpose, &format!("{cost}{transcendental}"))
}

/// How many transcendental functions are called, and for how many different arguments.
fn transcendental(count: TranscendentalCount) -> String {
    let TranscendentalCount { calls, arguments } = count;
    let plural = |n: usize, noun: &str| match n {
        1 => format!("1 {noun}"),
        n => format!("{n} {noun}s"),
    };
    if calls == 0 && arguments == 0 {
        return String::new();
    }
    let calls = plural(calls, "call");
    let arguments = plural(arguments, "argument");
    format!(" Transcendental functions: {calls} for {arguments}.")
}

/// `12 operations: 5 additions, 6 multiplications, 1 function.`
fn operations(count: &StageCount) -> String {
    let kinds = [
        (count.additions, "addition"),
        (count.multiplications, "multiplication"),
        (count.divisions, "division"),
        (count.functions, "function"),
        (count.kernels, "divided difference"),
    ];
    let plural = |n: usize, noun: &str| match n {
        1 => format!("1 {noun}"),
        n => format!("{n} {noun}s"),
    };
    let parts = kinds.into_iter().filter(|&(n, _)| n > 0);
    let parts: Vec<String> = parts.map(|(n, noun)| plural(n, noun)).collect();
    match parts.as_slice() {
        [] => "No operations.".to_owned(),
        [only] => format!("{only}."),
        parts => format!(
            "{}: {}.",
            plural(count.total(), "operation"),
            parts.join(", ")
        ),
    }
}

fn paragraphs(first: &str, second: &str) -> TokenStream {
    doc([first.to_owned(), String::new(), second.to_owned()])
}

fn doc(lines: impl IntoIterator<Item = String>) -> TokenStream {
    let lines = lines.into_iter().map(|line| format!(" {line}"));
    quote! { #(#[doc = #lines])* }
}

#[cfg(test)]
mod tests {
    use eem_symbolic::StageCount;

    use super::operations;

    #[test]
    fn costs_are_said_in_words() {
        let mut count = StageCount::default();
        assert_eq!(operations(&count), "No operations.");
        count.divisions = 1;
        assert_eq!(operations(&count), "1 division.");
        count.kernels = 2;
        assert_eq!(
            operations(&count),
            "3 operations: 1 division, 2 divided differences."
        );
    }
}

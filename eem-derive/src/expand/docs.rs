//! The documentation of the generated code: the model as formulas, each function with its cost.

use eem_symbolic::{Formulas, Model, Program, StageCount, TranscendentalCount};
use proc_macro2::TokenStream;
use quote::quote;

use crate::ast::{self, Role};
use crate::checked::Checked;

/// Columns of a line in a formula block.
const WIDTH: usize = 96;
/// Columns by which the second line of a formula is indented.
const INDENT: usize = 4;

// Expands to:
//
//     /// Generated from the free energy of the model.
//     ///
//     /// ```text
//     /// ψ = …
//     /// f = ∂ψ/∂lambda = …
//     /// ```
pub(super) fn formulas(checked: &Checked<'_>, model: &Model) -> TokenStream {
    let mut lines = vec![
        "Generated from the free energy of the model:".to_owned(),
        String::new(),
        "```text".to_owned(),
    ];
    for (left, right) in equations(checked, &model.formulas()) {
        // A long formula comes with a list of definitions, one per line.
        for line in format!("{left} = {right}").lines() {
            wrap(line, &mut lines);
        }
    }
    lines.push("```".to_owned());
    doc(lines)
}

/// Left and right sides, in the order in which a reader wants them.
fn equations(checked: &Checked<'_>, formulas: &Formulas) -> Vec<(String, String)> {
    let names = |role| {
        let variables = checked.variables.iter().filter(move |v| v.role == role);
        variables.map(|v| ast::name(v.ident))
    };
    let theta = names(Role::Temperature).next().unwrap_or_default();
    let mut equations = vec![("ψ".to_owned(), formulas.free_energy.clone())];
    if let Some(entropy) = &formulas.entropy {
        equations.push((format!("s = −∂ψ/∂{theta}"), entropy.clone()));
        let energy = formulas.internal_energy.clone();
        equations.push((format!("e = ψ + {theta} s"), energy));
    }
    for (name, force) in names(Role::Stretch).zip(&formulas.forces) {
        equations.push((format!("f = ∂ψ/∂{name}"), force.clone()));
    }
    for (k, (name, force)) in names(Role::Viscous)
        .zip(&formulas.dashpot_forces)
        .enumerate()
    {
        let g = subscript("g", k, formulas.dashpot_forces.len());
        equations.push((format!("{g} = −∂ψ/∂{name}"), force.clone()));
    }
    if let Some(capacity) = &formulas.heat_capacity {
        equations.push((format!("c = {theta} ∂s/∂{theta}"), capacity.clone()));
    }
    for (k, viscosity) in formulas.viscosities.iter().enumerate() {
        let eta = subscript("η", k, formulas.viscosities.len());
        equations.push((eta, viscosity.clone()));
    }
    equations
}

/// `symbol`, numbered from 1 if there are several.
fn subscript(symbol: &str, index: usize, count: usize) -> String {
    if count == 1 {
        symbol.to_owned()
    } else {
        format!("{symbol}_{}", index + 1)
    }
}

/// Appends a formula, broken in front of operators into lines of at most [`WIDTH`] columns where
/// possible: outside of parentheses rather than inside, late rather than early. What is deeper in
/// parentheses is indented more.
fn wrap(formula: &str, lines: &mut Vec<String>) {
    let mut rest: Vec<char> = formula.chars().collect();
    let (mut indent, mut depth) = (0, 0);
    while rest.len() > WIDTH {
        let Some((deeper, at)) = break_point(&rest, indent) else {
            break;
        };
        depth += deeper;
        indent = INDENT * usize::try_from(1 + depth).unwrap_or(1);
        lines.push(rest[..at].iter().collect());
        // The blank goes, the operator leads the next line.
        rest = [vec![' '; indent], rest.split_off(at + 1)].concat();
    }
    lines.push(rest.into_iter().collect());
}

/// The best blank to break at, and how many more parentheses are open there than at the start.
fn break_point(line: &[char], indent: usize) -> Option<(i32, usize)> {
    let mut depth = 0;
    let mut best: Option<(i32, usize)> = None;
    for at in indent + 1..=WIDTH {
        match line[at] {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ' ' if matches!(line[at + 1..], ['+' | '-', ' ', ..]) => {
                // In the first half only what is outside of everything.
                let late = 2 * at > WIDTH;
                if (late || depth <= 0) && best.is_none_or(|(best, _)| depth <= best) {
                    best = Some((depth, at));
                }
            }
            _ => {}
        }
    }
    best
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

/// How many transcendental functions are called, beside how many arguments they have.
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

    use super::{WIDTH, operations, wrap};

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

    #[test]
    fn long_formulas_are_broken_at_operators() {
        let terms: Vec<String> = (0..60).map(|i| format!("term{i}")).collect();
        let formula = terms.join(" + ");
        let mut lines = Vec::new();
        wrap(&formula, &mut lines);
        assert!(lines.len() > 1);
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH));
        let words: Vec<&str> = lines
            .iter()
            .flat_map(|line| line.split_whitespace())
            .collect();
        assert_eq!(words.join(" "), formula);
    }
}

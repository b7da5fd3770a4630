//! How faults are drawn.

use crate::text::{Source, compile};

/// The drawing of the only fault of a free energy with the parameter k.
fn drawn(psi: &str) -> String {
    let source = Source::new(psi).parameter("k", None);
    let faults = compile(&source).expect_err("this is wrong");
    assert_eq!(faults.all().len(), 1, "{faults}");
    faults.to_string()
}

#[test]
fn carets_stand_below_their_tokens() {
    // Columns are characters, a tab is one, and a line ends before what ends it.
    assert_eq!(
        drawn("|x: Stretch| {\r\n\tlet λ² = x;\r\n\tk * x }")
            .lines()
            .next(),
        Some("error: cannot read `²` in a formula")
    );
    assert_eq!(
        drawn("|λ: Stretch| {\r\n\tlet µ = λ;\tk * µ * y\r\n}"),
        "error: unknown name `y`
 --> psi, line 2, column 21
  |
2 |  let µ = λ; k * µ * y
  |                     ^
  = help: use an argument of the closure, a parameter or an earlier `let`; a new parameter has to be declared, `y`"
    );
}

#[test]
fn what_goes_on_is_drawn_to_the_end_of_its_line() {
    let lines = "\n".repeat(8);
    assert_eq!(
        drawn(&format!("{lines}|x: Stretch| k * [x,  // two\n 1]")),
        "error: an array is not allowed in a formula
 --> psi, line 9, column 18
  |
9 | |x: Stretch| k * [x,  // two
  |                  ^^^^^^^^^^^
  = help: bind each number with its own `let`"
    );
    let tenth = drawn(&format!("{lines}\n|x: Stretch| k * [x]"));
    assert!(
        tenth.contains("\n  --> psi, line 10, column 18\n   |\n10 | |x"),
        "{tenth}"
    );
    assert!(
        tenth.contains("\n   |                  ^^^\n   = help"),
        "{tenth}"
    );
}

#[test]
fn of_a_long_line_a_part_is_drawn() {
    let long = format!(
        "|x: Stretch| k * x{} + y{}",
        " + x".repeat(100),
        " + x".repeat(100)
    );
    let drawn = drawn(&long);
    assert!(drawn.contains("line 1, column 422"), "{drawn}");
    let lines: Vec<Vec<char>> = drawn.lines().map(|line| line.chars().collect()).collect();
    let (line, carets) = (&lines[3], &lines[4]);
    let caret = carets
        .iter()
        .position(|&c| c == '^')
        .expect("there is a caret");
    assert_eq!((line[caret], carets.len()), ('y', caret + 1));
    assert!(
        line[4] == '…' && line.ends_with(&['…']) && line.len() < 170,
        "{drawn}"
    );
}

#[test]
fn calls_of_helpers_are_named() {
    let source = Source::new("|x: Stretch| {\n let f = |y| ln(y);\n k * (f(x - x - 1) + f(-2)) }");
    let faults = compile(&source.parameter("k", None)).expect_err("this is wrong");
    let calls: Vec<_> = faults.all().iter().flat_map(|fault| &fault.calls).collect();
    assert_eq!(calls, ["`f(x - x - 1)`", "`f(-2)`"]);
    assert_eq!(
        faults.to_string(),
        "error: `ln` has no value here: its argument is never positive
 --> psi, line 2, column 17
  |
2 |  let f = |y| ln(y);
  |                 ^
  = in the call `f(x - x - 1)`
  = in the call `f(-2)`
  = help: `ln(x)` is defined for `x > 0`"
    );
}

#[test]
fn warnings_are_in_the_order_of_the_source() {
    let source =
        Source::new("|e1: StrainTrace| {\n k * ln(1 + e1).powi(2)\n + k * (cosh(e1) - 1) }");
    let compiled = compile(&source.parameter("k", None)).expect("this is right");
    let lines: Vec<_> = compiled
        .warnings()
        .iter()
        .map(|w| (w.line, w.column, w.width))
        .collect();
    assert_eq!(lines, [(2, 6, 10), (3, 8, 14)]);
}

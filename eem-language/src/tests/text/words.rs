//! What only a text is told, and in which words.

use std::fs;
use std::path::Path;

use crate::dialect::Dialect;
use crate::message::written;
use crate::tests::catalogue::{file_key, messages};
use crate::text::{Fault, Source, compile, compile_in};

/// Part, line, column, width, text and help of every mistake.
fn faults(source: &Source) -> Vec<(String, usize, usize, usize, String, String)> {
    // Not on a thread of its own: messages remember the thread that wrote them.
    let faults = compile_in(source, Dialect::Text).expect_err("this is wrong");
    let fault = |f: &Fault| {
        let (text, help) = (f.text.clone(), f.help.clone());
        (f.part.to_string(), f.line, f.column, f.width, text, help)
    };
    faults.all().iter().map(fault).collect()
}

/// A source, and what is said about it: part, line, column, width, text, and a part of the help.
type Case<'c> = (
    Source,
    &'c [(&'c str, usize, usize, usize, &'c str, &'c str)],
);

fn check(cases: &[Case<'_>]) {
    for (source, expected) in cases {
        let found = faults(source);
        let all = format!("{source:?}: {found:#?}");
        assert_eq!(found.len(), expected.len(), "{all}");
        for (found, expected) in found.iter().zip(*expected) {
            let (part, line, column, width, text, help) = found;
            let place = (part.as_str(), *line, *column, *width);
            assert_eq!(
                place,
                (expected.0, expected.1, expected.2, expected.3),
                "{all}"
            );
            assert_eq!(text, expected.4, "{all}");
            assert!(help.contains(expected.5), "{all}");
        }
    }
}

fn psi(text: &str) -> Source {
    Source::new(text)
}

#[test]
fn texts_that_are_no_tokens_are_reported_together() {
    let long = "x".repeat(1 + (64 << 10));
    let most = "this text has 65537 bytes, and may have 65536 at most";
    check(&[
        (
            psi("|x: Stretch| {\n  k * (x\n}")
                .viscosity("x", "η · k")
                .parameter("2k", None)
                .parameter("fn", Some("N"))
                .parameter("k", None)
                .parameter("k", None),
            &[
                ("psi", 3, 1, 1, "nothing fits this `}`", "counterpart"),
                (
                    "viscosity of `x`",
                    1,
                    3,
                    1,
                    "cannot read `·` in a formula",
                    "write `*`",
                ),
                (
                    "parameter `2k`",
                    1,
                    1,
                    2,
                    "`2k` is not a name",
                    "begins with no digit",
                ),
                ("parameter `fn`", 1, 1, 2, "`fn` is not a name", "keyword"),
                (
                    "parameter `k`",
                    1,
                    1,
                    1,
                    "a second parameter `k`",
                    "remove one",
                ),
            ],
        ),
        (
            psi("|x: Stretch| (x"),
            &[("psi", 1, 14, 1, "this `(` is not closed", "counterpart")],
        ),
        (
            psi("|x: Stretch| x) + (x"),
            &[("psi", 1, 15, 1, "nothing fits this `)`", "")],
        ),
        (
            psi("|x: Stretch| x²"),
            &[("psi", 1, 15, 1, "cannot read `²` in a formula", "x.powi(2)")],
        ),
        (
            psi("|x: Stretch| x /* x"),
            &[("psi", 1, 16, 1, "cannot read `/` in a formula", "`*/`")],
        ),
        (
            psi("|x: Stretch| \"x"),
            &[("psi", 1, 14, 1, "cannot read `\"` in a formula", "strings")],
        ),
        (
            psi("\u{feff}|x: Stretch| x"),
            &[("psi", 1, 1, 1, "cannot read `\u{feff}` in a formula", "")],
        ),
        (psi(&long), &[("psi", 1, 1, 65537, most, "shorten")]),
        (
            psi("|x: Stretch| k * x").parameter("k", Some(&"(".repeat(257))),
            &[(
                "unit of `k`",
                1,
                1,
                257,
                "this text has 257 bytes, and may have 256 at most",
                "",
            )],
        ),
    ]);
}

#[test]
fn names_are_names() {
    for name in [
        "", " ", "a b", "1", "k[", "k[]", "k[n]", "k[1u8]", "k[-1]", "k[2][2]", "self", "((k))",
        "k()",
    ] {
        let source = psi("|x: Stretch| x").parameter(name, None);
        let found = faults(&source);
        assert_eq!(found.len(), 1, "{found:?}");
    }
    for name in ["k ", "r#type", "λ_0", "_k[3]"] {
        let source = psi("|x: Stretch| x.powi(2)").parameter(name, None);
        let found = compile(&source).map_err(|faults| faults.to_string());
        let unused = name.starts_with('_');
        assert_eq!(found.is_ok(), unused, "{found:?}");
    }
    let array = psi("|x: Stretch, g: Viscous| (x - g).powi(2)").viscosity("g[2]", "1");
    assert_eq!(faults(&array)[0].4, "`g[2]` is not a name");
}

#[test]
fn constants_of_a_program_have_no_meaning() {
    let help = "a new parameter has to be declared, `R`";
    let of_program = "`crate::gas::R` is a constant of a program, and a text belongs to none";
    check(&[
        (
            psi("|x: Stretch| R * x"),
            &[("psi", 1, 14, 1, "unknown name `R`", help)],
        ),
        (
            psi("|x: Stretch| R[0] * x"),
            &[("psi", 1, 14, 1, "unknown name `R`", help)],
        ),
        (
            psi("|x: Stretch| diff(x * x, R)"),
            &[("psi", 1, 26, 1, "unknown name `R`", help)],
        ),
        (
            psi("|x: Stretch| MU * x").parameter("mu", None),
            &[("psi", 1, 14, 2, "unknown name `MU`", "did you mean `mu`?")],
        ),
        (
            psi("|x: Stretch| crate::gas::R * x"),
            &[("psi", 1, 14, 13, of_program, "a parameter, `R`")],
        ),
        (
            psi("|x: Stretch| core::f64::consts::P * x"),
            &[(
                "psi",
                1,
                14,
                20,
                "unknown constant `core::f64::consts::P`",
                "did you mean `PI`?",
            )],
        ),
    ]);
    let known = psi("|x: Stretch| PI * core::f64::consts::TAU * x.powi(2)");
    assert!(compile(&known).is_ok());
}

#[test]
fn words_are_those_of_a_text() {
    let closure = "`|lambda: Stretch, theta: Temperature| …`";
    let end = "cannot read the formula: unexpected end of input, expected an expression";
    check(&[
        (
            psi(""),
            &[("psi", 1, 1, 1, "a free energy without a closure", closure)],
        ),
        (
            psi("// k"),
            &[("psi", 1, 1, 4, "a free energy without a closure", closure)],
        ),
        (
            psi("k * x"),
            &[(
                "psi",
                1,
                1,
                5,
                "the free energy must be a closure, whose arguments have roles",
                closure,
            )],
        ),
        (
            psi("|x: Stretch|\n  2 * \n\n"),
            &[("psi", 2, 6, 1, end, "")],
        ),
        (
            psi("|x: Stretch| x, |y: Stretch| y"),
            &[(
                "psi",
                1,
                1,
                30,
                "a second free energy",
                "a text has one closure; add the terms, or write another text",
            )],
        ),
        (
            psi("crate = ::eem, |x: Stretch| x"),
            &[(
                "psi",
                1,
                1,
                5,
                "a free energy has no option `crate`",
                "there is only its closure",
            )],
        ),
        (
            psi("crate = \"eem\", |x: Stretch| x"),
            &[(
                "psi",
                1,
                9,
                5,
                "a free energy has no option `crate`",
                "there is only its closure",
            )],
        ),
    ]);
}

#[test]
fn laws_and_parameters_have_the_words_of_a_text() {
    let end = "cannot read the formula: unexpected end of input, expected an expression";
    check(&[
        (
            psi("|x: Stretch, a: Viscous, b: Viscous| (x - a - b).powi(2)")
                .viscosity("a", "1, b = 2"),
            &[(
                "viscosity of `a`",
                1,
                4,
                1,
                "a law for `b` in the text of another",
                "a text of its own",
            )],
        ),
        (
            psi("|x: Stretch, a: Viscous| (x - a).powi(2)").viscosity("a", ""),
            &[("viscosity of `a`", 1, 1, 1, end, "")],
        ),
        (
            psi("|x: Stretch, a: Viscous| (x - a).powi(2)"),
            &[(
                "psi",
                1,
                14,
                1,
                "the dashpot `a` has no viscosity law",
                "write a viscosity for `a`, in N s/m",
            )],
        ),
        (
            psi("|x: Stretch| k[0] * x").parameter("k[2]", None),
            &[(
                "parameter `k[2]`",
                1,
                1,
                1,
                "neither the free energy nor a viscosity uses `k[1]`",
                "remove the parameter, or call it `_k` to keep it",
            )],
        ),
        (
            psi("|x: Stretch| k * (x - l)")
                .parameter("k", Some("N"))
                .parameter("l", None),
            &[(
                "parameter `l`",
                1,
                1,
                1,
                "`l` has no unit, but other parameters of the formula have one",
                "the formula needs the unit `m`",
            )],
        ),
    ]);
}

#[test]
fn every_message_of_texts_has_a_case() {
    written::take();
    texts_that_are_no_tokens_are_reported_together();
    names_are_names();
    constants_of_a_program_have_no_meaning();
    words_are_those_of_a_text();
    laws_and_parameters_have_the_words_of_a_text();
    let key = "src/message/text.rs";
    let written = written::take().into_iter();
    let written = written.filter(|(file, _)| file_key(Path::new(file)) == key);
    let lines: Vec<u32> = written.map(|(_, line)| line).collect();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(key);
    let source = fs::read_to_string(file).expect("the catalogue can be read");
    let mut missing = messages(&source);
    missing.retain(|(first, last, _)| !lines.iter().any(|line| (first..=last).contains(&line)));
    assert!(missing.is_empty(), "without a case: {missing:?}");
}

//! What texts cannot do to the program that reads them: use up its stack, or its memory.

use proc_macro2::TokenStream;

use crate::dialect::Dialect;
use crate::text::{Source, compile, compile_in, reader};

/// What stands before and behind the x of a free energy, many times.
const NESTED: [(&str, &str); 28] = [
    ("(", ")"),
    ("{", "}"),
    ("[", "]"),
    ("exp(", ")"),
    ("-", ""),
    ("", " + x"),
    ("", ".exp()"),
    ("", ".y"),
    ("", "[0]"),
    ("", "(0)"),
    ("", " as f64"),
    ("", "?"),
    ("return ", ""),
    ("break ", ""),
    ("..", ""),
    ("&mut ", ""),
    ("|y| ", ""),
    ("if x { ", " }"),
    ("if x { x } else ", "{ x }"),
    ("let y = ", ""),
    ("'a: ", ""),
    ("<", ""),
    ("<f64 as T<", ">>::Y"),
    ("x as *const ", ""),
    ("x as fn() -> ", ""),
    ("x::<Vec<", ">>"),
    ("y = ", ""),
    ("#[a] ", ""),
];

#[test]
fn no_nesting_uses_up_the_stack() {
    for (before, behind) in NESTED {
        for count in [10, 30, 100, 300, 480, 900, 5000] {
            let psi = format!("{}x{}", before.repeat(count), behind.repeat(count));
            let source = Source::new(format!("|x: Stretch| {psi}"));
            // Right or wrong, there is an answer.
            let answer = compile(&source).map(|compiled| compiled.warnings().len());
            let role = compile(&Source::new(format!("|x: {psi}| x")));
            drop((answer, role));
        }
    }
    let unit = format!("{}N{}", "(".repeat(120), ")".repeat(120));
    let source = Source::new("|x: Stretch| k * x").parameter("k", Some(&unit));
    assert!(compile(&source).is_ok());
}

/// A free energy with this many terms, that all differ.
fn sum(terms: u32) -> Source {
    let term = |i| format!(" + {i} * k * ln(x / {i}).powi(2) * (x - {i})");
    let terms: String = (1..=terms).map(term).collect();
    Source::new(format!("|x: Stretch| k * x{terms}")).parameter("k", None)
}

#[test]
fn a_sum_of_hundreds_of_terms_is_flat() {
    for terms in [300, 950] {
        let compiled = compile(&sum(terms)).expect("this is right");
        assert!(compiled.programs().is_ok());
    }
    let text = compile(&sum(1200))
        .expect_err("there are too many")
        .to_string();
    assert!(
        text.contains("this sum has 1201 terms, more than the 1001"),
        "{text}"
    );
    let short = format!("|x: Stretch| x{}", " + x".repeat(10_000));
    let text = compile(&Source::new(short))
        .expect_err("there are too many")
        .to_string();
    assert!(
        text.contains("this sum has 10001 terms, more than the 1001"),
        "{text}"
    );
    let brackets = format!("|x: Stretch| {}x{}", "(".repeat(30_000), ")".repeat(30_000));
    let text = compile(&Source::new(brackets))
        .expect_err("this is deep")
        .to_string();
    assert!(text.contains("nested too deeply"), "{text}");
}

#[test]
fn bindings_may_be_a_long_chain() {
    let chain: Vec<String> = (1..1000)
        .map(|i| format!("let a{i} = exp(a{});", i - 1))
        .collect();
    let chain = chain.concat();
    let source = Source::new(format!("|x: Stretch| {{ let a0 = x; {chain} a999 }}"));
    let compiled = compile(&source).expect("this is right");
    assert!(compiled.programs().is_ok());
}

fn source(number: usize) -> Source {
    let psi = format!(
        "|x: Stretch, theta: Temperature| {{ {number}.5 * k * ln(x / l).powi(2) - c * theta * ln(theta) }}"
    );
    Source::new(psi)
        .parameter("k", None)
        .parameter("c", None)
        .parameter("l", None)
}

#[test]
fn texts_are_not_kept() {
    let file = |tokens: TokenStream| {
        let first = tokens.into_iter().next().expect("a token");
        first.span().file()
    };
    let read = || "x".parse::<TokenStream>().expect("a token");
    // In this thread, as where there are no others.
    for number in 0..50 {
        drop(compile_in(&source(number), Dialect::Text));
        assert_ne!(file(read()), "<parsed string 1>");
        reader::forget_places();
    }
    assert_eq!(file(read()), "<parsed string 1>");
    // In threads, which leave the places of this one alone.
    let mine = read();
    drop(compile(&source(0)));
    assert_eq!(file(mine), "<parsed string 2>");
    assert_eq!(file(read()), "<parsed string 3>");
}

/// `cargo test --release -p eem-language memory -- --ignored`: 10⁵ compilations, half of them of wrong texts.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes minutes"]
fn memory_does_not_grow() {
    let resident = || {
        let status = std::fs::read_to_string("/proc/self/status").expect("Linux says it");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let number = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
        number.expect("a number of KiB")
    };
    let run = |numbers: std::ops::Range<usize>| {
        for number in numbers {
            assert!(compile(&source(number)).is_ok());
            assert!(compile(&source(number).parameter("b", None)).is_err());
        }
    };
    run(0..500);
    let before = resident();
    run(500..25_500);
    let half_way = resident();
    run(25_500..50_500);
    let after = resident();
    println!("{before} KiB, then {half_way} KiB, then {after} KiB");
    // Each text alone has 100 bytes: 10⁵ of them would be 10 MB.
    assert!(after < before + 4096, "{before} KiB grew to {after} KiB");
}

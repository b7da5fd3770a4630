//! Any texts as a model: there are programs, or faults with places in the texts.

use eem_language::text::{Compiled, Fault, Faults, Part, Source, compile};

use crate::expressions::decode;

/// Bytes beyond this are ignored: longer texts are refused.
const LONGEST: usize = 70_000;
/// Of longer texts no programs are made: the longest would take seconds.
const LONGEST_WITH_PROGRAMS: usize = 600;
/// What ends a part.
const END: &str = "~";

/// A source with the texts before each `~`: ψ, then the names and laws of viscosities, whose number is in the first byte,
/// then names and units of parameters. If the first byte is odd, the bytes are numbers of words.
///
/// # Panics
///
/// If reading does, if a place is outside of its text, or if the answer is not the same twice.
pub fn text(data: &[u8]) {
    let Some((kind, text)) = decode(data, LONGEST, END) else {
        return;
    };
    let source = source(&text, usize::from(kind / 2 % 4));
    let answer = compile(&source);
    match &answer {
        Ok(compiled) => {
            check_all(&source, compiled.warnings());
            if text.len() <= LONGEST_WITH_PROGRAMS {
                match compiled.programs() {
                    Ok(programs) => programs.verify().expect("valid programs"),
                    Err(faults) => check_all(&source, faults.all()),
                }
            }
        }
        Err(faults) => {
            assert_ne!(faults.all(), [], "no model and no fault: {source:?}");
            check_all(&source, faults.all());
        }
    }
    assert_eq!(
        said(&answer),
        said(&compile(&source)),
        "two answers to {source:?}"
    );
}

/// All that is said, as it is drawn.
fn said(answer: &Result<Compiled, Faults>) -> Vec<String> {
    let faults = answer.as_ref().map_or_else(Faults::all, Compiled::warnings);
    faults.iter().map(ToString::to_string).collect()
}

fn source(text: &str, viscosities: usize) -> Source {
    let mut parts = text.split(END);
    let mut source = Source::new(parts.next().unwrap_or_default());
    for _ in 0..viscosities {
        let (Some(dashpot), Some(law)) = (parts.next(), parts.next()) else {
            return source;
        };
        source = source.viscosity(dashpot, law);
    }
    while let Some(name) = parts.next() {
        source = source.parameter(name, parts.next().filter(|unit| !unit.is_empty()));
    }
    source
}

fn check_all(source: &Source, faults: &[Fault]) {
    for fault in faults {
        check(source, fault);
    }
}

/// The place of a fault is in its part, and can be drawn.
fn check(source: &Source, fault: &Fault) {
    let text = match &fault.part {
        Part::FreeEnergy => Some(source.free_energy()),
        Part::Dashpot(name) | Part::Parameter(name) => Some(name.as_str()),
        // Several may have one name.
        Part::Viscosity(_) | Part::Unit(_) => None,
    };
    if let Some(text) = text {
        let line = text.split('\n').nth(fault.line - 1);
        let line = line.unwrap_or_else(|| panic!("{fault:?} in {source:?}"));
        let last = fault.column - 1 + fault.width;
        assert!(last <= line.chars().count() + 1, "{fault:?} in {source:?}");
    }
    let lines = fault.to_string().lines().count();
    assert!(lines >= 6, "{fault}");
}

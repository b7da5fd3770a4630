//! Any texts as a model: there are programs, or faults with places in the texts.

use eem_language::text::{Fault, Part, Source, compile};

use crate::expressions::WORDS;

/// Bytes beyond this are ignored: longer texts are refused.
const LONGEST: usize = 70_000;
/// Of longer texts no programs are made: the longest would take seconds.
const LONGEST_WITH_PROGRAMS: usize = 600;
/// What ends a part.
const END: char = '~';

/// A source with the texts before each `~`: ψ, then the names and laws of viscosities, whose number is in the first byte,
/// then names and units of parameters. If the first byte is odd, the bytes are numbers of [`WORDS`].
///
/// # Panics
///
/// If reading does, if a place is outside of its text, or if the answer is not the same twice.
pub fn text(data: &[u8]) {
    let Some((&kind, data)) = data.split_first() else {
        return;
    };
    let data = &data[..data.len().min(LONGEST)];
    let text = if kind % 2 == 0 {
        String::from_utf8_lossy(data).into_owned()
    } else {
        let word = |&byte: &u8| WORDS.get(usize::from(byte)).copied().unwrap_or("~");
        data.iter().map(word).collect()
    };
    let source = source(&text, usize::from(kind / 2 % 4));
    let answer = compile(&source);
    match &answer {
        Ok(compiled) => {
            compiled.warnings().iter().for_each(|fault| check(&source, fault));
            if text.len() <= LONGEST_WITH_PROGRAMS {
                match compiled.programs() {
                    Ok(programs) => programs.verify().expect("valid programs"),
                    Err(faults) => faults.all().iter().for_each(|fault| check(&source, fault)),
                }
            }
        }
        Err(faults) => {
            assert!(!faults.all().is_empty(), "no model and no fault: {source:?}");
            faults.all().iter().for_each(|fault| check(&source, fault));
        }
    }
    let again = compile(&source).map_err(|faults| faults.to_string());
    let first = answer.as_ref().map_err(ToString::to_string);
    assert_eq!(
        first.map(|compiled| compiled.warnings()),
        again.as_ref().map(|compiled| compiled.warnings()).map_err(Clone::clone),
        "two answers to {source:?}"
    );
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

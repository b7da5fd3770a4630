//! Any texts as a model: there are programs, or faults with places in the texts.

mod answers;

use eem_language::text::{Compiled, Fault, Faults, Part, Source, compile};

use crate::expressions::decode;
use answers::check_answer;

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
    check_answer(&source, &answer, text.len() <= LONGEST_WITH_PROGRAMS);
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

//! The compile-fail cases: a text gets the messages of the struct at the same places, in its own words.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use super::item::{AsText, items};
use syn::spanned::Spanned as _;

use crate::dialect::Dialect;
use crate::tests::catalogue::sources;
use crate::text::{Fault, Level, Part, compile_in};

/// Items that texts cannot say, or about which something else is said. Why.
const RUST_ONLY: &[(&str, &str, &str)] = &[
    (
        "attribute/argument_hides_field",
        "Spring",
        "a field that is no number",
    ),
    ("attribute/empty_free_energy", "Bare", "attributes"),
    ("attribute/empty_free_energy", "Empty", "attributes"),
    (
        "attribute/empty_free_energy",
        "OnlyThePath",
        "the path of the crate",
    ),
    ("attribute/missing_free_energy", "Spring", "attributes"),
    ("attribute/second_crate", "Spring", "the path of the crate"),
    ("attribute/second_free_energy", "Spring", "attributes"),
    (
        "attribute/too_deep",
        "Model",
        "a text may be nested less deeply, so that the place is another",
    ),
    (
        "attribute/unknown_option",
        "Quoted",
        "the path of the crate",
    ),
    (
        "attribute/unknown_option",
        "NoComma",
        "the path of the crate",
    ),
    (
        "attribute/unreadable_free_energy",
        "NameValue",
        "attributes",
    ),
    ("attribute/unreadable_viscosity", "Bare", "attributes"),
    ("attribute/unreadable_viscosity", "Empty", "attributes"),
    ("attribute/unreadable_viscosity", "Nameless", "attributes"),
    ("attribute/unreadable_viscosity", "Colon", "attributes"),
    ("expression/constants", "Model", "a constant of the program"),
    ("expression/entries", "Model", "a constant of the program"),
    (
        "field/arrays",
        "Model",
        "an array whose length is a constant",
    ),
    ("field/attribute_on_field", "Spring", "attributes"),
    (
        "field/not_a_parameter",
        "Model",
        "fields that are no numbers",
    ),
    ("field/second_scalar", "Spring", "types of fields"),
    ("field/unused_and_used", "Spring", "marks of fields"),
    ("item/enumeration", "Material", "items"),
    ("item/tuple_struct", "Spring", "items"),
    ("item/union", "Material", "items"),
    ("unit/constants", "Model", "constants of the program"),
    ("unit/constants", "Scaled", "constants of the program"),
    ("unit/constants", "Nothing", "constants of the program"),
    ("unit/not_a_string", "Model", "attributes"),
    ("unit/not_on_a_field", "Model", "attributes"),
    ("unit/second", "Model", "attributes"),
];

/// Words that have no meaning in a text.
const WORDS_OF_RUST: [&str; 7] = [
    "#[",
    "struct",
    "field",
    ": f64",
    "Rust",
    "[f64",
    "attribute",
];

/// What the compiler prints for one mistake.
struct Printed {
    level: Level,
    text: String,
    line: usize,
    column: usize,
    /// Carets, if it is on one line.
    width: Option<usize>,
}

/// The messages in a file of expected output.
fn printed(text: &str) -> Vec<Printed> {
    let mut all = Vec::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let (level, first) = match line.split_once(": ") {
            Some(("error", first)) => (Level::Error, first),
            Some(("warning", first)) => (Level::Warning, first),
            _ => continue,
        };
        let first = first.strip_prefix("use of deprecated macro `formula`: ");
        let level = if first.is_some() {
            Level::Warning
        } else {
            level
        };
        let mut words = first.unwrap_or_else(|| line.split_at(7).1).to_owned();
        let place = loop {
            let line = lines.next().expect("a message has a place");
            match line.trim_start().strip_prefix("--> ") {
                Some(place) => break place,
                None => write!(words, "\n{}", line.trim_start()).expect("a string"),
            }
        };
        let mut place = place
            .rsplit(':')
            .map(|number| number.parse().expect("a number"));
        let (column, line) = (place.next(), place.next());
        let mut width = None;
        while let Some(line) = lines.next_if(|line| !line.is_empty()) {
            let carets = line.split_once('|').map_or("", |(_, drawn)| drawn).trim();
            if width.is_none() && !carets.is_empty() && carets.chars().all(|c| c == '^') {
                width = Some(carets.len());
            }
        }
        all.push(Printed {
            level,
            text: words,
            line: line.expect("a line"),
            column: column.expect("a column"),
            width,
        });
    }
    all
}

/// The byte of a file at a line and a column.
fn byte(file: &str, line: usize, column: usize) -> usize {
    let before: usize = file
        .split_inclusive('\n')
        .take(line - 1)
        .map(str::len)
        .sum();
    let here = file[before..].chars().take(column - 1);
    before + here.map(char::len_utf8).sum::<usize>()
}

type Said = (Part, usize, usize, Option<usize>, String);

/// What is said about a text.
fn faults(item: &AsText, dialect: Dialect, level: Level) -> Vec<Fault> {
    let compiled = match compile_in(&item.source, dialect) {
        Ok(compiled) => compiled,
        Err(faults) => return faults.all().to_vec(),
    };
    match (level, compiled.programs()) {
        (Level::Error, Err(faults)) => faults.all().to_vec(),
        (Level::Error, Ok(_)) => Vec::new(),
        (Level::Warning, _) => compiled.warnings().to_vec(),
    }
}

/// As the compiler prints it.
fn said(fault: &Fault) -> Said {
    let calls = crate::message::calls_shown(&fault.calls);
    let lines = [fault.text.clone()].into_iter().chain(calls);
    let lines: Vec<String> = lines.chain([format!("help: {}", fault.help)]).collect();
    let Fault { line, column, .. } = *fault;
    (
        fault.part.clone(),
        line,
        column,
        Some(fault.width),
        lines.join("\n"),
    )
}

/// Compares one item with what is expected of it; what differs.
fn differs(file: &str, item: &syn::DeriveInput, expected: &[&Printed]) -> Result<(), String> {
    let text = AsText::new(file, item)?;
    let errors = expected.iter().any(|printed| printed.level == Level::Error);
    let level = if errors { Level::Error } else { Level::Warning };
    let expected = expected.iter().filter(|printed| printed.level == level);
    let place = |printed: &&Printed| {
        let place = text.place(file, byte(file, printed.line, printed.column));
        let place = place.ok_or_else(|| format!("no part has the place of: {}", printed.text));
        place.map(|(part, line, column)| (part, line, column, printed.width, printed.text.clone()))
    };
    let mut expected: Vec<Said> = expected.map(place).collect::<Result<_, _>>()?;
    let as_derived = faults(&text, Dialect::Attribute, level);
    let mut found: Vec<Said> = as_derived.iter().map(said).collect();
    for said in [&mut expected, &mut found] {
        said.sort_by_key(|said| format!("{said:?}"));
    }
    for (expected, found) in expected.iter_mut().zip(&mut found) {
        // Quotes belong to the width of a literal, and what goes on in the next line has another one.
        let quoted = matches!(expected.0, Part::Unit(_));
        // The compiler is given the first token of what is warned of.
        if expected.3.is_none() || quoted || level == Level::Warning {
            (expected.3, found.3) = (None, None);
        }
    }
    if let Some((e, f)) = expected.iter().zip(&found).find(|(e, f)| e != f) {
        return Err(format!("expected {e:#?}\nfound {f:#?}"));
    }
    if expected.len() != found.len() {
        let all = format!("expected {expected:#?}\nfound {found:#?}");
        return Err(format!(
            "{} instead of {}\n{all}",
            found.len(),
            expected.len()
        ));
    }
    let places = |faults: &[Fault]| -> Vec<_> {
        let place = |f: &Fault| (f.part.clone(), f.line, f.column, f.width);
        faults.iter().map(place).collect()
    };
    let as_text = faults(&text, Dialect::Text, level);
    if places(&as_text) != places(&as_derived) {
        return Err(format!("in words of a text: {as_text:#?}"));
    }
    for fault in as_text {
        // What is written is called by its name in every dialect.
        let (_, _, _, _, words) = said(&fault);
        let words = words
            .split("is not allowed in a formula")
            .last()
            .unwrap_or_default();
        if let Some(word) = WORDS_OF_RUST.iter().find(|word| words.contains(*word)) {
            return Err(format!("`{word}` in a text: {words}"));
        }
    }
    Ok(())
}

#[test]
fn texts_get_the_messages_of_structs_at_the_same_places() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../eem-ui/tests/ui");
    let mut rust_only: Vec<_> = RUST_ONLY.iter().collect();
    let (mut same, mut wrong) = (0, Vec::new());
    for case in sources(&root) {
        let file = fs::read_to_string(&case).expect("the case can be read");
        let expected = case.with_extension("stderr");
        let expected = printed(&fs::read_to_string(&expected).expect("it has an output"));
        let case = case
            .strip_prefix(&root)
            .expect("it is below")
            .with_extension("");
        let case = case.to_string_lossy().replace('\\', "/");
        for item in items(&file) {
            let span = item.span();
            let lines = span.start().line..=span.end().line;
            let of_item: Vec<&Printed> = expected
                .iter()
                .filter(|printed| lines.contains(&printed.line))
                .collect();
            let listed = rust_only
                .iter()
                .position(|(c, i, _)| *c == case && item.ident == i);
            match (differs(&file, &item, &of_item), listed) {
                (Ok(()), None) => same += 1,
                (Ok(()), Some(_)) => wrong.push(format!("{case}, {}: is listed", item.ident)),
                (Err(_), Some(listed)) => drop(rust_only.remove(listed)),
                (Err(what), None) => wrong.push(format!("{case}, {}: {what}", item.ident)),
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(rust_only.is_empty(), "listed, and not there: {rust_only:?}");
    assert!(same > 100, "{same} items were compared");
}

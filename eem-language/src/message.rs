//! Every message a user can get, in one place.
//!
//! A message is one lower-case sentence about what is wrong, with the offending text in
//! backticks, and a line `help: …` that says what to write instead. There is one function per
//! message. The modules are the folders of the compile-fail tests in `eem-ui/tests/ui`;
//! `tests::catalogue` checks that every message has a case there.

use crate::dialect::Dialect;

pub(crate) mod attribute;
pub(crate) mod expression;
pub(crate) mod field;
pub(crate) mod item;
pub(crate) mod text;
pub(crate) mod unit;
#[cfg(test)]
pub(crate) mod written;

/// Largest number of calls of helpers that a message names.
const CALLS: usize = 3;

/// Words of a message in both dialects.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Said {
    attribute: String,
    text: String,
}

/// Words that take their nouns from the dialect.
fn said(words: impl Fn(Dialect) -> String) -> Said {
    Said {
        attribute: words(Dialect::Attribute),
        text: words(Dialect::Text),
    }
}

impl Said {
    fn in_dialect(&self, dialect: Dialect) -> &str {
        dialect.choose(&self.attribute, &self.text)
    }
}

impl From<String> for Said {
    fn from(words: String) -> Self {
        Self {
            text: words.clone(),
            attribute: words,
        }
    }
}

impl From<&str> for Said {
    fn from(words: &str) -> Self {
        words.to_owned().into()
    }
}

/// What is wrong and what to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Message {
    text: Said,
    help: Said,
}

impl Message {
    #[cfg_attr(test, track_caller)]
    fn new(text: impl Into<Said>, help: impl Into<Said>) -> Self {
        #[cfg(test)]
        written::record(std::panic::Location::caller());
        Self {
            text: text.into(),
            help: help.into(),
        }
    }
}

impl Message {
    /// What is wrong.
    pub(crate) fn text(&self, dialect: Dialect) -> &str {
        self.text.in_dialect(dialect)
    }

    /// What to write.
    pub(crate) fn help(&self, dialect: Dialect) -> &str {
        self.help.in_dialect(dialect)
    }

    /// The whole message for the compiler, with the calls of helpers to which it applies, as quoted.
    pub(crate) fn whole(&self, dialect: Dialect, calls: &[String]) -> String {
        let mut lines = vec![self.text(dialect).to_owned()];
        lines.extend(calls_shown(calls));
        lines.push(format!("help: {}", self.help(dialect)));
        lines.join("\n")
    }
}

/// A line for every call that a message names, and one for all others.
pub(crate) fn calls_shown(calls: &[String]) -> impl Iterator<Item = String> {
    let shown = calls.iter().take(CALLS);
    let others = calls.len().checked_sub(CALLS).filter(|&others| others > 0);
    shown
        .map(|call| format!("in the call {call}"))
        .chain(others.map(|others| format!("and in other calls: {others}")))
}

/// `a`, `b` and `c` in backticks, for lists in messages.
fn list<'n>(names: impl IntoIterator<Item = &'n str>) -> String {
    joined(names, "and")
}

/// `a`, `b` or `c` in backticks.
fn alternatives<'n>(names: impl IntoIterator<Item = &'n str>) -> String {
    joined(names, "or")
}

fn joined<'n>(names: impl IntoIterator<Item = &'n str>, word: &str) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        None => "nothing".to_owned(),
        Some((only, [])) => only.clone(),
        Some((last, others)) => format!("{} {word} {last}", others.join(", ")),
    }
}

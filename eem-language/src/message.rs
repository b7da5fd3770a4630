//! Every message a user can get, in one place.
//!
//! A message is one lower-case sentence about what is wrong, with the offending text in
//! backticks, and a line `help: …` that says what to write instead. There is one function per
//! message. The modules are the folders of the compile-fail tests in `eem-ui/tests/ui`;
//! `tests::catalogue` sees to it that every message has a case there.

use std::fmt::{self, Display, Formatter};

pub(crate) mod attribute;
pub(crate) mod expression;
pub(crate) mod field;
pub(crate) mod item;
pub(crate) mod unit;
#[cfg(test)]
pub(crate) mod written;

/// Calls of helpers that a message names.
const CALLS: usize = 3;

/// What is wrong and what to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Message {
    text: String,
    help: String,
}

impl Message {
    #[cfg_attr(test, track_caller)]
    fn new(text: impl Into<String>, help: impl Into<String>) -> Self {
        #[cfg(test)]
        written::record(std::panic::Location::caller());
        Self {
            text: text.into(),
            help: help.into(),
        }
    }
}

impl Message {
    /// The message with the calls of helpers in which it is true, in quotes.
    pub(crate) fn within(&self, calls: &[String]) -> String {
        let mut lines = vec![self.text.clone()];
        let shown = calls.iter().take(CALLS);
        lines.extend(shown.map(|call| format!("in the call {call}")));
        if let Some(others @ 1..) = calls.len().checked_sub(CALLS) {
            lines.push(format!("and in other calls: {others}"));
        }
        lines.push(format!("help: {}", self.help));
        lines.join("\n")
    }
}

impl Display for Message {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.within(&[]))
    }
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

//! Every message a user can get, in one place.
//!
//! A message is one lower-case sentence about what is wrong, with the offending text in
//! backticks, and a line `help: …` that says what to write instead. There is one function per
//! message. The modules are the folders of the compile-fail tests in `tests/ui` of the root crate;
//! `tests::catalogue` sees to it that every message has a case there.

use std::fmt::{self, Display, Formatter};

pub(crate) mod attribute;
pub(crate) mod expression;
pub(crate) mod field;
pub(crate) mod item;
pub(crate) mod unit;
#[cfg(test)]
pub(crate) mod written;

/// What is wrong and what to write.
#[derive(Debug)]
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

impl Display for Message {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}\nhelp: {}", self.text, self.help)
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

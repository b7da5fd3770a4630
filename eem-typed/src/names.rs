//! Names of laws and of their parameters, which are kept as long as the program runs.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use crate::error::LawError;

/// The name of a law that has been given none.
pub(crate) const NAMELESS: &&str = &"Law";

/// The most bytes of a name.
const LONGEST: usize = 64;

/// The most different names of a program, so that at most 64 KiB are kept.
const MOST: usize = 1024;

/// The name, kept until the program ends: the same for the same text.
pub(crate) fn name(text: &str) -> Result<&'static &'static str, LawError> {
    static NAMES: Mutex<BTreeMap<&'static str, &'static &'static str>> =
        Mutex::new(BTreeMap::new());
    let refuse = |why| {
        let name = text.chars().take(LONGEST).collect();
        Err(LawError::Name { name, why })
    };
    if text.is_empty() {
        return refuse("it is empty");
    }
    if text.len() > LONGEST {
        return refuse("a name has at most 64 bytes");
    }
    let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(&known) = names.get(text) {
        return Ok(known);
    }
    if names.len() == MOST {
        return refuse("the program has used 1024 other names; use one of them again");
    }
    let kept: &'static str = Box::leak(text.into());
    let name: &'static &'static str = Box::leak(Box::new(kept));
    names.insert(kept, name);
    Ok(name)
}

/// The most bytes of all lists of names.
const BYTES: usize = 4 << 20;

/// A list of names, kept until the program ends: the same for the same names. Empty if the program has used too many others.
pub(crate) fn list(names: &[&str]) -> &'static [&'static str] {
    static LISTS: Mutex<(usize, BTreeMap<String, &'static [&'static str]>)> =
        Mutex::new((0, BTreeMap::new()));
    let mut lists = LISTS.lock().unwrap_or_else(PoisonError::into_inner);
    let (bytes, lists) = &mut *lists;
    let text = names.join(" ");
    if let Some(known) = lists.get(&text) {
        return known;
    }
    let more = 2 * text.len() + size_of_val(names);
    if *bytes + more > BYTES {
        return &[];
    }
    *bytes += more;
    let kept = names.iter().map(|&name| &*Box::leak(Box::from(name)));
    let kept: &'static [&'static str] = Box::leak(kept.collect());
    lists.insert(text, kept);
    kept
}

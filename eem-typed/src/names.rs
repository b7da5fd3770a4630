//! Names of laws, which handles of elements keep as long as the program runs.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use crate::error::LawError;

/// The name of a law that has none.
pub(crate) const NAMELESS: &&str = &"Law";

/// Bytes that a name may have.
const LONGEST: usize = 64;

/// Different names that a program may use, so that 64 KiB are kept at most.
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

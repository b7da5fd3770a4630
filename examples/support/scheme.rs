//! The schemes by their names on the command line.

use clap::builder::PossibleValuesParser;

/// The name that stands for every scheme.
pub(crate) const ALL: &str = "all";

/// A scheme with the name it has on the command line, in the table and as a file.
pub(crate) type Named = &'static str;

const SCHEMES: [Named; 3] = ["eem-entropy", "midpoint", "trapezoidal"];

/// Accepts the names of the schemes and `all`.
pub(crate) fn parser() -> PossibleValuesParser {
    PossibleValuesParser::new(SCHEMES.into_iter().chain([ALL]))
}

/// The scheme of that name; every scheme for `all`.
pub(crate) fn chosen(name: &str) -> Vec<Named> {
    SCHEMES
        .into_iter()
        .filter(|scheme| name == ALL || *scheme == name)
        .collect()
}

/// Which look a scheme has in the pictures: always the same, whatever else is drawn; 0 is the
/// reference's.
pub(crate) fn look(name: &str) -> usize {
    1 + SCHEMES
        .iter()
        .position(|scheme| *scheme == name)
        .unwrap_or(SCHEMES.len())
}

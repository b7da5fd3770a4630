//! Lines on the terminal that do not mind when nobody reads on, as in `… | head`.

use std::fmt::Display;
use std::io::{Write, stdout};

/// Prints a line; a closed pipe is no reason to fail, the exit code still says how it went.
pub fn say(line: impl Display) {
    let _closed_pipe = writeln!(stdout(), "{line}");
}

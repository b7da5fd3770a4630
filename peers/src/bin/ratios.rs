//! The library's explicit scheme and a prototype written by hand, in turn.

use std::process::ExitCode;

fn main() -> ExitCode {
    eem_peers::ratios()
}

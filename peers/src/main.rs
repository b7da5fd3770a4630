//! Solvers of other crates in the pictures of eem's study `work_precision`.

use std::process::ExitCode;

fn main() -> ExitCode {
    eem_peers::peers()
}

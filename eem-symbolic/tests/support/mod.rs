//! High precision, laws and random expressions for the tests of programs.
#![allow(dead_code)] // Other crates use a part: the random expressions of `eem`, and the benchmark.

pub(crate) mod corners;
pub(crate) mod laws;
pub(crate) mod precise;
pub(crate) mod random;
pub(crate) mod solids;

/// All springs and solids.
pub(crate) fn all_laws() -> Vec<laws::Law> {
    laws::all().into_iter().chain(solids::all()).collect()
}

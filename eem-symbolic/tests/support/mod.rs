//! Laws for the tests of programs, beside high precision and random expressions.

pub(crate) mod corners;
pub(crate) mod laws;
pub(crate) mod solids;

pub(crate) use eem_testkit::{precise, random};

/// All springs and solids.
pub(crate) fn all_laws() -> Vec<laws::Law> {
    laws::all().into_iter().chain(solids::all()).collect()
}

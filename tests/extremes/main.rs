//! What holds at the extremes: every step keeps the laws to rounding, or is a typed error.
//!
//! One file per kind of extreme. A judge ([`extremes::judge`]) forms every law from the stored states
//! by its definition, with 32 digits. The long forms are run by the example `extremes`.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "suite.rs"]
mod extremes;

#[cfg(feature = "gradients")]
mod gradients;

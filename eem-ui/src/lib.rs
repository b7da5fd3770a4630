//! Only tests: the compile errors and warnings of `#[derive(FreeEnergy)]`.
//!
//! `cargo test -p eem-ui` runs them.

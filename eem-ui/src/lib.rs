//! Nothing but tests: what the compiler makes of `#[derive(FreeEnergy)]`.
//!
//! `cargo test -p eem-ui` runs them.

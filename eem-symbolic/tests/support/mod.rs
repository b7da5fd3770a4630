//! High precision, laws and random expressions for the tests of programs.
#![allow(dead_code)] // Every test file uses another part.

pub mod corners;
pub mod laws;
pub mod precise;
pub mod random;

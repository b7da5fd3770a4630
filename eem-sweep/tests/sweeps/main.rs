//! Sweeps keep what they promise: the same bits however members are divided, nothing lost, torn or double whatever
//! is killed, and nothing overwritten when something is wrong.

#![allow(clippy::unwrap_used, reason = "a test: what is missing is a failure")]

mod bits;
mod damage;
mod failures;
mod inputs;
mod kills;
mod merges;
mod program;
mod refusals;

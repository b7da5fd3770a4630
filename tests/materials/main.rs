//! What the derive makes of a free energy: legal forms, derivatives against independent oracles, descriptions.

// For `lint_silence`.
#![deny(future_incompatible)]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

// A second name of the crate, which `hygiene` derives with.
extern crate eem as renamed;

use eem_testkit::scenes as support;

#[cfg(feature = "gradients")]
mod by_parameters;
mod describing;
mod domain;
mod generics;
mod hygiene;
#[cfg(feature = "gradients")]
#[path = "../random_expressions/kernels.rs"]
#[allow(dead_code, reason = "other tests bound its errors")]
mod kernels;
mod legal_forms;
pub mod lint_silence;
mod named_numbers;
mod spellings;
mod transcendental_count;
mod zoo;

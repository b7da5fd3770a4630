//! The published cases against reference data, and equations solved a second way.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use eem_testkit::scenes as support;

mod bars;
mod blocks;
mod cook;
mod equilibrium;
mod logarithmic_stiffness;
mod midpoint_identity;
mod order;
mod order_of_solids;
// Dense elimination would take minutes.
#[cfg(feature = "sparse")]
mod panel;
mod plate;
mod reference_trajectory;
mod same_bits;
#[cfg(feature = "sparse")]
mod satellite;
mod step_tangent;

//! What every step and every run keeps: energy, entropy and momenta, with their loads, and the GENERIC form.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use eem_testkit::scenes as support;

mod blocks;
mod cells;
mod damped;
mod dissipation;
mod double_pendulums;
mod explicit;
mod explicit_at_rest;
mod explicit_loads;
mod explicit_momenta;
mod explicit_supports;
mod explicit_thermostats;
mod free_bodies;
mod generic;
mod heat_in_solids;
mod high_order;
mod high_order_solids;
mod invariants_under_loads;
mod kelvin_voigt;
mod loads;
mod moved_solids;
mod rockets;
mod same_motion;
mod several_dashpots;
mod single_pendulum;
mod solids;
mod spoilt_force;
mod thermostats;
#[cfg(feature = "typed")]
mod typed;
mod variational_4;
mod viscous_strain;

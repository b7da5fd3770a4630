//! How scenes are run: to an end, recorded, resumed, many at once and on threads.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use eem_testkit::scenes as support;

mod allocation;
mod automatic;
mod changing;
mod control;
mod controlling;
mod ends;
mod ensemble;
mod events;
mod files;
#[cfg(feature = "gradients")]
mod gradients;
#[cfg(feature = "vtk")]
mod paraview;
mod recording;
mod rest;
mod resuming;
mod rounded;
mod seeing;
mod stopping;
mod study;
mod study_at_rest;
#[cfg(feature = "parallel")]
mod threads;
mod tolerances;

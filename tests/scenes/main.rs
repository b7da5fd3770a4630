//! What a scene may consist of: mixed networks, what an element costs, and what is refused.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use eem_testkit::scenes as support;

mod bad_handles;
mod bad_input;
mod bad_loads;
mod copies;
#[cfg(feature = "gmsh")]
mod gmsh;
#[cfg(feature = "sparse")]
mod memory;
mod meshes;
mod networks;
mod polygons;
mod refusals;
mod refused;
mod resting;
mod unknowns;

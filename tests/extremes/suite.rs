//! The modules of the suite, shared by the tests and by the example `extremes`.

#![allow(dead_code, reason = "tests and example each use their own part")]

// What a step is judged by.
pub(crate) mod digits;
pub(crate) mod element;
pub(crate) mod jet;
pub(crate) mod judge;
pub(crate) mod model;
pub(crate) mod rounding;
pub(crate) mod stored;

// What is tried.
pub(crate) mod campaign;
pub(crate) mod drawing;
pub(crate) mod families;
pub(crate) mod graph;
pub(crate) mod material;
pub(crate) mod models;
pub(crate) mod published;
pub(crate) mod random;
pub(crate) mod tally;
pub(crate) mod watched;
pub(crate) mod world;

// The kinds of extremes.
pub(crate) mod bits;
#[cfg(test)]
pub(crate) mod carried;
pub(crate) mod findings;
pub(crate) mod heat;
pub(crate) mod kinds;
pub(crate) mod lengths;
pub(crate) mod long;
pub(crate) mod phases;
#[cfg(test)]
pub(crate) mod reports;
pub(crate) mod rest;
pub(crate) mod scenes;
pub(crate) mod steps;
pub(crate) mod stiffness;
#[cfg(test)]
pub(crate) mod tolerances;
pub(crate) mod units;

//! The modules of the suite, shared by the tests and by the example `extremes`.

#![allow(dead_code, reason = "tests and example each use their own part")]

pub(crate) mod digits;
pub(crate) mod drawing;
pub(crate) mod element;
pub(crate) mod findings;
pub(crate) mod heat;
pub(crate) mod jet;
pub(crate) mod judge;
pub(crate) mod material;
pub(crate) mod model;
pub(crate) mod models;
pub(crate) mod random;
pub(crate) mod scenes;
pub(crate) mod stiffness;
pub(crate) mod stored;
pub(crate) mod tally;
pub(crate) mod watched;
pub(crate) mod world;

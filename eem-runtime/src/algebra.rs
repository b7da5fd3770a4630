//! Linear systems: small ones by dense elimination, large ones by `eem-sparse`.

pub(crate) mod bivector;
pub(crate) mod jacobi;
pub(crate) mod lu;
pub(crate) mod memory;
pub(crate) mod pattern;
pub(crate) mod system;
pub(crate) mod threads;
mod vector;

pub(crate) use vector::{
    add, ascending, combined, difference, dot, hypot, indices, largest, length, norm, scaled, size,
    vector,
};

//! Linear systems: small ones by dense elimination, large ones by `eem-sparse`.

pub(crate) mod lu;
pub(crate) mod pattern;
pub(crate) mod system;

//! Materials: what a free energy offers, its description, its inversion and its domain.

pub(crate) mod component_energy;
pub mod describe;
pub(crate) mod domain;
pub(crate) mod free_energy;
pub(crate) mod inversion;
pub(crate) mod joint;
pub(crate) mod point_energy;

//! Runtime.

pub mod kernel;
mod scalar;

pub use scalar::{Real, Scalar};

mod free_energy;
mod inversion;

pub use free_energy::Caloric;
pub use inversion::{Inversion, InversionError, invert};

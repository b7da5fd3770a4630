//! Materials of `eem`: what a free energy offers, its description, its inversion and its domain, and the numbers that
//! it is evaluated with.
//!
//! `eem` exports what users need of it; the rest is for its runtime, and may change with it.

pub mod component_energy;
pub mod describe;
pub mod domain;
pub mod free_energy;
pub mod inversion;
pub mod joint;
#[doc(hidden)]
pub mod number;
#[doc(hidden)]
pub mod point_energy;

pub use component_energy::ComponentEnergy;
pub use describe::{Describe, Description};
pub use domain::{Domain, DomainError, DomainPoint, DomainReport, Least, check_domain};
pub use free_energy::{Array, Caloric, Entry, FreeEnergy, Material, Rates};
pub use inversion::{Inversion, InversionError, invert};
pub use joint::{Joint, JointEnergy};
#[doc(inline)]
pub use number::kernel;
pub use number::scalar::{Discord, Mask, Real, Scalar};

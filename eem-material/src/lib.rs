//! Materials of `eem`: the trait [`FreeEnergy`], descriptions of models, the inversion of s(θ), checks of a domain, and
//! the number types that formulas are evaluated with.
//!
//! `eem` re-exports what users need. The rest is for its runtime and may change with it.

mod array;
#[doc(hidden)]
pub mod arrays;
pub mod component_energy;
pub mod describe;
pub mod domain;
#[doc(hidden)]
pub mod formulas;
pub mod free_energy;
pub mod inversion;
pub mod joint;
#[doc(hidden)]
pub mod number;
#[doc(hidden)]
pub mod point_energy;
#[doc(hidden)]
pub mod tabled;
mod together;
mod values;
mod with_room;

pub use component_energy::ComponentEnergy;
pub use describe::{Describe, Description};
pub use domain::{Domain, DomainError, DomainPoint, DomainReport, Least, check_domain};
pub use free_energy::{Array, Caloric, Entry, FreeEnergy, Material, Rates};
pub use inversion::{Inversion, InversionError, invert};
pub use joint::{Joint, JointEnergy};
#[doc(inline)]
pub use number::kernel;
pub use number::scalar::Scalar;

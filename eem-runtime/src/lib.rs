//! Runtime of `eem`: scenes, schemes, Newton's method, ledger.
//!
//! The flow is one way:
//!
//! ```text
//! free_energy (generated) ─▶ scheme ─▶ group ─▶ solver ─▶ simulation ─▶ ledger
//!          kernel, inversion ─┘   kinematics ─┘
//! ```
//!
//! | symbol | name | unit | meaning |
//! |---|---|---|---|
//! | q, p | position, momentum | m, kg m/s | of a node |
//! | λ | stretch | m | distance of the two nodes of a spring |
//! | γ | viscous stretch | m | of a dashpot |
//! | θ, s | temperature, entropy | K, J/K | of an element |
//! | ψ, e | free, internal energy | J | `e = ψ + θ s` |
//! | f, g | force, dashpot force | N | `∂ψ/∂λ`, `−∂ψ/∂γ` |
//! | η, κ | viscosity, conductance | N s/m, W/K | |
//! | h | step | s | |
//!
//! Index 0 is the old, 1 the new state of a step, `m` their mean, `*` an algorithmic quantity.

pub mod describe;
pub mod kernel;
pub mod kinematics;

mod blueprint;
mod certificate;
mod checkpoint;
mod compact;
mod compensated;
mod conduction;
mod domain;
mod ensemble;
mod error;
mod free_energy;
mod group;
mod handle;
mod impulse;
mod inversion;
#[cfg(feature = "lanes")]
mod lanes;
mod layout;
mod ledger;
mod loads;
mod lu;
mod masses;
mod newton;
mod pattern;
mod point_energy;
mod readable;
mod recorder;
mod scalar;
mod scene;
mod scheme;
mod simulation;
mod solver;
mod state;
mod system;

pub use checkpoint::{Checkpoint, RestoreError};
pub use describe::{Describe, Description};
pub use domain::{Domain, DomainError, DomainPoint, DomainReport, Least, check_domain};
pub use ensemble::{Ensemble, Experiment, MemberError, MemberFailure, Members, Outputs};
pub use error::{Law, NewtonIteration, SceneError, StateError, StepError, StepFailure};
pub use free_energy::{Array, Caloric, Entry, FreeEnergy};
pub use handle::{Element, HeatPartner, Node, Reservoir};
pub use inversion::{Inversion, InversionError, invert};
pub use kinematics::{Strain, StrainEnergy};
pub use ledger::Ledger;
pub use newton::{NewtonSettings, StepReport};
pub use recorder::{Column, CustomQuantity, Quantity, RecordError, Recorder};
pub use scalar::{Discord, Mask, Real, Scalar};
pub use scene::{Scene, Section};
pub use scheme::{Scheme, UnknownScheme};
pub use simulation::Simulation;
pub use simulation::generic::Generic;
pub use simulation::linearize::StepTangent;
pub use simulation::run::RunEnd;

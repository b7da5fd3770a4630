//! Runtime of `eem`: scenes, schemes, Newton's method, ledger.
//!
//! Each folder uses only those before it:
//!
//! ```text
//! number ─▶ algebra ─▶ material ─▶ element ─▶ scene ─▶ step ─▶ run
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

mod algebra;
mod element;
mod material;
mod number;
mod run;
mod scene;
mod step;

pub use algebra::memory::TooLarge;
pub use element::error::StateError;
pub use element::handle::{Element, HeatPartner, Node, Reservoir};
pub use element::kinematics;
pub use element::kinematics::{SolidState, Strain, StrainEnergy};
pub use material::component_energy::ComponentEnergy;
pub use material::describe;
pub use material::describe::{Describe, Description};
pub use material::domain::{Domain, DomainError, DomainPoint, DomainReport, Least, check_domain};
pub use material::free_energy::{Array, Caloric, Entry, FreeEnergy, Material, Rates};
pub use material::inversion::{Inversion, InversionError, invert};
pub use material::joint::{Joint, JointEnergy};
pub use number::kernel;
pub use number::scalar::{Discord, Mask, Real, Scalar};
pub use run::checkpoint::{Checkpoint, RestoreError};
pub use run::ensemble::{Ensemble, Experiment, MemberError, MemberFailure, Members, Outputs};
#[cfg(debug_assertions)]
#[doc(hidden)]
pub use run::instances::instances;
pub use run::ledger::Ledger;
pub use run::recorder::{Column, CustomQuantity, Quantity, RecordError, Recorder};
pub use run::simulation::Simulation;
pub use run::simulation::event::Event;
pub use run::simulation::generic::Generic;
pub use run::simulation::linearize::StepTangent;
pub use run::simulation::run::RunEnd;
pub use run::study::Study;
pub use run::study::advice::{Advice, Recommendation};
pub use run::study::error::StudyError;
pub use run::study::quantity::{EndState, StateQuantity};
pub use run::study::reference::{ReferenceEnd, StudyReference};
pub use run::study::report::{StudyReport, StudyRow};
pub use run::study::setting::{Precision, Setting, StepChoice};
pub use run::study::statement::Statement;
#[cfg(feature = "vtk")]
pub use run::vtk::VtkSeries;
pub use scene::Scene;
pub use scene::body::Body;
pub use scene::bulk::Bulk;
pub use scene::error::SceneError;
#[cfg(feature = "gmsh")]
pub use scene::gmsh::{LineFault, Msh, MshError};
pub use scene::mesh::{Face, Mesh, MeshError, Outline};
pub use scene::refused::RefusedScene;
pub use scene::rocket_error::RocketError;
pub use scene::solid::Section;
pub use scene::solid_error::SolidError;
pub use step::control::{StepStatistics, Tolerance};
pub use step::error::{StepError, StepFailure, StepLimit};
pub use step::law::Law;
pub use step::newton::{NewtonIteration, NewtonSettings, StepReport};
pub use step::outcome::Corrections;
pub use step::scheme::Scheme;
pub use step::scheme_name::UnknownScheme;

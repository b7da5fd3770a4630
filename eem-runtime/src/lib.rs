//! The runtime of `eem`: scenes, schemes, Newton's method, certificate, ledger.
//!
//! Each folder uses only those before it:
//!
//! ```text
//! algebra ─▶ element ─▶ scene ─▶ step ─▶ run
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
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | add a scheme | a row in `step/scheme.rs` and in `step/features.rs`, and in `step/automatic.rs` if `Auto` may choose it; a `Tableau` in `step/rule` for one with stages; other conjugates in `element/conjugates` or a `Source` in `element/group/stages` |
//! | change what a step proves | `step/certificate.rs`, `element/group/certify.rs`, `step/solver/closing` |
//! | change Newton's method: start, convergence, end | `step/newton.rs`; `begin.rs`, `past.rs`, `converge.rs` in `step/solver` |
//! | change step control | `step/control`; `attempt.rs`, `control.rs`, `halves.rs` in `run/simulation`; `step/explicit/error.rs` |
//! | change when `Scheme::Auto` switches | `step/automatic.rs`, `run/simulation/automatic.rs` |
//! | change the explicit scheme | `step/explicit`: `stages.rs`, `tableau.rs`, `closing`, `inertia`, `guard.rs`; `element/group/explicit` |
//! | solve the linear systems differently | `algebra/system.rs`; `algebra/lu` for small ones; `step/solver/kept_factors.rs` for factors that are reused |
//! | reject what does not fit in memory | `algebra/memory.rs`, `step/systems.rs` |
//! | add a strain measure | `strain.rs`, `between.rs`, `stiffness.rs` in `element/kinematics`; `tensor.rs` in `eem-mesh`; its role in `eem-language` |
//! | change viscous strain tensors | `joint.rs`, `component_energy.rs` in `eem-material` |
//! | compile springs with other arrays with this crate | `element/group/springs.rs`; `formulas.rs`, `tabled.rs` and `with_room.rs` in `eem-material` |
//! | change the dashpot in parallel with a spring | `element/group/kelvin_voigt.rs` |
//! | add a shape of cell | `shape.rs` in `eem-mesh` |
//! | change solids and their checks | `bulk.rs`, `meshed_solid.rs`, `body_heat.rs`, `solid.rs` in `scene`; meshes: `eem-mesh` |
//! | add a load, a support or a thermostat | `scene/loads.rs`, `scene/act.rs`, `step/loads.rs`; `step/solver/rockets.rs` if it follows the motion; the ledger |
//! | let a controller set something else | `run/simulation/controller.rs`; `Course` in `scene/loads.rs`; `SavedLoads` in `run/checkpoint.rs` |
//! | change ovens | `run/simulation/attempt.rs` |
//! | change the scheme in the middle of a run | `run/simulation/change.rs`; what not every scheme can step: the table in `step/features.rs`, its errors in `check.rs` there |
//! | measure what elements do in a step | `element/meters.rs`, where balances book; `run/simulation/meters.rs`, `run/recorder/quantity.rs` |
//! | add something to checkpoints | `run/checkpoint`: `entries.rs` for rules and digests, `lines.rs` for files |
//! | add a conserved quantity | `run/ledger.rs` |
//! | record, stop or resume a run | `run/recorder`, `run/vtk.rs`, `run/checkpoint.rs`; `run.rs` and `event` in `run/simulation` |
//! | reject a scene, state or checkpoint | `scene/check.rs`, `run/simulation/resume.rs`, `element/group/audit.rs`; messages in each `error.rs` |
//! | find states at rest differently | `step/solver/rest.rs`; `run/equilibrium`: settings, thermal balance, names of free motions |
//! | differentiate other quantities, or by other inputs | `run/gradient`, `run/simulation/gradient`, by inputs in `inputs.rs` (adjoint) and `directions.rs` (tangents); memory: `run/gradient/snapshots.rs`; equations of a step: `step/adjoint.rs`, `pull_back.rs` and `push_forward.rs` in `element/group` |
//! | run many scenes at once | `run/ensemble` |
//! | use more threads in one scene | `algebra/threads.rs`, `element/group/evaluate.rs`; `eem-sparse` for elimination |
//! | check a material before use | `domain` in `eem-material` |

// Each module uses those before it; the documentation shows their methods in this order.
mod algebra;
mod element;

mod scene;

mod step;

mod run;

#[doc(inline)]
pub use eem_material::{
    Array, Caloric, ComponentEnergy, Describe, Description, Domain, DomainError, DomainPoint,
    DomainReport, Entry, FreeEnergy, Inversion, InversionError, Joint, JointEnergy, Least,
    Material, Rates, Scalar, check_domain, describe, invert, kernel,
};

#[doc(inline)]
pub use eem_mesh::{Face, Mesh, MeshError, Outline};
#[cfg(feature = "gmsh")]
#[doc(inline)]
pub use eem_mesh::{LineFault, Msh, MshError};

pub use algebra::memory::TooLarge;
pub use element::error::StateError;
#[cfg(not(test))]
#[doc(hidden)]
pub use element::group::springs::of_dimension;
pub use element::handle::{Element, HeatPartner, HeatPath, Node, Reservoir};
pub use element::kinematics;
pub use element::kinematics::{SolidState, Strain, StrainEnergy};
pub use run::checkpoint::{Checkpoint, FormatError, LoadError, RestoreError};
pub use run::ensemble::{Ensemble, MemberError, MemberFailure};
pub use run::equilibrium::motion::{EquilibriumError, FreeMotion, MotionKind};
pub use run::equilibrium::{Equilibrium, EquilibriumReport};
#[cfg(feature = "gradients")]
pub use run::gradient::{
    error::GradientError,
    history::History,
    input::{Input, Objective},
    result::Gradient,
    series::{Sensitivities, Series},
};
pub use run::ledger::Ledger;
pub use run::recorder::{Column, CustomQuantity, Quantity, RecordError, Recorder};
pub use run::simulation::Simulation;
pub use run::simulation::attempt::StepTangent;
pub use run::simulation::change::RefusedChange;
pub use run::simulation::event::Event;
pub use run::simulation::generic::Generic;
pub use run::simulation::run::RunEnd;
pub use run::simulation::warning::Warning;
#[cfg(feature = "vtk")]
pub use run::vtk::VtkSeries;
pub use scene::Scene;
pub use scene::bulk::{Body, Bulk};
pub use scene::error::RocketError;
pub use scene::error::SceneError;
pub use scene::refused::RefusedScene;
pub use scene::solid::Section;
pub use scene::solid_error::SolidError;
pub use step::control::{StepStatistics, Tolerance};
pub use step::error::{StepError, StepFailure, StepLimit, WorstError};
pub use step::law::Law;
pub use step::newton::{NewtonIteration, NewtonSettings, StepReport};
pub use step::outcome::Corrections;
pub use step::scheme::{Scheme, UnknownScheme};
pub use step::timed::TimedLoad;

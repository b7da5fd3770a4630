// The first definition of a link counts: the links of the README and of the pages lead to the modules below in rustdoc,
// and to the files on a forge. Pictures are shown on a forge only; rustdoc shows their description.
//! [tutorial]: crate::tutorial
//! [materials]: crate::guide::materials
//! [solids]: crate::guide::solids
//! [running]: crate::guide::running
//! [choosing]: crate::choosing
//! [accuracy]: crate::accuracy
//! [performance]: crate::performance
//! [extremes]: crate::extremes
//! [reproducible]: crate::reproducible
//! [gradients]: crate::gradients
//! [sweeps]: crate::sweeps
//! [scale]: crate::scale
//!
#![doc = include_str!("../README.md")]

// What the derive generates begins with `::eem`; here that is this crate.
extern crate self as eem;

#[cfg(feature = "derive")]
pub use eem_derive::FreeEnergy;
pub use eem_runtime::*;
pub use eem_study::*;
#[cfg(feature = "derive")]
pub mod materials;
/// Parameter sweeps in many processes; see also [`sweeps`].
#[cfg(feature = "sweep")]
pub use eem_sweep as sweep;
/// Materials from texts in a running program.
#[cfg(feature = "typed")]
pub use eem_typed as typed;
/// The linear algebra crate: vectors of positions and momenta, matrices of [`Generic`].
pub use nalgebra;

// To change something, look in
//
// - a page: `README.md`, `docs`; a new page is a module below. `tests/structure/documents.rs` checks form and links,
//   `followed.rs` there runs those programs that print something
// - an example: a file in `examples/src/bin`, its name in `examples/Cargo.toml`; a study: `studies/src/lib.rs` says more
// - a test across crates: `tests`, a file in the folder of its subject
// - extremes, or fresh random steps: `tests/extremes`, a file per kind; `models.rs`, `families.rs`, `judge.rs`
// - a free energy that is compared with all oracles: a `specimen!` in `tests/materials/zoo/families`
// - fuzzing of the front end and of the mathematics: `fuzz`
// - the page in the browser: `web/src/lib.rs` says more
// - benchmarks: `benches`, and `benches/README.md`
// - limits on files, functions and imports: `tests/structure`
// - the gate: `.ci/run`

/// What most programs need: `use eem::prelude::*`.
///
/// ```
/// use eem::prelude::*;
///
/// let mut scene = Scene::<2>::new();
/// let pivot = scene.anchor([0.0, 0.0]);
/// assert_eq!(pivot.to_string(), "node 0");
/// ```
pub mod prelude {
    pub use core::ops::ControlFlow;

    #[cfg(feature = "vtk")]
    pub use crate::VtkSeries;
    pub use crate::kinematics::{Hex8, Hex20, Quad4, Quad8};
    pub use crate::{
        Advice, Body, Bulk, Checkpoint, Describe, Element, Ensemble, Equilibrium, Event,
        FreeEnergy, HeatPath, Law, Ledger, Mesh, NewtonSettings, Node, Quantity, Recorder,
        Reservoir, RunEnd, Scene, SceneError, Scheme, Section, Setting, Simulation, StepError,
        StepFailure, StepReport, Study, Tolerance,
    };
}

/// The guide in three pages: materials, solids, and running a scene.
pub mod guide {
    /// How to write a material: springs, temperature, units, dashpots, and checks before you trust it.
    ///
    /// [solids]: crate::guide::solids
    /// [running]: crate::guide::running
    ///
    #[doc = include_str!("../docs/materials.md")]
    pub mod materials {}

    /// How to write and mesh a solid, load it, heat it and let it creep.
    ///
    /// [running]: crate::guide::running
    /// [materials]: crate::guide::materials
    ///
    #[doc = include_str!("../docs/solids.md")]
    pub mod solids {}

    /// How to run a scene: loads, thermostats, recording, events, checkpoints, ensembles, step control.
    ///
    /// [materials]: crate::guide::materials
    /// [choosing]: crate::choosing
    /// [sweeps]: crate::sweeps
    ///
    #[doc = include_str!("../docs/running.md")]
    pub mod running {}
}

/// Gradients: the derivatives of any number by all inputs of a run.
///
/// This page needs the feature `gradients`.
///
#[cfg_attr(feature = "gradients", doc = include_str!("../docs/gradients.md"))]
pub mod gradients {}

/// Tutorial: from an empty folder to a picture of energy and temperature, in ten minutes.
///
/// [materials]: crate::guide::materials
/// [running]: crate::guide::running
/// [choosing]: crate::choosing
///
#[doc = include_str!("../docs/tutorial.md")]
pub mod tutorial {}

/// Choosing a scheme and a step: what each costs, by scene and accuracy.
///
/// [accuracy]: crate::accuracy
/// [gradients]: crate::gradients
///
#[doc = include_str!("../docs/choosing.md")]
pub mod choosing {}

/// Accuracy: errors of all schemes, and what rounding does to the laws.
///
/// [extremes]: crate::extremes
///
#[doc = include_str!("../docs/accuracy.md")]
pub mod accuracy {}

/// Performance: what a step costs, on which machine.
///
/// [choosing]: crate::choosing
///
#[doc = include_str!("../docs/performance.md")]
pub mod performance {}

/// Sweeps: parameter studies with thousands of runs in many processes.
///
/// [scale]: crate::scale
///
#[doc = include_str!("../docs/sweeps.md")]
pub mod sweeps {}

/// Scale: what a million and a billion runs cost, and which limit comes first.
///
/// [sweeps]: crate::sweeps
///
#[doc = include_str!("../docs/scale.md")]
pub mod scale {}

/// Extremes: attempts to break the laws, and what came of them.
#[doc = include_str!("../docs/extremes.md")]
#[allow(
    clippy::doc_markdown,
    reason = "tables that a program writes name errors as they are"
)]
pub mod extremes {}

/// Reproducible results: which bits depend on the machine, and the feature `portable`.
///
/// [sweeps]: crate::sweeps
///
#[doc = include_str!("../docs/reproducible.md")]
pub mod reproducible {}

/// Names for generated code. Not part of the public interface.
#[doc(hidden)]
pub mod __private {
    pub use core;
    pub use eem_runtime::{
        Array, Caloric, ComponentEnergy, Describe, Description, FreeEnergy, Joint, JointEnergy,
        Material, Rates, Scalar, Strain, StrainEnergy, describe, kernel,
    };
}

// The first definition of a link counts: these, which lead to the pages below, and not those at the
// end of the README, which lead to the files. The picture is embedded.
//! [tutorial]: crate::tutorial
//! [guide]: crate::guide
//! [choosing]: crate::choosing
//! [accuracy]: crate::accuracy
//! [performance]: crate::performance
//! [extremes]: crate::extremes
//! [reproducible]: crate::reproducible
//! [sweeps]: crate::sweeps
//! [scale]: crate::scale
#![doc = include_str!("../docs/energy.link.md")]
//!
#![doc = include_str!("../README.md")]

// What the derive generates begins with `::eem`; here that is this crate.
extern crate self as eem;

pub use eem_derive::FreeEnergy;
pub use eem_runtime::*;
pub mod materials;
/// Parameter sweeps in many processes; see also [`sweeps`].
#[cfg(feature = "sweep")]
pub use eem_sweep as sweep;
/// Vectors and matrices of positions, momenta and of [`Generic`].
pub use nalgebra;

/// Everything that a program which builds and steps scenes needs, for `use eem::prelude::*`.
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

    pub use crate::{
        Bulk, Checkpoint, Describe, Element, Ensemble, Event, FreeEnergy, Law, Ledger, Mesh,
        NewtonSettings, Node, Quantity, Recorder, Reservoir, RunEnd, Scene, SceneError, Scheme,
        Section, Simulation, StepError, StepFailure, StepReport, Tolerance,
    };
}

/// Guide: how a material is written, in stages, and how it is checked.
///
/// [choosing]: crate::choosing
///
#[doc = include_str!("../docs/guide.md")]
pub mod guide {}

/// Choosing a scheme: what each costs and keeps, by scene and accuracy.
#[doc = include_str!("../docs/choosing.md")]
pub mod choosing {}

/// Tutorial: from an empty folder to a picture of energy and temperature, in ten minutes.
///
/// [guide]: crate::guide
/// [choosing]: crate::choosing
#[doc = include_str!("../docs/tutorial.link.md")]
///
#[doc = include_str!("../docs/tutorial.md")]
pub mod tutorial {}

/// Accuracy: tables of all schemes, roundings, and a stiffness that is logarithmic in the temperature.
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

/// Sweeps: thousands of members in many processes, on engines that users have.
///
/// [scale]: crate::scale
///
#[doc = include_str!("../docs/sweeps.md")]
pub mod sweeps {}

/// Scale: what a million and a billion members cost, and which limit comes first.
///
/// [sweeps]: crate::sweeps
///
#[doc = include_str!("../docs/scale.md")]
pub mod scale {}

/// Extremes: what was tried to break the laws, what completes and what is refused.
#[doc = include_str!("../docs/extremes.md")]
#[allow(
    clippy::doc_markdown,
    reason = "tables that a program writes name errors as they are"
)]
pub mod extremes {}

/// Reproducible: which bits depend on the machine, and the feature `portable`.
///
/// [sweeps]: crate::sweeps
///
#[doc = include_str!("../docs/reproducible.md")]
pub mod reproducible {}

/// What generated code names. Not part of the public interface.
#[doc(hidden)]
pub mod __private {
    pub use core;
    pub use eem_runtime::{
        Array, Caloric, ComponentEnergy, Describe, Description, FreeEnergy, Joint, JointEnergy,
        Material, Rates, Real, Scalar, Strain, StrainEnergy, describe, kernel,
    };
}

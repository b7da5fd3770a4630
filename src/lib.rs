#![doc = include_str!("../README.md")]

pub use eem_derive::FreeEnergy;
pub use eem_runtime::*;
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
        Checkpoint, Describe, Element, Ensemble, FreeEnergy, Law, Ledger, NewtonSettings, Node,
        Quantity, Recorder, Reservoir, RunEnd, Scene, SceneError, Scheme, Section, Simulation,
        StepError, StepFailure, StepReport, Tolerance,
    };
}

/// Guide: how a material is written, in stages, and how it is checked.
#[doc = include_str!("../docs/guide.md")]
pub mod guide {}

/// Choosing a scheme: what each costs and keeps, by scene and accuracy.
#[doc = include_str!("../docs/choosing.md")]
pub mod choosing {}

/// What generated code names. Not part of the public interface.
#[doc(hidden)]
pub mod __private {
    pub use core;
    pub use eem_runtime::{
        Array, Caloric, Describe, Description, FreeEnergy, Rates, Scalar, Strain, StrainEnergy,
        describe, kernel,
    };
}

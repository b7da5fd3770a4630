//! The extension module `eem._eem`: scenes, materials from texts and runs for Python.
//!
//! | to | look in |
//! |---|---|
//! | add a call to scenes | `act.rs` for what it keeps, `built.rs` for what it does, `scene.rs` for its arguments |
//! | add a quantity of runs | `run.rs`, `simulation.rs`; `record.rs` and `python/eem/_record.py` to record it |
//! | change how arrays are taken | `input.rs` |
//! | change handles | `handle.rs` |
//! | add a quantity that has derivatives, or an input they are by | `gradient.rs`, `python/eem/_gradient.py`; `sensitivities.rs`, `python/eem/_sensitivities.py` |
//! | change what a study takes or tells | `study.rs`, `python/eem/_study.py` |
//! | change exceptions | `error.rs`, `python/eem/_errors.py` |
//! | compile solids differently, or other shapes of them | `solids` |

mod act;
mod arguments;
mod built;
mod ensemble;
mod error;
mod function;
mod gradient;
mod handle;
mod input;
mod material;
mod record;
mod report;
mod run;
mod scene;
mod sensitivities;
mod setting;
mod simulation;
mod study;
mod watch;
mod world;

/// The module.
#[pyo3::pymodule]
mod _eem {
    #[pymodule_export]
    use crate::handle::{
        Element, ElementArray, HeatPath, HeatPathArray, Lineage, Node, NodeArray, Reservoir,
        ReservoirArray,
    };
    #[pymodule_export]
    use crate::material::Material;
    #[pymodule_export]
    use crate::report::Report;
    #[pymodule_export]
    use crate::scene::PyScene;
    #[pymodule_export]
    use crate::simulation::Simulation;
    #[pymodule_export]
    use crate::study::Studied;

    /// The version of the library.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// The names of the scalar entries of a ledger.
    #[pymodule_export]
    const LEDGER: [&str; crate::record::LEDGER.len()] = crate::record::LEDGER;

    /// The names of the quantities that have derivatives.
    #[pymodule_export]
    const QUANTITIES: [&str; crate::gradient::QUANTITIES.len()] = crate::gradient::QUANTITIES;

    /// The names of the kinds of quantities whose errors a study finds.
    #[pymodule_export]
    const KINDS: [&str; crate::study::KINDS.len()] = crate::study::KINDS;
}

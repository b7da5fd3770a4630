//! Runs: simulations, their ledger, recorder and checkpoints, ensembles of them, and studies of their errors.

pub(crate) mod checkpoint;
pub(crate) mod ensemble;
pub(crate) mod ledger;
pub(crate) mod recorder;
pub(crate) mod simulation;
pub(crate) mod study;
#[cfg(feature = "vtk")]
pub(crate) mod vtk;

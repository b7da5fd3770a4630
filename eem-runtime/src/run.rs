//! Runs: simulations with their ledger, recorder and checkpoints, and ensembles of simulations.

pub(crate) mod checkpoint;
pub(crate) mod ensemble;
pub(crate) mod equilibrium;
#[cfg(feature = "gradients")]
pub(crate) mod gradient;
pub(crate) mod ledger;
pub(crate) mod recorder;
pub(crate) mod simulation;
#[cfg(feature = "vtk")]
pub(crate) mod vtk;

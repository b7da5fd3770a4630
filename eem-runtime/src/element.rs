//! Elements: how arms measure a deformation, what follows from the measures in a step, and groups of
//! elements with their points.

pub(crate) mod balances;
pub(crate) mod conduction;
pub(crate) mod conjugates;
pub(crate) mod ends;
pub(crate) mod error;
pub(crate) mod group;
pub(crate) mod handle;
pub(crate) mod impulse;
pub mod kinematics;
pub(crate) mod layout;
pub(crate) mod lineage;
pub(crate) mod loads;
pub(crate) mod masses;
pub(crate) mod meters;
pub(crate) mod phase;
pub(crate) mod state;
pub(crate) mod tableau;
pub(crate) mod tally;

//! The elements of an explicit scheme: one dynamic call per group and phase.
//!
//! ```text
//! rates      forces and rates of a stage                                          (rates)
//! thermostats  heat of thermostats whose temperature changes                      (thermostat)
//! close      temperatures from entropies, and energies, of a state that closes a step     (closing)
//! pull       forces on the nodes in such a state                                  (closing)
//! finish     rates of the closed state, with which the next step begins           (closing)
//! ```

mod closed;
mod closing;
mod group;
mod rates;
pub(super) mod stage;
mod temperature;
mod thermostat;
pub(super) mod view;

pub(crate) use group::ExplicitElements;
pub(crate) use stage::{Combination, Past, Place, Stage, Thermostat, first_reservoir};
pub(crate) use temperature::is_met;
pub(crate) use view::{Caloric, ClosingView, ComponentEnergy, UnkeptEntropy};

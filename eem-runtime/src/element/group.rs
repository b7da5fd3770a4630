//! All elements of one model, stepped together.
//!
//! [`Group`] is the interface to the solver: one dynamic call per group and phase. `ElementGroup` implements it for schemes
//! with one set of forces, `StageGroup` for several stages; elements of explicit schemes are an [`ExplicitGroup`]. Groups know the
//! nodes; the points, with materials and internal variables, are behind a wall (`points`). The phases of a step of an `ElementGroup` are
//!
//! ```text
//!            elements and their nodes          points
//! begin      begin, arms                       begin                      take over the old state
//! evaluate   evaluate, placed, arms            respond, local, eliminate  response at the trial, local unknowns eliminated
//!            share, pose, site                                            contributions added at their matrix indices
//! correct    correct                           correct, point             local unknowns from the global solution
//! close      closing                           closing, recovery, certify impulses, what is booked, and the new state
//! ```

mod ahead;
mod arms;
mod audit;
mod begin;
mod build;
mod certify;
mod closing;
mod condensed;
mod correct;
mod damp;
mod damping;
mod element_group;
mod elements;
mod eliminate;
mod evaluate;
mod explicit;
mod generic;
mod inspect;
mod interface;
mod kelvin_voigt;
mod local;
mod loose;
mod member;
mod model_list;
mod model_points;
mod models;
mod modes;
#[cfg(feature = "gradients")]
mod past;
mod placed;
mod point;
#[cfg(feature = "gradients")]
mod point_step;
mod points;
mod pose;
#[cfg(feature = "gradients")]
mod pull_back;
#[cfg(feature = "gradients")]
mod push_forward;
mod recounting;
mod recovery;
mod respond;
mod share;
mod site;
pub(crate) mod springs;
mod stages;
mod stiffness;
#[cfg(feature = "gradients")]
mod terms;
mod view;
mod ways;

pub(crate) use arms::points;
pub(crate) use audit::Misfit;
pub(crate) use explicit::{
    Caloric, ClosingView, Combination, ComponentEnergy, Past, Place, Stage, Thermostat,
    UnkeptEntropy, first_reservoir, is_met,
};
pub(crate) use interface::{Elements, ExplicitGroup, Group, Loose};
pub(crate) use loose::LooseElements;
pub(crate) use model_list::identity;
#[cfg(feature = "gradients")]
pub(crate) use point_step::{
    Direction, PastStep, PerVariable, SeeParameters, StepBack, StepWeights,
};
pub(crate) use stiffness::Stiffness;
#[cfg(feature = "gradients")]
pub(crate) use terms::Terms;
pub(crate) use view::{
    Along, Before, ElementGeneric, ElementTotals, ElementView, EntropySlopes, Old, Placed, Sites,
    StepView, Trial,
};

//! Schemes written by hand for the pendulums, to measure the library against.
//!
//! Mainly `eem-explicit`: stages of DOP853 in temperature variables, entropies by quadrature over the stages, and one closing per step that
//! restores energy and angular momentum to rounding and cannot lower the entropy. Only what the three cases need:
//! `f64`, arrays of constant size, one path of heat, no loads. Data and laws are constants, so that the compiler sees
//! all of it at once.
//!
//! | module | subject |
//! |---|---|
//! | `model` | what the pendulums have in common, and the unknowns |
//! | `creeping`, `logarithmic` | laws of the springs and data of the pendulums |
//! | `stages`, `tableau` | rates, and the Runge–Kutta stages |
//! | `quadrature` | entropies of a step, with a guard for the second law |
//! | `closing`, `inertia` | energy and angular momentum restored |
//! | `run`, `control` | steps, and their size for a tolerance |
//! | `temperature` | `eem-temperature` for one pendulum, with formulas from a computer algebra system |

// The stages are inlined into one function: the library's are, too.
#![allow(
    clippy::inline_always,
    reason = "eleven calls of a stage are too many for the compiler's own estimate"
)]

mod closing;
mod control;
mod creeping;
mod inertia;
mod logarithmic;
mod model;
mod quadrature;
mod run;
mod stages;
mod tableau;
mod temperature;

pub(crate) use creeping::Single;
pub(crate) use logarithmic::{Krueger, Log};
pub(crate) use model::Pendulum;
pub(crate) use run::Run;
pub(crate) use temperature::TemperatureRun;

/// 2⁻⁵³, the largest relative error of one rounding.
pub(crate) const ROUNDING: f64 = 0.5 * f64::EPSILON;

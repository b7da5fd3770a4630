//! All elements of one model, stepped through the stages of a [`Tableau`].
//!
//! The internal variables of all stages are eliminated together, point by point. Where the conjugates of
//! a stage come from is a [`Source`](source::Source): values of the free energy there, or
//! projections of its derivatives along the path through the step.
//!
//! ```text
//! begin     take over the old state, once                             (begin)
//! evaluate  conjugates of the stages                                  (values, projection, heat)
//!           local unknowns eliminated                                 (eliminate, values, projection)
//!           contributions to the global residual and tangent          (assemble, forces)
//! correct   local unknowns from the global solution                   (correct)
//! close     increments of the internal variables, and the new state   (closing, values, projection)
//! ```

mod assemble;
mod begin;
mod closing;
mod correct;
mod eliminate;
mod forces;
mod heat;
mod local;
mod member;
mod projection;
mod secant;
mod site;
mod source;
mod stage_group;
mod values;

pub(crate) use projection::Projections;
pub(crate) use source::Source;
pub(crate) use stage_group::StageGroup;
pub(crate) use values::Values;

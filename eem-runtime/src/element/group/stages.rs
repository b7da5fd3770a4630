//! All elements of one model, stepped through the stages of a [`Tableau`].
//!
//! Every stage evaluates the free energy at a point of its own. The internal variables of all stages are
//! eliminated together, element by element.
//!
//! ```text
//! begin     take over the old state, once                                   (member)
//! evaluate  free energy at the stages                                       (at_stage, heat)
//!           local unknowns eliminated                                       (local)
//!           contributions to the global residual and tangent                (assemble)
//! correct   local unknowns from the global solution                         (correct)
//! close     increments of the internal variables, and the new state         (closing)
//! ```

mod assemble;
mod at_stage;
mod closing;
mod correct;
mod evaluate;
mod heat;
mod local;
mod member;
mod secant;
mod site;
mod stage_group;

pub(crate) use stage_group::StageGroup;

//! All elements of one model, stepped through the stages of a [`Tableau`](crate::element::tableau::Tableau).
//!
//! The internal variables of all stages are eliminated together, point by point. The conjugates of the stages are
//! values of the free energy at the stages, or projections of its derivatives along the path through the step. The
//! models stand behind a table ([`StageModels`](models::StageModels)), the nodes in front of it.
//!
//! ```text
//! begin     reads the old state, once                                 (stage_group, geometry, models)
//! evaluate  conjugates of the stages                                  (values, projection)
//!           local unknowns eliminated                                 (point, values, projection)
//!           contributions to the global residual and tangent          (assemble)
//! correct   local unknowns from the global solution                   (stage_group, point, values, projection)
//! close     increments of the internal variables, and the new state   (stage_group, values, projection)
//! ```

mod assemble;
mod equations;
mod geometry;
pub(super) mod models;
mod point;
pub(super) mod projection;
mod site;
mod stage_group;
pub(super) mod stage_points;
pub(super) mod values;

pub(crate) use projection::Projections;
pub(crate) use stage_group::StageGroup;
pub(crate) use values::Values;

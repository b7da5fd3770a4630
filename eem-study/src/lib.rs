//! Work and precision: the cost and the accuracy of each setting for a scene.
//!
//! To compare schemes differently, look in `reference.rs`, `row.rs` and `advice.rs`.

mod advice;
mod course;
mod error;
mod progress;
mod quantity;
mod reference;
mod report;
mod row;
mod setting;
mod study;
mod table;

pub use advice::{Advice, Recommendation};
pub use error::StudyError;
pub use quantity::{EndState, StateQuantity};
pub use reference::{ReferenceEnd, StudyReference};
pub use report::StudyReport;
pub use row::{Statement, StudyRow};
pub use setting::{Setting, StepChoice};
pub use study::Study;

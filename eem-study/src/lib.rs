//! Work and precision: the cost and the error of many schemes and steps for a scene of your own.
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | change the reference | `reference.rs` |
//! | change when an error is stated | `statement.rs` |
//! | change the recommendation | `advice.rs` |

mod advice;
mod course;
mod error;
mod grid;
mod measure;
mod progress;
mod quantity;
mod reference;
mod report;
mod setting;
mod statement;
mod study;
mod table;

pub use advice::{Advice, Recommendation};
pub use error::StudyError;
pub use quantity::{EndState, StateQuantity};
pub use reference::{ReferenceEnd, StudyReference};
pub use report::{StudyReport, StudyRow};
pub use setting::{Precision, Setting, StepChoice};
pub use statement::Statement;
pub use study::Study;

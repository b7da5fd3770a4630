//! Code that the studies share: command line, record of a run, tables, CSV files, figures, progress bar, checked claims;
//! free energies and scenes for numbers of any type.
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | add a study | `bin/NAME/main.rs` with the physics; scene and pictures beside it |
//! | draw a deformed solid | `deformed.rs`; `Mesh::outlines` gives the faces |
//! | draw the figure of a paper | `figures.rs` in the folder of the study; `published.rs` |
//! | fit a model to records | `bin/fit_damper/fit.rs` |
//! | find a least value by gradients | `least.rs` |
//! | check that a change keeps all bits, or count instructions | `README.md` |

#![allow(
    clippy::must_use_candidate,
    clippy::missing_errors_doc,
    clippy::missing_panics_doc,
    reason = "used by the programs of this package only"
)]

pub mod build;
pub mod claims;
pub mod command_line;
pub mod comparison;
pub mod defects;
pub mod deformed;
pub mod figures;
pub mod first_law;
pub mod least;
pub mod models;
pub mod output;
pub mod pendulums;
pub mod points;
pub mod progress;
pub mod published;
pub mod record;
pub mod simulate;
pub mod statistics;
pub mod table;
pub mod terminal;
pub mod time_grid;

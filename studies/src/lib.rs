//! What all studies share, so that the files of each are about its physics:
//! command line, record of a run, table, CSV files, figures, progress bar and claims; and free energies and scenes for
//! numbers of any type.

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

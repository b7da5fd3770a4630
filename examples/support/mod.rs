//! What all examples share, so that each example's file is about its physics:
//! command line, record of a run, table, CSV files, figures, progress bar and claims.

#![allow(dead_code, reason = "every example uses its own part of this module")]

pub(crate) mod claims;
pub(crate) mod command_line;
pub(crate) mod comparison;
pub(crate) mod defects;
pub(crate) mod deformed;
pub(crate) mod figures;
pub(crate) mod first_law;
pub(crate) mod output;
pub(crate) mod points;
pub(crate) mod progress;
pub(crate) mod published;
pub(crate) mod record;
pub(crate) mod simulate;
pub(crate) mod statistics;
pub(crate) mod table;
pub(crate) mod terminal;
pub(crate) mod time_grid;

//! Parameter sweeps over many processes, of one machine or of a cluster.
//!
//! [`Ensemble`](eem_runtime::Ensemble) fills one machine. Beyond it there are engines: Slurm, PBS, HyperQueue, GNU
//! parallel, MPI. Members do not talk to each other, so that this crate brings no engine and fits all of them: every
//! process is the same program with another `--shard`, and all that they share is a directory.
//!
//! | what | where |
//! |---|---|
//! | what members differ in | [`Inputs`], [`Row`] |
//! | what is kept of them | [`Record`], [`Failure`] |
//! | the sweep | [`Plan`], [`Sweep`] |
//! | the command line | [`main`](fn@main), [`Command`] |
//!
//! Files of a sweep:
//!
//! | file in the directory | what it has |
//! |---|---|
//! | `sweep.json` | what all processes agree on: digests of program and inputs, settings, columns; written by the first |
//! | `parts/FIRST-LAST.MEMBERS.gGENERATION.SWEEP.CONTENT.csv` | records that a thread has reported, a second of work each; SWEEP and CONTENT are digests |
//! | `progress/SHARD.json` | how far a process is |
//! | `progress/SHARD.PROCESS-CHANCE.begun` | members that a thread is at |
//! | `tables/DIGEST` | empty; a table that was merged, and may be replaced |
//! | `merged.csv`, `merged.csv.json` | the table of all members, and what `merge` has found |
//!
//! A file is written under a temporary name, brought to disk, and only then given its name: it is there whole or not at
//! all. The name of a part has a digest of its contents, so that nothing but the same bytes can take its place, and what
//! is damaged is found when it is read; a table gets its name by a hard link, which fails where the name is taken. A
//! member is *reported* when its part has its name. There are no locks that a killed process could leave behind.
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | change inputs, or which members a process takes | `inputs`, `selection.rs`; `engine.rs` for `--shard auto` |
//! | change files, or what a kill can lose | `files.rs` (naming), `part.rs`, `manifest.rs`, `walk.rs` (which record counts), `begun.rs` (members that kill processes); `tests/sweeps/kills.rs` |
//! | write another format | `format` |
//! | try an engine | the scripts in `cluster` |

#![warn(missing_docs)]
#![allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of members, which are below 2³²"
)]

mod begun;
mod command;
mod digest;
mod each;
mod engine;
mod error;
mod files;
mod format;
mod inputs;
mod job;
mod manifest;
mod merge;
mod part;
mod places;
mod progress;
mod record;
mod run;
mod selection;
mod status;
mod sweep;
mod team;
mod walk;

pub use command::{Again, Command, Join, Leave, Look, Work, execute, main};
pub use engine::EngineError;
pub use error::{Difference, SweepError};
pub use format::Format;
pub use inputs::{InputError, Inputs, Row};
pub use merge::Merged;
pub use progress::ShardProgress;
pub use record::{Failure, FailureKind, Record};
pub use run::{RunOptions, RunReport};
pub use selection::Selection;
pub use status::Status;
pub use sweep::{Plan, Sweep};

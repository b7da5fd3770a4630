//! Parameter sweeps in many processes, on one machine or on a cluster.
//!
//! An [`Ensemble`](eem_runtime::Ensemble) uses the cores of one machine. For more, use a job system (in this crate, an
//! *engine*): Slurm, PBS, HyperQueue, GNU parallel or MPI. The runs of a sweep, its *members*, are independent: every
//! process runs the same program with another `--shard`, and all processes share one directory.
//!
//! | subject | types |
//! |---|---|
//! | inputs of the members | [`Inputs`], [`Row`] |
//! | results | [`Record`], [`Failure`] |
//! | the sweep | [`Plan`], [`Sweep`] |
//! | the command line | [`main`](fn@main), [`Command`] |
//!
//! Files of a sweep:
//!
//! | file in the directory | contents |
//! |---|---|
//! | `sweep.json` | digests of program and inputs, settings, columns; written by the first process, checked by all others |
//! | `parts/FIRST-LAST.MEMBERS.gGENERATION.SWEEP.CONTENT.csv` | records of one batch, about a second of work; SWEEP and CONTENT are digests |
//! | `progress/SHARD.json` | progress of a process |
//! | `progress/SHARD.PROCESS-RANDOM.begun` | members that a thread is working on |
//! | `tables/DIGEST` | empty; marks a merged table that may be replaced |
//! | `merged.csv`, `merged.csv.json` | the table of all members, and what `merge` has verified |
//!
//! A file is written under a temporary name, synced to disk and then renamed, so it is complete or absent. The name of a
//! part contains a digest of its contents: only the same bytes can replace it, and damage is detected on reading. A table
//! gets its name by a hard link, which fails if the name is taken. A member is *reported* when its part has its final
//! name. There are no lock files.
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | change inputs, or which members a process takes | `inputs`, `selection.rs`; `engine.rs` for `--shard auto` |
//! | change files, or what a kill can lose | `files.rs` (naming), `part.rs`, `manifest.rs`, `walk.rs` (which of several records counts), `begun.rs` (members that kill their process); `tests/sweeps/kills.rs` |
//! | write another format | `format` |
//! | test an engine | the scripts in `cluster` |

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

//! What can go wrong with a sweep as a whole, and what to do then.

use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::engine::EngineError;
use crate::inputs::InputError;

/// Why a sweep does not go on. Records that were reported before stay on disk.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A file cannot be written or read.
    #[error("cannot {action} {}: {source}{}", path.display(), advice(source))]
    File {
        /// What was tried.
        action: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// Why it failed.
        source: io::Error,
    },
    /// The directory holds another sweep: another program, inputs or settings.
    #[error(
        "{} holds another sweep: {}. Take another directory, or run the program, inputs and settings that began this one",
        directory.display(), list(differences))]
    Different {
        /// The directory.
        directory: PathBuf,
        /// What differs.
        differences: Vec<Difference>,
    },
    /// There is no sweep in the directory.
    #[error("{} holds no sweep; `run` begins one", directory.display())]
    NoSweep {
        /// The directory.
        directory: PathBuf,
    },
    /// A part of another sweep lies among those of this one.
    #[error(
        "{} belongs to the sweep {found}, this one is {expected}; move the file away",
        path.display()
    )]
    ForeignPart {
        /// The file.
        path: PathBuf,
        /// The digest in its name.
        found: String,
        /// The digest of this sweep.
        expected: String,
    },
    /// A file is not what this crate has written.
    #[error("{} is damaged: {reason}; move it away and run its members again", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Two processes have run the same member and got different bits.
    #[error(
        "member {member} has other bits in {} than in {}: the program does not depend on its inputs alone, or the \
         machines compute differently",
        first.display(), second.display())]
    Conflict {
        /// The id of the member.
        member: u64,
        /// A part with it.
        first: PathBuf,
        /// Another one.
        second: PathBuf,
    },
    /// Members are missing.
    #[error(
        "{} lacks {missing} of {members} members: {which}; `run` fills the gaps",
        directory.display()
    )]
    Incomplete {
        /// The directory.
        directory: PathBuf,
        /// How many are missing.
        missing: usize,
        /// How many there should be.
        members: usize,
        /// The ids that are missing, the first ones of many.
        which: String,
    },
    /// The file to be written exists, and is none that this sweep has merged.
    #[error("{} exists and was not merged from this sweep; move it away, or choose another name with --into", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A member that was asked for does not exist.
    #[error("there is no member {member}; ids go from {first} to {last}")]
    UnknownMember {
        /// The id.
        member: u64,
        /// The smallest id.
        first: u64,
        /// The largest id.
        last: u64,
    },
    /// There are not so many shards.
    #[error("there is no shard {index}/{count}: shards are counted from 0, the last of {count} is {}/{count}", count.saturating_sub(1))]
    NoShard {
        /// The shard.
        index: u64,
        /// How many there are.
        count: u64,
    },
    /// The program cannot read or write Arrow files.
    #[error(
        "the format `arrow` needs the feature `arrow` of the crate `eem`; build with it, or take --format csv"
    )]
    NoArrow,
    /// The shard cannot be told from the environment.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// The inputs cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
}

impl SweepError {
    /// The exit code of a process that ends with this error; see [`main`](fn@crate::main) for all codes.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::File { .. } => 5,
            Self::Incomplete { .. } => 6,
            Self::UnknownMember { .. } | Self::NoShard { .. } | Self::Engine(_) => 2,
            Self::Different { .. }
            | Self::NoSweep { .. }
            | Self::ForeignPart { .. }
            | Self::Damaged { .. }
            | Self::Conflict { .. }
            | Self::Exists { .. }
            | Self::NoArrow
            | Self::Input(_) => 4,
        }
    }
}

/// Something in which a process and the directory that it was given disagree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// What it is: `program`, `inputs`, the name of a setting …
    pub what: String,
    /// What the directory says.
    pub there: String,
    /// What this process says.
    pub here: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, there, here } = self;
        write!(f, "{what} is {there} there and {here} here")
    }
}

fn list(differences: &[Difference]) -> String {
    let texts: Vec<String> = differences.iter().map(Difference::to_string).collect();
    texts.join("; ")
}

/// What to do about an error of the file system.
fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "; free space and run the same command again, what was reported stays"
        }
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "; choose a directory that can be written with --dir"
        }
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "; a file is in the way, choose another directory with --dir"
        }
        _ => "",
    }
}

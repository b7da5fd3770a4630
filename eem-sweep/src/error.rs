//! Errors of a sweep as a whole, and what to do about them.

use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::engine::EngineError;
use crate::inputs::InputError;

/// Why a sweep stops. Records that were reported stay on disk.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// A file cannot be written or read.
    #[error("cannot {action} {}: {source}{}", path.display(), advice(action, source))]
    File {
        /// The action that failed.
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
        /// The differences.
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
        "{} belongs to the sweep {found}, this one is {expected}; run it with the program, inputs, settings and format \
         that began the directory, or move the file away if it is none of it",
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
    /// A file was changed, or was not written by this crate.
    #[error("{} is damaged: {reason}; move it away and run its members again", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage.
        reason: String,
    },
    /// The file that says what all processes agree on is not what this crate has written.
    #[error(
        "{} is damaged: {reason}; if no process is beginning this sweep right now, move the file away and run the \
         program, inputs and settings that began it: they write it again, and the parts that are there stay",
        path.display()
    )]
    DamagedManifest {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// Two processes have run the same member and got different bits.
    #[error(
        "member {member} has other bits in {} than in {}: the program does not depend on its inputs alone, or the \
         machines compute differently. Move away the one that is not to count, and `run` again what it alone has",
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
        /// The number of missing members.
        missing: usize,
        /// The number of all members.
        members: usize,
        /// The missing ids, possibly shortened.
        which: String,
    },
    /// The file to be written exists and was not merged by this sweep.
    #[error("{} exists and was not merged from this sweep; move it away, or choose another name with --into", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The target of the table is not a file.
    #[error("{} is no regular file; choose another name with --into", path.display())]
    NoFile {
        /// The path.
        path: PathBuf,
    },
    /// The table would lie among the files of the sweep.
    #[error(
        "{} would be among the files of the sweep in {}; choose another name with --into",
        path.display(), folder.display()
    )]
    OwnFolder {
        /// The table.
        path: PathBuf,
        /// The folder of the sweep.
        folder: PathBuf,
    },
    /// No member has an id in the requested range.
    #[error("no member has an id from {start} to below {end}; ids go from {first} to {last}")]
    NoMembers {
        /// The first id that was asked for.
        start: u64,
        /// The id after the last one.
        end: u64,
        /// The smallest id that there is.
        first: u64,
        /// The largest id that there is.
        last: u64,
    },
    /// A requested member does not exist.
    #[error("there is no member {member}; ids go from {first} to {last}")]
    UnknownMember {
        /// The id.
        member: u64,
        /// The smallest id.
        first: u64,
        /// The largest id.
        last: u64,
    },
    /// A requested shard does not exist.
    #[error("there is no shard {index}/{count}: {}", shards(*count))]
    NoShard {
        /// The shard.
        index: u64,
        /// The number of shards.
        count: u64,
    },
    /// The program cannot read or write Arrow files.
    #[error(
        "the format `arrow` needs the feature `arrow` of the crate `eem`; build with it, or take --format csv"
    )]
    NoArrow,
    /// The environment does not determine the shard.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// The inputs are invalid.
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
            Self::UnknownMember { .. }
            | Self::NoMembers { .. }
            | Self::NoShard { .. }
            | Self::NoFile { .. }
            | Self::OwnFolder { .. }
            | Self::Engine(_) => 2,
            Self::Different { .. }
            | Self::NoSweep { .. }
            | Self::ForeignPart { .. }
            | Self::Damaged { .. }
            | Self::DamagedManifest { .. }
            | Self::Conflict { .. }
            | Self::Exists { .. }
            | Self::NoArrow
            | Self::Input(_) => 4,
        }
    }
}

/// A difference between a process and the directory it was given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Its subject: `program`, `inputs`, the name of a setting, …
    pub what: String,
    /// The value in the directory.
    pub there: String,
    /// The value in this process.
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

/// Which shards there are.
fn shards(count: u64) -> String {
    match count {
        0 => "a sweep has one shard at least, 0/1".to_owned(),
        1 => "the only one is 0/1".to_owned(),
        _ => format!(
            "they are counted from 0, the last of {count} is {}/{count}",
            count - 1
        ),
    }
}

/// What to do about an error of the file system.
fn advice(action: &str, error: &io::Error) -> &'static str {
    let reads = action.starts_with("read");
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "; free space and run the same command again, what was reported stays"
        }
        io::ErrorKind::PermissionDenied if reads => "; give this user the right to read it",
        io::ErrorKind::NotFound if reads => "; run the same command again, and see why it went",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "; choose a place that can be written, with --dir or --into"
        }
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists if !reads => {
            "; a file is in the way, choose another directory with --dir"
        }
        io::ErrorKind::NotFound => "; make the directory, or choose another one",
        _ if reads => "; when it can be read again, run the same command",
        _ => "; when it can be written again, run the same command",
    }
}

//! What can be wrong with a series of files.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::scene::error::SceneError;

/// Why a state cannot be written. It is what an [`io::Error`] of the kind [`InvalidInput`](io::ErrorKind::InvalidInput)
/// has within.
#[derive(Debug, Error)]
pub(super) enum SeriesError {
    /// The name is none of a file.
    #[error(
        "`{0}` is no name of a series: it begins the names of files, so that it must not be empty and has neither `/` nor `\\`; the folder is given apart from it"
    )]
    Name(String),
    /// Another series of the program has these files.
    #[error(
        "`{list}` is already that of another series of this program: give each series a name or a folder of its own",
        list = .0.display()
    )]
    Taken(PathBuf),
    /// The scene had less or more when the series was made.
    #[error(
        "the series has {series_nodes} nodes and {series_elements} elements, and the simulation {run_nodes} and {run_elements}: make the series when everything is in the scene",
        series_nodes = series[0], series_elements = series[1], run_nodes = run[0], run_elements = run[1]
    )]
    OtherCounts {
        /// Nodes and elements.
        series: [usize; 2],
        /// Nodes and elements.
        run: [usize; 2],
    },
    /// The simulation is of another scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl From<SeriesError> for io::Error {
    fn from(error: SeriesError) -> Self {
        Self::new(io::ErrorKind::InvalidInput, error)
    }
}

/// An error of a file or a folder, with its path.
pub(super) fn at(path: &Path) -> impl Fn(io::Error) -> io::Error + '_ {
    |error| io::Error::new(error.kind(), format!("`{}`: {error}", path.display()))
}

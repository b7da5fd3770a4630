//! What all processes of a sweep agree on: written by the first, compared by all others.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::digest::Digest;
use crate::error::{Difference, SweepError};
use crate::files::{self, Draft, failed};
use crate::format::Format;
use crate::part::{PARTS, refuse_foreign};

/// The file in the directory of a sweep.
const NAME: &str = "sweep.json";

/// The layout of files that this version of the crate writes.
const LAYOUT: u32 = 2;

/// How often a file without contents is read again, and the pause before each time.
const LOOKS: u32 = 20;
const PAUSE: Duration = Duration::from_millis(50);

/// What decides the bits of a sweep, and how its files are written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Manifest {
    layout: u32,
    pub(crate) name: String,
    program: String,
    pub(crate) members: usize,
    /// The digest of the inputs.
    inputs: String,
    input_columns: Vec<String>,
    output_columns: Vec<String>,
    /// Scheme, step and Newton's method.
    stepping: BTreeMap<String, String>,
    /// The settings of the caller.
    settings: BTreeMap<String, String>,
    pub(crate) format: Format,
    /// The digest of all the above.
    pub(crate) digest: String,
}

/// What a process knows before it has seen the directory.
#[derive(Clone, Debug)]
pub(crate) struct Identity {
    pub(crate) name: String,
    pub(crate) program: String,
    pub(crate) members: usize,
    pub(crate) inputs: String,
    pub(crate) input_columns: Vec<String>,
    pub(crate) output_columns: Vec<String>,
    pub(crate) stepping: BTreeMap<String, String>,
    pub(crate) settings: BTreeMap<String, String>,
}

impl Manifest {
    fn new(identity: Identity, format: Format) -> Self {
        let mut manifest = Self {
            layout: LAYOUT,
            name: identity.name,
            program: identity.program,
            members: identity.members,
            inputs: identity.inputs,
            input_columns: identity.input_columns,
            output_columns: identity.output_columns,
            stepping: identity.stepping,
            settings: identity.settings,
            format,
            digest: String::new(),
        };
        manifest.digest = manifest.digest();
        manifest
    }

    fn digest(&self) -> String {
        let mut digest = Digest::new();
        for (what, value) in self.items() {
            digest.text(&what);
            digest.text(&value);
        }
        digest.hex()
    }

    /// The names and values by which manifests are compared.
    fn items(&self) -> Vec<(String, String)> {
        let mut items = vec![
            ("layout of files".to_owned(), self.layout.to_string()),
            ("name".to_owned(), self.name.clone()),
            ("program".to_owned(), self.program.clone()),
            ("number of members".to_owned(), self.members.to_string()),
            ("digest of inputs".to_owned(), self.inputs.clone()),
            (
                "input columns".to_owned(),
                format!("{:?}", self.input_columns),
            ),
            (
                "output columns".to_owned(),
                format!("{:?}", self.output_columns),
            ),
            ("format".to_owned(), self.format.to_string()),
        ];
        items.extend(self.stepping.clone());
        let settings = self.settings.iter();
        items.extend(settings.map(|(name, value)| (format!("setting `{name}`"), value.clone())));
        items
    }

    fn differences(&self, here: &Self) -> Vec<Difference> {
        let (there, here) = (self.items(), here.items());
        let value = |items: &[(String, String)], what: &str| {
            let mut found = items.iter().filter(|(other, _)| other == what);
            found.next().map_or("absent".to_owned(), |(_, v)| v.clone())
        };
        let mut names: Vec<&String> = there.iter().chain(&here).map(|(what, _)| what).collect();
        names.sort();
        names.dedup();
        let pairs = names.into_iter().map(|what| Difference {
            what: what.clone(),
            there: value(&there, what),
            here: value(&here, what),
        });
        pairs.filter(|pair| pair.there != pair.here).collect()
    }

    /// The manifest of a directory, which must match `identity` and the requested format; written if there is none and
    /// `begin` is true.
    pub(crate) fn agree(
        directory: &Path,
        identity: Identity,
        format: Option<Format>,
        begin: bool,
    ) -> Result<Self, SweepError> {
        let path = directory.join(NAME);
        let mut there = read(&path)?;
        if there.is_none() && begin {
            let manifest = Self::new(identity.clone(), format.unwrap_or_default());
            if !manifest.format.is_available() {
                return Err(SweepError::NoArrow);
            }
            // If the manifest was lost, the same sweep writes it again; another one is refused because of the parts.
            refuse_foreign(&directory.join(PARTS), &manifest.digest)?;
            let text = files::json(&path, &manifest)?;
            let mut draft = Draft::new(&path)?;
            draft.write_all(&text).map_err(failed("write", &path))?;
            // Another process may have been first; the file that is there now counts.
            draft.publish()?;
            there = read(&path)?;
        }
        let Some(there) = there else {
            let directory = directory.to_owned();
            return Err(SweepError::NoSweep { directory });
        };
        let here = Self::new(identity, format.unwrap_or(there.format));
        let differences = there.differences(&here);
        if !differences.is_empty() {
            return Err(SweepError::Different {
                directory: directory.to_owned(),
                differences,
            });
        }
        if !there.format.is_available() {
            return Err(SweepError::NoArrow);
        }
        Ok(there)
    }
}

/// The manifest in a file, if there is one.
fn read(path: &Path) -> Result<Option<Manifest>, SweepError> {
    let damaged = |reason: String| SweepError::DamagedManifest {
        path: path.to_owned(),
        reason,
    };
    let mut looks = 0;
    let bytes = loop {
        match files::read(path)? {
            None => return Ok(None),
            // Without hard links, the file of another process is empty for a moment.
            Some(bytes) if bytes.is_empty() && looks < LOOKS => sleep(PAUSE),
            Some(bytes) => break bytes,
        }
        looks += 1;
    };
    let manifest: Manifest = serde_json::from_slice(&bytes).map_err(|e| damaged(e.to_string()))?;
    if manifest.digest != manifest.digest() {
        return Err(damaged("its digest is not that of its contents".to_owned()));
    }
    Ok(Some(manifest))
}

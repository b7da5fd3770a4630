//! The progress of a process: a file that others can read, and a bar on the terminal after two seconds.

use std::env;
use std::fs;
use std::io::{IsTerminal, stderr};
use std::path::{Path, PathBuf};
use std::process;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use indicatif::{ProgressBar, ProgressStyle};
use serde::{Deserialize, Serialize};

use crate::files::replace_without_sync;

/// How long a run may take before a bar appears.
const PATIENCE: Duration = Duration::from_secs(2);

/// How often the file is written.
const INTERVAL: Duration = Duration::from_secs(1);

/// The progress of a process when it wrote its file last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShardProgress {
    /// Which members it runs: `shard-2-of-8`.
    pub selection: String,
    /// How many it has to run.
    pub members: usize,
    /// How many are done, reported or not.
    pub done: usize,
    /// How many of them have been reported, so that no kill can lose them.
    pub reported: usize,
    /// How many of these have failed.
    pub failed: usize,
    /// The time since the process began, s.
    pub seconds: f64,
    /// When this was written, s since 1970.
    pub updated: u64,
    /// The machine.
    pub host: String,
    /// The process.
    pub process: u32,
}

/// The folder where processes write their progress.
pub(crate) fn folder(directory: &Path) -> PathBuf {
    directory.join("progress")
}

/// Writes and shows the progress of a run.
pub(crate) struct Teller {
    path: PathBuf,
    started: Instant,
    told: Option<Instant>,
    bar: Option<ProgressBar>,
    wants_bar: bool,
    now: ShardProgress,
}

impl Teller {
    /// The progress of a run before its first member.
    pub(crate) fn new(directory: &Path, selection: &str, members: usize, wants_bar: bool) -> Self {
        let folder = folder(directory);
        // Progress is for people. If it cannot be written, nor can records, whose error says why.
        let _reported_by_parts = fs::create_dir_all(&folder);
        let host = env::var("HOSTNAME").ok();
        let host = host.or_else(|| fs::read_to_string("/etc/hostname").ok());
        Self {
            path: folder.join(format!("{selection}.json")),
            started: Instant::now(),
            told: None,
            bar: None,
            wants_bar: wants_bar && stderr().is_terminal(),
            now: ShardProgress {
                selection: selection.to_owned(),
                members,
                done: 0,
                reported: 0,
                failed: 0,
                seconds: 0.0,
                updated: 0,
                host: host.unwrap_or_default().trim().to_owned(),
                process: process::id(),
            },
        }
    }

    /// Sets how many members are done and not reported yet.
    pub(crate) fn at_hand(&mut self, members: usize) {
        self.now.done = self.now.reported + members;
        let is_due = self.told.is_none_or(|told| told.elapsed() >= INTERVAL);
        if is_due {
            self.tell();
        }
    }

    /// A batch has been reported, with so many members and failures.
    pub(crate) fn reported(&mut self, members: usize, failed: usize) {
        self.now.reported += members;
        self.now.failed += failed;
        self.at_hand((self.now.done).saturating_sub(self.now.reported));
    }

    /// Writes the progress for the last time.
    pub(crate) fn finish(&mut self) {
        if self.now.members > 0 {
            self.tell();
        }
    }

    fn tell(&mut self) {
        self.told = Some(Instant::now());
        self.now.seconds = self.started.elapsed().as_secs_f64();
        let clock = SystemTime::now().duration_since(UNIX_EPOCH);
        self.now.updated = clock.map_or(0, |time| time.as_secs());
        let text = serde_json::to_vec(&self.now).unwrap_or_default();
        let _reported_by_parts = replace_without_sync(&self.path, &text);
        self.show();
    }

    fn show(&mut self) {
        if !self.wants_bar || self.started.elapsed() < PATIENCE {
            return;
        }
        let now = &self.now;
        let bar = self
            .bar
            .get_or_insert_with(|| bar(&now.selection, now.members as u64));
        bar.set_position(now.done as u64);
    }
}

impl Drop for Teller {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn bar(label: &str, members: u64) -> ProgressBar {
    let template = "{prefix} [{bar:40}] {pos}/{len} members, {eta} left";
    let style = ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .progress_chars("=> ");
    ProgressBar::new(members)
        .with_style(style)
        .with_prefix(label.to_owned())
}

/// The latest progress of all processes, in the order of their selections; files that cannot be read are left out.
pub(crate) fn of_all_processes(directory: &Path) -> Vec<ShardProgress> {
    let entries = fs::read_dir(folder(directory));
    let paths = entries.into_iter().flatten().flatten().map(|e| e.path());
    let files = paths.filter(|path| path.extension().is_some_and(|end| end == "json"));
    let texts = files.filter_map(|path| fs::read(path).ok());
    let mut all: Vec<ShardProgress> = texts
        .filter_map(|text| serde_json::from_slice(&text).ok())
        .collect();
    all.sort_by(|a, b| (a.selection.len(), &a.selection).cmp(&(b.selection.len(), &b.selection)));
    all
}

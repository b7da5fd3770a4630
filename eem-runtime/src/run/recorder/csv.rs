//! Recorded columns as CSV, with enough digits to restore every bit.

use std::fs::File;
use std::io;
use std::path::Path;

use super::{Column, Recorder};

impl<const D: usize> Recorder<D> {
    /// Writes a header with names and units, then one line per row, separated by commas (RFC 4180).
    ///
    /// Values have 17 significant digits, enough to restore a double. Newton iterations are integers.
    ///
    /// # Errors
    ///
    /// Those of the writer.
    ///
    /// ```
    /// use eem::{Quantity, Recorder, Scene, Scheme, Simulation};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let pivot = scene.anchor([0.1]);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
    /// let recorder = Recorder::new(&run, [("q", Quantity::Position(pivot))])?;
    /// let mut text = Vec::new();
    /// recorder.write_csv(&mut text)?;
    /// assert_eq!(text, b"time (s),q_x (m)\n0.0000000000000000e0,1.0000000000000001e-1\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_csv(&self, writer: impl io::Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(writer);
        writer.write_record(self.columns().iter().map(Column::head))?;
        self.write_rows(0, writer)
    }

    /// Writes header and rows to a file; an existing file is replaced.
    ///
    /// # Errors
    ///
    /// Those of the file system.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let pivot = scene.anchor([0.1]);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
    /// let recorder = Recorder::new(&run, [("q", Quantity::Position(pivot))])?;
    /// let path = std::env::temp_dir().join(format!("rows-{}.csv", std::process::id()));
    /// recorder.save_csv(&path)?;
    /// assert!(std::fs::read_to_string(&path)?.starts_with("time (s),q_x (m)\n"));
    /// # std::fs::remove_file(path)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save_csv(&self, path: impl AsRef<Path>) -> io::Result<()> {
        self.write_csv(File::create(path)?)
    }

    /// Continues the file of an interrupted run: writes the rows without the header and without the first row,
    /// which is the last row of the earlier run.
    ///
    /// For this the recorder of the earlier run must [`record`](Self::record) the state of the checkpoint before it
    /// writes.
    ///
    /// # Errors
    ///
    /// Those of the writer.
    ///
    /// ```
    /// use eem::{Quantity, Recorder, Scene, Scheme, Simulation};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(1.0, [0.5], [2.0]);
    /// let mut run = Simulation::new(scene.clone(), Scheme::EemEntropy, 0.25)?;
    /// let recorder = |run: &Simulation<1>| Recorder::new(run, [("q", Quantity::Position(mass))]);
    ///
    /// let mut text = Vec::new();
    /// let mut rows = recorder(&run)?;
    /// run.run_until_with(0.5, |run, report| rows.observe(run, report))?;
    /// rows.write_csv(&mut text)?;
    /// let saved = run.checkpoint();
    ///
    /// let mut resumed = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
    /// resumed.restore(&saved)?;
    /// let mut rows = recorder(&resumed)?;
    /// resumed.run_until_with(1.0, |run, report| rows.observe(run, report))?;
    /// rows.append_csv(&mut text)?;
    /// assert_eq!(text.iter().filter(|&&byte| byte == b'\n').count(), 1 + 5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn append_csv(&self, writer: impl io::Write) -> io::Result<()> {
        self.write_rows(1, csv::Writer::from_writer(writer))
    }

    fn write_rows(&self, first: usize, mut writer: csv::Writer<impl io::Write>) -> io::Result<()> {
        for row in first..self.rows() {
            writer.write_record(self.columns().iter().map(|column| column.text(row)))?;
        }
        writer.flush()
    }
}

impl Column {
    /// The value in a row.
    fn text(&self, row: usize) -> String {
        let value = self.values[row];
        if self.is_count {
            format!("{value}")
        } else {
            format!("{value:.16e}")
        }
    }
}

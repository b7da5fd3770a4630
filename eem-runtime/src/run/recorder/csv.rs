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
    /// use eem::prelude::*;
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
    /// let run = Simulation::new(Scene::<1>::new(), Scheme::EemEntropy, 0.25)?;
    /// let recorder = Recorder::new(&run, [("E", Quantity::TotalEnergy)])?;
    /// let path = std::env::temp_dir().join(format!("rows-{}.csv", std::process::id()));
    /// recorder.save_csv(&path)?;
    /// assert!(std::fs::read_to_string(&path)?.starts_with("time (s),E (J)\n0.0000000000000000e0,"));
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
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(1.0, [0.5], [2.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
    /// let mut text = Vec::new();
    /// for end in [0.5, 1.0] {
    ///     let mut rows = Recorder::new(&run, [("q", Quantity::Position(mass))])?;
    ///     let is_first = run.time() == 0.0;
    ///     run.run_until_with(end, |run, report| rows.observe(run, report))?;
    ///     if is_first { rows.write_csv(&mut text)? } else { rows.append_csv(&mut text)? }
    /// }
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

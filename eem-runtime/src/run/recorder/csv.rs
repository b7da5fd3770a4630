//! Recorded columns as text that gives back every value bit for bit.

use std::io;

use super::{Column, Recorder};
use crate::number::scalar::Real;

impl<const D: usize, S: Real> Recorder<D, S> {
    /// Writes a header and a line per row, separated by commas (RFC 4180).
    ///
    /// Values have 17 significant digits, which identify a double; Newton iterations are whole
    /// numbers.
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
    /// assert_eq!(text, b"time,q_x\n0.0000000000000000e0,1.0000000000000001e-1\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_csv(&self, writer: impl io::Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(writer);
        writer.write_record(self.columns().iter().map(Column::name))?;
        for row in 0..self.rows() {
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

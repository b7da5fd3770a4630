//! Visits the records of a sweep, for programs that evaluate them.

use std::path::Path;

use crate::error::SweepError;
use crate::inputs::Row;
use crate::record::Failure;
use crate::sweep::Sweep;
use crate::walk::walk;

impl Sweep<'_> {
    /// Visits the reported records, each once, in ascending order of ids: the inputs of a member, and its outputs
    /// in the order of [`Record::COLUMNS`](crate::Record::COLUMNS), or its failure. These are the rows of the
    /// merged table, written or not. Only [`merge`](Self::merge) verifies that none is missing.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::sweep::{Inputs, Plan, RunOptions};
    /// use eem::Scene;
    ///
    /// let inputs = Inputs::grid([("speed", vec![5.0, f64::NAN, 20.0])])?;
    /// let sweep = Plan::new("stones", inputs, Scheme::EemEntropy, 0.1).closures(
    ///     |row| row.number("speed"),
    ///     |&speed| {
    ///         let mut scene = Scene::<1>::new();
    ///         let stone = scene.mass(0.5, [0.0], [speed]);
    ///         (scene, stone)
    ///     },
    ///     |run, stone, _| {
    ///         run.step()?;
    ///         Ok(run.position(stone)?.x)
    ///     },
    /// );
    /// # let directory = std::env::temp_dir().join(format!("eem-each-{}", std::process::id()));
    /// # let _ = std::fs::remove_dir_all(&directory);
    /// sweep.run(&directory, &RunOptions::default())?;
    /// let (mut farthest, mut failed) = ((0, 0.0), Vec::new());
    /// sweep.each(&directory, |row, result| match result {
    ///     Ok(outputs) if outputs[0] > farthest.1 => farthest = (row.id(), outputs[0]),
    ///     Ok(_) => {}
    ///     Err(failure) => failed.push((row.id(), failure.kind.name())),
    /// })?;
    /// assert!(farthest.0 == 2 && (farthest.1 - 2.0_f64).abs() < 1e-14);
    /// assert_eq!(failed, [(1, "scene")]);
    /// # std::fs::remove_dir_all(&directory)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SweepError`] if there is no sweep or another one in the directory, a file of it cannot be read, or a member
    /// has different bits in two parts.
    pub fn each(
        &self,
        directory: &Path,
        mut visit: impl FnMut(Row<'_>, Result<&[f64], &Failure>),
    ) -> Result<(), SweepError> {
        let opened = self.open(directory, None, false)?;
        let shelf = opened.shelf();
        let (mut inputs, mut outputs) = (Vec::new(), Vec::new());
        walk(&shelf, &shelf.parts()?, |record| {
            let failure = record.reader.result(opened.heads(), &mut outputs)?;
            let row = self.inputs().row(record.place, &mut inputs);
            match &failure {
                None => visit(row, Ok(&outputs)),
                Some(failure) => visit(row, Err(failure)),
            }
            Ok(())
        })
    }
}

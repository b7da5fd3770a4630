//! States of a run as files for ParaView.

mod cell;

use core::error::Error;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

use crate::element::handle::Node;
use crate::run::simulation::Simulation;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use cell::{Cell, DATA, Xml, cells, list};

/// Writes states of a run for ParaView: one `.vtu` file per time, and a `.pvd` file that lists them. Open the
/// latter.
///
/// Points are the nodes, with `displacement` (m) relative to the scene and `velocity` (m/s). Cells are springs,
/// cells of solids with means over their integration points, and nodes that belong to neither. Data: `temperature`
/// (K), `internal_energy` (J, sum), `entropy_production` (W/K, sum); for springs `stretch` (m) and `force` (N); for
/// solids `strain_trace` (tr E), `dilatation` (J − 1), `von_mises` (Pa) and the tensors `strain` (E), `stress`
/// (Cauchy, Pa) and `viscous_strain` (Γ). Missing values are NaN; tensors that no cell has are left out. Scenes
/// have at most three dimensions. Values have all their digits.
///
/// ```no_run
/// use eem::VtkSeries;
/// use eem::prelude::*;
///
/// let mut scene = Scene::<2>::new();
/// scene.mass(1.0, [0.0, 0.0], [1.0, 0.0]);
/// let mut series = VtkSeries::new(&scene, "out", "flight");
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
/// for second in 0..=10 {
///     run.run_until(f64::from(second))?;
///     series.write(&run)?;
/// }
/// // out/flight.pvd, out/flight_00000.vtu … out/flight_00010.vtu
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct VtkSeries<const D: usize> {
    folder: PathBuf,
    name: String,
    nodes: Vec<Node>,
    /// Their positions in the scene, m.
    reference: Vec<[f64; 3]>,
    cells: Vec<Cell>,
    times: Vec<f64>,
    /// Whether the files are reserved for this series.
    has_claimed: bool,
}

impl<const D: usize> VtkSeries<D> {
    /// Files `NAME.pvd` and `NAME_00000.vtu`, … in a folder, which is created if necessary. Files of an earlier run
    /// of the program are replaced. Make the series when the scene is complete.
    pub fn new(scene: &Scene<D>, folder: impl Into<PathBuf>, name: impl Into<String>) -> Self {
        const {
            assert!(D <= 3, "ParaView shows at most three dimensions");
        }
        let positions = scene.plan.entries.positions.chunks_exact(D);
        Self {
            folder: folder.into(),
            name: name.into(),
            nodes: (0..scene.plan.entries.nodes.len())
                .map(|at| scene.plan.node_at(at))
                .collect(),
            reference: positions.map(in_space).collect(),
            cells: cells(scene),
            times: Vec::new(),
            has_claimed: false,
        }
    }

    /// Writes the present state and updates the list of times.
    ///
    /// ```
    /// use eem::VtkSeries;
    /// use eem::prelude::*;
    ///
    /// let folder = std::env::temp_dir().join("eem of two series");
    /// let scene = Scene::<2>::new();
    /// let mut series = [(); 2].map(|()| VtkSeries::new(&scene, &folder, "flight"));
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// series[0].write(&run)?;
    /// // It would write over the files of the first.
    /// let error = series[1].write(&run).unwrap_err();
    /// assert!(error.to_string().contains("already that of another series"));
    /// # std::fs::remove_dir_all(folder)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// File errors, with paths. [`io::ErrorKind::InvalidInput`] if `run` belongs to another scene, or to one that
    /// had fewer nodes or elements when the series was made; if the name is empty or contains `/` or `\`; if
    /// another series of this program has written files with this name to the folder.
    pub fn write(&mut self, run: &Simulation<D>) -> io::Result<()> {
        self.check(run)?;
        let text = self.text(run).map_err(invalid)?;
        fs::create_dir_all(&self.folder).map_err(at(&self.folder))?;
        self.claim()?;
        let file = self.folder.join(self.file_of(self.times.len()));
        fs::write(&file, text).map_err(at(&file))?;
        self.times.push(run.time());
        let steps = self.times.iter().enumerate();
        let list = list(steps.map(|(index, &time)| (time, self.file_of(index))));
        let file = self.list_file();
        fs::write(&file, list).map_err(at(&file))
    }

    /// An error unless the name is valid, and the simulation has as many nodes and elements as the scene.
    fn check(&self, run: &Simulation<D>) -> io::Result<()> {
        if self.name.is_empty() || self.name.contains(['/', '\\']) {
            return Err(invalid(format!(
                "`{}` is no name of a series: it begins the names of files, so that it must not be empty and has neither `/` nor `\\`; the folder is given apart from it",
                self.name
            )));
        }
        let elements = self.cells.iter().map(|cell| cell.elements.len());
        let series = [self.nodes.len(), elements.sum()];
        let run = run.counts();
        if series != run {
            return Err(invalid(format!(
                "the series has {} nodes and {} elements, and the simulation {} and {}: make the series when everything is in the scene",
                series[0], series[1], run[0], run[1]
            )));
        }
        Ok(())
    }

    /// Reserves the files for this series.
    fn claim(&mut self) -> io::Result<()> {
        static TAKEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
        if self.has_claimed {
            return Ok(());
        }
        let folder = fs::canonicalize(&self.folder).map_err(at(&self.folder))?;
        let mut taken = TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
        if !taken.insert(folder.join(&self.name)) {
            return Err(invalid(format!(
                "`{}` is already that of another series of this program: give each series a name or a folder of its own",
                self.list_file().display()
            )));
        }
        self.has_claimed = true;
        Ok(())
    }

    fn list_file(&self) -> PathBuf {
        self.folder.join(format!("{}.pvd", self.name))
    }

    fn file_of(&self, index: usize) -> String {
        format!("{}_{index:05}.vtu", self.name)
    }

    /// The text of a `.vtu` with all values of a state.
    fn text(&self, run: &Simulation<D>) -> Result<String, SceneError> {
        let mut xml = Xml::new("UnstructuredGrid");
        let (nodes, cells) = (self.nodes.len(), self.cells.len());
        xml.line("<UnstructuredGrid>");
        xml.line(&format!(
            "<Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\">"
        ));
        let [mut positions, mut moved, mut velocities] = [const { Vec::new() }; 3];
        for (&node, reference) in self.nodes.iter().zip(&self.reference) {
            let position = in_space(run.position(node)?.as_slice());
            velocities.push(in_space(run.velocity(node)?.as_slice()));
            moved.push([0, 1, 2].map(|axis| position[axis] - reference[axis]));
            positions.push(position);
        }
        xml.line("<PointData>");
        xml.numbers("displacement", 3, moved.as_flattened());
        xml.numbers("velocity", 3, velocities.as_flattened());
        xml.line("</PointData>\n<CellData>");
        let mut columns = [const { Vec::new() }; DATA.len()];
        for cell in &self.cells {
            cell.append(run, &mut columns)?;
        }
        for ((name, components), values) in DATA.into_iter().zip(columns) {
            let is_known = |value: &f64| !value.is_nan();
            if components == 1 || values.iter().step_by(components).any(is_known) {
                xml.numbers(name, components, &values);
            }
        }
        xml.line("</CellData>\n<Points>");
        xml.numbers("position", 3, positions.as_flattened());
        xml.line("</Points>\n<Cells>");
        let connectivity = self.cells.iter().flat_map(|cell| &cell.nodes);
        xml.array("Int64", "connectivity", 1, connectivity);
        let ends = self.cells.iter().scan(0, |end, cell| {
            *end += cell.nodes.len();
            Some(*end)
        });
        xml.array("Int64", "offsets", 1, ends);
        xml.array("UInt8", "types", 1, self.cells.iter().map(|cell| cell.kind));
        xml.line("</Cells>\n</Piece>\n</UnstructuredGrid>");
        Ok(xml.end())
    }
}

/// A vector in three dimensions.
fn in_space(vector: &[f64]) -> [f64; 3] {
    core::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}

/// An error that is not one of a file.
fn invalid(error: impl Into<Box<dyn Error + Send + Sync>>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, error)
}

/// An error of a file or a folder, with its path.
fn at(path: &Path) -> impl Fn(io::Error) -> io::Error + '_ {
    |error| io::Error::new(error.kind(), format!("`{}`: {error}", path.display()))
}

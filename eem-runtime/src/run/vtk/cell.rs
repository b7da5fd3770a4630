//! The values of cells in files, and the text of the files: XML of the Visualization Toolkit, version 1.0, with numbers as text.

use core::fmt::{self, Display, Write as _};

use crate::algebra::vector;
use crate::element::handle::Element;
use crate::run::simulation::Simulation;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use nalgebra::SMatrix;

/// The data of cells: names and numbers of components. Symmetric tensors have the order of the format: 11, 22, 33, 12,
/// 23, 13.
pub(super) const DATA: [(&str, usize); 11] = [
    ("temperature", 1),
    ("internal_energy", 1),
    ("entropy_production", 1),
    ("stretch", 1),
    ("force", 1),
    ("strain_trace", 1),
    ("dilatation", 1),
    ("von_mises", 1),
    ("strain", 6),
    ("stress", 6),
    ("viscous_strain", 6),
];

/// A node of no element, a spring, or a cell of a solid.
#[derive(Debug, Default)]
pub(super) struct Cell {
    pub(super) nodes: Vec<usize>,
    /// The number of its shape in the format.
    pub(super) kind: u8,
    /// Its integration points, or the spring; empty for a node.
    pub(super) elements: Vec<Element>,
    is_spring: bool,
    is_thermal: bool,
    has_viscous_strain: bool,
}

impl Cell {
    /// Appends its values in a state to the columns of [`DATA`]: sums of energy and production, means of all others, and
    /// NaN where a cell has no value.
    pub(super) fn append<const D: usize>(
        &self,
        run: &Simulation<D>,
        columns: &mut [Vec<f64>; DATA.len()],
    ) -> Result<(), SceneError> {
        let mut scalars = [f64::NAN; 8];
        let [temperature, energy, production, mechanical @ ..] = &mut scalars;
        let mut tensors = [[f64::NAN; 6]; 3];
        if !self.elements.is_empty() {
            [*energy] = self.sum(|element| Ok([run.internal_energy(element)?]))?;
        }
        if self.is_thermal {
            [*temperature] = self.mean(|element| Ok([run.temperature(element)?]))?;
            [*production] = self.sum(|element| Ok([run.entropy_production(element)?]))?;
        }
        let [stretch, force, of_solid @ ..] = mechanical;
        if self.is_spring {
            [*stretch] = self.mean(|element| Ok([run.stretch(element)?]))?;
            [*force] = self.mean(|element| Ok([run.force(element)?]))?;
        } else if !self.elements.is_empty() {
            *of_solid = self.mean(|element| {
                let state = run.solid_state(element)?;
                let e = |axis| state.strain[(axis, axis)];
                let trace = e(0) + e(1) + e(2);
                Ok([trace, state.dilatation, state.von_mises()])
            })?;
            tensors[0] = self.mean(|element| Ok(components(&run.solid_state(element)?.strain)))?;
            tensors[1] = self.mean(|element| Ok(components(&run.solid_state(element)?.stress)))?;
        }
        if self.has_viscous_strain {
            tensors[2] = self.mean(|element| Ok(components(&run.viscous_strain(element)?)))?;
        }
        let tensors = tensors.iter().map(|tensor| &tensor[..]);
        let values = scalars.chunks_exact(1).chain(tensors);
        for (column, values) in columns.iter_mut().zip(values) {
            column.extend_from_slice(values);
        }
        Ok(())
    }

    /// The sum over its points.
    fn sum<const N: usize>(
        &self,
        of: impl Fn(Element) -> Result<[f64; N], SceneError>,
    ) -> Result<[f64; N], SceneError> {
        let mut total = [0.0; N];
        for &element in &self.elements {
            let values = of(element)?;
            total = vector(|k| total[k] + values[k]);
        }
        Ok(total)
    }

    /// The mean over its points.
    fn mean<const N: usize>(
        &self,
        of: impl Fn(Element) -> Result<[f64; N], SceneError>,
    ) -> Result<[f64; N], SceneError> {
        let points = f64::from(u32::try_from(self.elements.len()).unwrap_or(u32::MAX));
        Ok(self.sum(of)?.map(|sum| sum / points))
    }
}

/// The components of a symmetric tensor.
fn components(tensor: &SMatrix<f64, 3, 3>) -> [f64; 6] {
    let places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
    places.map(|place| tensor[place])
}

/// The cells of a scene in the order of creation, then the nodes that belong to none.
pub(super) fn cells<const D: usize>(scene: &Scene<D>) -> Vec<Cell> {
    let mut cells = Vec::new();
    let mut is_alone = vec![true; scene.plan.entries.nodes.len()];
    let mut next = 0;
    while let Some(entry) = scene.plan.entries.elements.get(next) {
        // An invalid solid has no group; the scene is rejected for it.
        let Some(group) = scene.groups.get(entry.group) else {
            next += 1;
            continue;
        };
        let points = group.points_per_element();
        let shape = group.shape();
        for &node in &entry.nodes {
            is_alone[node] = false;
        }
        cells.push(Cell {
            kind: kind(entry.nodes.len(), D),
            nodes: entry.nodes.clone(),
            elements: (next..next + points)
                .map(|at| scene.element_at(at))
                .collect(),
            is_spring: shape.is_spring,
            is_thermal: shape.thermal,
            has_viscous_strain: shape.viscous_strain > 0,
        });
        next += points;
    }
    let alone = (0..scene.plan.entries.nodes.len()).filter(|&node| is_alone[node]);
    cells.extend(alone.map(|node| Cell {
        nodes: vec![node],
        kind: kind(1, D),
        ..Cell::default()
    }));
    cells
}

/// The number in the format of a shape with this number of nodes.
const fn kind(nodes: usize, dimension: usize) -> u8 {
    match (nodes, dimension) {
        (1, _) => 1,
        (2, _) => 3,
        (4, _) => 9,
        (8, 2) => 23,
        (8, _) => 12,
        (20, _) => 25,
        // As a set of points.
        _ => 2,
    }
}

/// The text of a `.pvd`: the file of each time, s.
pub(super) fn list(files: impl Iterator<Item = (f64, String)>) -> String {
    let mut xml = Xml::new("Collection");
    xml.line("<Collection>");
    for (time, file) in files {
        let file = escaped(&file);
        let time = Number(time);
        xml.line(&format!("<DataSet timestep=\"{time}\" file=\"{file}\"/>"));
    }
    xml.line("</Collection>");
    xml.end()
}

/// A file of some kind.
pub(super) struct Xml(String);

impl Xml {
    pub(super) fn new(kind: &str) -> Self {
        Self(format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        ))
    }

    pub(super) fn line(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    pub(super) fn array<T: Display>(
        &mut self,
        kind: &str,
        name: &str,
        components: usize,
        values: impl Iterator<Item = T>,
    ) {
        self.line(&format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
        ));
        for value in values {
            // Writing to a string does not fail.
            let _ = write!(self.0, "{value} ");
        }
        self.line("\n</DataArray>");
    }

    pub(super) fn numbers(&mut self, name: &str, components: usize, numbers: &[f64]) {
        let numbers = numbers.iter().map(|&number| Number(number));
        self.array("Float64", name, components, numbers);
    }

    pub(super) fn end(mut self) -> String {
        self.line("</VTKFile>");
        self.0
    }
}

/// A number with enough digits to restore it.
struct Number(f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_nan() {
            f.write_str("nan")
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// Text in an attribute of XML.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('"', "&quot;")
}

//! The text of the files: XML of the Visualization Toolkit, version 1.0, with numbers as text.

use core::fmt::{self, Display, Write as _};

/// An unstructured grid with data on points and cells.
#[derive(Debug, Default)]
pub(super) struct Grid {
    /// Positions, m.
    pub(super) points: Vec<[f64; 3]>,
    kinds: Vec<u8>,
    connectivity: Vec<usize>,
    /// The end of the nodes of each cell in `connectivity`.
    offsets: Vec<usize>,
    /// Vectors per point, by name.
    pub(super) vectors: Vec<(&'static str, Vec<[f64; 3]>)>,
    /// Data per cell: names, numbers of components, and all components.
    pub(super) cell_data: Vec<(&'static str, usize, Vec<f64>)>,
}

impl Grid {
    /// Cells of some kinds with their nodes, without points.
    pub(super) fn new<'a>(cells: impl Iterator<Item = (u8, &'a [usize])>) -> Self {
        let mut grid = Self::default();
        for (kind, nodes) in cells {
            grid.kinds.push(kind);
            grid.connectivity.extend_from_slice(nodes);
            grid.offsets.push(grid.connectivity.len());
        }
        grid
    }

    /// The text of a `.vtu`.
    pub(super) fn to_xml(&self) -> String {
        let mut xml = Xml::new("UnstructuredGrid");
        let (points, cells) = (self.points.len(), self.kinds.len());
        xml.line("<UnstructuredGrid>");
        xml.line(&format!(
            "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">"
        ));
        xml.line("<PointData>");
        for (name, vectors) in &self.vectors {
            xml.numbers(name, 3, vectors.as_flattened());
        }
        xml.line("</PointData>\n<CellData>");
        for (name, components, values) in &self.cell_data {
            xml.numbers(name, *components, values);
        }
        xml.line("</CellData>\n<Points>");
        xml.numbers("position", 3, self.points.as_flattened());
        xml.line("</Points>\n<Cells>");
        xml.array("Int64", "connectivity", 1, self.connectivity.iter());
        xml.array("Int64", "offsets", 1, self.offsets.iter());
        xml.array("UInt8", "types", 1, self.kinds.iter());
        xml.line("</Cells>\n</Piece>\n</UnstructuredGrid>");
        xml.end()
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

struct Xml(String);

impl Xml {
    fn new(kind: &str) -> Self {
        Self(format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        ))
    }

    fn line(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    fn array<T: Display>(
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

    fn numbers(&mut self, name: &str, components: usize, numbers: &[f64]) {
        let numbers = numbers.iter().map(|&number| Number(number));
        self.array("Float64", name, components, numbers);
    }

    fn end(mut self) -> String {
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

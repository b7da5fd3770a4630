//! Meshes from files of Gmsh, format 4.1 in ASCII.

mod error;
mod file;

pub use error::{LineFault, MshError};

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::mesh::{Face, Mesh, MeshError};
use crate::shape::Shape;
use eem_material::free_energy::Array;
use file::Block;

/// The nodes of a Gmsh `Hex20` in the order of VTK.
const HEX20: [usize; 20] = [
    0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15,
];

/// The contents of a Gmsh file: nodes, and elements by the tags of their entities. Needs the feature `gmsh`.
///
/// The format is 4.1 in ASCII, which `gmsh -3 -format msh41 part.geo` writes. Tags of entities are those shown by
/// Gmsh; names of physical groups are not read.
///
/// ```
/// use eem::kinematics::Quad4;
/// use eem::{Msh, MshError};
///
/// let file = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
///     $Nodes\n1 4 1 4\n2 7 0 4\n1\n2\n3\n4\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n$EndNodes\n\
///     $Elements\n2 2 1 2\n1 5 1 1\n1 2 3\n2 7 3 1\n2 1 2 3 4\n$EndElements\n";
/// let file = Msh::parse(file)?;
/// let mesh = file.mesh::<Quad4, 2>()?;
/// assert_eq!((mesh.cells().len(), mesh.nodes().len()), (1, 4));
/// // The line with the tag 5 is the side x = 2.
/// assert_eq!(file.face(&mesh, 5)?, mesh.face(|[x, _]| x == 2.0)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Msh {
    /// Positions, m, by tag.
    nodes: BTreeMap<u64, [f64; 3]>,
    blocks: Vec<Block>,
}

impl Msh {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// [`MshError::Read`] if the file cannot be read; [`MshError::Format`] if it is not format 4.1 in ASCII;
    /// [`MshError::Section`], [`MshError::SecondSection`], [`MshError::Unended`] or [`MshError::Outside`] for
    /// damaged sections; [`MshError::Line`] for an invalid line, or a section that contradicts its header.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, MshError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|error| MshError::Read {
            path: path.to_owned(),
            reason: error.to_string(),
        })?;
        // Binary files have a head in ASCII, which tells their format.
        Self::parse(&String::from_utf8_lossy(&bytes))
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    ///
    /// As [`open`](Self::open).
    pub fn parse(text: &str) -> Result<Self, MshError> {
        let (nodes, blocks) = file::read(text)?;
        Ok(Self { nodes, blocks })
    }

    /// All cells of a shape. Lengths in the file are in m.
    ///
    /// # Errors
    ///
    /// [`MshError::WrongElement`] for elements of the same dimension with another shape; [`MshError::NoElements`]
    /// if there are none; [`MshError::NoNode`] and [`MshError::Orphan`] for nodes without position or element;
    /// [`MshError::Plane`] for a plane mesh that does not have a constant z; errors of the [`Mesh`] as
    /// [`MshError::Element`], [`MshError::Elements`], [`MshError::Duplicate`] or [`MshError::Mesh`].
    pub fn mesh<H: Shape<D>, const D: usize>(&self) -> Result<Mesh<H, D>, MshError> {
        self.check_orphans()?;
        self.mesh_from(|_| true, None)
    }

    /// The cells of a shape that belong to the volumes (in the plane, surfaces) with these tags.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::Msh;
    ///
    /// let file = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
    ///     $Nodes\n1 6 1 6\n2 7 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n$EndNodes\n\
    ///     $Elements\n2 2 1 2\n2 7 3 1\n1 1 2 5 4\n2 8 3 1\n2 2 3 6 5\n$EndElements\n";
    /// let file = Msh::parse(file)?;
    /// assert_eq!(file.mesh::<Quad4, 2>()?.cells().len(), 2);
    /// assert_eq!(file.mesh_of::<Quad4, 2>(&[8])?.nodes()[0], [1.0, 0.0]);
    /// assert!(file.mesh_of::<Quad4, 2>(&[9]).is_err());
    /// # Ok::<(), eem::MshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`mesh`](Self::mesh), for these entities, each of which must have elements.
    pub fn mesh_of<H: Shape<D>, const D: usize>(
        &self,
        entities: &[i32],
    ) -> Result<Mesh<H, D>, MshError> {
        let has = |entity| {
            let mut blocks = self.blocks.iter();
            blocks.any(|block| block.dimension == D && block.entity == entity)
        };
        if let Some(&entity) = entities.iter().find(|&&entity| !has(entity)) {
            let (shape, entity) = (H::NAME, Some(entity));
            return Err(MshError::NoElements { shape, entity });
        }
        self.mesh_from(
            |entity| entities.contains(&entity),
            entities.first().copied(),
        )
    }

    /// The faces on the surface of a mesh of this file that belong to the surface (in the plane, line) with this
    /// tag.
    ///
    /// # Errors
    ///
    /// [`MshError::NoFace`] if there are none, or if the mesh has been moved since it was read.
    pub fn face<H: Shape<D>, const D: usize>(
        &self,
        mesh: &Mesh<H, D>,
        entity: i32,
    ) -> Result<Face, MshError> {
        // Nodes of a mesh have the positions of the file, bit by bit; −0 and 0 are the same.
        let key = |place: [f64; D]| place.map(|coordinate| (coordinate + 0.0).to_bits());
        let of_entity = |block: &&Block| block.dimension + 1 == D && block.entity == entity;
        let blocks = self.blocks.iter().filter(of_entity);
        let elements = blocks.flat_map(|block| &block.elements);
        let keys = elements.map(|(_, nodes)| {
            let places = nodes.iter().filter_map(|node| self.nodes.get(node));
            let keys = places.map(|place| key(core::array::from_fn(|axis| place[axis])));
            keys.collect()
        });
        let wanted: BTreeSet<BTreeSet<[u64; D]>> = keys.collect();
        let mut sides = mesh.surface();
        sides.retain(|&side| {
            let places = mesh.nodes_of(side).map(|node| key(mesh.nodes()[node]));
            wanted.contains(&places.collect::<BTreeSet<_>>())
        });
        mesh.face_of(sides).map_err(|_| MshError::NoFace { entity })
    }

    /// The mesh of the wanted entities; `entity` names them in an error.
    fn mesh_from<H: Shape<D>, const D: usize>(
        &self,
        wanted: impl Fn(i32) -> bool,
        entity: Option<i32>,
    ) -> Result<Mesh<H, D>, MshError> {
        let shape = H::NAME;
        let mut cells = Vec::new();
        let blocks = self.blocks.iter();
        for block in blocks.filter(|block| block.dimension == D && wanted(block.entity)) {
            if block.kind.name != shape {
                return Err(MshError::WrongElement {
                    entity: block.entity,
                    found: block.kind.name,
                    shape,
                });
            }
            cells.extend(&block.elements);
        }
        if cells.is_empty() {
            return Err(MshError::NoElements { shape, entity });
        }
        let tags: BTreeSet<u64> = cells.iter().flat_map(|(_, nodes)| nodes).copied().collect();
        let tags: Vec<u64> = tags.into_iter().collect();
        let places = self.places(&tags)?;
        let mut named = Vec::new();
        for (element, nodes) in &cells {
            let mut cell = H::PerNode::filled(0);
            for (at, to) in cell.as_mut().iter_mut().enumerate() {
                let node = nodes[if shape == "Hex20" { HEX20[at] } else { at }];
                *to = tags.binary_search(&node).unwrap_or(usize::MAX);
                if !self.nodes.contains_key(&node) {
                    let element = *element;
                    return Err(MshError::NoNode { element, node });
                }
            }
            named.push(cell);
        }
        let tag = |&cell: &usize| cells[cell].0;
        let tags_of = |cells: &[usize]| cells.iter().map(tag).collect();
        Mesh::new(places, named).map_err(|error| match &error {
            MeshError::InsideOut { cell, .. }
            | MeshError::InsideOutAtNode { cell, .. }
            | MeshError::Repeated { cell, .. } => {
                let element = tag(cell);
                MshError::Element { element, error }
            }
            MeshError::SameNodes { cells } | MeshError::SameSide { cells, .. } => {
                let elements = tags_of(cells);
                MshError::Elements { elements, error }
            }
            MeshError::CrowdedFace { cells, .. } => {
                let elements = tags_of(cells);
                MshError::Elements { elements, error }
            }
            MeshError::Duplicate { nodes } => MshError::Duplicate {
                nodes: nodes.map(|node| tags[node]),
            },
            _ => MshError::Mesh(error),
        })
    }

    /// The positions of nodes; in the plane all must have the same z.
    fn places<const D: usize>(&self, tags: &[u64]) -> Result<Vec<[f64; D]>, MshError> {
        let mut height = None;
        let mut places = Vec::new();
        for &node in tags {
            let place = self.nodes.get(&node).copied().unwrap_or_default();
            if D == 2 {
                let z = place[2];
                let first = *height.get_or_insert(z);
                if (z - first).abs() > 0.0 {
                    return Err(MshError::Plane { node, z, first });
                }
            }
            places.push(core::array::from_fn(|axis| place[axis]));
        }
        Ok(places)
    }

    /// An error unless every node belongs to an element, which may be a point.
    fn check_orphans(&self) -> Result<(), MshError> {
        let elements = self.blocks.iter().flat_map(|block| &block.elements);
        let named: BTreeSet<u64> = elements.flat_map(|(_, nodes)| nodes).copied().collect();
        match self.nodes.keys().find(|node| !named.contains(node)) {
            Some(&node) => Err(MshError::Orphan { node }),
            None => Ok(()),
        }
    }
}

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// All cells of this shape in a Gmsh file, whose lengths are in m. For parts and faces use [`Msh`]. Needs the
    /// feature `gmsh`.
    ///
    /// ```
    /// use eem::kinematics::Hex8;
    /// use eem::{Mesh, MshError};
    ///
    /// let error = Mesh::<Hex8, 3>::from_msh("no such file.msh").unwrap_err();
    /// assert!(matches!(error, MshError::Read { .. }));
    /// ```
    ///
    /// # Errors
    ///
    /// Those of [`Msh::open`] and [`Msh::mesh`].
    pub fn from_msh(path: impl AsRef<Path>) -> Result<Self, MshError> {
        Msh::open(path)?.mesh()
    }
}

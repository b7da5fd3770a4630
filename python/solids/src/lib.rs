//! Solids of texts in two and three dimensions: the solver is compiled for each of their shapes here and nowhere else.

use eem::kinematics::{Hex8, Quad4};
use eem::typed::{Law, LawError, solid};
use eem::{Bulk, Element, Mesh, MeshError, Node, Scene};

/// A scene that takes solids of some laws.
pub trait Solids<const D: usize> {
    /// Puts a solid with these places, m, and cells into the scene, in the plane with a thickness, m: its nodes and points.
    ///
    /// # Errors
    ///
    /// [`Refused`], which says why.
    fn add_solid(
        &mut self,
        law: &Law,
        places: Vec<[f64; D]>,
        cells: &[usize],
        section: (Bulk<D>, f64),
    ) -> Result<Parts, Refused>;
}

/// The nodes of a solid in the order of its mesh, and its points cell by cell.
pub type Parts = (Vec<Node>, Vec<Element>);

/// Why there is no such solid.
#[derive(Clone, Debug, PartialEq)]
pub enum Refused {
    /// Its law has no values that are finite, or is too large.
    Law(LawError),
    /// Its law has none of the shapes.
    Shape,
    /// Its mesh is not right.
    Mesh(MeshError),
    /// There is no solid on a line.
    Line,
}

/// The laws that there are, for messages.
pub const SHAPES: &str = "a solid made of texts has two of the strains `StrainTrace`, `StrainSquare`, `Dilatation` and \
    `FibreStrain`, with a temperature or without";

/// A law as a material of the first of these types that fits.
macro_rules! first_of {
    ($law:ident, $add:ident, [$($shape:ty),* $(,)?]) => {{
        $(
            match $law.model() {
                Ok(model) => {
                    let model: $shape = model;
                    return Ok($add!(model));
                }
                Err(LawError::Shape { .. }) => {}
                Err(error) => return Err(Refused::Law(error)),
            }
        )*
        Err(Refused::Shape)
    }};
}

macro_rules! solids {
    ($dim:literal, $cell:ty, $corners:literal, $in_section:expr) => {
        impl Solids<$dim> for Scene<$dim> {
            fn add_solid(
                &mut self,
                law: &Law,
                places: Vec<[f64; $dim]>,
                cells: &[usize],
                (bulk, thickness): (Bulk<$dim>, f64),
            ) -> Result<Parts, Refused> {
                let in_section: fn(Bulk<$dim>, f64) -> Bulk<$dim> = $in_section;
                let bulk = in_section(bulk, thickness);
                let cells = cells.as_chunks::<$corners>().0.to_vec();
                let mesh = Mesh::<$cell, $dim>::new(places, cells).map_err(Refused::Mesh)?;
                macro_rules! add {
                    ($model:ident) => {{
                        let body = self.solid($model, &mesh, &bulk);
                        (body.nodes().to_vec(), body.points().to_vec())
                    }};
                }
                first_of!(
                    law,
                    add,
                    [
                        solid!(strains: 2),
                        solid!(strains: 2, temperature: 1),
                    ]
                )
            }
        }
    };
}

solids!(2, Quad4, 4, |bulk, thickness| bulk.thickness(thickness));
solids!(3, Hex8, 8, |bulk, _| bulk);

impl Solids<1> for Scene<1> {
    fn add_solid(
        &mut self,
        _: &Law,
        _: Vec<[f64; 1]>,
        _: &[usize],
        _: (Bulk<1>, f64),
    ) -> Result<Parts, Refused> {
        Err(Refused::Line)
    }
}

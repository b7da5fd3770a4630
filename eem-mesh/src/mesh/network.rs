//! The network of conductances between the integration points of a mesh, per conductivity.
//!
//! The parent cell is divided in proportion to the Gauss weights, so that each point has its own sub-cell. The
//! conductances from its centre c to the centre of a face with the area vector A, and through a face, are
//!
//! ```text
//! t = k |A·d|/d²,   d = c_face − c,   κ = t_a t_b/(t_a + t_b)
//! ```

use super::Mesh;
use super::face::{Face, Skewness, SubFace, facing};
use super::geometry::{area_vector, distance, mean};
use super::grid::indices;
use crate::shape::{Points, Shape};

/// The cuts of the parent cell along each axis, from −1 by Gauss weights.
fn cuts(per_axis: usize) -> &'static [f64] {
    match per_axis {
        2 => &[-1.0, 0.0, 1.0],
        _ => &[-1.0, -4.0 / 9.0, 4.0 / 9.0, 1.0],
    }
}

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// Pairs of points with `κ/k` (m; dimensionless in the plane), within and between cells, and the skewness of their faces.
    #[doc(hidden)]
    #[must_use]
    pub fn network(&self) -> (Vec<([usize; 2], f64)>, Skewness) {
        let pairs = self.pairs_of_faces();
        let skewness = Skewness::of(&pairs, H::PerPoint::<()>::LEN);
        let link = |[a, b]: [SubFace<D>; 2]| {
            let shape_factor = a.shape_factor * b.shape_factor / (a.shape_factor + b.shape_factor);
            ([a.point, b.point], shape_factor)
        };
        (pairs.into_iter().map(link).collect(), skewness)
    }

    /// The number of skew faces between integration points, `|A·d| < 0.95 |A| |d|`, and the number of all of them.
    ///
    /// Conduction follows Fourier's law where the lines between points are normal to the faces. Elsewhere heat
    /// flows along these lines, however fine the mesh is, with the conductivity tensor
    ///
    /// ```text
    /// K = k Σ d̂ ⊗ d̂     d̂ the unit vectors along the lines of the mesh
    /// ```
    ///
    /// instead of k 1. If more than one face in twenty is skew, a solid with a conductivity is rejected, unless
    /// `Bulk::allow_skew_cells` is called.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::Mesh;
    ///
    /// let square = Mesh::<Quad4, 2>::block([2, 2], [[0.0, 1.0]; 2])?;
    /// assert_eq!(square.skew_faces(), (0, 24));
    /// let sheared = square.mapped(|[x, y]| [x + 0.5 * y, y])?;
    /// assert_eq!(sheared.skew_faces(), (24, 24));
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    #[must_use]
    pub fn skew_faces(&self) -> (usize, usize) {
        let skewness = Skewness::of(&self.pairs_of_faces(), H::PerPoint::<()>::LEN);
        (skewness.skew, skewness.faces)
    }

    /// The sub-faces on a face of the mesh.
    #[doc(hidden)]
    #[must_use]
    pub fn outside(&self, face: &Face) -> Vec<SubFace<D>> {
        face.sides
            .iter()
            .flat_map(|&side| self.sub_faces_of(side))
            .collect()
    }

    /// Both sides of each face between two points.
    fn pairs_of_faces(&self) -> Vec<[SubFace<D>; 2]> {
        let mut pairs = Vec::new();
        for cell in 0..self.cells.len() {
            for index in indices([H::PER_AXIS; D]) {
                for axis in (0..D).filter(|&axis| index[axis] + 1 < H::PER_AXIS) {
                    let mut next = index;
                    next[axis] += 1;
                    pairs.push([
                        self.sub_face(cell, index, axis, 1),
                        self.sub_face(cell, next, axis, 0),
                    ]);
                }
            }
        }
        self.for_same_sides(|same| {
            if let &[first, second] = same {
                let [first, second] = [first, second].map(|side| self.sub_faces_of(side));
                pairs.extend(facing(first, &second));
            }
        });
        pairs
    }

    /// The sub-faces on a face of a cell. Faces come in pairs per axis.
    #[doc(hidden)]
    #[must_use]
    pub fn sub_faces_of(&self, [cell, face]: [usize; 2]) -> Vec<SubFace<D>> {
        let (axis, side) = (face / 2, face % 2);
        let end = side * (H::PER_AXIS - 1);
        let outer = indices([H::PER_AXIS; D]).filter(|index| index[axis] == end);
        outer
            .map(|index| self.sub_face(cell, index, axis, side))
            .collect()
    }

    /// The lower (0) or upper (1) face of a sub-cell along an axis.
    fn sub_face(&self, cell: usize, index: [usize; D], axis: usize, side: usize) -> SubFace<D> {
        let cuts = cuts(H::PER_AXIS);
        let middle = index.map(|at| f64::midpoint(cuts[at], cuts[at + 1]));
        // Corners in the order of the bits of their number.
        let corner = |number: usize| {
            let mut place = middle;
            let mut others = 0;
            for along in 0..D {
                let end = if along == axis {
                    side
                } else {
                    others += 1;
                    (number >> (others - 1)) & 1
                };
                place[along] = cuts[index[along] + end];
            }
            self.position(cell, place)
        };
        let corners: Vec<_> = (0..1_usize << (D - 1)).map(corner).collect();
        let area = area_vector::<H, D>(&corners);
        let centre = mean(corners.iter().copied());
        let own = self.position(cell, middle);
        let arm: [f64; D] = core::array::from_fn(|axis| centre[axis] - own[axis]);
        let product = (0..D).fold(0.0, |sum, axis| sum + area[axis] * arm[axis]);
        let product = product.abs();
        let [size, length] = [area, arm].map(|vector| distance(vector, [0.0; D]));
        let axes = index.iter().rev();
        let point = axes.fold(0, |point, at| point * H::PER_AXIS + at);
        SubFace {
            point: cell * H::PerPoint::<()>::LEN + point,
            area: size,
            shape_factor: product / (length * length),
            centre,
            cosine: product / (size * length),
        }
    }

    /// The position of a point of the parent cell, m.
    fn position(&self, cell: usize, place: [f64; D]) -> [f64; D] {
        let mut position = [0.0; D];
        for (a, &node) in self.cells[cell].as_ref().iter().enumerate() {
            let (share, _) = H::function(a, place);
            for (sum, at) in position.iter_mut().zip(self.nodes[node]) {
                *sum += share * at;
            }
        }
        position
    }
}

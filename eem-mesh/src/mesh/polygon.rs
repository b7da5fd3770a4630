//! Meshes of polygons, and refinement.

use super::Mesh;
use super::check::check_finite;
use super::error::MeshError;
use super::geometry::{mean, power_of_two};
use crate::shape::Quad4;

impl Mesh<Quad4, 2> {
    /// A polygon with these corners, m, in order, clockwise or not. It may have re-entrant corners, but no holes.
    ///
    /// It is divided into triangles between its corners, and each triangle into three quadrilaterals: in total
    /// three cells per corner, less six. The cells are far from rectangular; [`refined`](Self::refined) makes them
    /// smaller. For conduction prefer a mesh of rectangles.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::{Mesh, MeshError};
    ///
    /// let angle = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    /// let mesh = Mesh::<Quad4, 2>::polygon(&angle)?;
    /// assert_eq!(mesh.cells().len(), 12);
    ///
    /// let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    /// let error = Mesh::<Quad4, 2>::polygon(&bow).unwrap_err();
    /// assert_eq!(error, MeshError::Crossing { sides: [0, 2] });
    /// # Ok::<(), MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::Place`] if a corner is not finite, [`MeshError::Crossing`] if two sides cross or touch,
    /// [`MeshError::Empty`] if there are fewer than three corners or all are on a line; [`MeshError::Scale`] if
    /// areas overflow or underflow.
    pub fn polygon(corners: &[[f64; 2]]) -> Result<Self, MeshError> {
        check_finite(corners)?;
        // Without this, areas may overflow or underflow.
        let power = power_of_two(corners.as_flattened().iter());
        let scaled: Vec<_> = corners.iter().map(|at| at.map(|x| power * x)).collect();
        check_polygon(&scaled)?;
        let mut order: Vec<usize> = (0..corners.len()).collect();
        if twice_area(&scaled, &order) < 0.0 {
            order.reverse();
        }
        let mut division = Division::of(corners.to_vec());
        for triangle in triangles(&scaled, order)? {
            division.divide(&triangle);
        }
        Self::new(division.nodes, division.cells)
    }

    /// The same mesh with each cell divided into four at the middles of its edges.
    ///
    /// ```
    /// use eem::Mesh;
    /// use eem::kinematics::Quad4;
    ///
    /// let triangle = Mesh::<Quad4, 2>::polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])?;
    /// let finer = triangle.refined()?;
    /// assert_eq!((triangle.cells().len(), triangle.nodes().len()), (3, 7));
    /// assert_eq!((finer.cells().len(), finer.nodes().len()), (12, 19));
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If two nodes coincide after rounding.
    pub fn refined(&self) -> Result<Self, MeshError> {
        let mut division = Division::of(self.nodes.clone());
        for cell in &self.cells {
            division.divide(cell);
        }
        Self::new(division.nodes, division.cells)
    }
}

/// The division of cells into quadrilaterals, one per corner.
#[derive(Debug)]
struct Division {
    nodes: Vec<[f64; 2]>,
    cells: Vec<[usize; 4]>,
    /// For each of the first nodes its edges to later ones: the other end, and the node in the middle.
    edges: Vec<Vec<[usize; 2]>>,
}

impl Division {
    fn of(nodes: Vec<[f64; 2]>) -> Self {
        Self {
            edges: vec![Vec::new(); nodes.len()],
            nodes,
            cells: Vec::new(),
        }
    }

    /// Divides a cell with these corners, counterclockwise.
    fn divide(&mut self, corners: &[usize]) {
        let centre = self.nodes.len();
        let places = corners.iter().map(|&corner| self.nodes[corner]);
        self.nodes.push(mean(places));
        let count = corners.len();
        for (at, &corner) in corners.iter().enumerate() {
            let into = self.middle([corners[(at + count - 1) % count], corner]);
            let out = self.middle([corner, corners[(at + 1) % count]]);
            self.cells.push([corner, out, centre, into]);
        }
    }

    /// The node in the middle of an edge, new if there is none yet.
    fn middle(&mut self, [a, b]: [usize; 2]) -> usize {
        let edges = &mut self.edges[a.min(b)];
        if let Some(&[_, middle]) = edges.iter().find(|edge| edge[0] == a.max(b)) {
            return middle;
        }
        let middle = self.nodes.len();
        edges.push([a.max(b), middle]);
        self.nodes.push(mean([self.nodes[a], self.nodes[b]]));
        middle
    }
}

/// Twice the area of a triangle, m²; positive if counterclockwise.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Twice the area of a polygon, m²; positive if counterclockwise.
fn twice_area(corners: &[[f64; 2]], order: &[usize]) -> f64 {
    let from = corners[order[0]];
    let pairs = order.windows(2);
    pairs.fold(0.0, |sum, pair| {
        sum + cross(from, corners[pair[0]], corners[pair[1]])
    })
}

/// An error unless there are at least three corners, and sides meet only at their common corner.
fn check_polygon(corners: &[[f64; 2]]) -> Result<(), MeshError> {
    let count = corners.len();
    if count < 3 {
        return Err(MeshError::Empty);
    }
    let side = |at: usize| [corners[at], corners[(at + 1) % count]];
    for first in 0..count {
        for second in first + 1..count {
            let meet = if second == first + 1 {
                folds_back(side(first), side(second)[1])
            } else if (second + 1) % count == first {
                folds_back(side(second), side(first)[1])
            } else {
                touch(side(first), side(second))
            };
            if meet {
                let sides = [first, second];
                return Err(MeshError::Crossing { sides });
            }
        }
    }
    Ok(())
}

/// Whether the next side goes back along a side.
fn folds_back([a, b]: [[f64; 2]; 2], c: [f64; 2]) -> bool {
    let along = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    cross(a, b, c) == 0.0 && along <= 0.0
}

/// Whether two sides have a point in common.
fn touch([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let apart = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    let boxes_meet = (0..2).all(|axis| {
        a[axis].min(b[axis]) <= c[axis].max(d[axis]) && c[axis].min(d[axis]) <= a[axis].max(b[axis])
    });
    boxes_meet && !apart(cross(a, b, c), cross(a, b, d)) && !apart(cross(c, d, a), cross(c, d, b))
}

/// Cuts off corners, the triangle nearest to equilateral first, until none is left.
fn triangles(corners: &[[f64; 2]], mut order: Vec<usize>) -> Result<Vec<[usize; 3]>, MeshError> {
    let mut triangles = Vec::new();
    while order.len() >= 3 {
        let count = order.len();
        let around = |at: usize| [count - 1, 0, 1].map(|shift| order[(at + shift) % count]);
        let is_free = |triangle: [usize; 3]| {
            let mut others = order.iter().filter(|other| !triangle.contains(other));
            others.all(|&other| !holds(triangle.map(|at| corners[at]), corners[other]))
        };
        let ears = (0..count).map(|at| (at, roundness(around(at).map(|at| corners[at]))));
        let ears = ears.filter(|&(at, roundness)| roundness > 0.0 && is_free(around(at)));
        let best = ears.max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((at, _)) = best else {
            // The rest has no area.
            return Err(MeshError::Empty);
        };
        triangles.push(around(at));
        order.remove(at);
    }
    Ok(triangles)
}

/// Twice the area of a triangle over the square of its longest side; negative if clockwise.
fn roundness([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let square = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    cross(a, b, c) / square(a, b).max(square(b, c)).max(square(c, a))
}

/// Whether a position is inside a triangle or on its edges.
fn holds([a, b, c]: [[f64; 2]; 3], place: [f64; 2]) -> bool {
    [[a, b], [b, c], [c, a]]
        .iter()
        .all(|&[from, to]| cross(from, to, place) >= 0.0)
}

//! Inertia in the linear systems of the adjoint and the tangents of a step.

use crate::algebra::system::LinearSystem;
use crate::algebra::vector;
use crate::element::layout::Layout;
use crate::element::masses::Masses;

/// The masses with the indices of their matrix entries.
#[derive(Debug)]
pub(super) struct Inertia<const D: usize> {
    pub(super) nodes: Vec<Moving<D>>,
    pairs: Vec<Coupling<D>>,
}

/// A node that moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving<const D: usize> {
    /// Its first coordinate and unknown, and its diagonal entries.
    pub(super) coordinate: usize,
    pub(super) unknown: usize,
    diagonal: [usize; D],
    pub(super) mass: f64,
}

/// The entries of a mass that couples two nodes, in both triangles.
#[derive(Clone, Copy, Debug)]
struct Coupling<const D: usize> {
    places: [[usize; D]; 2],
    mass: f64,
}

impl<const D: usize> Inertia<D> {
    pub(super) fn new(layout: &Layout, masses: &Masses, system: &LinearSystem<1>) -> Self {
        let place = |row: usize, column: usize| {
            vector(|axis| system.place(Some(row + axis), Some(column + axis)))
        };
        let nodes = masses.iter().zip(&layout.nodes).enumerate();
        let nodes = nodes.filter_map(|(node, (mass, unknown))| {
            let unknown = (*unknown)?;
            Some(Moving {
                coordinate: node * D,
                unknown,
                diagonal: place(unknown, unknown),
                mass: mass?,
            })
        });
        let pairs = masses.pairs().iter().filter_map(|pair| {
            let [a, b] = pair.nodes().map(|node| layout.nodes[node]);
            let (a, b) = (a?, b?);
            Some(Coupling {
                places: [place(a, b), place(b, a)],
                mass: pair.mass,
            })
        });
        Self {
            nodes: nodes.collect(),
            pairs: pairs.collect(),
        }
    }

    /// Adds `2M/h` to a matrix.
    pub(super) fn add_to(&self, step: f64, system: &mut LinearSystem<1>) {
        let (values, _) = system.parts();
        let per = 2.0 / step;
        for node in &self.nodes {
            for &place in &node.diagonal {
                values[place] += per * node.mass;
            }
        }
        for pair in &self.pairs {
            for &place in pair.places.as_flattened() {
                values[place] += per * pair.mass;
            }
        }
    }
}

//! Joints: nodes that a solid shares with others, and why a requested joint is rejected.

use crate::element::handle::{Element, Node};
use crate::element::kinematics::Shape;
use crate::scene::body::Body;
use crate::scene::solid_error::SolidError;
use eem_mesh::{Mesh, distance};

/// Another solid, with whose nodes those of a new mesh are merged within a distance.
#[derive(Clone, Debug)]
pub(super) struct Joint<const D: usize> {
    /// The first point of the other solid.
    other: Element,
    /// Sorted by the first coordinate.
    nodes: Vec<Shared<D>>,
    /// The largest distance of merged nodes, m.
    within: f64,
}

/// A node of another solid and its position, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared<const D: usize> {
    pub(super) node: Node,
    place: [f64; D],
}

impl<const D: usize> Joint<D> {
    pub(super) fn new<H: Shape<D>>(other: &Body<H, D>, within: f64) -> Self {
        let places = other.mesh().nodes().iter();
        let nodes = other.nodes().iter().zip(places);
        let mut nodes: Vec<_> = nodes
            .map(|(&node, &place)| Shared { node, place })
            .collect();
        nodes.sort_by(|a, b| a.place[0].total_cmp(&b.place[0]));
        Self {
            other: other.first(),
            nodes,
            within,
        }
    }

    /// The nearest node within the distance from a position, and how far it is, m.
    fn nearest(&self, place: [f64; D]) -> Option<(f64, Shared<D>)> {
        let is_before = |shared: &Shared<D>| place[0] - shared.place[0] > self.within;
        let from = self.nodes.partition_point(is_before);
        let near = self.nodes[from..].iter();
        let near = near.take_while(|shared| shared.place[0] - place[0] <= self.within);
        let near = near.map(|&shared| (distance(place, shared.place), shared));
        let near = near.filter(|(distance, _)| *distance <= self.within);
        near.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The error that no node of a mesh is near enough.
    fn too_far<H: Shape<D>>(&self, mesh: &Mesh<H, D>, element: Element) -> SolidError {
        let unlimited = Self {
            within: f64::INFINITY,
            ..self.clone()
        };
        let places = mesh.nodes().iter();
        let nearest = places.filter_map(|&place| unlimited.nearest(place));
        SolidError::NotJoined {
            elements: [element, self.other],
            within: self.within,
            nearest: nearest.fold(f64::INFINITY, |least, (distance, _)| least.min(distance)),
        }
    }
}

/// For each node of a mesh the node of another solid with which it is merged, if there is one.
pub(super) fn joined<H: Shape<D>, const D: usize>(
    joints: &[Joint<D>],
    mesh: &Mesh<H, D>,
    element: Element,
) -> Result<Vec<Option<Shared<D>>>, SolidError> {
    let mut nearest: Vec<Option<(f64, Shared<D>)>> = vec![None; mesh.nodes().len()];
    for joint in joints {
        let elements = [element, joint.other];
        let within = joint.within;
        if !(within >= 0.0 && within.is_finite()) {
            return Err(SolidError::JointDistance { elements, within });
        }
        let mut is_joined = false;
        for (known, &place) in nearest.iter_mut().zip(mesh.nodes()) {
            let Some(found) = joint.nearest(place) else {
                continue;
            };
            is_joined = true;
            if known.is_none_or(|(distance, _)| found.0 < distance) {
                *known = Some(found);
            }
        }
        if !is_joined {
            return Err(joint.too_far(mesh, element));
        }
    }
    let mut moved = nearest
        .iter()
        .flatten()
        .filter(|(distance, _)| *distance > 0.0);
    if moved.next().is_some() {
        // The mesh must be valid with its nodes in their new positions.
        let places = mesh.nodes().iter().zip(&nearest);
        let places = places.map(|(&place, known)| known.map_or(place, |(_, shared)| shared.place));
        let checked = Mesh::<H, D>::new(places.collect(), mesh.cells().to_vec());
        checked.map_err(|error| SolidError::JoinedNodes {
            element,
            within: joints
                .iter()
                .fold(0.0, |most, joint| joint.within.max(most)),
            error,
        })?;
    }
    let shared = nearest.into_iter().map(|known| Some(known?.1));
    Ok(shared.collect())
}

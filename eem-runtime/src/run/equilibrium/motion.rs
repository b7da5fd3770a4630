//! Descriptions of motions that no force resists.

use core::fmt;

use crate::algebra::jacobi::shortest_solution;
use crate::algebra::vector;
use crate::element::handle::Node;
use crate::scene::Scene;

/// Two motions are the same if they differ by at most this fraction of the largest displacement; the search for a free
/// motion is more accurate.
pub(super) const LIKENESS: f64 = 1e-4;

/// The most nodes in a message.
const MOST_NAMED: usize = 3;

/// The kind of a free motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MotionKind {
    /// All nodes of a connected body move alike.
    Translation,
    /// A connected body rotates.
    Rotation,
    /// A connected body rotates and moves along the axis.
    Screw,
    /// Elements are deformed, or turn about common nodes: a mechanism, or buckling.
    Deformation,
}

impl fmt::Display for MotionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Translation => "a rigid translation",
            Self::Rotation => "a rigid rotation",
            Self::Screw => "a rigid translation with rotation",
            Self::Deformation => "a motion",
        })
    }
}

/// A motion that no force resists, or along which the scene is unstable.
///
/// ```
/// use eem::materials::Hooke;
/// use eem::prelude::*;
/// use eem::{EquilibriumError, MotionKind};
///
/// let mut scene = Scene::<2>::new();
/// let hinge = scene.anchor([0.0, 0.0]);
/// let end = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
/// scene.spring(Hooke { stiffness: 100.0, natural_length: 1.0 }, [hinge, end]);
/// match scene.equilibrium(Equilibrium::new()) {
///     Err(EquilibriumError::Free { motion }) => {
///         assert_eq!(motion.kind, MotionKind::Rotation);
///         assert_eq!(motion.nodes[0].0, end);
///         assert_eq!(motion.nodes[0].1[1].abs(), 1.0);
///     }
///     other => panic!("{other:?}"),
/// }
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMotion {
    /// Its kind.
    pub kind: MotionKind,
    /// The nodes that move and their displacements, of which the largest component is 1; those that move most come
    /// first. Only those of one connected body.
    pub nodes: Vec<(Node, Vec<f64>)>,
    /// `xᵀ K x / xᵀ x` of the displacements x and the tangent stiffness K, N/m.
    pub stiffness: f64,
}

impl fmt::Display for FreeMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of ", self.kind)?;
        for (at, (node, by)) in self.nodes.iter().take(MOST_NAMED).enumerate() {
            let by: Vec<_> = by.iter().map(|x| format!("{:.3}", x + 0.0)).collect();
            let comma = if at > 0 { ", " } else { "" };
            write!(f, "{comma}{node} by ({})", by.join(", "))?;
        }
        match self.nodes.len().saturating_sub(MOST_NAMED) {
            0 => Ok(()),
            more => write!(f, " and of {more} more nodes"),
        }
    }
}

/// The free motion with these displacements of moving nodes, where nodes are at `position`.
pub(super) fn name<const D: usize>(
    scene: &Scene<D>,
    position: impl Fn(usize) -> [f64; D],
    displacements: &[(usize, [f64; D])],
    stiffness: f64,
) -> FreeMotion {
    let mut moved = vec![[0.0; D]; scene.nodes.len()];
    for &(node, by) in displacements {
        moved[node] = by;
    }
    let size = |by: &[f64; D]| by.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let most = (0..moved.len()).max_by(|&a, &b| size(&moved[a]).total_cmp(&size(&moved[b])));
    let body = most.map_or_else(Vec::new, |node| body_of(scene, node));
    let places: Vec<_> = body
        .iter()
        .map(|&node| (position(node), moved[node]))
        .collect();
    let mut nodes: Vec<_> = body
        .into_iter()
        .filter(|&node| size(&moved[node]) > LIKENESS)
        .collect();
    nodes.sort_by(|&a, &b| size(&moved[b]).total_cmp(&size(&moved[a])));
    let nodes = nodes
        .into_iter()
        .map(|node| (scene.node_at(node), moved[node].to_vec()));
    FreeMotion {
        kind: kind_of(&places),
        nodes: nodes.collect(),
        stiffness,
    }
}

/// A node and all nodes that elements connect with it.
fn body_of<const D: usize>(scene: &Scene<D>, node: usize) -> Vec<usize> {
    let mut elements = vec![Vec::new(); scene.nodes.len()];
    for (index, entry) in scene.elements.iter().enumerate() {
        entry
            .nodes
            .iter()
            .for_each(|&node| elements[node].push(index));
    }
    let mut is_known = vec![false; scene.nodes.len()];
    let mut body = vec![node];
    is_known[node] = true;
    let mut next = 0;
    while let Some(&node) = body.get(next) {
        next += 1;
        // Bodies at the same anchor are not connected by it.
        if scene.nodes[node].mass.is_none() {
            continue;
        }
        for &other in elements[node]
            .iter()
            .flat_map(|&at| &scene.elements[at].nodes)
        {
            if !is_known[other] {
                is_known[other] = true;
                body.push(other);
            }
        }
    }
    body
}

/// A position and the displacement there.
type Moved<const D: usize> = ([f64; D], [f64; D]);

/// The mean position and the mean displacement.
fn mean<const D: usize>(places: &[Moved<D>]) -> Moved<D> {
    let mut sums = ([0.0; D], [0.0; D]);
    let mut count = 0.0;
    for (r, by) in places {
        for axis in 0..D {
            sums.0[axis] += r[axis];
            sums.1[axis] += by[axis];
        }
        count += 1.0;
    }
    let (centre, shift) = sums;
    (centre.map(|sum| sum / count), shift.map(|sum| sum / count))
}

/// The kind of the rigid motion `t + W (r − c)` that fits these displacements best, by least squares, with the centre c of the
/// positions r; a deformation if the fit is not close.
fn kind_of<const D: usize>(places: &[Moved<D>]) -> MotionKind {
    let (centre, shift) = mean(places);
    let planes: Vec<_> = (0..D).flat_map(|a| (0..a).map(move |b| [a, b])).collect();
    // The displacement of a place by a unit rotation in a plane.
    let turned = |r: &[f64; D], [a, b]: [usize; 2]| -> [f64; D] {
        vector(|axis| match axis {
            axis if axis == a => r[b] - centre[b],
            axis if axis == b => centre[a] - r[a],
            _ => 0.0,
        })
    };
    let dot = |a: &[f64; D], b: &[f64; D]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut gram = vec![0.0; planes.len() * planes.len()];
    let mut right = vec![0.0; planes.len()];
    for (r, by) in places {
        let turns: Vec<_> = planes.iter().map(|&plane| turned(r, plane)).collect();
        let by = vector(|axis| by[axis] - shift[axis]);
        for (i, one) in turns.iter().enumerate() {
            right[i] += dot(one, &by);
            for (j, other) in turns.iter().enumerate() {
                gram[i * planes.len() + j] += dot(one, other);
            }
        }
    }
    // The cut-off `least` leaves out the rotation of a line about itself.
    let largest = gram.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let turn = shortest_solution(&gram, &right, f64::EPSILON.sqrt() * largest);
    let (mut rotation, mut misfit) = (0.0_f64, 0.0_f64);
    for (r, by) in places {
        let mut turned_by = [0.0; D];
        for (&plane, turn) in planes.iter().zip(turn.iter()) {
            for (sum, x) in turned_by.iter_mut().zip(turned(r, plane)) {
                *sum += turn * x;
            }
        }
        for axis in 0..D {
            rotation = rotation.max(turned_by[axis].abs());
            misfit = misfit.max((by[axis] - shift[axis] - turned_by[axis]).abs());
        }
    }
    if misfit > LIKENESS {
        return MotionKind::Deformation;
    }
    if rotation <= LIKENESS {
        return MotionKind::Translation;
    }
    // In space the axis of W has the components W_21, −W_20, W_10, and a screw moves along it.
    if let ([w10, w20, w21], [x, y, z]) = (&turn[..], &shift[..]) {
        let along: f64 = w21 * x - w20 * y + w10 * z;
        if along.abs() > LIKENESS * turn.iter().map(|w| w * w).sum::<f64>().sqrt() {
            return MotionKind::Screw;
        }
    }
    MotionKind::Rotation
}

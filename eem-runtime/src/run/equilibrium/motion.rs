//! Why there is no state at rest: descriptions of motions that no force resists.

use core::fmt;

use crate::algebra::jacobi::shortest_solution;
use crate::element::handle::{Element, Node};
use crate::scene::entry::ElementEntry;
use crate::scene::error::SceneError;
use crate::step::error::StepFailure;
use eem_material::number::readable::Readable;
use thiserror::Error;

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
/// let ends = [scene.anchor([0.0, 0.0]), scene.mass(1.0, [1.0, 0.0], [0.0, 0.0])];
/// scene.spring(Hooke { stiffness: 100.0, natural_length: 1.0 }, ends);
/// let Err(EquilibriumError::Free { motion }) = scene.equilibrium(Equilibrium::new()) else {
///     panic!("nothing holds it");
/// };
/// let (node, by) = &motion.nodes[0];
/// assert_eq!((motion.kind, *node, by[1].abs()), (MotionKind::Rotation, ends[1], 1.0));
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

/// A scene in a free motion.
pub(super) struct Moved<'a> {
    pub(super) dimension: usize,
    /// Positions and displacements of all nodes, coordinate after coordinate, m.
    pub(super) positions: &'a [f64],
    pub(super) displacements: &'a [f64],
    pub(super) elements: &'a [ElementEntry],
    pub(super) is_mass: &'a dyn Fn(usize) -> bool,
    pub(super) node_at: &'a dyn Fn(usize) -> Node,
}

impl Moved<'_> {
    /// The coordinates of a node.
    fn of<'b>(&self, all: &'b [f64], node: usize) -> &'b [f64] {
        &all[node * self.dimension..][..self.dimension]
    }

    /// The largest component of the displacement of a node.
    fn size(&self, node: usize) -> f64 {
        let by = self.of(self.displacements, node);
        by.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
    }

    /// The description of the motion with this stiffness.
    pub(super) fn name(&self, stiffness: f64) -> FreeMotion {
        let nodes = 0..self.displacements.len() / self.dimension;
        let most = nodes.max_by(|&a, &b| self.size(a).total_cmp(&self.size(b)));
        let mut nodes = most.map_or_else(Vec::new, |node| self.body_of(node));
        let kind = self.kind_of(&nodes);
        nodes.retain(|&node| self.size(node) > LIKENESS);
        nodes.sort_by(|&a, &b| self.size(b).total_cmp(&self.size(a)));
        let named = |&node: &usize| {
            let by = self.of(self.displacements, node);
            ((self.node_at)(node), by.to_vec())
        };
        FreeMotion {
            kind,
            nodes: nodes.iter().map(named).collect(),
            stiffness,
        }
    }

    /// A node and all nodes that elements connect with it.
    fn body_of(&self, node: usize) -> Vec<usize> {
        let nodes = self.positions.len() / self.dimension;
        let mut elements = vec![Vec::new(); nodes];
        for entry in self.elements {
            for &node in &entry.nodes {
                elements[node].push(entry);
            }
        }
        let mut is_known = vec![false; nodes];
        let mut body = vec![node];
        is_known[node] = true;
        let mut next = 0;
        while let Some(&node) = body.get(next) {
            next += 1;
            // Bodies at the same anchor are not connected by it.
            if !(self.is_mass)(node) {
                continue;
            }
            for entry in &elements[node] {
                for &other in &entry.nodes {
                    if !is_known[other] {
                        is_known[other] = true;
                        body.push(other);
                    }
                }
            }
        }
        body
    }

    /// The mean of coordinates over some nodes.
    fn mean(&self, all: &[f64], nodes: &[usize]) -> Vec<f64> {
        let mut sums = vec![0.0; self.dimension];
        let mut count = 0.0;
        for &node in nodes {
            for (sum, x) in sums.iter_mut().zip(self.of(all, node)) {
                *sum += x;
            }
            count += 1.0;
        }
        for sum in &mut sums {
            *sum /= count;
        }
        sums
    }

    /// The kind of the rigid motion `t + W (r − c)` that fits the displacements of some nodes best, by least squares, with the centre c
    /// of their positions r; a deformation if the fit is not close.
    fn kind_of(&self, nodes: &[usize]) -> MotionKind {
        let centre = self.mean(self.positions, nodes);
        let shift = self.mean(self.displacements, nodes);
        let mut planes = Vec::new();
        for a in 0..self.dimension {
            planes.extend((0..a).map(|b| [a, b]));
        }
        // The displacement of a node by a unit rotation in a plane.
        let turned = |node: usize, [a, b]: [usize; 2]| {
            let r = self.of(self.positions, node);
            let mut by = vec![0.0; self.dimension];
            by[a] = r[b] - centre[b];
            by[b] = centre[a] - r[a];
            by
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let count = planes.len();
        let (mut gram, mut right) = (vec![0.0; count * count], vec![0.0; count]);
        for &node in nodes {
            let turns: Vec<_> = planes.iter().map(|&plane| turned(node, plane)).collect();
            let mut by = self.of(self.displacements, node).to_vec();
            for (by, shift) in by.iter_mut().zip(&shift) {
                *by -= shift;
            }
            for (i, one) in turns.iter().enumerate() {
                right[i] += dot(one, &by);
                for (j, other) in turns.iter().enumerate() {
                    gram[i * count + j] += dot(one, other);
                }
            }
        }
        // The cut-off `least` leaves out the rotation of a line about itself.
        let largest = gram.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let turn = shortest_solution(&gram, &right, f64::EPSILON.sqrt() * largest);
        let (mut rotation, mut misfit) = (0.0_f64, 0.0_f64);
        for &node in nodes {
            let mut turned_by = vec![0.0; self.dimension];
            for (&plane, turn) in planes.iter().zip(turn.iter()) {
                for (sum, x) in turned_by.iter_mut().zip(turned(node, plane)) {
                    *sum += turn * x;
                }
            }
            let by = self.of(self.displacements, node);
            for (axis, turned_by) in turned_by.into_iter().enumerate() {
                rotation = rotation.max(turned_by.abs());
                misfit = misfit.max((by[axis] - shift[axis] - turned_by).abs());
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
}

/// Why [`Scene::equilibrium`](crate::Scene::equilibrium) found no stable state at rest. The scene is unchanged.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// The scene is invalid.
    #[error("{}", summary(errors))]
    Scene {
        /// What is wrong with it, at least one error.
        errors: Vec<SceneError>,
    },
    /// A setting is invalid.
    #[error("the {name} is {value}, it must be positive and finite", value = Readable(*value))]
    Setting {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A load at the start is not finite, or an element has no force in the initial state.
    #[error(transparent)]
    Start(StepFailure),
    /// A motion that no force resists: a body without supports, or a mechanism.
    #[error(
        "nothing holds {motion} (stiffness {:.1e} N/m): add supports or springs, or loads that stretch them",
        motion.stiffness
    )]
    Free {
        /// The motion.
        motion: FreeMotion,
    },
    /// Forces are balanced, at least along a motion by which the scene would leave the state: it buckles.
    #[error(
        "the state is unstable: nothing starts {motion}, which has the stiffness {:.3e} N/m; add a small load or change positions along it to find the stable state beside it (the loads were followed up to {:.1} % of them)",
        motion.stiffness, 100.0 * followed
    )]
    Unstable {
        /// The motion.
        motion: FreeMotion,
        /// The share of the loads up to which states were stable.
        followed: f64,
    },
    /// No state was found in which all forces are balanced.
    #[error(
        "no state at rest was found: {residual:.3e} N were left{} (the loads were followed up to {:.1} % of them){}; take more load steps, or start nearer to the state",
        node.map_or_else(String::new, |node| format!(" on {node}")), 100.0 * followed, reason(failure)
    )]
    NotFound {
        /// The node with the largest force out of balance.
        node: Option<Node>,
        /// That force, N.
        residual: f64,
        /// The share of the loads up to which states were found.
        followed: f64,
        /// Why the last attempt failed.
        failure: Box<StepFailure>,
    },
    /// Paths of heat join elements, but none joins them with a reservoir or a thermostat: any temperature is one of
    /// thermal balance.
    #[error(
        "no path of heat joins {element} and its partners with a reservoir or a thermostat, so that their temperature in thermal balance is undetermined; add one, or keep temperatures as they are"
    )]
    Insulated {
        /// The first such element.
        element: Element,
    },
    /// Conductances differ by so much that rounding leaves the temperatures undetermined.
    #[error(
        "rounding leaves the temperatures of thermal balance undetermined: conductances differ by too much"
    )]
    HeatNotBalanced,
}

/// The reason that an element gives why it has no state, as the end of a message.
fn reason(failure: &StepFailure) -> String {
    match failure {
        StepFailure::State(error) => format!(": {error}"),
        _ => String::new(),
    }
}

fn summary(errors: &[SceneError]) -> String {
    let first = errors.first().map_or_else(String::new, ToString::to_string);
    match errors.len().saturating_sub(1) {
        0 => first,
        more => format!("{first} (and {more} more)"),
    }
}

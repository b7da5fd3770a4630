//! The linear systems of a scheme, whose memory is reserved before a scene is changed, and their sparsity patterns.
//!
//! ```text
//! tangent   displacements of the masses and coupled interface temperatures Θ; each iteration
//! secant    one unknown per mass, the same for every axis of space; once per step, D right sides
//! ```
//!
//! Where elements share only nodes, both patterns are the graph of the masses, and the entries of two masses are a block
//! with one row per axis of space.

use crate::algebra::memory::{MemoryLimit, TooLarge};
use crate::algebra::pattern::Pattern;
use crate::algebra::system::LinearSystem;
use crate::element::conduction::{Conduction, Partner};
use crate::element::ends::Ends;
use crate::element::layout::Layout;
use crate::element::loads::PushLine;
use crate::element::tableau::Ending;
use crate::step::scheme::{Closing, Scheme};

/// The linear systems that a scheme solves in a step.
#[derive(Debug)]
pub(crate) struct Systems<const D: usize> {
    /// The system of an iteration.
    pub(crate) tangent: LinearSystem<1>,
    /// The system of a stage, if a scheme ends its steps stage by stage.
    pub(crate) secant: Option<LinearSystem<D>>,
}

impl<const D: usize> Systems<D> {
    /// The systems of a scheme, or an error if one exceeds the memory limit.
    pub(crate) fn new(
        scheme: Scheme,
        (elements, layout): (&Ends, &Layout),
        conduction: &Conduction,
        rockets: &[PushLine],
        limit: MemoryLimit,
    ) -> Result<Self, TooLarge> {
        let mut pattern = if scheme.closing() == Closing::Explicit {
            Pattern::new(0, |_| {})
        } else {
            tangent_pattern(elements, layout, conduction, rockets, D)
        };
        let sets = scheme.sets().len();
        if sets > 1 {
            pattern = pattern.repeated(sets);
        }
        let ending = scheme.tableau().map(|rule| &rule.ending);
        let has_secant = matches!(ending, Some(Ending::StageByStage));
        Ok(Self {
            tangent: LinearSystem::new(&pattern, D, limit)?,
            secant: has_secant
                .then(|| LinearSystem::new(&mass_pattern(elements, layout, &[], D), 1, limit))
                .transpose()?,
        })
    }
}

/// The pattern of the tangent.
///
/// The forces of an element depend on its nodes, on its own Θ and on that of its partners, and
/// so does its own Θ. If there are no Θ, the coordinates of a node are the rows of a block.
fn tangent_pattern(
    elements: &Ends,
    layout: &Layout,
    conduction: &Conduction,
    rockets: &[PushLine],
    dimension: usize,
) -> Pattern {
    if layout.coupled.iter().all(Option::is_none)
        && let Ok(blocks) = mass_pattern(elements, layout, rockets, dimension).in_blocks(dimension)
    {
        return blocks;
    }
    Pattern::new(layout.unknowns, |pair| {
        let mut own = Vec::new();
        for rocket in rockets {
            own.clear();
            for first in nodes_of(rocket, layout) {
                own.extend(first..first + dimension);
            }
            pair_all(&own, pair);
        }
        for (nodes, slots) in elements.iter().zip(&layout.elements) {
            own.clear();
            for &node in nodes {
                if let Some(first) = layout.nodes[node as usize] {
                    own.extend(first..first + dimension);
                }
            }
            let Some(slot) = slots.thermal else {
                pair_all(&own, pair);
                continue;
            };
            own.extend(layout.coupled[slot]);
            pair_all(&own, pair);
            for &row in &own {
                for link in conduction.links(slot) {
                    if let Partner::Slot(partner) = link.partner
                        && let Some(column) = layout.coupled[partner]
                    {
                        pair(row, column);
                    }
                }
            }
        }
    })
}

/// The graph of the masses, whose edges are elements and rockets; without rockets, the pattern of the secant matrix.
fn mass_pattern(
    elements: &Ends,
    layout: &Layout,
    rockets: &[PushLine],
    dimension: usize,
) -> Pattern {
    let masses = layout.nodes.iter().flatten().count();
    Pattern::new(masses, |pair| {
        let mut own = Vec::new();
        for nodes in elements.iter() {
            own.clear();
            for &node in nodes {
                own.extend(layout.nodes[node as usize].map(|first| first / dimension));
            }
            pair_all(&own, pair);
        }
        for rocket in rockets {
            own.clear();
            for first in nodes_of(rocket, layout) {
                own.push(first / dimension);
            }
            pair_all(&own, pair);
        }
    })
}

/// The first unknowns of the nodes of a rocket.
fn nodes_of(rocket: &PushLine, layout: &Layout) -> Vec<usize> {
    let mut unknowns = Vec::new();
    for node in [rocket.node, rocket.tail, rocket.head] {
        unknowns.extend(layout.nodes[node.index]);
    }
    unknowns
}

/// Adds every pair of some unknowns.
fn pair_all(own: &[usize], pair: &mut dyn FnMut(usize, usize)) {
    for &row in own {
        for &column in own {
            if column < row {
                pair(row, column);
            }
        }
    }
}

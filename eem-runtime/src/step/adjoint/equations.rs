//! What the adjoint and the tangents of a step share: inertia and interface temperatures.

use crate::algebra::lu::Singular;
use crate::algebra::system::LinearSystem;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::{Group, PastStep};
use crate::element::layout::Layout;
use crate::element::masses::Masses;

/// Why a step has no adjoint, and no tangents.
pub(crate) enum NoAdjoint {
    /// Its equations do not determine the new state.
    Singular,
    /// An element cannot be in one of the states.
    State(StateError),
}

impl From<StateError> for NoAdjoint {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}

impl From<Singular> for NoAdjoint {
    fn from(_: Singular) -> Self {
        Self::Singular
    }
}

/// The masses with the indices of their matrix entries, and the interface temperatures of a step.
#[derive(Debug)]
pub(super) struct Equations {
    pub(super) moving: Vec<Moving>,
    pairs: Vec<Coupling>,
    pub(super) interface: InterfaceTemperatures,
    /// Whether there are any.
    is_coupled: bool,
}

/// A coordinate of a node that moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving {
    /// Its index, its unknown, and the diagonal entry.
    pub(super) coordinate: usize,
    pub(super) unknown: usize,
    diagonal: usize,
    pub(super) mass: f64,
}

/// The entries of a mass that couples two coordinates, in both triangles.
#[derive(Clone, Copy, Debug)]
struct Coupling {
    places: [usize; 2],
    mass: f64,
}

impl Equations {
    pub(super) fn new(
        dimension: usize,
        layout: &Layout,
        masses: &Masses,
        system: &LinearSystem<1>,
    ) -> Self {
        let place = |row: usize, column: usize| system.place(Some(row), Some(column));
        let (mut moving, mut pairs) = (Vec::new(), Vec::new());
        for (node, (mass, first)) in masses.iter().zip(&layout.nodes).enumerate() {
            let (Some(mass), Some(first)) = (mass, *first) else {
                continue;
            };
            for unknown in first..first + dimension {
                moving.push(Moving {
                    coordinate: node * dimension + (unknown - first),
                    unknown,
                    diagonal: place(unknown, unknown),
                    mass,
                });
            }
        }
        for pair in masses.pairs() {
            if let [Some(a), Some(b)] = pair.nodes().map(|node| layout.nodes[node]) {
                pairs.extend((0..dimension).map(|axis| Coupling {
                    places: [place(a + axis, b + axis), place(b + axis, a + axis)],
                    mass: pair.mass,
                }));
            }
        }
        Self {
            moving,
            pairs,
            interface: InterfaceTemperatures::new(layout.thermal),
            is_coupled: layout.coupled.iter().any(Option::is_some),
        }
    }

    /// Finds the interface temperatures of a step.
    pub(super) fn find_interfaces<const D: usize>(
        &mut self,
        past: &PastStep<'_>,
        groups: &mut [Box<dyn Group<D>>],
    ) -> Result<(), NoAdjoint> {
        if self.is_coupled {
            for group in groups {
                group.find_interfaces(past, &mut self.interface)?;
            }
        }
        Ok(())
    }

    /// Adds `2M/h` to a matrix.
    pub(super) fn add_inertia(&self, step: f64, system: &mut LinearSystem<1>) {
        let (values, _) = system.parts();
        let per = 2.0 / step;
        for of in &self.moving {
            values[of.diagonal] += per * of.mass;
        }
        for pair in &self.pairs {
            for place in pair.places {
                values[place] += per * pair.mass;
            }
        }
    }
}

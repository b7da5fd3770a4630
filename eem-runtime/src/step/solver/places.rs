//! The indices of the unknowns of nodes and of interface temperatures in the global systems.

use crate::algebra::vector;
use crate::element::group::Sites;
use crate::element::masses::Masses;
use eem_material::number::compact::compact;

/// A node that moves.
///
/// Moving nodes come first among the unknowns of a set, in their order: node `i` of them has the rows `D i`
/// to `D i + D − 1` of the set in the tangent and row `i` of the secant matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovingNode<const D: usize> {
    node: u32,
    trial: u32,
    set: u32,
    /// Its first row in the tangent.
    row: u32,
    /// Its diagonal entries in the tangent.
    diagonal: [u32; D],
    /// Its diagonal entry in the secant matrix, if there is one.
    secant_diagonal: u32,
    /// m, kg, and 1/m.
    pub(super) mass: f64,
    pub(super) per_mass: f64,
}

impl<const D: usize> MovingNode<D> {
    #[inline]
    pub(super) fn node(&self) -> usize {
        self.node as usize
    }

    /// The same in a scene with other masses.
    pub(super) fn with_mass(self, masses: &Masses) -> Self {
        let mass = masses.get(self.node()).unwrap_or(self.mass);
        let per_mass = mass.recip();
        Self {
            mass,
            per_mass,
            ..self
        }
    }

    /// Its index in the trial, which has all nodes of every set of unknowns.
    #[inline]
    pub(super) fn in_trial(&self) -> usize {
        self.trial as usize
    }

    /// The set of unknowns to which it belongs.
    #[inline]
    pub(super) fn set(&self) -> usize {
        self.set as usize
    }

    /// Its rows of a vector of the tangent.
    #[inline]
    pub(super) fn rows<'a>(&self, vector: &'a [[f64; 1]]) -> &'a [f64; D] {
        let from = self.row as usize;
        let rows = vector.as_flattened().get(from..from + D);
        rows.and_then(<[f64]>::as_array)
            .unwrap_or_else(|| no_such_row())
    }

    /// The same, mutable.
    #[inline]
    pub(super) fn rows_mut<'a>(&self, vector: &'a mut [[f64; 1]]) -> &'a mut [f64; D] {
        let from = self.row as usize;
        let rows = vector.as_flattened_mut().get_mut(from..from + D);
        rows.and_then(<[f64]>::as_mut_array)
            .unwrap_or_else(|| no_such_row())
    }

    /// Its diagonal entries in the tangent.
    #[inline]
    pub(super) fn diagonal(&self) -> [usize; D] {
        vector(|axis| self.diagonal[axis] as usize)
    }

    /// Its diagonal entry in the secant matrix, if there is one.
    #[inline]
    pub(super) fn secant_diagonal(&self) -> usize {
        self.secant_diagonal as usize
    }
}

#[cold]
fn no_such_row() -> ! {
    unreachable!("rows come from the system")
}

/// A coupled interface temperature.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface {
    /// The thermal slot, and its index in the trial.
    pub(super) slot: usize,
    pub(super) in_trial: usize,
    pub(super) row: usize,
}

/// The moving nodes, which are those with a mass, for a set of unknowns.
pub(super) fn moving<const D: usize>(masses: &Masses, sites: &Sites<'_, D>) -> Vec<MovingNode<D>> {
    let [set, _] = sites.sets;
    let mut moving = Vec::with_capacity(masses.len());
    for (node, (mass, first)) in masses.iter().zip(&sites.layout.nodes).enumerate() {
        let (Some(mass), Some(first)) = (mass, *first) else {
            continue;
        };
        let own = Some(first / D);
        moving.push(MovingNode {
            node: compact(node),
            trial: compact(set * masses.len() + node),
            set: compact(set),
            row: compact(sites.row(Some(first))),
            diagonal: vector(|axis| {
                let unknown = Some(first + axis);
                compact(sites.place(unknown, unknown))
            }),
            secant_diagonal: compact(sites.secant_place(own, own)),
            mass,
            per_mass: mass.recip(),
        });
    }
    moving
}

/// The coupled interface temperatures.
pub(super) fn interfaces<const D: usize>(sites: &Sites<'_, D>) -> Vec<Interface> {
    let first = sites.sets[0] * sites.layout.thermal;
    let mut interfaces = Vec::new();
    for (slot, unknown) in sites.layout.coupled.iter().enumerate() {
        if unknown.is_some() {
            interfaces.push(Interface {
                slot,
                in_trial: first + slot,
                row: sites.row(*unknown),
            });
        }
    }
    interfaces
}

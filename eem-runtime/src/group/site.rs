//! Where the elements write in the global systems, found once per scene.

use super::Sites;
use crate::conduction::Partner;
use crate::free_energy::Array;
use crate::kinematics::Kinematics;
use crate::scalar::Real;

/// The places of one element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site<K: Kinematics<S, D>, S: Real, const D: usize> {
    pub(super) nodes: K::PerNode<usize>,
    /// Whether the nodes move with the unknowns; anchors do not.
    pub(super) is_mass: K::PerNode<bool>,
    /// The first row of each node in the tangent.
    pub(super) rows: K::PerNode<usize>,
    /// The first entry of each row of the block of two nodes in the tangent.
    pub(super) blocks: K::PerNode<K::PerNode<[usize; D]>>,
    /// The row of each node in the secant system.
    pub(super) secant_rows: K::PerNode<usize>,
    /// The entry of two nodes in the secant matrix.
    pub(super) secant: K::PerNode<K::PerNode<usize>>,
    /// Which of the contacts of the group it is, if the element conducts heat to others.
    pub(super) contact: Option<usize>,
}

/// The places of an element whose algorithmic temperature Θ its neighbours see.
#[derive(Clone, Debug)]
pub(super) struct Contact<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// The row of Θ.
    pub(super) unknown: usize,
    pub(super) diagonal: usize,
    /// The first entry of each node in the row of Θ.
    pub(super) row: K::PerNode<usize>,
    /// The entries of the rows of each node in the column of Θ.
    pub(super) column: Column<K, S, D>,
    pub(super) partners: Vec<PartnerSite<K, S, D>>,
}

/// An entry per row of a node.
pub(super) type Column<K, S, const D: usize> = <K as Kinematics<S, D>>::PerNode<[usize; D]>;

/// A path of heat to another element.
#[derive(Clone, Debug)]
pub(super) struct PartnerSite<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// The row of the partner's Θ.
    pub(super) unknown: usize,
    /// κ, W/K.
    pub(super) conductance: S,
    /// The entries of the rows of each node in the column of the partner's Θ.
    pub(super) column: Column<K, S, D>,
    /// The entry of the partner's Θ in the row of the own one.
    pub(super) entry: usize,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// The nodes, and no places yet.
    pub(super) fn unconnected(nodes: &[usize]) -> Self {
        let mut own = K::PerNode::filled(0);
        own.as_mut().copy_from_slice(nodes);
        Self {
            nodes: own,
            is_mass: K::PerNode::filled(false),
            rows: K::PerNode::filled(0),
            blocks: K::PerNode::filled(K::PerNode::filled([0; D])),
            secant_rows: K::PerNode::filled(0),
            secant: K::PerNode::filled(K::PerNode::filled(0)),
            contact: None,
        }
    }

    /// The places of an element with these nodes.
    pub(super) fn new(nodes: &[usize], sites: &Sites<'_, S, D>) -> Self {
        let unknown = |node: usize| sites.layout.nodes[nodes[node]];
        let mass = |node: usize| unknown(node).map(|first| first / D);
        let mut site = Self::unconnected(nodes);
        for i in 0..nodes.len() {
            site.is_mass[i] = unknown(i).is_some();
            site.rows[i] = sites.row(unknown(i));
            site.secant_rows[i] = sites.secant_row(mass(i));
            for j in 0..nodes.len() {
                site.blocks[i][j] = column::<S, D>(unknown(i), unknown(j), sites);
                site.secant[i][j] = sites.secant_place(mass(i), mass(j));
            }
        }
        site
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Contact<K, S, D> {
    /// The places of an element with these nodes and the thermal slot, if it is coupled.
    pub(super) fn new(
        nodes: &[usize],
        slot: Option<usize>,
        sites: &Sites<'_, S, D>,
    ) -> Option<Self> {
        let slot = slot?;
        let unknown = sites.layout.coupled[slot]?;
        let column_of = |theta: usize| {
            let mut entries = K::PerNode::filled([0; D]);
            for (entry, &node) in entries.as_mut().iter_mut().zip(nodes) {
                *entry = column::<S, D>(sites.layout.nodes[node], Some(theta), sites);
            }
            entries
        };
        let mut row = K::PerNode::filled(0);
        for (place, &node) in row.as_mut().iter_mut().zip(nodes) {
            *place = sites.place(Some(unknown), sites.layout.nodes[node]);
        }
        let partners = sites.conduction.links(slot).iter().filter_map(|link| {
            let Partner::Slot(partner) = link.partner else {
                return None;
            };
            let theta = sites.layout.coupled[partner]?;
            Some(PartnerSite {
                unknown: sites.row(Some(theta)),
                conductance: link.conductance,
                column: column_of(theta),
                entry: sites.place(Some(unknown), Some(theta)),
            })
        });
        Some(Self {
            unknown: sites.row(Some(unknown)),
            diagonal: sites.place(Some(unknown), Some(unknown)),
            row,
            column: column_of(unknown),
            partners: partners.collect(),
        })
    }
}

/// The entries of the rows of a node in one column.
fn column<S: Real, const D: usize>(
    first: Option<usize>,
    column: Option<usize>,
    sites: &Sites<'_, S, D>,
) -> [usize; D] {
    core::array::from_fn(|axis| {
        let row = first.map(|first| first + axis);
        sites.place(row, column)
    })
}

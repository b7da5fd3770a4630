//! Matrix indices of the elements in the global systems, found once per scene.

use crate::element::conduction::Partner;
use crate::element::group::view::Sites;
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::Array;
use eem_material::number::compact::compact;

/// The matrix indices of one element in the tangent.
///
/// The rows of a node have entries in the same columns, so that the entries of a column in them are
/// equally spaced.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site<K: Kinematics<D>, const D: usize> {
    pub(super) nodes: K::PerNode<u32>,
    /// The first row of each node.
    pub(super) rows: K::PerNode<u32>,
    /// The distance of the entries of one column in consecutive rows of each node.
    pub(super) strides: K::PerNode<u32>,
    /// The first entry of the block of two nodes, that of its first row.
    pub(super) blocks: K::PerNode<K::PerNode<u32>>,
    /// Whether the nodes move with the unknowns; anchors do not.
    pub(super) is_mass: K::PerNode<bool>,
}

/// The interface temperature Θ of a point, with its paths of heat to others.
#[derive(Clone, Debug)]
pub(crate) struct HeatContact {
    /// The row of Θ.
    pub(super) unknown: u32,
    pub(super) diagonal: u32,
    pub(super) paths: Vec<HeatPath>,
}

/// The matrix indices of the nodes of an element with the interface temperature of a point.
#[derive(Clone, Debug)]
pub(super) struct ContactSite<K: Kinematics<D>, const D: usize> {
    /// The first entry of each node in the row of Θ.
    pub(super) row: K::PerNode<u32>,
    /// The entry of the first row of each node in the column of Θ.
    pub(super) column: K::PerNode<u32>,
    /// Of each path.
    pub(super) partners: Vec<PartnerSite<K, D>>,
}

/// A path of heat to another element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeatPath {
    /// The partner's thermal slot, and the row of its Θ.
    pub(super) slot: u32,
    pub(super) unknown: u32,
    /// The entry of the partner's Θ in the row of the own Θ.
    pub(super) entry: u32,
    /// The index of the link in the list of all links.
    pub(super) link: u32,
    /// κ, W/K.
    pub(super) conductance: f64,
    /// For the transposed system: the entry of the own Θ in the row of the partner's Θ.
    #[cfg(feature = "gradients")]
    pub(super) entry_back: u32,
}

/// The matrix indices of the nodes of an element with the interface temperature of a partner.
#[derive(Clone, Debug)]
pub(super) struct PartnerSite<K: Kinematics<D>, const D: usize> {
    /// The entry of the first row of each node in the column of the partner's Θ.
    pub(super) column: K::PerNode<u32>,
    /// For the transposed system: the first entry of each node in the row of the partner's Θ.
    #[cfg(feature = "gradients")]
    pub(super) row: K::PerNode<u32>,
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// The nodes, without matrix indices.
    pub(super) fn unconnected(nodes: &[u32]) -> Self {
        let mut own = K::PerNode::filled(0);
        for (own, &node) in own.as_mut().iter_mut().zip(nodes) {
            *own = node;
        }
        Self {
            nodes: own,
            rows: K::PerNode::filled(0),
            strides: K::PerNode::filled(0),
            blocks: K::PerNode::filled(K::PerNode::filled(0)),
            is_mass: K::PerNode::filled(false),
        }
    }

    /// The matrix indices of an element with these nodes.
    pub(super) fn new(nodes: K::PerNode<u32>, sites: &Sites<'_, D>) -> Self {
        let unknown = |node: usize| sites.layout.nodes[nodes[node] as usize];
        let mut site = Self {
            nodes,
            ..Self::unconnected(&[])
        };
        for i in 0..K::PerNode::<u32>::LEN {
            site.is_mass[i] = unknown(i).is_some();
            site.rows[i] = compact(sites.row(unknown(i)));
            site.strides[i] = stride(unknown(i), unknown(i), sites);
            for j in 0..K::PerNode::<u32>::LEN {
                site.blocks[i][j] = compact(sites.place(unknown(i), unknown(j)));
                debug_assert!(
                    unknown(j).is_none()
                        || stride(unknown(i), unknown(j), sites) == site.strides[i],
                    "entries are equally spaced"
                );
            }
        }
        site
    }
}

impl<K: Kinematics<D>, const D: usize> ContactSite<K, D> {
    /// The contact of a point with this thermal slot and nodes, if it is coupled.
    pub(super) fn new(
        nodes: &K::PerNode<u32>,
        slot: Option<usize>,
        sites: &Sites<'_, D>,
    ) -> Option<(HeatContact, Self)> {
        let slot = slot?;
        let unknown = sites.layout.coupled[slot]?;
        let per_node = |place: &dyn Fn(Option<usize>) -> usize| {
            let mut entries = K::PerNode::filled(0);
            for (entry, &node) in entries.as_mut().iter_mut().zip(nodes.as_ref()) {
                *entry = compact(place(sites.layout.nodes[node as usize]));
            }
            entries
        };
        let column_of = |theta: usize| per_node(&|node| sites.place(node, Some(theta)));
        let links = sites.conduction.links(slot).iter();
        let links = links.zip(sites.conduction.first_link(slot)..);
        let (mut paths, mut partners) = (Vec::new(), Vec::new());
        for (link, place) in links {
            let Partner::Slot(partner) = link.partner else {
                continue;
            };
            let Some(theta) = sites.layout.coupled[partner] else {
                continue;
            };
            paths.push(HeatPath {
                slot: compact(partner),
                unknown: compact(sites.row(Some(theta))),
                entry: compact(sites.place(Some(unknown), Some(theta))),
                link: compact(place),
                conductance: link.conductance,
                #[cfg(feature = "gradients")]
                entry_back: compact(sites.place(Some(theta), Some(unknown))),
            });
            partners.push(PartnerSite {
                column: column_of(theta),
                #[cfg(feature = "gradients")]
                row: per_node(&|node| sites.place(Some(theta), node)),
            });
        }
        let contact = HeatContact {
            unknown: compact(sites.row(Some(unknown))),
            diagonal: compact(sites.place(Some(unknown), Some(unknown))),
            paths,
        };
        let own = Self {
            row: per_node(&|node| sites.place(Some(unknown), node)),
            column: column_of(unknown),
            partners,
        };
        Some((contact, own))
    }
}

/// The paths of heat of a contact, if there is one.
pub(super) fn paths_of(contact: Option<&HeatContact>) -> Option<&[HeatPath]> {
    contact.map(|contact| &contact.paths[..])
}

impl HeatContact {
    /// `Σ κ (δΘ_partner − δΘ)`, W.
    #[inline]
    pub(super) fn heat(&self, solution: &[[f64; 1]]) -> f64 {
        let own = solution[self.unknown as usize][0];
        self.paths.iter().fold(0.0, |sum, path| {
            sum + path.conductance * (solution[path.unknown as usize][0] - own)
        })
    }
}

/// The distance between the entries of a column in the first two rows of a node.
fn stride<const D: usize>(
    first: Option<usize>,
    column: Option<usize>,
    sites: &Sites<'_, D>,
) -> u32 {
    let place = |axis: usize| sites.place(first.map(|first| first + axis), column);
    if D == 1 || first.is_none() {
        return 0;
    }
    compact(place(1) - place(0))
}

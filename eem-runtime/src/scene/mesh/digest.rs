//! What tells meshes apart: a number that equal meshes have in common, and others almost certainly do not.

use core::hash::Hasher;
use std::hash::DefaultHasher;

/// A hash of the places of all nodes, bit by bit, and of the nodes of all cells. Two meshes that are not equal have
/// the same one with a probability of 2⁻⁶⁴.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Digest(u64);

impl Digest {
    pub(super) fn of<C: AsRef<[usize]>, const D: usize>(nodes: &[[f64; D]], cells: &[C]) -> Self {
        let mut hasher = DefaultHasher::new();
        hasher.write_usize(nodes.len());
        for coordinate in nodes.as_flattened() {
            // −0 and 0 are one place.
            hasher.write_u64((coordinate + 0.0).to_bits());
        }
        for &node in cells.iter().flat_map(AsRef::as_ref) {
            hasher.write_usize(node);
        }
        Self(hasher.finish())
    }
}

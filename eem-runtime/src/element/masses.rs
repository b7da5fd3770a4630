//! The mass matrix: masses of the nodes, none for anchors, and masses of solids, which couple nodes.

use std::borrow::Cow;

use eem_material::number::compact::compact;

/// The mass matrix, a number for every pair of nodes, kg.
#[derive(Clone, Debug)]
pub(crate) struct Masses {
    /// Its diagonal. That of an anchor is stored as zero, which no other node has.
    own: Vec<f64>,
    /// Off-diagonal entries, once for each pair of nodes that move.
    pairs: Vec<MassPair>,
    /// Entries of solids at anchors: once for each pair with an anchor, and each anchor with itself.
    held: Vec<MassPair>,
}

/// An entry of the mass matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MassPair {
    nodes: [u32; 2],
    /// kg.
    pub(crate) mass: f64,
}

impl MassPair {
    pub(crate) fn nodes(&self) -> [usize; 2] {
        self.nodes.map(|node| node as usize)
    }
}

impl Masses {
    /// From the masses of the nodes, zero for anchors, and pairs, among them the masses of solids at anchors. Entries of the
    /// same pair add up.
    pub(crate) fn new(own: Vec<f64>, mut pairs: Vec<([usize; 2], f64)>) -> Self {
        let mut masses = Self {
            own,
            pairs: Vec::new(),
            held: Vec::new(),
        };
        pairs.sort_by_key(|&(nodes, _)| nodes);
        for (nodes, mass) in pairs {
            let moves = nodes.iter().all(|&node| masses.get(node).is_some());
            let among = if moves {
                &mut masses.pairs
            } else {
                &mut masses.held
            };
            match among.last_mut() {
                Some(last) if last.nodes() == nodes => last.mass += mass,
                _ => among.push(MassPair {
                    nodes: nodes.map(compact),
                    mass,
                }),
            }
        }
        masses
    }

    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.own.len()
    }

    /// The mass of a node, its diagonal entry; `None` for an anchor.
    #[inline]
    pub(crate) fn get(&self, node: usize) -> Option<f64> {
        let mass = self.own[node];
        (mass != 0.0).then_some(mass)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Option<f64>> + Clone + '_ {
        (0..self.len()).map(|node| self.get(node))
    }

    pub(crate) fn anchors(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.len()).filter(|&node| self.get(node).is_none())
    }

    /// Off-diagonal entries of nodes that move.
    pub(crate) fn pairs(&self) -> &[MassPair] {
        &self.pairs
    }

    /// Entries of solids at anchors: pairs with an anchor, and anchors with themselves.
    pub(crate) fn held(&self) -> &[MassPair] {
        &self.held
    }

    /// Whether masses couple nodes: those of solids.
    #[inline]
    pub(crate) fn are_coupled(&self) -> bool {
        !(self.pairs.is_empty() && self.held.is_empty())
    }

    /// The entries of the matrix except the diagonal of the nodes that move, with row and column.
    pub(crate) fn coupled(&self) -> impl Iterator<Item = ([usize; 2], f64)> + '_ {
        let pairs = self.pairs.iter().chain(&self.held);
        pairs.flat_map(|pair| {
            let [i, j] = pair.nodes();
            let other = (i != j).then_some(([j, i], pair.mass));
            [([i, j], pair.mass)].into_iter().chain(other)
        })
    }

    /// The mass on which gravity acts at each node, the sum of a row, kg; at anchors that of solids.
    pub(crate) fn weights(&self) -> Cow<'_, [f64]> {
        let mut weights = Cow::Borrowed(&self.own[..]);
        for ([row, _], mass) in self.coupled() {
            weights.to_mut()[row] += mass;
        }
        weights
    }

    /// `p = M v` of coordinates stored node after node; `momenta` is written.
    pub(crate) fn find_momenta(&self, dimension: usize, velocities: &[f64], momenta: &mut [f64]) {
        for (at, momentum) in momenta.iter_mut().enumerate() {
            *momentum = self.own[at / dimension] * velocities[at];
        }
        for (nodes, mass) in self.coupled() {
            let [row, column] = nodes.map(|node| node * dimension);
            for axis in 0..dimension {
                momenta[row + axis] += mass * velocities[column + axis];
            }
        }
    }
}

//! The impulses of a step, in one of the vectors that are stored for each node.

/// Vectors per node.
pub(crate) const PLACES: usize = 3;

/// The impulses on all nodes, N s.
#[derive(Debug)]
pub(crate) struct Impulses<'a, S, const D: usize> {
    nodes: &'a mut [[[S; D]; PLACES]],
    place: usize,
}

impl<'a, S, const D: usize> Impulses<'a, S, D> {
    #[inline]
    pub(crate) fn new(nodes: &'a mut [[[S; D]; PLACES]], place: usize) -> Self {
        Self { nodes, place }
    }

    #[inline]
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut [S; D]> {
        let place = self.place;
        self.nodes.iter_mut().map(move |node| &mut node[place])
    }

    #[inline]
    pub(crate) fn of(&mut self, node: usize) -> &mut [S; D] {
        &mut self.nodes[node][self.place]
    }
}

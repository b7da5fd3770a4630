//! The impulses of a step, in one of the vectors that are stored for each node.

/// Vectors per node.
pub(crate) const PLACES: usize = 3;

/// The impulses on all nodes, N s.
#[derive(Debug)]
pub(crate) struct Impulses<'a, const D: usize> {
    nodes: &'a mut [[[f64; D]; PLACES]],
    place: usize,
}

impl<'a, const D: usize> Impulses<'a, D> {
    #[inline]
    pub(crate) fn new(nodes: &'a mut [[[f64; D]; PLACES]], place: usize) -> Self {
        Self { nodes, place }
    }

    #[inline]
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut [f64; D]> {
        let place = self.place;
        self.nodes.iter_mut().map(move |node| &mut node[place])
    }

    #[inline]
    pub(crate) fn of(&mut self, node: usize) -> &mut [f64; D] {
        &mut self.nodes[node][self.place]
    }
}

//! The nodes of all elements of a scene.

use eem_material::number::compact::compact;

/// The nodes of each element, in the order of the elements.
#[derive(Clone, Debug)]
pub(crate) struct Ends {
    nodes: Vec<u32>,
    /// The index in `nodes` of the first node of each element, then the number of all.
    starts: Vec<u32>,
}

impl Ends {
    /// No elements yet.
    pub(crate) fn none() -> Self {
        Self {
            nodes: Vec::new(),
            starts: vec![0],
        }
    }

    /// Adds the nodes of the next element.
    pub(crate) fn push(&mut self, nodes: impl IntoIterator<Item = u32>) {
        self.nodes.extend(nodes);
        self.starts.push(compact(self.nodes.len()));
    }

    /// Number of elements.
    pub(crate) const fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The nodes of an element.
    pub(crate) fn of(&self, element: usize) -> &[u32] {
        let [start, end] = [self.starts[element], self.starts[element + 1]];
        &self.nodes[start as usize..end as usize]
    }

    /// The nodes of each element.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.len()).map(|element| self.of(element))
    }
}

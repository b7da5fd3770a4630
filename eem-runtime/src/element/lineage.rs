//! The handles of a scene that may be a copy of another one.

#[cfg(feature = "gradients")]
use super::handle::Reservoir;
use super::handle::{Handle, Kind, Node, SceneId};

/// A scene and its ancestors, of which it is a copy: their handles are valid in it if they are older than the copy.
#[derive(Clone, Debug)]
pub(crate) struct Lineage {
    own: SceneId,
    /// The ancestors, the oldest first, with the number of their handles when they were copied.
    copied: Vec<(SceneId, Counts)>,
}

/// The number of handles of each kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts {
    pub(crate) nodes: usize,
    pub(crate) elements: usize,
    pub(crate) reservoirs: usize,
    pub(crate) paths: usize,
}

impl Counts {
    const fn of(&self, kind: Kind) -> usize {
        match kind {
            Kind::Node => self.nodes,
            Kind::Element => self.elements,
            Kind::Reservoir => self.reservoirs,
            Kind::HeatPath => self.paths,
        }
    }
}

impl Lineage {
    /// A scene without ancestors.
    pub(crate) fn new() -> Self {
        Self {
            own: SceneId::unique(),
            copied: Vec::new(),
        }
    }

    pub(crate) const fn scene(&self) -> SceneId {
        self.own
    }

    /// The lineage of a copy of the scene, which now has these numbers of handles.
    pub(crate) fn copy(&self, counts: Counts) -> Self {
        let mut copied = self.copied.clone();
        copied.push((self.own, counts));
        Self {
            own: SceneId::unique(),
            copied,
        }
    }

    /// Whether a handle is valid in this scene.
    #[inline]
    pub(crate) fn owns<H: Handle>(&self, handle: &H) -> bool {
        handle.scene() == self.own || self.inherits(handle)
    }

    fn inherits<H: Handle>(&self, handle: &H) -> bool {
        let mut copied = self.copied.iter();
        copied
            .any(|(scene, counts)| *scene == handle.scene() && handle.index() < counts.of(H::KIND))
    }

    /// The handle of a node.
    pub(crate) fn node(&self, index: usize) -> Node {
        let scene = self.giver(Kind::Node, index);
        Node { scene, index }
    }

    /// The handle of a reservoir.
    #[cfg(feature = "gradients")]
    pub(crate) fn reservoir(&self, index: usize) -> Reservoir {
        let scene = self.giver(Kind::Reservoir, index);
        Reservoir { scene, index }
    }

    /// The scene that created a handle.
    pub(crate) fn giver(&self, kind: Kind, index: usize) -> SceneId {
        let mut copied = self.copied.iter();
        let giver = copied.find(|(_, counts)| index < counts.of(kind));
        giver.map_or(self.own, |&(scene, _)| scene)
    }
}

//! Which handles are of a scene that may be a copy of another one.

use super::handle::{Handle, Kind, SceneId};

/// A scene, and those that it is a copy of: their handles are also its own, if they are older than the copy.
#[derive(Clone, Debug)]
pub(crate) struct Lineage {
    own: SceneId,
    /// The scenes that it comes from, the first one first, and how much of each kind they had when they were copied.
    copied: Vec<(SceneId, Counts)>,
}

/// How many nodes, elements and reservoirs a scene has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts {
    pub(crate) nodes: usize,
    pub(crate) elements: usize,
    pub(crate) reservoirs: usize,
}

impl Counts {
    const fn of(&self, kind: Kind) -> usize {
        match kind {
            Kind::Node => self.nodes,
            Kind::Element => self.elements,
            Kind::Reservoir => self.reservoirs,
        }
    }
}

impl Lineage {
    /// A scene of its own.
    pub(crate) fn new() -> Self {
        Self {
            own: SceneId::unique(),
            copied: Vec::new(),
        }
    }

    /// The scene itself, which no copy is.
    pub(crate) const fn scene(&self) -> SceneId {
        self.own
    }

    /// That of a copy of the scene, which has so much now.
    pub(crate) fn copy(&self, counts: Counts) -> Self {
        let mut copied = self.copied.clone();
        copied.push((self.own, counts));
        Self {
            own: SceneId::unique(),
            copied,
        }
    }

    /// Whether a handle is of this scene.
    #[inline]
    pub(crate) fn owns<H: Handle>(&self, handle: &H) -> bool {
        handle.scene() == self.own || self.inherits(handle)
    }

    fn inherits<H: Handle>(&self, handle: &H) -> bool {
        let mut copied = self.copied.iter();
        copied
            .any(|(scene, counts)| *scene == handle.scene() && handle.index() < counts.of(H::KIND))
    }

    /// The scene that gave the handle of a kind with a place.
    pub(crate) fn giver(&self, kind: Kind, index: usize) -> SceneId {
        let mut copied = self.copied.iter();
        let giver = copied.find(|(_, counts)| index < counts.of(kind));
        giver.map_or(self.own, |&(scene, _)| scene)
    }
}

//! Handles: what a scene returns for the things put into it.
//!
//! A handle is a small copyable value that contains the id of its scene, so that a handle of another scene is
//! an error and never a wrong node.

use core::fmt;
use core::sync::atomic::{AtomicU32, Ordering};

use eem_material::number::compact::compact;

/// The scene that a handle belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct SceneId(u32);

impl SceneId {
    /// An id that differs from those of the last 2³² scenes of this process.
    pub(crate) fn unique() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// The kinds of handles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Node,
    Element,
    Reservoir,
    HeatPath,
}

/// A handle of any kind.
pub(crate) trait Handle: fmt::Display + Copy {
    const KIND: Kind;

    /// The scene that created it.
    fn scene(&self) -> SceneId;

    /// Its index in the order of creation.
    fn index(&self) -> usize;
}

macro_rules! handle {
    ($(#[$docs:meta])* $name:ident, $text:literal) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name {
            pub(crate) scene: SceneId,
            pub(crate) index: usize,
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($text, " {}"), self.index)
            }
        }

        impl Handle for $name {
            const KIND: Kind = Kind::$name;

            fn scene(&self) -> SceneId {
                self.scene
            }

            fn index(&self) -> usize {
                self.index
            }
        }
    };
}

handle! {
    /// An anchor or a mass of a scene. Shown as `node 0`, counted in the order of creation.
    Node, "node"
}
handle! {
    /// A heat reservoir of a scene. Shown as `reservoir 0`, counted in the order of creation.
    Reservoir, "reservoir"
}
handle! {
    /// A path of heat of a scene. Shown as `path of heat 0`, counted in the order of creation.
    HeatPath, "path of heat"
}

/// A spring of a scene, or an integration point of a solid. Printed as `element 0 (Spring)`: number in the order of
/// creation, and name of the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Element {
    scene: SceneId,
    index: u32,
    model: &'static &'static str,
}

impl Element {
    /// The element with this index in the order of creation.
    pub(crate) fn new(scene: SceneId, index: usize, model: &'static &'static str) -> Self {
        Self {
            scene,
            index: compact(index),
            model,
        }
    }

    /// The name of its model.
    #[must_use]
    pub const fn model(self) -> &'static str {
        self.model
    }

    /// Its index in the order of creation.
    #[inline]
    pub(crate) const fn index(self) -> usize {
        self.index as usize
    }

    /// The element of the same model that was created `count` elements later.
    pub(crate) fn after(self, count: usize) -> Self {
        Self::new(self.scene, self.index() + count, self.model)
    }
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "element {} ({})", self.index, self.model)
    }
}

impl Handle for Element {
    const KIND: Kind = Kind::Element;

    fn scene(&self) -> SceneId {
        self.scene
    }

    fn index(&self) -> usize {
        Self::index(*self)
    }
}

/// A partner for heat conduction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HeatPartner {
    /// Another element.
    Element(Element),
    /// A reservoir.
    Reservoir(Reservoir),
}

impl From<Element> for HeatPartner {
    fn from(element: Element) -> Self {
        Self::Element(element)
    }
}

impl From<Reservoir> for HeatPartner {
    fn from(reservoir: Reservoir) -> Self {
        Self::Reservoir(reservoir)
    }
}

impl fmt::Display for HeatPartner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Element(element) => element.fmt(f),
            Self::Reservoir(reservoir) => reservoir.fmt(f),
        }
    }
}

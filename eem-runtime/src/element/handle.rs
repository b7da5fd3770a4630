//! Handles: what a scene returns for the things put into it.
//!
//! A handle is a small copyable value that knows its scene, so that a handle of another scene is
//! an error and never somebody else's node.

use core::fmt;
use core::sync::atomic::{AtomicU32, Ordering};

use eem_material::number::compact::compact;

/// Which scene a handle belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct SceneId(u32);

impl SceneId {
    /// An identity that none of the last four thousand million scenes of this process has.
    pub(crate) fn unique() -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// What a scene counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Node,
    Element,
    Reservoir,
}

/// A handle of any kind.
pub(crate) trait Handle: fmt::Display + Copy {
    /// What it stands for.
    const KIND: Kind;

    /// The scene that gave it.
    fn scene(&self) -> SceneId;

    /// Its place, in the order of creation.
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

/// A spring of a scene, or an integration point of a solid. Printed as `element 0 (Spring)`: number in the order of
/// creation, and name of the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Element {
    scene: SceneId,
    index: u32,
    model: &'static &'static str,
}

impl Element {
    /// The element with this place in the order of creation.
    pub(crate) fn new(scene: SceneId, index: usize, model: &'static &'static str) -> Self {
        Self {
            scene,
            index: compact(index),
            model,
        }
    }

    /// Its place, in the order of creation.
    #[inline]
    pub(crate) const fn index(self) -> usize {
        self.index as usize
    }

    /// The one that was created so many places after it, of the same model.
    pub(crate) fn after(self, places: usize) -> Self {
        Self {
            index: compact(self.index() + places),
            ..self
        }
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
